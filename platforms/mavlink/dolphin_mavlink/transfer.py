"""MAVLink's mission protocol, from the ground station's side: an upload, and a download. Pure: each takes messages and
the time, and gives messages to send.

Nothing is ever waited for only once. Whoever hears nothing repeats its last message, after four of the link's round
trips; what comes twice, late or out of order changes nothing. What an upload's end leaves open (an acknowledgement
that was lost, an error that answers a repeated item) the download after it decides.
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


class RoundTrip:
    """How long the link takes for a question and its answer, by those that were asked once."""

    def __init__(self):
        self.seconds = 0.2

    def measured(self, seconds):
        self.seconds += 0.2 * (min(seconds, 2.0) - self.seconds)

    @property
    def patience(self):
        """After so many seconds without an answer, one asks again."""
        return min(max(4 * self.seconds, 0.25), 2.0)


class Repeated:
    """A message that is sent until it is answered."""

    def __init__(self, round_trip):
        self._round_trip = round_trip
        self.messages, self.sent_at, self.times = [], 0.0, 0

    def send(self, now, *messages):
        self.messages, self.sent_at, self.times = list(messages), now, 1
        return self.messages

    def answered(self, now):
        if self.times == 1:
            self._round_trip.measured(now - self.sent_at)
        self.times = 0

    def postponed(self, now, seconds):
        """The answer is that it shall be sent again, `seconds` from now."""
        self.sent_at, self.times = now + seconds - self._round_trip.patience, max(self.times, 2)

    def tick(self, now):
        if self.times == 0 or now - self.sent_at < self._round_trip.patience:
            return []
        self.sent_at, self.times = now, self.times + 1
        return self.messages


def numbered(items, home):
    """The items with the numbers that the vehicle gives them. ArduPilot keeps its home position as item 0; others begin
    with the first item, where jumps then lead to numbers that are smaller by one."""
    if home is not None:
        x, y = round(home[0] * 1e7), round(home[1] * 1e7)
        return [missions.Item(missions.WAYPOINT, missions.GLOBAL, x=x, y=y), *items]

    def jump(item):
        if item.command != missions.JUMP:
            return item
        return missions.dataclasses.replace(item, params=(item.params[0] - 1, *item.params[1:]))

    return [jump(item) for item in items]


class Upload:
    """`result` is None while it goes on, then "accepted", "unclear" (a download will tell), "again" (the vehicle gave
    the transfer up), or ("refused", why)."""

    def __init__(self, target, items, round_trip):
        self._target, self._items = target, items
        self._repeated = Repeated(round_trip)
        self._asked = -1  # the highest item that was asked for
        self.result = None

    def begin(self, now):
        count = mavlink.MAVLink_mission_count_message(*self._target, len(self._items))
        return self._repeated.send(now, count)

    def hear(self, now, message):
        kind = message.get_type()
        if self.result is not None or getattr(message, "mission_type", 0) != 0:
            return []
        if kind in ("MISSION_REQUEST", "MISSION_REQUEST_INT") and message.seq < len(self._items):
            if message.seq == self._asked and self._repeated.times > 0 and now - self._repeated.sent_at < 0.1:
                return []  # it has been answered: this is the request's copy
            if message.seq > self._asked:
                self._repeated.answered(now)
            self._asked = max(self._asked, message.seq)
            return self._repeated.send(now, self._items[message.seq].message(self._target, message.seq))
        if kind == "MISSION_ACK":
            self._acknowledged(message.type)
        return []

    def _acknowledged(self, verdict):
        everything = self._asked == len(self._items) - 1
        if verdict == mavlink.MAV_MISSION_ACCEPTED:
            # Without a request for the last item it is the end of something else.
            self.result = "accepted" if everything else None
        elif verdict == mavlink.MAV_MISSION_OPERATION_CANCELLED:
            self.result = "again"
        elif verdict == mavlink.MAV_MISSION_ERROR:
            self.result = "unclear" if everything else "again"
        elif verdict in _REFUSALS:
            at = f"item {self._asked}: " if 0 <= self._asked else ""
            self.result = ("refused", at + _REFUSALS[verdict])
        # An invalid sequence answers an item that came twice.

    def tick(self, now):
        return self._repeated.tick(now) if self.result is None else []

    def cancel(self):
        """Tells the vehicle that nothing more will come."""
        return [mavlink.MAVLink_mission_ack_message(*self._target, mavlink.MAV_MISSION_OPERATION_CANCELLED)]


class Download:
    """`items` is None until all are there. Up to `window` items are asked for at once; after a loss, one at a time."""

    def __init__(self, target, round_trip, window=1, most=65535):
        self._target, self._window, self._most = target, window, most
        self._repeated = Repeated(round_trip)
        self._count, self._got, self._asked = None, {}, 0
        self.items, self.refused = None, None

    def begin(self, now):
        return self._repeated.send(now, mavlink.MAVLink_mission_request_list_message(*self._target))

    def hear(self, now, message):
        kind = message.get_type()
        if self.items is not None or self.refused or getattr(message, "mission_type", 0) != 0:
            return []
        if kind == "MISSION_COUNT" and self._count is None:
            self._repeated.answered(now)
            self._count = message.count
            if message.count > self._most:
                # It is not what was sent, whatever it holds.
                return self._end([None] * message.count)
            return self._next(now)
        if kind in ("MISSION_ITEM_INT", "MISSION_ITEM") and self._count is not None:
            if message.seq < self._count and message.seq not in self._got:
                self._got[message.seq] = missions.of_message(message)
                self._repeated.answered(now)
                return self._next(now)
        if kind == "MISSION_ACK" and message.type not in (0, mavlink.MAV_MISSION_INVALID_SEQUENCE):
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
        messages = self._repeated.tick(now)
        if messages and self._count is not None:
            # Something was lost: on with one at a time.
            self._window, self._asked = 1, min(n for n in range(self._count) if n not in self._got) + 1
        return messages
