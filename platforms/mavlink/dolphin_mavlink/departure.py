"""A vehicle that has left its mission, or the mode it was in before: by its pilot, by an emergency, by the end of the
mission, or by a late copy of an order. Pure.

Nothing is sent before the verdict. The decisive report may be on its way, and one heartbeat may be an old one: a
verdict waits for another heartbeat, and if the mission may be over, for the vehicle's position."""

from . import hands

WORDS = 1.5  # seconds in which the reason for a mode that was left may come, and another heartbeat
AFTERWARDS = 4.0  # seconds in which word may come that the last item was reached
LOST = 10.0  # seconds in which such words come even if the link loses many
OVER = ("MISSION_CURRENT", "GLOBAL_POSITION_INT")  # by these shows whether a mission is over


class Departure:
    """From the first heartbeat with the other mode on. `progress` is of the mission if it ran, else None."""

    def __init__(self, now, vehicle, progress):
        self._vehicle, self._progress, self._since = vehicle, progress, now
        self._beats = vehicle.heartbeats
        # One that is not armed may have restarted: its clock shows it, once a message with it was asked for.
        may_be_over = (progress is not None and vehicle.mode in vehicle.modes.after) or not vehicle.armed
        self._due = now + (AFTERWARDS if may_be_over else WORDS)
        self.mode = vehicle.mode

    def heartbeat(self):
        self.mode = self._vehicle.mode

    def goes_on(self, now):
        """The vehicle reports that its mission is not over."""
        if self._vehicle.armed and now - self._since >= 1:
            self._due = now

    @property
    def _is_over(self):
        """Whether the mission was over, in a mode that the autopilot itself takes then."""
        if self._progress is None or self.mode not in self._vehicle.modes.after:
            return False
        return self._progress.was_over(self._since)

    def is_ripe(self, now, timeout):
        v = self._vehicle
        if self._progress is None and now - self._since > timeout:
            return True
        if now < self._due or v.heartbeats == self._beats:
            return False
        may_be_over = self._progress is not None and self.mode in v.modes.after
        if not may_be_over or self._is_over or now - self._since >= LOST:
            return True
        return all(v.heard.get(kind, 0.0) > self._since for kind in OVER)

    def verdict(self, now, restarted, may_be_ours):
        """The event that ends the mission. `may_be_ours`: whether a late copy of an order may be what took it away."""
        v = self._vehicle
        if self._is_over:
            return ("done",)
        if restarted:
            return "failed", hands.restarted(v)
        if may_be_ours and not hands.is_emergency(now, v):
            return "failed", f"left mode {v.modes.mission} for {self.mode}: by its pilot, or by a late copy of an order"
        v.pilot = self.mode
        why, v.hand = hands.named(now, v, self.mode)
        return "failed", why
