"""The state that all stages of an execution share, and the ends that a mission can have. Pure."""

from .commands import Commands
from .modes import parameters_of
from .progress import Progress
from .restoration import Restoration
from .wire import mavlink


class ExecutionState:
    """`events` are the reports to make, oldest first: ("taken",), ("progress", share), ("done",), ("failed", why),
    ("stopped",), ("absent",), ("unknown", why), ("note", note). After an end, `is_over`."""

    def __init__(self, vehicle, round_trip, mission, timeout, on_stop="hold"):
        self.vehicle, self.mission, self.timeout = vehicle, mission, timeout
        self.stop_mode = vehicle.modes.home if on_stop == "return" else vehicle.modes.hold
        self.events, self.stage, self.is_over = [], "link", False
        self._round_trip = round_trip
        self._commands = Commands(vehicle, round_trip)
        self._boarding, self._progress = None, Progress(vehicle, mission)
        self._next_after_note = None
        self._mode_before, self._asked_mode, self._mode_asked = None, None, False
        self._first_mode, self._refusal_of = None, None  # its mode before it was armed; the refused command
        self._restoration, self._departure, self._stop = None, None, None
        self._stage_at = self._asked_at = self._begun = 0.0
        self._beats = 0
        self._in_mission_at = 0.0  # the last time in the mode of the mission
        self._rewinding = None
        self._known, self._asked_for = set(), set()  # the modes that it may be in; those that we asked for
        self._disarmed = None  # since it is disarmed
        self._armed_by_us, self._resumes, self._stopping, self._unknown = False, False, False, False
        self._unrecognised, self._doubt = None, None

    @property
    def _has_restarted(self):
        return self.vehicle.restarted_at >= self._begun

    # Commands

    def _send_command(self, now, command, *params):
        self._asked_at = now
        return self._commands.send(now, command, *params)

    def _set_mode(self, now, mode):
        self._asked_mode, self._stage_at, self._beats = mode, now, self.vehicle.heartbeats
        self._known.add(mode)
        self._asked_for.add(mode)
        self._asked_at = now
        return self._commands.set_mode(now, mode)

    def _disarm(self):
        """Of a vehicle that we have armed and that has not moved: its autopilot refuses it in flight."""
        return [self._commands.once(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 0)]

    # Ends

    def _give_up(self, now, *event):
        """Ends a mission that was not begun. A vehicle that was not armed is disarmed, and goes back into the mode in
        which it was: a plane that will not arm must not take off when another station arms it."""
        out = self._disarm() if self._armed_by_us else []
        mode, self._boarding, self._armed_by_us = self._first_mode, None, False
        moved = mode is not None and bool(self._asked_for) and mode not in self._asked_for
        if self._refusal_of is None and not moved:
            self._end(*event)
            return out
        self.stage, self._commands.waiting = "back", None
        if not moved or parameters_of(self.vehicle.autopilot, self.vehicle.frame, mode) is None:
            mode = None
        refusal = self._refusal_of
        self._restoration = Restoration(now, self.vehicle, self._round_trip, mode, event, refusal)
        return out if mode is None else out + self._set_mode(now, mode)

    def _tell_unknown(self, why):
        if not self._unknown:
            self._unknown = True
            self.events.append(("unknown", why))

    def _fail(self, why):
        self._end("failed", why)
        return []

    def _end(self, *event):
        if not self.is_over:
            self.is_over = True
            self.events.append(event)
            self._commands.waiting, self._boarding = None, None
            if event[0] == "done":
                self.vehicle.finished(unseen=self._asked_mode is not None)
