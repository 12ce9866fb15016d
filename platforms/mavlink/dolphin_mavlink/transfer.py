"""MAVLink's mission protocol, from the ground station's side: an upload, and a download. Pure: each takes messages and
the time, and gives messages to send.

No message is sent only once. A message without an answer is repeated after four of the link's round trips, and then
at longer and longer intervals; messages that come twice, late or out of order change nothing. The download after an
upload decides the cases that its end leaves open: a lost acknowledgement, or an error that answers a repeated item.
"""

from . import mission as missions
from .wire import mavlink

_REFUSALS = {
    mavlink.MAV_MISSION_UNSUPPORTED_FRAME: "it does not know the frame",
    mavlink.MAV_MISSION_UNSUPPORTED: "it does not support the command",
    mavlink.MAV_MISSION_NO_SPACE: "it has no space for so many items",
    mavlink.MAV_MISSION_INVALID: "it is invalid",
    mavlink.MAV_MISSION_DENIED: "it was denied",
    **{n: f"parameter {n - mavlink.MAV_MISSION_INVALID_PARAM1 + 1} is invalid" for n in range(6, 13)},
}


LONGEST = 10.0  # seconds: longer round trips cannot be distinguished from losses
ITEM_PATIENCE = 1.5  # seconds: earlier repeats of an item keep a vehicle from asking for it (MAVSDK's timer)
SILENCE = 5.0  # seconds of silence after which the vehicle has given a transfer up, unless the link is slower
ASKED_AGAIN = 0.4  # seconds: a download is given up by MAVSDK after five times 0.5 s without a question
ERRORS = 5  # errors that end a transfer before its first item: fewer may answer the transfer before it
COPY = 0.1, 0.9  # seconds, by the round trip, within which a second request for an item is taken for the first one


class RoundTrip:
    """How long the link takes for a question and its answer, by those that were asked once."""

    def __init__(self):
        self.seconds = 0.2
        self._is_measured, self._backoff = False, 1.0

    def measured(self, seconds):
        """A question that was asked once was answered."""
        self._learn(min(seconds, LONGEST))
        self._backoff = 1.0

    def at_least(self, seconds):
        """A question that was asked more than once was answered, `seconds` after it was asked last."""
        if seconds > self.seconds:
            self._learn(min(seconds, LONGEST))

    def _learn(self, seconds):
        gain = 1.0 if not self._is_measured else 0.5 if seconds > self.seconds else 0.2
        self._is_measured = True
        self.seconds += gain * (seconds - self.seconds)

    def repeated(self):
        """A question had no answer in time: the link has lost it, or is slower than it was."""
        self._backoff = min(1.5 * self._backoff, 40.0)

    def patience(self, most, measured=2.0, hurried=False):
        """Seconds without an answer after which a question is repeated: `most`, on a link that was measured to be fast
        `measured`, and more if it is known to be slower. `hurried`: the vehicle gives up if no question comes."""
        least, share, longest = (1.0, 1.2, 1.2) if hurried else (2.0, 1.5, 3.0)
        known = max(0.25, min(4 * self.seconds, max(least, share * self.seconds)))
        if self._is_measured:
            most = min(most, max(measured, longest * self.seconds))
        return min(known * self._backoff, max(known, most))

    @property
    def silence(self):
        return max(SILENCE, 3 * self.seconds)

    @property
    def settled(self):
        """Seconds after which all earlier messages have been answered."""
        return max(0.25, 1.5 * self.seconds)


