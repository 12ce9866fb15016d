"""An adapter of Dolphin's platform protocol for ROS 2 robots, on the package `dolphin`.

`configuration_file` reads robots.yaml, `messages` makes and reads messages, `maneuvers` makes goals of plans that
programs describe, `goals` maps requests and results, `robot` is the vehicle; none of them needs ROS. `ros` is the
thin rest that calls rclpy, `shell` the process.
"""

version = "0.1"
