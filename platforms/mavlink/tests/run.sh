#!/bin/sh
# Runs the tests of the adapter with the Python of DOLPHIN_MAVLINK, which has pymavlink and mavsdk. Without it they are
# skipped, and a line says so: scripts/test sets it, by ../install --test.
if [ -z "${DOLPHIN_MAVLINK:-}" ]; then
  echo "skipped: the tests of platforms/mavlink: no pymavlink (platforms/mavlink/install --test)"
  exit 0
fi
folder=$(dirname "$0")/..
exec "$DOLPHIN_MAVLINK" -B "$folder/../../scripts/unittests" "$folder" "$@"
