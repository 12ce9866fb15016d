#!/bin/sh
# Runs the tests of the bridge: those without a broker with python3, or that of DOLPHIN_PYTHON, which needs PyYAML
# (Debian: python3-yaml). With the Python of ../install in DOLPHIN_MQTT, Debian's mosquitto and the command in DOLPHIN,
# also those with a broker, of check_broker; where CI=true these have to run. Arguments choose modules.
folder=$(dirname "$0")/..
PATH=$PATH:/usr/sbin
PYTHONPATH=$(readlink -f "$folder/../../python")
export PATH PYTHONPATH
python=${DOLPHIN_PYTHON:-python3}
if [ -n "${DOLPHIN_MQTT:-}" ] && [ -n "${DOLPHIN:-}" ] && command -v mosquitto >/dev/null; then
  python=$DOLPHIN_MQTT
  broker=check_broker
else
  echo "check_broker takes DOLPHIN_MQTT, the Python of platforms/mqtt/install, DOLPHIN and Debian's mosquitto"
  [ "${CI:-}" != true ] || exit 1
  broker=""
fi
# shellcheck disable=SC2086 # no word if there is no broker
[ "$#" -gt 0 ] || set -- test_configuration test_sensor test_bridge $broker
exec "$python" -B "$folder/../../scripts/unittests" "$folder" "$@"
