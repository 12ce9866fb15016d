"""A mission on a vehicle, from the order to the verdict. Pure: messages, orders and the time go in; messages to send
come out, and what is to be reported is in `events`.

The stages, in order:

    hold     a vehicle that still flies a mission is held first, so that an upload changes nothing that moves
    upload   the items go to the vehicle, each acknowledged
    verify   they are downloaded, and compared
    rewind   the mission begins with its first item
    note     Dolphin keeps a note: from now on the mission may have been begun
    arm      if the mission says so and the vehicle is not armed
    settle   on a link that doubles or reorders: until no late copy of an order into another mode is to be expected
    mode     the mode that flies missions
    run      until the last item is reached
    stop     the mode that holds, until the vehicle confirms it
    back     what was refused: the mode before, and the reason, which comes in a text

A hand on the vehicle wins: whenever its mode is neither the one before nor the one we asked for, somebody else flies,
and we send nothing more. No command is repeated blindly: only while the vehicle's own heartbeats show that nothing
happened.
"""

from . import hands, resumption, rewinding
from .boarding import Boarding
from .commands import Commands
from .departure import Departure
from .landing import Disarmed
from .modes import parameters_of
from .progress import Progress
from .refusal import Refusal
from .restoration import Restoration
from .rewinding import Rewinding
from .stopping import AGAIN, GRACE, SETTLED, STOPPED, Stopping
from .vehicle import DEAF, UNSIGNED
from .wire import mavlink

ACCEPTED = mavlink.MAV_RESULT_ACCEPTED
TRANSFER = {
    "MISSION_COUNT",
    "MISSION_REQUEST",
    "MISSION_REQUEST_INT",
    "MISSION_ITEM",
    "MISSION_ITEM_INT",
    "MISSION_ACK",
}


