"""Sensors of an MQTT broker as inputs of a run, on the package `dolphin`.

`configuration` reads sensors.yaml, `sensor` decides on the pairs that messages and silence lead to; neither needs a
broker. `broker` is the thin part that calls paho-mqtt, `shell` the process.
"""

version = "0.1"