class Repeated:
    """A message that is sent until it is answered, at the latest every `most` seconds if the link is not slower, and
    every `measured` seconds if it was measured to be fast."""

    def __init__(self, round_trip, most=8.0, measured=2.0, hurried=False):
        self._round_trip, self._patience = round_trip, (most, measured, hurried)
        self.messages, self.sent_at, self.times = [], 0.0, 0
        self._due, self._least = 0.0, 0.0

    def send(self, now, *messages, least=0.0):
        """`least`: how many seconds pass before it is repeated, at least."""
        self.messages, self.times, self._least = list(messages), 1, least
        self._sent(now)
        return self.messages

    def _sent(self, now):
        self.sent_at, self._due = now, now + max(self._least, self._round_trip.patience(*self._patience))

    def answered(self, now):
        if self.times == 1:
            self._round_trip.measured(now - self.sent_at)
        elif self.times > 1:
            self._round_trip.at_least(now - self.sent_at)
        self.times = 0

    def postponed(self, now, seconds):
        """The answer is that it shall be sent again, `seconds` from now."""
        self._due, self.times = now + seconds, max(self.times, 2)

    def again(self, now):
        """It is asked for."""
        self.times += 1
        self._sent(now)
        return self.messages

    def tick(self, now):
        if self.times == 0 or now < self._due:
            return []
        self._round_trip.repeated()
        return self.again(now)


def numbered(items, home):
    """The items as they are numbered on board. ArduPilot keeps its home position as item 0; others begin with the first
    item, and their jumps lead to numbers that are smaller by one."""
    if home is not None:
        x, y = round(home[0] * 1e7), round(home[1] * 1e7)
        return [missions.Item(missions.WAYPOINT, missions.GLOBAL, x=x, y=y), *items]

    def jump(item):
        if item.command != missions.JUMP:
            return item
        return missions.dataclasses.replace(item, params=(item.params[0] - 1, *item.params[1:]))

    return [jump(item) for item in items]


class Upload:
    """`result` is None during the transfer, then "accepted", "unclear" (a download decides), "again" (the vehicle gave
    the transfer up), "silent" (it stopped asking for items), or ("refused", why)."""

    def __init__(self, target, items, round_trip):
        self._target, self._items, self._round_trip = target, items, round_trip
        self._repeated = Repeated(round_trip)
        self._asked = -1  # the highest item that was asked for
        self._errors = 0  # before the first item was asked for
        self._heard_at = 0.0
        self.result = None

    def begin(self, now):
        count = mavlink.MAVLink_mission_count_message(*self._target, len(self._items))
        return self._repeated.send(now, count)

    def hear(self, now, message):
        kind = message.get_type()
        if self.result is not None or getattr(message, "mission_type", 0) != 0:
            return []
        if kind in ("MISSION_REQUEST", "MISSION_REQUEST_INT"):
            return self._requested(now, message.seq)
        if kind == "MISSION_ACK":
            self._acknowledged(message.type)
        return []

    def _requested(self, now, seq):
        if seq >= len(self._items) or seq > self._asked + 1:
            return []  # of an earlier transfer
        self._heard_at = now
        repeated = self._repeated
        if seq == self._asked and repeated.times > 0:
            low, high = COPY
            if now - repeated.sent_at < min(max(low, 0.9 * self._round_trip.seconds), high):
                return []  # it has been answered: this is the request's copy
            return repeated.again(now)
        if seq > self._asked:
            repeated.answered(now)
            self._asked = seq
            return repeated.send(now, self._items[seq].message(self._target, seq), least=ITEM_PATIENCE)
        return []  # a late copy: later items were asked for

    def _acknowledged(self, verdict):
        everything = self._asked == len(self._items) - 1
        if verdict == mavlink.MAV_MISSION_ACCEPTED:
            # Without a request for the last item it is the end of something else.
            self.result = "accepted" if everything else None
        elif self._asked < 0 and verdict in (mavlink.MAV_MISSION_OPERATION_CANCELLED, mavlink.MAV_MISSION_ERROR):
            # It answers an earlier transfer, as long as the vehicle asks for items in the end.
            self._errors += 1
            self.result = "again" if self._errors >= ERRORS else None
        elif verdict == mavlink.MAV_MISSION_OPERATION_CANCELLED:
            self.result = "again"
        elif verdict == mavlink.MAV_MISSION_ERROR:
            self.result = "unclear" if everything else "again"
        elif verdict in _REFUSALS:
            at = f"item {self._asked}: " if 0 <= self._asked else ""
            self.result = ("refused", at + _REFUSALS[verdict])
        # An invalid sequence answers an item that came twice.

    def tick(self, now):
        if self.result is not None:
            return []
        if self._asked >= 0 and now - self._heard_at > self._round_trip.silence:
            self.result = "unclear" if self._asked == len(self._items) - 1 else "silent"
            return []
        return self._repeated.tick(now)

    def cancel(self):
        """Ends the transfer for the vehicle."""
        return [mavlink.MAVLink_mission_ack_message(*self._target, mavlink.MAV_MISSION_OPERATION_CANCELLED)]


