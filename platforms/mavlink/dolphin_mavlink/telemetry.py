"""The messages that a vehicle is asked to send, and how often. Pure.

While a vehicle lands, its position is asked for ten times a second: a fall from a metre's height lasts less than half
a second."""

from .wire import mavlink

POSITION = 33
_WANTED = [  # the number of each message, and how many a second
    (POSITION, 1.0),
    (1, 1.0),  # SYS_STATUS
    (42, 1.0),  # MISSION_CURRENT
    (24, 0.2),  # GPS_RAW_INT
    (245, 1.0),  # EXTENDED_SYS_STATE
    (147, 0.5),  # BATTERY_STATUS
    (242, 0.2),  # HOME_POSITION
    (162, 0.5),  # FENCE_STATUS
]
_NEEDED = ("GLOBAL_POSITION_INT", "MISSION_CURRENT")  # asked for again when they are not heard
MISSED = 2.5  # seconds after which one of these is missed
AGAIN = 2.0  # seconds after which a request is repeated
ASKED = 10  # requests until one is repeated only every 30 s
LANDING = 10.0  # positions a second while it lands
OFTEN = 0.25  # seconds between two positions that come as often


class Telemetry:
    """Of one vehicle. Its methods return the messages to send."""

    def __init__(self, now, vehicle):
        self._vehicle = vehicle
        self._times, self._at = 0, now
        self._is_fast, self._fast_at = False, 0.0  # whether we have asked for more positions, and when

    def ask(self, now):
        """All of them."""
        self._times, self._at = self._times + 1, now
        out = [self._interval(number, rate) for number, rate in _WANTED]
        if self._times > 1 and any(kind not in self._vehicle.heard for kind in _NEEDED):
            # Older autopilots have only this command.
            target, stream = self._vehicle.target, mavlink.MAV_DATA_STREAM_ALL
            out.append(mavlink.MAVLink_request_data_stream_message(*target, stream, 2, 1))
        return out

    def tick(self, now, flies, lands):
        """`flies`: whether it flies a mission of ours. `lands`: whether it is at an item that lands it."""
        return self._again(now) + self._positions(now, flies, lands)

    def _again(self, now):
        """A request may be lost, and an autopilot that restarts forgets it."""
        heard = self._vehicle.heard
        if not any(now - heard.get(kind, self._at) > MISSED for kind in _NEEDED):
            self._times = min(self._times, 1)
            return []
        due = AGAIN if self._times < ASKED else 30
        return self.ask(now) if self._vehicle.link(now) and now - self._at >= due else []

    def _positions(self, now, flies, lands):
        heights = self._vehicle.heights
        come_often = len(heights) > 1 and abs(heights[-1].at - heights[-2].at) <= OFTEN
        if lands and not come_often and now - self._fast_at >= AGAIN:
            self._is_fast, self._fast_at = True, now
            return [self._interval(POSITION, LANDING)]
        if self._is_fast and not flies:  # what follows a landing is judged, too
            self._is_fast = False
            return [self._interval(POSITION, 1.0)]
        return []

    def _interval(self, number, rate):
        command = mavlink.MAV_CMD_SET_MESSAGE_INTERVAL
        return mavlink.MAVLink_command_long_message(
            *self._vehicle.target, command, 0, number, 1e6 / rate, 0, 0, 0, 0, 0
        )
