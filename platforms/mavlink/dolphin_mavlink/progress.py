"""The progress of a vehicle in its mission, from its reports and its position. Pure."""

import math

from . import geo
from . import mission as missions
from . import modes
from .wire import mavlink

NEAR = {"plane": 150.0, "vtol": 150.0}  # metres within which a place counts as reached; others: 15
LATE = 2.5  # seconds by which reports of its place and its item may be late
APART = 5.0  # metres: no autopilot takes a place for reached from as far from the next one
_ENDS_ON_THE_GROUND = (missions.LAND, missions.RETURN, missions.VTOL_LAND)


class Progress:
    """`current` is the number on board of its current item; None until the vehicle has reported one."""

    def __init__(self, vehicle, mission):
        self._vehicle, self._mission = vehicle, mission
        px4 = vehicle.autopilot == modes.PX4
        self._last_index, self._most_visits = mission.last(px4), mission.visits(px4)
        self.current = None
        self._at = None  # the item that it is at, by that or by the last one that it reached
        self._is_past = False  # whether it is at the number after the last item, as MAVSDK's vehicle is at the end
        self._was_active, self._near_since, self._was_at_last = False, None, False
        self._there_since = None  # since when it is at the place of the last item, and at that item
        self._reached, self._visits, self._reached_last = False, 0, None
        # Reports that decide are believed when they come twice.
        self._complete_since, self._completes = None, 0
        self._total, self._strange = None, 0

    def begin(self):
        self.current, self._total, self._at, self._is_past = None, None, None, False
        self._was_active, self._reached, self._visits, self._was_at_last = False, False, 0, False
        self._there_since = None

    def resume(self):
        """It has begun before."""
        self.current, self._was_active = self._vehicle.current, True
        self._at = self.current
        self._was_at_last = self._at_last

    # Items

    @property
    def first(self):
        return 1 if self._vehicle.home_is_item_0 else 0

    @property
    def _last(self):
        return self._last_index + self.first

    @property
    def _last_item(self):
        return self._mission.items[self._last_index]

    @property
    def _at_last(self):
        return self._at is not None and self._at >= self._last

    @property
    def has_begun(self):
        """Whether it was at an item after the first one since `begin`."""
        return self._at is not None and self._at > self.first

    @property
    def share(self):
        return min(max((self._vehicle.current - self.first) / len(self._mission.items), 0.0), 1.0)

    # Reports of the vehicle

    def news(self, now):
        """The vehicle has reported the state of its mission."""
        v = self._vehicle
        self.current = self._at = v.current
        self._is_past = not v.home_is_item_0 and v.current == len(self._mission.items)
        self._was_at_last = self._was_at_last or self._at_last
        self._look(now)
        if v.mission_state == mavlink.MISSION_STATE_ACTIVE:
            self._was_active = True
        if v.mission_state == mavlink.MISSION_STATE_COMPLETE:
            self._complete_since = self._complete_since if self._complete_since is not None else now
            self._completes += 1
        else:
            self._complete_since, self._completes = None, 0
        self._strange = self._strange + 1 if v.total not in (None, self._total) else 0
        if self._total is None:
            self._total = v.total

    def flies_on(self, now):
        """The vehicle reports that it is armed and flies its mission. Its item was reported before."""
        self._was_at_last = self._at_last
        self._look(now)

    def _look(self, now):
        if not (self._at_last and self._is_near(self._last_item)):
            self._there_since = None
        elif self._there_since is None:
            self._there_since = now

    def item_reached(self, seq):
        if self._at is None or seq >= self._at:
            self._at = seq + 1
            self._was_at_last = self._was_at_last or self._at_last
        if seq >= self._last and (self._reached_last is None or self._reached_last < self._last):
            self._visits += 1
            self._reached = self._visits >= self._most_visits
        self._reached_last = seq

    # Conclusions

    @property
    def is_replaced(self):
        """Whether another mission is on board."""
        return self._strange >= 2

    def is_over(self, now):
        """Whether the last item is reached and its action has begun."""
        finished = self._completes >= 2 and (self._was_active or now - self._complete_since >= 2)
        if (self._reached and (self._was_at_last or self._completes > 0)) or finished:
            return True
        return self._at_last and self._begun_without_end(now)

    def was_over(self, left):
        """Whether a vehicle that went at `left` into a mode that it takes after a mission did so because the mission
        was over. Each report may have been lost, the last ones too: then the place decides, and the time there."""
        is_complete = self._completes > 0 and (self._was_active or self.has_begun)
        if self._reached or is_complete or self._is_past:
            return True
        if self._most_visits > 1 or self._mission.endless or not self._is_near(self._last_item):
            return False
        seconds = self._last_item.seconds
        if seconds > 0 and (self._there_since is None or left - self._there_since < seconds - LATE):
            return False
        return self._was_at_last or self._is_only_at_last()

    def _is_only_at_last(self):
        """Whether the vehicle is at the place of the last item, and at none of those since the item it was at."""
        v, last = self._vehicle, self._last_item
        if self._at is None or self._at <= self.first or not last.is_destination:
            return False
        far = geo.distance(v.place, last.place)
        items = self._mission.items[self._at - self.first : self._last_index]
        others = [geo.distance(v.place, item.place) for item in items if item.is_destination]
        return all(other > max(2 * far, APART) for other in others)

    def returns_by_itself(self):
        """Whether its mode is one that the mission's last item asks for."""
        last = self._last_item.command
        if not self._was_at_last:
            return False
        returns = {"RTL", "QRTL", "SMART_RTL", "LAND", "QLAND"} if last == missions.RETURN else {"LAND", "QLAND"}
        return last in _ENDS_ON_THE_GROUND and self._vehicle.mode in returns

    @property
    def was_at_its_landing(self):
        """Whether the vehicle was at its last item, which lands it. ArduCopter goes back to its first item when it is
        disarmed: its item does not count then."""
        return self._was_at_last and self._lands(self._last_item)

    @property
    def is_where_it_lands(self):
        """Whether the mission ends with a landing, and the vehicle is at its place."""
        last = self._last_item
        places = [item for item in self._mission.items[: self._last_index + 1] if item.is_destination]
        if last.command == missions.RETURN:
            return self._is_near(last)
        return self._lands(last) and bool(places) and self._is_near(places[-1])

    @property
    def lands(self):
        """Whether the item that it is at lands it."""
        n = None if self.current is None else self.current - self.first
        return n is not None and 0 <= n < len(self._mission.items) and self._lands(self._mission.items[n])

    @staticmethod
    def _lands(item):
        return item.command in _ENDS_ON_THE_GROUND

    def _begun_without_end(self, now):
        """Whether the last item has begun, by the vehicle's position: no autopilot reports it as reached, or the report
        was lost."""
        last = self._last_item
        circles_home = last.command == missions.RETURN and self._vehicle.frame == "plane"
        if not circles_home and last.command not in (missions.LOITER_UNLIMITED, missions.WAYPOINT):
            return False
        if self._mission.endless or self._most_visits > 1:
            return False
        if not self._is_near(last):
            self._near_since = None
            return False
        if self._near_since is None:
            self._near_since = now
        if last.command == missions.LOITER_UNLIMITED:
            return True
        # A vehicle that reports the state of its mission also reports its end.
        told = self._vehicle.mission_state is not None and last.command == missions.WAYPOINT
        return not told and now - self._near_since >= last.seconds + 5

    def _is_near(self, item):
        v = self._vehicle
        place = v.home if item.command == missions.RETURN else item.place if item.is_destination else v.place
        if place is None or v.place is None:
            return False
        radius = abs(item.params[2]) if item.command in missions.DESTINATIONS and math.isfinite(item.params[2]) else 0.0
        return geo.distance(v.place, place) <= max(NEAR.get(v.frame, 15.0), 1.5 * radius)
