"""An adapter of Dolphin's platform protocol for vehicles that speak MAVLink: those of ArduPilot and PX4.

`station` is the pure core: messages, orders and the time go in, messages and reports come out. It has neither sockets
nor a clock. `shell` is the thin rest: sockets, serial lines, standard streams.
"""

version = "0.1"
