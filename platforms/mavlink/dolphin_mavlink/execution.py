"""A mission on a vehicle, from the order to the verdict. Pure: messages, orders and the time go in; messages to send
come out, and reports are in `events`.

The stages, in order:

    hold     a vehicle that still flies a mission is held first, so that an upload changes nothing that moves
    upload   the items go to the vehicle, each acknowledged
    verify   they are downloaded, and compared
    rewind   the mission begins with its first item
    note     Dolphin keeps a note: from now on the mission may have been begun
    arm      if the mission allows it and the vehicle is not armed
    settle   on a link that doubles or reorders: until late copies of an order into another mode have passed
    mode     the mode that flies missions
    run      until the last item is reached
    stop     the mode that holds, until the vehicle confirms it
    back     after a refusal: into the mode before, until the reason has come in a text

A hand on the vehicle wins: a mode that is neither the one before nor one that we asked for is a pilot's or another
station's, and we send nothing more. No command is repeated blindly: only while the vehicle's own heartbeats show that
nothing happened.
"""

from .preparation import Preparation
from .vehicle import DEAF, UNSIGNED
from .wire import mavlink

TRANSFER = {
    "MISSION_COUNT",
    "MISSION_REQUEST",
    "MISSION_REQUEST_INT",
    "MISSION_ITEM",
    "MISSION_ITEM_INT",
    "MISSION_ACK",
}


class Execution(Preparation):
    """A mission on a vehicle. `events` has what it reports."""

    # Orders of the station

    def begin(self, now):
        self._stage_at = self._asked_at = self._begun = now
        return self._try(now)

    def resume(self, now, unrecognised=None, doubt=None):
        """Finds out what became of a mission that an adapter before this one has begun, or was about to begin.
        `unrecognised`: the reason why that mission is unknown. `doubt`: it has no note, which may be lost."""
        self._stage_at = self._asked_at = self._begun = now
        self._resumes, self._mode_asked, self._unrecognised = True, True, unrecognised
        self._doubt = doubt
        return self._try(now)

    def watch(self, now):
        """Judges a mission that another station has begun just now."""
        self._stage_at = self._asked_at = self._begun = now
        self._mode_asked = True
        self._progress.begin()
        return self._run(now)

    # Messages and time

    def hear(self, now, message):
        """Takes in a message that the vehicle has taken in already: later than all before it."""
        if self.is_over:
            return []
        kind = message.get_type()
        out = []
        if self._departure is not None and self.stage != "run" and kind != "HEARTBEAT":
            return []  # nothing goes on while a hand may be on it; open questions are repeated
        if kind == "COMMAND_ACK":
            out = self._acknowledged(now, message)
        elif kind == "HEARTBEAT":
            out = self._heartbeat(now)
        elif kind == "MISSION_CURRENT":
            out = self._mission_news(now)
        elif kind == "MISSION_ITEM_REACHED":
            out = self._item_reached(now, message.seq)
        elif self._boarding is not None and kind in TRANSFER:
            self._asked_at = now
            out = self._boarding.hear(now, message)
            out += self._boarded(now)
        return out + self._look(now)

    def tick(self, now):
        if self.is_over:
            return []
        if self._departure is not None:
            is_ripe = self._departure.is_ripe(now, self.timeout) or self._has_restarted
            return self._judge_departure(now) if is_ripe else self._look(now)
        out = []
        if self.stage == "link":
            out = self._try(now)
        elif self._boarding is not None:
            out = self._boarding.tick(now)
            out += self._boarded(now)
        elif self.stage == "settle":
            out = self._begin_mission(now)
        elif self._commands.waiting is not None:
            out = self._repeat(now)
        return out + self._look(now) + self._silence(now)

    def _heartbeat(self, now):
        v = self.vehicle
        if self.stage == "stop":
            return self._heartbeat_in_stop(now)
        if self.stage == "run":
            return self._heartbeat_in_run(now)
        if self.stage == "back":
            self._restoration.heartbeat(self._known)
            return []
        if self.stage == "link" or self._resumes:
            return []
        if self.stage == "hold" and v.mode in v.modes.after and v.mode not in self._known:
            # The mission that it flew has ended before our order came: there is nothing to hold.
            self._mode_before = v.mode
            self._known.add(v.mode)
            return self._upload(now)
        if v.mode not in self._known:
            return self._taken_over(now)
        if self._departure is not None:
            out = self._is_back_again(now)
            if self._stopping:
                return out
        if v.armed and v.mode == self._first_mode and v.mode not in v.modes.hands_off and not self._armed_by_us:
            # It was not armed, and by now its pilot has armed it.
            v.pilot = v.mode
            return self._fail(f"taken over by its pilot in mode {v.mode}")
        if (
            self._commands.waiting == mavlink.MAV_CMD_DO_SET_MODE
            and v.mode == self._asked_mode
            and v.mode != self._mode_before
        ):
            return self._accepted(now)  # the acknowledgement was lost
        if self._commands.waiting == mavlink.MAV_CMD_COMPONENT_ARM_DISARM and v.armed:
            return self._accepted(now)
        return []

    def _mission_news(self, now):
        v, progress = self.vehicle, self._progress
        if self.stage == "rewind" and self._rewinding.is_confirmed:
            return self._accepted(now)
        if self.stage not in ("run", "mode"):
            return []
        if progress.current != v.current and self.stage == "run" and v.armed and self._disarmed is None:
            self.events.append(("progress", progress.share))
        progress.news(now)
        if self.stage == "mode":
            return self._begun_already(now)
        if self._departure is not None and v.mission_state not in (None, mavlink.MISSION_STATE_COMPLETE):
            self._departure.goes_on(now)
        if progress.is_replaced and self.stage == "run":
            return self._fail("its mission was replaced by another station")
        return []

    def _item_reached(self, now, seq):
        if self.stage not in ("run", "mode"):
            return []
        self._progress.item_reached(seq)
        return self._begun_already(now) if self.stage == "mode" else []

    def _look(self, now):
        if self.stage == "back" and not self.is_over:
            verdict = self._restoration.verdict(now)
            if verdict is not None:
                self._end(*verdict)
        elif self.stage == "run" and not self.is_over and self._progress.is_over(now):
            self._end("done")
        elif self.stage == "run" and not self.is_over and self._disarmed is not None:
            self._judge_disarmed(now)
        return []

    def _silence(self, now):
        """A vehicle that does not answer while its mission is on its way."""
        if self.stage in ("run", "stop", "back", "unrecognised") or self.is_over:
            return []
        deaf = self.vehicle.is_deaf(now)
        patience = min(self.timeout, DEAF) if deaf else self.timeout
        if now - self._asked_at <= patience:
            return []
        if self._resumes:
            return []  # nothing is reported before it is known
        if not self._mode_asked:
            return self._give_up(
                now,
                "failed",
                f"no answer from its autopilot for {patience:g} seconds ({self.stage})"
                + (f"; it {UNSIGNED}" if deaf else ""),
            )
        self._tell_unknown(f"it did not report whether it went into mode {self.vehicle.modes.mission}")
        return []
