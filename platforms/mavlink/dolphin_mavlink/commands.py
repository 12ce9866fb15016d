"""Commands to a vehicle, each repeated until it is acknowledged. Pure."""

import math

from .modes import parameters_of
from .transfer import Repeated
from .wire import mavlink

IN_PROGRESS = mavlink.MAV_RESULT_IN_PROGRESS
LATE = 5.0  # seconds by which a copy of an order may come late
LATER = 0.5  # seconds after which is asked for again what is refused for now


class Commands:
    """`waiting` is the command that waits for its acknowledgement, if any."""

    def __init__(self, vehicle, round_trip):
        self._vehicle, self._repeated = vehicle, Repeated(round_trip, most=2.0)
        self.waiting = None
        self._modes_sent, self._modes_acknowledged, self._modes_before = 0, 0, 0
        self._mode, self._mode_sent_at = None, {}  # the mode sent last; when each was sent last
        self._mode_acknowledged_at = -math.inf  # when a mode, or a copy of one, was acknowledged last

    def once(self, command, *params):
        """A message with the command, which is not repeated."""
        params = (*params, *(0.0,) * (7 - len(params)))
        return mavlink.MAVLink_command_long_message(*self._vehicle.target, command, 0, *params)

    def send(self, now, command, *params):
        self.waiting = command
        return self._repeated.send(now, self.once(command, *params))

    def set_mode(self, now, mode):
        main, sub = parameters_of(self._vehicle.autopilot, self._vehicle.frame, mode)
        self._modes_before = self._modes_sent
        self._modes_sent += 1
        self._mode, self._mode_sent_at[mode] = mode, now
        flag = mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED
        return self.send(now, mavlink.MAV_CMD_DO_SET_MODE, flag, main, sub)

    def tick(self, now):
        out = self._repeated.tick(now)
        if out and self.waiting == mavlink.MAV_CMD_DO_SET_MODE:
            self._modes_sent += 1
            self._mode_sent_at[self._mode] = now
        return out

    def since_mode(self, now, mode):
        """Seconds since it was ordered into `mode` last."""
        return now - self._mode_sent_at.get(mode, -math.inf)

    def since_other_mode(self, now, mode):
        """Seconds since it was ordered into another mode than `mode` last."""
        return min((now - at for sent, at in self._mode_sent_at.items() if sent != mode), default=math.inf)

    def may_be_late(self, mode, seen_at):
        """Whether a late copy of an order into `mode` may have taken the vehicle out of the mode in which it was seen
        at `seen_at` for the last time: since then a copy may have come, or its acknowledgement has."""
        if mode not in self._mode_sent_at:
            return False
        return self.since_mode(seen_at, mode) < LATE or self._mode_acknowledged_at >= seen_at

    def acknowledged(self, now, message):
        """Whether the command that waits is answered for good. An acknowledgement of a mode does not name the mode: it
        may answer an earlier order, and the one that waits is then still repeated."""
        if message.result == IN_PROGRESS:
            return False
        is_mode = message.command == mavlink.MAV_CMD_DO_SET_MODE
        if is_mode:
            self._modes_acknowledged += 1
            self._mode_acknowledged_at = now
        if message.command != self.waiting or (is_mode and not self.is_last_mode):
            return False
        self._repeated.answered(now)
        return True

    def later(self, now):
        """The command that waits is sent again in a moment."""
        self._repeated.postponed(now, LATER)

    @property
    def times(self):
        """How many times it was sent since it was answered last."""
        return self._repeated.times

    @property
    def is_last_mode(self):
        """Whether an acknowledgement of a mode must be of the last one: all that were sent before are acknowledged."""
        return self._modes_acknowledged > self._modes_before
