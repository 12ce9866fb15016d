"""Whether a vehicle that is disarmed has landed, or lost its motors in flight. Pure.

ArduCopter reports the ground as soon as it is disarmed, at any height: its reports before, and its sinking
afterwards, decide. An autopilot disarms after the vehicle has been at rest on the ground for a second. So a vehicle
that came down later than that, or faster than a landing, fell; also from heights from which its fall is too short to be
seen in a report."""

from . import hands

SETTLED = 1.0  # seconds after which a vehicle that lost its motors in flight sinks fast, or has sunk
OPEN = 15.0  # seconds in which the vehicle may report its landing
AWAY = 2.5  # seconds without an armed heartbeat, after which anything may have happened
REST = 1.0  # seconds on the ground before an autopilot disarms
LANDING = 1.5  # metres a second: no landing ends faster, unless the vehicle reports so
NOISE = 1.0  # metres: errors of a height, also by the wash of the rotors
AFTERWARDS = 4.0  # seconds in which reports of it come
AIRCRAFT = ("copter", "plane", "vtol")
POSITION, STATE = "GLOBAL_POSITION_INT", "EXTENDED_SYS_STATE"


class Disarmed:
    """A vehicle with a mission, from the first heartbeat on that reports it disarmed."""

    def __init__(self, vehicle, progress):
        self._vehicle, self.since = vehicle, vehicle.disarmed_at
        self._progress, self._lands = progress, progress.lands  # whether it was at an item that lands it then
        self.was_away = self.since - vehicle.armed_at > AWAY
        self._was_on_ground = vehicle.grounded
        self._flew = vehicle.flew_at >= max(vehicle.armed_at - AWAY, self.since - 2 * AWAY)

    def _heard(self, kind, seconds=0.0):
        return self._vehicle.heard.get(kind, self.since) > self.since + seconds

    @property
    def fell(self):
        """Whether it sank faster than a landing, or while it was disarmed."""
        v = self._vehicle
        return v.frame in AIRCRAFT and v.sank_at > max(v.armed_at, self.since - AWAY)

    @property
    def has_landed(self):
        """Whether it is on the ground, and was not disarmed above it. None: it is not known yet."""
        v = self._vehicle
        if self.fell:
            return False
        if self._was_on_ground or v.frame not in AIRCRAFT:
            return True
        if v.landed is not None and not self._heard(STATE):
            return None
        if v.relative is not None and not self._heard(POSITION, SETTLED):
            return None
        return v.landed is not False and not self._came_down_too_fast()

    def _came_down_too_fast(self):
        """Between two reports, the second on the ground: faster than a landing in the time that there was. A vehicle
        that sinks faster at the first report than before it may be falling already."""
        heights = list(self._vehicle.heights)
        ground = heights[-1].height if heights else 0.0
        for before, above, below in zip([None, *heights], heights, heights[1:]):
            if abs(below.height - ground) > NOISE:
                continue
            seconds = below.at - above.at if below.armed else below.at - above.at - REST if above.armed else 0.0
            steady = min(before.sinks, above.sinks) if before is not None else above.sinks
            if above.height - ground > NOISE + max(LANDING, steady) * max(seconds, 0.0):
                return True
        return False

    @property
    def _was_in_flight(self):
        """Whether it was disarmed in the air."""
        v = self._vehicle
        if v.frame not in AIRCRAFT:
            return False
        return self.fell or v.landed is False or (self._flew and not self._lands)

    def verdict(self, now):
        """The event that follows, or None: whether it has landed shows a moment later."""
        v, progress, since = self._vehicle, self._progress, now - self.since
        in_flight = "failed", "was disarmed in flight" + hands.emergency(now, v)
        if progress.was_at_its_landing or (self.was_away and progress.is_where_it_lands):
            if self.has_landed:
                return ("done",)
            if self.has_landed is False and (self.fell or since >= AFTERWARDS):
                return in_flight
            if since >= OPEN and v.link(now):
                return "unknown", "was disarmed, and does not report whether it has landed"
            return None
        if since < AFTERWARDS or not v.link(now):
            return None
        if self._was_in_flight:
            return in_flight
        if self.was_away:
            return "failed", "was disarmed while it was not heard: it may have flown its mission"
        return "failed", "was disarmed"
