#!/bin/sh
# Runs the tests of the adapter that need no ROS, with python3, or that of DOLPHIN_PYTHON. It needs PyYAML (Debian:
# python3-yaml). `run.sh check_ros`, with the Python of ../install in DOLPHIN_ROS2, runs those on ROS 2.
folder=$(dirname "$0")/..
python=${DOLPHIN_PYTHON:-python3}
case " $* " in *" check_ros "*) python=${DOLPHIN_ROS2:?is the Python of platforms/ros2/install} ;; esac
PYTHONPATH=$(readlink -f "$folder/../../python")
export PYTHONPATH
exec "$python" -B "$folder/../../scripts/unittests" "$folder" "$@"
