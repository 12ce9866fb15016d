"""A mission under way: its end, its stop, and the hands that take the vehicle out of it. Pure."""

from . import hands, resumption
from .departure import Departure
from .execution_state import ExecutionState
from .landing import Disarmed
from .stopping import AGAIN, GRACE, STOPPED, Stopping
from .wire import mavlink


class Flight(ExecutionState):
    """The stages "run" and "stop"."""

    @property
    def lands(self):
        """Whether the vehicle is at an item that lands it."""
        return self.stage == "run" and self._progress.lands

    def _run(self, now):
        self.stage, self._stage_at, self._commands.waiting = "run", now, None
        self._in_mission_at = now
        self._beats = self.vehicle.heartbeats
        self.events.append(("taken",))
        if self.vehicle.home_is_item_0 and self._armed_by_us:
            # A copter on the ground waits for this; others take it for granted.
            return [self._commands.once(mavlink.MAV_CMD_MISSION_START, 0, 0)]
        return []

    def _resumed(self, now, different, same_commands=False):
        v = self.vehicle
        self._mode_before, self._known = v.mode, {v.mode}
        self._resumes, self._asked_mode = False, None
        if self._doubt is None:
            event = resumption.found(v, self._progress, different)
        else:
            event = resumption.without_note(v, self._doubt, different, same_commands)
        if event == resumption.FLIES:
            self.stage, self._stage_at = "run", now
            if not self._stopping:
                self.events.append(event)
        elif event[0] == "unknown":
            # It cannot be known what became of the mission. The vehicle is stopped when Dolphin orders it.
            self.stage = "unrecognised"
            self._tell_unknown(event[1])
        else:
            self._end(*event)
        return self._go_to_stop(now) if self._stopping and not self.is_over else []

    def _heartbeat_in_run(self, now):
        v = self.vehicle
        if v.armed:
            self._disarmed = None
        if self._disarmed is not None:
            return []
        if v.mode == v.modes.mission:
            self._asked_mode, self._in_mission_at = None, now
            if self._departure is not None:
                out = self._is_back_again(now)
                if self._stopping:
                    return out
            if v.armed:
                self._progress.flies_on(now)
                return []
            return self._was_disarmed(now)
        if self._asked_mode is not None and v.mode == self._mode_before and not self._progress.has_begun:
            if now - self._stage_at > GRACE and v.heartbeats - self._beats >= 3:
                return self._fail(f"its autopilot did not go into mode {v.modes.mission}: it is in mode {v.mode}")
            return []
        if self._progress.returns_by_itself():
            return self._was_disarmed(now) if not v.armed else []
        return self._taken_over(now)

    # Disarmed, or in another mode

    def _was_disarmed(self, now):
        if now - self._stage_at >= GRACE:
            self._disarmed = Disarmed(self.vehicle, self._progress)
        return []

    def _judge_disarmed(self, now):
        verdict = self._disarmed.verdict(now)
        if self._has_restarted:
            self._fail(hands.restarted(self.vehicle))
        elif verdict is not None and verdict[0] == "unknown":
            self._tell_unknown(verdict[1])
        elif verdict is not None:
            self._end(*verdict)

    def _taken_over(self, now):
        """The mode is neither ours nor the one before."""
        if self._departure is None:
            self._departure = Departure(now, self.vehicle, self._progress if self.stage == "run" else None)
        self._departure.heartbeat()
        return []

    def _is_back_again(self, now):
        """The heartbeat with the other mode was an old one, or a hand has given the vehicle back."""
        self._departure = None
        if not self._stopping:
            return []
        self._stopping = False
        return self.stop(now)

    def _judge_departure(self, now):
        runs = self.stage == "run"
        may_be_ours = runs and self._commands.may_be_late(self._departure.mode, self._in_mission_at)
        self._end(*self._departure.verdict(now, self._has_restarted, may_be_ours))
        return []

    # Stops

    def stop(self, now):
        """Stops the mission, if anything of it runs or may run."""
        if self.is_over or self._stopping or self.stage == "back":
            return []
        self._stopping = True
        if self._resumes and self.stage in ("link", "verify"):
            return []  # first it must be known whether it is ours that flies
        if self._departure is not None:
            return []  # first it must be known whether a hand is on it
        out = self._boarding.cancel() if self._boarding is not None else []
        if not self._mode_asked:
            return out + self._give_up(now, "stopped")
        return out + self._go_to_stop(now)

    def _go_to_stop(self, now):
        v = self.vehicle
        self.stage, self._boarding = "stop", None
        if not v.armed and self._asked_mode is None and v.link(now):
            return self._finish_stop()
        if self._mode_before is None:
            self._mode_before = v.mode
        self._stop = Stopping(v, self._commands, self._progress, self.stop_mode, self._mode_before)
        return self._order_stop(now)

    def _order_stop(self, now):
        self._stop.ordered(now)
        return self._set_mode(now, self.stop_mode)

    def _heartbeat_in_stop(self, now):
        what = self._stop.heartbeat(now)
        if what == AGAIN:
            return self._order_stop(now)
        return self._finish_stop() if what == STOPPED else []

    def _finish_stop(self):
        self._end("stopped")
        return []