class Execution:
    """`events` are what happened, oldest first: ("taken",), ("progress", share), ("done",), ("failed", why),
    ("stopped",), ("unknown", why), ("note", note). After an end, `is_over`."""

    def __init__(self, vehicle, round_trip, mission, timeout, on_stop="hold"):
        self.vehicle, self.mission, self.timeout = vehicle, mission, timeout
        self.stop_mode = vehicle.modes.home if on_stop == "return" else vehicle.modes.hold
        self.events, self.stage, self.is_over = [], "link", False
        self._round_trip = round_trip
        self._commands = Commands(vehicle, round_trip)
        self._boarding, self._progress = None, Progress(vehicle, mission)
        self._next_after_note = None
        self._mode_before, self._asked_mode, self._mode_asked = None, None, False
        self._first_mode, self._refusal_of = None, None  # where it was while it was not armed; what was refused
        self._restoration, self._departure, self._stop = None, None, None
        self._stage_at = self._asked_at = self._begun = 0.0
        self._beats = 0
        self._in_mission_at = 0.0  # when it was in the mode of the mission last
        self._rewinding = None
        self._known, self._asked_for = set(), set()  # the modes that it may be in; those that we asked for
        self._disarmed = None  # since it is disarmed
        self._armed_by_us, self._resumes, self._stopping, self._unknown = False, False, False, False
        self._unrecognised = None

    # What the station calls

    @property
    def lands(self):
        """Whether the vehicle is at an item that lands it."""
        return self.stage == "run" and self._progress.lands

    def begin(self, now):
        self._stage_at = self._asked_at = self._begun = now
        return self._try(now)

    def resume(self, now, unrecognised=None):
        """Finds out what became of a mission that an adapter before this one has begun, or was about to begin.
        `unrecognised`: why it is not known which mission that is."""
        self._stage_at = self._asked_at = self._begun = now
        self._resumes, self._mode_asked, self._unrecognised = True, True, unrecognised
        return self._try(now)

    def watch(self, now):
        """Judges a mission that another station has begun just now."""
        self._stage_at = self._asked_at = self._begun = now
        self._mode_asked = True
        self._progress.begin()
        return self._run(now)

    def kept(self, now):
        return self._next_after_note(now) if self.stage == "note" else []

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

    def hear(self, now, message):
        """Takes in a message that the vehicle has taken in already: later than all before it."""
        if self.is_over:
            return []
        kind = message.get_type()
        out = []
        if self._departure is not None and self.stage != "run" and kind != "HEARTBEAT":
            return []  # nothing goes on while a hand may be on it; what is not answered is repeated
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

    # The stages

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
            return "is not armed, and the plan does not say arm: true"
        return None

    def _upload(self, now):
        return self._board(now, Boarding.upload)

    def _board(self, now, begin):
        self._boarding = Boarding(self.vehicle, self.mission, self._round_trip)
        out = begin(self._boarding, now)
        self.stage, self._commands.waiting, self._asked_at = self._boarding.stage, None, now
        return out

    def _boarded(self, now):
        """What follows once the mission is on board, or is not."""
        result = self._boarding.result
        if result is None:
            self.stage, self._asked_at = self._boarding.stage, max(self._asked_at, self._boarding.since)
            return []
        self._boarding = None
        why = None if result == "aboard" else result
        if self._resumes:
            return self._resumed(now, why)
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

    def _arm(self, now):
        if not self.mission.arm:
            return self._fail("was disarmed, and the plan does not say arm: true")
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

    def _run(self, now):
        self.stage, self._stage_at, self._commands.waiting = "run", now, None
        self._in_mission_at = now
        self._beats = self.vehicle.heartbeats
        self.events.append(("taken",))
        if self.vehicle.home_is_item_0 and self._armed_by_us:
            # A copter on the ground waits for this; others take it for granted.
            return [self._commands.once(mavlink.MAV_CMD_MISSION_START, 0, 0)]
        return []

    # Commands and their acknowledgements

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
            # An autopilot that has just started or landed changes its mode in a moment; its heartbeats tell.
            self._commands.later(now)
            return []
        what = f"does not go into mode {self._asked_mode}"
        if self.stage == "arm":
            what, self._armed_by_us = "does not arm", False
        self._refusal_of = Refusal(now, self.vehicle, f"its autopilot {what}", result, self._asked_at)
        return self._give_up(now, "failed")

    def _give_up(self, now, *event):
        """Ends a mission that was not begun. A vehicle that was not armed is disarmed, and goes back into the mode in
        which it was: a plane that will not arm must not take off when somebody else arms it."""
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

    # What the vehicle tells

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

    def _heartbeat_in_stop(self, now):
        what = self._stop.heartbeat(now)
        if what == AGAIN:
            return self._order_stop(now)
        return self._finish_stop() if what == STOPPED else []

    def _finish_stop(self):
        self._end("stopped")
        return []

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

    def _begun_already(self, now):
        """Items that were reached since the mode was ordered acknowledge the order."""
        ordered = self._commands.waiting == mavlink.MAV_CMD_DO_SET_MODE
        return self._accepted(now) if ordered and self._progress.has_begun else []

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

    # Ends

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

    @property
    def _has_restarted(self):
        return self.vehicle.restarted_at >= self._begun

    def _silence(self, now):
        """A vehicle that does not answer while its mission is on its way."""
        if self.stage in ("run", "stop", "back", "unrecognised") or self.is_over:
            return []
        deaf = self.vehicle.is_deaf(now)
        patience = min(self.timeout, DEAF) if deaf else self.timeout
        if now - self._asked_at <= patience:
            return []
        if self._resumes:
            return []  # it says nothing until it knows
        if not self._mode_asked:
            return self._give_up(
                now,
                "failed",
                f"no answer from its autopilot for {patience:g} seconds ({self.stage})"
                + (f"; it {UNSIGNED}" if deaf else ""),
            )
        self._tell_unknown(f"it did not say whether it went into mode {self.vehicle.modes.mission}")
        return []

    def _tell_unknown(self, why):
        if not self._unknown:
            self._unknown = True
            self.events.append(("unknown", why))

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

    def _resumed(self, now, different):
        v = self.vehicle
        self._mode_before, self._known = v.mode, {v.mode}
        self._resumes, self._asked_mode = False, None
        event = resumption.found(v, self._progress, different)
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
