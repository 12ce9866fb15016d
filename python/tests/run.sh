#!/bin/sh
# Runs the tests of the package with python3, or that of DOLPHIN_PYTHON. DOLPHIN names the command: by default that on
# the path. Arguments choose tests: test_adapter test_kit
exec "${DOLPHIN_PYTHON:-python3}" -B "$(dirname "$0")/run.py" "$@"
