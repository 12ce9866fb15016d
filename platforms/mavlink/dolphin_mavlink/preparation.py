"""A mission before it runs: it is uploaded, the vehicle is armed, and the mode of missions is ordered. Pure."""

from . import rewinding
from .boarding import Boarding
from .flight import Flight
from .refusal import Refusal
from .rewinding import Rewinding
from .stopping import GRACE, SETTLED
from .wire import mavlink

ACCEPTED = mavlink.MAV_RESULT_ACCEPTED


class Preparation(Flight):
    """The stages from "link" to "mode", and acknowledgements of the commands of all stages."""

    def _try(self, now):
        v = self.vehicle
        if not v.link(now) or v.mode is None or now - v.heard_at > 2.5:
            return []
        if self._resumes and self._unrecognised is not None:
            return self._resumed(now, self._unrecognised)
        if self._resumes:
            return self._board(now, Boarding.compare)
        why = self._refusal(now)
        if why is not None:
            return self._fail(why)
        self._mode_before, self._known = v.mode, {v.mode}
        self._first_mode = None if v.armed else v.mode
        if v.armed and v.mode == v.modes.mission:
            self.stage = "hold"
            return self._set_mode(now, v.modes.hold)
        return self._upload(now)

    def _refusal(self, now):
        v = self.vehicle
        why = v.unready(now, has_plan=False)
        if why is not None:
            return why
        if not v.armed and not self.mission.arm:
            return "is not armed, and the plan has no arm: true"
        return None

    def _upload(self, now):
        return self._board(now, Boarding.upload)

    def _board(self, now, begin):
        self._boarding = Boarding(self.vehicle, self.mission, self._round_trip)
        out = begin(self._boarding, now)
        self.stage, self._commands.waiting, self._asked_at = self._boarding.stage, None, now
        return out

    def _boarded(self, now):
        """Goes on once the mission is on board, or has been refused."""
        result = self._boarding.result
        if result is None:
            self.stage, self._asked_at = self._boarding.stage, max(self._asked_at, self._boarding.since)
            return []
        same_commands, self._boarding = self._boarding.same_commands, None
        why = None if result == "aboard" else result
        if self._resumes:
            return self._resumed(now, why, same_commands)
        return self._rewind(now) if why is None else self._fail(why)

    def _rewind(self, now):
        self.stage = "rewind"
        self._rewinding = Rewinding(self.vehicle, self._commands, self._progress.first)
        return self._send_command(now, rewinding.COMMAND, self._progress.first, 1)

    def _prepare(self, now):
        """After the mission is at its first item: arms the vehicle, or begins."""
        v = self.vehicle
        if v.armed or v.modes.before_arming is None:
            return self._note(now, self._begin_mission)
        if v.mode == v.modes.before_arming:
            return self._note(now, self._arm)
        self.stage = "before arming"
        return self._set_mode(now, v.modes.before_arming)

    def _note(self, now, then):
        self.stage, self._next_after_note, self._asked_at = "note", then, now
        self.events.append(("note", self.mission.note))
        return []

    def kept(self, now):
        return self._next_after_note(now) if self.stage == "note" else []

    def _arm(self, now):
        if not self.mission.arm:
            return self._fail("was disarmed, and the plan has no arm: true")
        self.stage, self._armed_by_us = "arm", True
        return self._send_command(now, mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1)

    def _begin_mission(self, now):
        since = self._commands.since_other_mode(now, self.vehicle.modes.mission)
        if since < SETTLED and self.vehicle.is_confused(now):
            self.stage, self._commands.waiting = "settle", None
            return []
        self.stage, self._mode_asked = "mode", True
        self._progress.begin()
        return self._set_mode(now, self.vehicle.modes.mission)

    def _begun_already(self, now):
        """Items that were reached since the mode was ordered acknowledge the order."""
        ordered = self._commands.waiting == mavlink.MAV_CMD_DO_SET_MODE
        return self._accepted(now) if ordered and self._progress.has_begun else []

    # Commands and their acknowledgements

    def _repeat(self, now):
        v = self.vehicle
        if now - v.heard_at > 2.5:
            return []  # it would not be known what happened in the meantime
        out = self._commands.tick(now)
        return out + self._rewinding.repeated() if out and self.stage == "rewind" else out

    def _acknowledged(self, now, message):
        if not self._commands.acknowledged(now, message):
            return []
        if message.result == ACCEPTED:
            return self._accepted(now)
        if self.stage == "rewind":
            return self._rewinding.refused(now)
        return self._denied(now, message.result)

    def _accepted(self, now):
        self._commands.waiting = None
        if self.stage == "hold":
            self._mode_before = self.vehicle.modes.hold
            return self._upload(now)
        if self.stage == "rewind":
            return self._prepare(now)
        if self.stage == "before arming":
            self._mode_before = self._asked_mode
            return self._note(now, self._arm)
        if self.stage == "arm":
            return self._run(now) if self._mode_asked else self._begin_mission(now)
        if self.stage == "mode":
            if self.vehicle.armed or self._armed_by_us:
                return self._run(now)
            return self._arm(now)
        if self.stage == "stop":
            self._stop.accepted(now)
        if self.stage == "back":
            self._restoration.is_back = True
        return []

    def _denied(self, now, result):
        if self.stage in ("stop", "back"):
            if self.stage == "back":
                self._restoration.is_refused = True
            self._commands.later(now)  # heartbeats decide, and it is repeated
            return []
        if self.stage == "hold" and self.vehicle.idle_mission:
            return self._upload(now)  # its mission has ended: there was nothing to hold
        if result == mavlink.MAV_RESULT_TEMPORARILY_REJECTED and self.stage != "arm" and now - self._stage_at < GRACE:
            # An autopilot that has just started or landed changes its mode in a moment; heartbeats show it.
            self._commands.later(now)
            return []
        what = f"does not go into mode {self._asked_mode}"
        if self.stage == "arm":
            what, self._armed_by_us = "does not arm", False
        self._refusal_of = Refusal(now, self.vehicle, f"its autopilot {what}", result, self._asked_at)
        return self._give_up(now, "failed")