class Download:
    """`items` is None until all have come. Up to `window` items are asked for at once; after a loss, one at a time."""

    def __init__(self, target, round_trip, window=1, most=65535):
        self._target, self._window, self._most = target, window, most
        self._repeated = Repeated(round_trip, measured=ASKED_AGAIN, hurried=window == 1)
        self._count, self._got, self._asked = None, {}, 0
        self._round_trip, self._errors, self._heard_at = round_trip, 0, 0.0
        self._asked_at = {}  # when each item was asked for that was asked for once
        self.items, self.refused = None, None

    def begin(self, now):
        self._heard_at = now
        return self._repeated.send(now, mavlink.MAVLink_mission_request_list_message(*self._target))

    def hear(self, now, message):
        kind = message.get_type()
        if self.items is not None or self.refused or getattr(message, "mission_type", 0) != 0:
            return []
        if kind == "MISSION_COUNT" and self._count is None:
            self._heard_at = now
            self._repeated.answered(now)
            self._count = message.count
            if message.count > self._most:
                # It is not what was sent, whatever it holds.
                return self._end([None] * message.count)
            return self._next(now)
        if kind == "MISSION_COUNT" and not self._got and now - self._repeated.sent_at >= COPY[0]:
            self._heard_at = now
            return self._repeated.again(now)  # the vehicle repeats it: our question was lost
        if kind in ("MISSION_ITEM_INT", "MISSION_ITEM") and self._count is not None:
            if message.seq < self._count and message.seq not in self._got:
                self._heard_at = now
                self._got[message.seq] = missions.of_message(message)
                asked_at = self._asked_at.get(message.seq)
                if asked_at is not None:
                    self._round_trip.measured(now - asked_at)
                return self._next(now)
        if kind == "MISSION_ACK" and message.type not in (0, mavlink.MAV_MISSION_INVALID_SEQUENCE):
            # It may answer a copy of the upload's last item. A refusal is repeated, as often as the question is.
            self._errors += 1
            if min(self._errors, self._repeated.times) >= ERRORS:
                self.refused = _REFUSALS.get(message.type, f"error {message.type}")
        return []

    def _end(self, items):
        self.items = items
        return [mavlink.MAVLink_mission_ack_message(*self._target, mavlink.MAV_MISSION_ACCEPTED)]

    def _next(self, now):
        if len(self._got) == self._count:
            return self._end([self._got[n] for n in range(self._count)])
        missing = next(n for n in range(self._count) if n not in self._got)
        last = min(self._count, missing + self._window)
        self._asked = max(self._asked, missing)
        fresh = [self._request(n) for n in range(self._asked, last)]
        self._asked_at.update((n, now) for n in range(self._asked, last))
        self._asked = max(self._asked, last)
        # What is repeated is only the first that is missing: an autopilot may insist on the order.
        again = self._request(missing)
        self._repeated.send(now, again)
        return fresh

    def _request(self, n):
        return mavlink.MAVLink_mission_request_int_message(*self._target, n)

    def tick(self, now):
        if self.items is not None or self.refused:
            return []
        if self._count is not None and now - self._heard_at > self._round_trip.silence:
            # The vehicle has given it up: it is asked for the whole list again.
            self._count, self._got, self._asked, self._asked_at = None, {}, 0, {}
            return self.begin(now)
        messages = self._repeated.tick(now)
        if messages and self._count is not None:
            # Something was lost: on with one at a time.
            missing = min(n for n in range(self._count) if n not in self._got)
            self._window, self._asked = 1, missing + 1
            self._asked_at[missing] = None
        return messages
