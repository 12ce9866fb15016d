#!/bin/sh
# Runs the tests of the adapter: those without a server with python3, or that of DOLPHIN_PYTHON, which needs PyYAML
# (Debian: python3-yaml). With the Python of ../install in DOLPHIN_PEOPLE and the command in DOLPHIN also those of pages
# and runs; where CI=true these have to run. Arguments choose modules.
folder=$(dirname "$0")/..
PYTHONPATH=$(readlink -f "$folder/../../python")
export PYTHONPATH
python=${DOLPHIN_PYTHON:-python3}
if [ -n "${DOLPHIN_PEOPLE:-}" ] && [ -n "${DOLPHIN:-}" ]; then
  python=$DOLPHIN_PEOPLE
  served="test_site check_run"
else
  echo "test_site and check_run take DOLPHIN_PEOPLE, the Python of platforms/people/install, and DOLPHIN"
  [ "${CI:-}" != true ] || exit 1
  served=""
fi
# shellcheck disable=SC2086 # no word if there is none
[ "$#" -gt 0 ] || set -- test_configuration test_person $served
exec "$python" -B "$folder/../../scripts/unittests" "$folder" "$@"
