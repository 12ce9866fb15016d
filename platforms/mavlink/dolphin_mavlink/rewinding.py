"""The mission on board is set to its first item. Pure.

By the command, which is acknowledged. An autopilot that refuses it, or leaves it without an answer, may know only the
older message: then the mission is at its first item when MISSION_CURRENT confirms it."""

from .wire import mavlink

SILENT = 3  # commands without an answer after which the autopilot may not know the command
COMMAND = mavlink.MAV_CMD_DO_SET_MISSION_CURRENT


class Rewinding:
    """`first` is the number of the first item on board."""

    def __init__(self, vehicle, commands, first):
        self._vehicle, self._commands, self._first = vehicle, commands, first
        self._is_refused = False

    def _message(self):
        return mavlink.MAVLink_mission_set_current_message(*self._vehicle.target, self._first)

    def refused(self, now):
        self._is_refused = True
        self._commands.later(now)
        return [self._message()]

    def repeated(self):
        """The messages to send with the repeated command."""
        return [self._message()] if self._is_refused or self._commands.times >= SILENT else []

    @property
    def is_confirmed(self):
        """Whether the MISSION_CURRENT that was just heard confirms it."""
        return (self._is_refused or self._commands.times > SILENT) and self._vehicle.current == self._first
