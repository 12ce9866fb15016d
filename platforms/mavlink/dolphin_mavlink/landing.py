"""Whether a vehicle that is disarmed has landed, or lost its motors in flight. Pure.

ArduCopter reports the ground as soon as it is disarmed, at any height: what it reports before, and how it sinks
afterwards, decide."""

SETTLED = 1.0  # seconds after which a vehicle that lost its motors in flight sinks fast, or has sunk
OPEN = 15.0  # seconds in which the vehicle may report its landing
AWAY = 2.5  # seconds without an armed heartbeat, after which anything may have happened
POSITION, STATE = "GLOBAL_POSITION_INT", "EXTENDED_SYS_STATE"


class Disarmed:
    """A vehicle, from the first heartbeat on that reports it disarmed."""

    def __init__(self, vehicle):
        self._vehicle, self.since = vehicle, vehicle.disarmed_at
        self.was_away = self.since - vehicle.armed_at > AWAY
        self._was_on_ground = vehicle.grounded
        self._flew = vehicle.flew_at >= max(vehicle.armed_at - AWAY, self.since - 2 * AWAY)

    def _heard(self, kind, seconds=0.0):
        return self._vehicle.heard.get(kind, self.since) > self.since + seconds

    @property
    def fell(self):
        """Whether it sank faster than any landing."""
        return self._vehicle.sank_at > max(self._vehicle.armed_at, self.since - AWAY)

    @property
    def has_landed(self):
        """Whether it is on the ground, and was not disarmed above it. None: it is not known yet."""
        v = self._vehicle
        if self.fell:
            return False
        if self._was_on_ground or v.frame not in ("copter", "plane", "vtol"):
            return True
        if v.landed is not None and not self._heard(STATE):
            return None
        if v.relative is not None and not self._heard(POSITION, SETTLED):
            return None
        return v.landed is not False

    def was_in_flight(self, lands):
        """Whether it was disarmed in the air. `lands`: whether it was at an item that lands it."""
        v = self._vehicle
        if v.frame not in ("copter", "plane", "vtol"):
            return False
        return self.fell or v.landed is False or (self._flew and not lands)
