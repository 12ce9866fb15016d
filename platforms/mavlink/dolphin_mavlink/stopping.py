"""A stop, until the vehicle confirms it. Pure.

An acknowledgement comes before the mode changes, and is not one: heartbeats confirm a stop."""

GRACE = 5.0  # seconds in which a mode that was accepted shows in heartbeats
SETTLED = 1.0  # seconds after which few late copies of an order still come
GOES_ON, AGAIN, STOPPED = "goes on", "again", "stopped"


class Stopping:
    """`mode` is the one that is ordered, `before` the one before the mission."""

    def __init__(self, vehicle, commands, progress, mode, before):
        self._vehicle, self._commands, self._progress = vehicle, commands, progress
        self._mode, self._before, self._at_stop = mode, before, vehicle.mode
        self._since, self._beats, self._accepted = 0.0, 0, None

    def ordered(self, now):
        self._since, self._beats, self._accepted = now, self._vehicle.heartbeats, None

    def accepted(self, now):
        self._accepted = now

    def heartbeat(self, now):
        """GOES_ON; AGAIN if the mode has to be ordered again; or STOPPED."""
        v = self._vehicle
        if v.mode == v.modes.mission and v.armed:
            # If it has not heard us yet, the order is repeated.
            return AGAIN if self._accepted is not None and now - self._accepted > 1 else GOES_ON
        if not v.armed:
            return STOPPED
        if self._commands.since_mode(now, v.modes.mission) < SETTLED and v.is_confused(now):
            return GOES_ON  # a late copy of the order to begin may still arrive
        if v.mode == self._mode:
            # Was it in this mode when the mission was to begin, that order may still be on its way.
            if self._accepted is not None or self._at_stop != self._mode:
                return STOPPED
        elif v.mode not in (self._at_stop, self._before):
            return STOPPED  # by a pilot's hand
        if self._progress.returns_by_itself():
            return GOES_ON
        never_begun = now - self._since > GRACE and v.heartbeats - self._beats >= 3
        return STOPPED if never_begun else GOES_ON
