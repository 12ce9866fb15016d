#!/bin/sh
# Checks the mission: that the program is right, that no run of it fails, and that it completes on the simulated fleet.
set -eu
cd "$(dirname "$0")"
dolphin check mission.dol
dolphin explore mission.dol --strict
dolphin exec mission.dol --quiet
