#!/bin/sh
# Runs the tests of the package with python3, or that of DOLPHIN_PYTHON. DOLPHIN names the command: by default that on
# the path. Arguments choose tests: test_adapter test_kit
folder=$(dirname "$0")/..
exec "${DOLPHIN_PYTHON:-python3}" -B "$folder/../scripts/unittests" "$folder" "$@"
