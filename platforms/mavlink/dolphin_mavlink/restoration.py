"""The mode in which a vehicle was, put back after a mission that was not begun. Pure.

It ends once the mode is back, or is another's by now, and the reason of a refusal has come."""

BACK = 15.0  # seconds in which a mode is put back, on links that lose many messages too
REFUSED = 5.0  # seconds for that if its autopilot refuses it


class Restoration:
    """`end` is the event that follows, unless something was refused: `refusal`. `mode` is None if the vehicle has
    to stay as it is."""

    def __init__(self, now, vehicle, round_trip, mode, end, refusal):
        self._vehicle, self._round_trip, self._since = vehicle, round_trip, now
        self._mode, self._end, self._refusal = mode, end, refusal
        self.is_back, self.is_refused = mode is None, False

    def heartbeat(self, known):
        """`known` are the modes that it may be in: another one was set by a pilot."""
        self.is_back = self.is_back or self._vehicle.mode == self._mode or self._vehicle.mode not in known

    def verdict(self, now):
        """The event that ends it, or None."""
        patience = max(REFUSED if self.is_refused else BACK, 3 * self._round_trip.seconds)
        if not self.is_back and now - self._since < patience:
            return None
        if self._refusal is None:
            return self._end
        if not self._refusal.is_ripe(now):
            return None
        stays = "" if self.is_back else f", and stays in mode {self._vehicle.mode}"
        return "failed", self._refusal.why + stays
