"""`mission { ... }`: a language of plans for vehicles whose plans are missions of items. Heights are metres above the
home position, distances metres, times seconds. A mission that cannot be flown is refused with all reasons."""

import dataclasses
import math

from . import geo
from . import mission as missions
from .mission import Item, Mission
from .wire import mavlink

IMAGE_START, IMAGE_STOP = mavlink.MAV_CMD_IMAGE_START_CAPTURE, mavlink.MAV_CMD_IMAGE_STOP_CAPTURE
MOST_ITEMS = 5000
APPROACH = 5.0  # metres ahead for each metre of height that a plane's way down to its landing takes, at least


class Refused(Exception):
    """`problems`: the reasons why the plan is refused, each in a few words."""

    def __init__(self, problems):
        super().__init__("; ".join(problems))
        self.problems = list(problems)


class Unheard(Exception):
    """A value that the plan depends on, and that the vehicle has not reported yet."""


class Misfit(Exception):
    """Why one maneuver or item does not fit."""


def located(command, place, z, frame, params=(0.0, 0.0, 0.0, 0.0)):
    return Item(command, frame, params, round(place[0] * 1e7), round(place[1] * 1e7), float(z))


def speed_item(metres):
    return Item(missions.CHANGE_SPEED, params=(1.0, float(metres), -1.0, 0.0))


class Builder:
    """Goes through the items of `mission { ... }` in order. Heights are metres above the home position."""

    def __init__(self, stored, whom):
        self._stored, self._whom = stored, whom
        self.items, self.first_of, self.jumps = [], [], []
        self.arm, self.endless = False, False
        self._altitude = None
        # A vehicle on the ground takes its place for home once it is armed. Without a vehicle any place will do.
        anywhere = None if whom.known else (0.0, 0.0)
        self._at = whom.place or anywhere
        self._home_at = whom.home or (None if whom.armed else whom.place) or anywhere

    def mission(self, entries):
        problems = []
        for n, entry in enumerate(entries, 1):
            name = entry["item"]
            make = getattr(self, "_" + WORDS[name], None) if name in WORDS else None
            if make is None:
                problems.append(f"'{name}' is not an item of missions")
                continue
            before = len(self.items)
            try:
                positional, named = _WORDS_TAKE[name]
                arguments = _Arguments(name, entry["arguments"], entry["named"], positional, named)
                make(arguments)
            except Misfit as misfit:
                problems.append(f"item {n}, {name}: {misfit}")
            if len(self.items) > before or name == "jumpToItem":
                self.first_of.append(before)
        for at, to, times in self.jumps:
            if not 1 <= to <= len(self.first_of):
                problems.append(f"jumpToItem {to}: there are {len(self.first_of)} items")
            else:
                target = self.first_of[to - 1] + 1
                self.items[at] = Item(missions.JUMP, params=(float(target), float(times), 0.0, 0.0))
        if problems:
            raise Refused(problems)
        if not self.items:
            raise Refused(["it has no items"])
        return Mission(tuple(self.items), self.arm)

    @property
    def _place(self):
        """The place of the vehicle after the items so far."""
        if self._at is None:
            raise Unheard("position")
        return self._at

    @property
    def _home(self):
        if self._home_at is None:
            raise Unheard("home position")
        return self._home_at

    def _to(self, place):
        self._at = place

    def _z(self, a):
        given = a.number("altitude", None)
        if given is not None:
            self._altitude = given
        if self._altitude is None:
            if self._whom.kind in (None, "UAV"):
                raise Misfit("how high? Give altitude: metres above home, or begin with takeOff")
            self._altitude = 0.0
        speed = a.number("speed", None)
        if speed is not None:
            self._change_speed(speed)
        return self._altitude

    def _change_speed(self, speed):
        if not speed > 0:
            raise Misfit(f"a speed of {speed:g} does not move it")
        self.items.append(speed_item(speed))

    def _go(self, command, a, params=(0.0, 0.0, 0.0, 0.0)):
        z = self._z(a)
        self.items.append(located(command, self._place, z, missions.RELATIVE, params))

    # Settings

    def _settings_name(self, a):
        pass

    def _set_arm(self, a):
        self.arm = a.truth("arm")

    def _fly_stored(self, a):
        items = self._stored(a.text("stored"))
        base = len(self.items)
        for item in items:
            if item.command == missions.JUMP:
                item = dataclasses.replace(item, params=(item.params[0] + base, *item.params[1:]))
            self.items.append(item)
            if item.is_destination:
                self._to(item.place)
            elif item.command == mavlink.MAV_CMD_DO_SET_HOME:
                self._home_at = item.place if item.has_place else self._place

    def _speed(self, a):
        self._change_speed(a.number("speed"))

    def _set_altitude(self, a):
        self._altitude = a.number("altitude")

    def _set_home(self, a):
        place = a.place("position", None)
        if place is None:
            self._home_at = self._place
            self.items.append(Item(mavlink.MAV_CMD_DO_SET_HOME, params=(1.0, 0.0, 0.0, 0.0)))
        else:
            self._home_at = place
            self.items.append(located(mavlink.MAV_CMD_DO_SET_HOME, place, 0, missions.RELATIVE))

    # Ways

    def _take_off(self, a):
        self._altitude = a.number("altitude")
        if self._altitude <= 0:
            raise Misfit(f"to {self._altitude:g} m is not a take-off")
        yaw = a.number("yaw", math.nan)
        self.items.append(
            Item(missions.TAKE_OFF, missions.RELATIVE, (0.0, 0.0, 0.0, yaw), *_scaled(self._place), self._altitude)
        )

    def _to_offset(self, a):
        """To the given position, or else its place then, moved north, east and up by the given distances."""
        start = a.place("position", None) or self._place
        self._to(geo.displace(start, a.number("north", 0.0), a.number("east", 0.0)))
        self._rise(a)

    def _move(self, a):
        self._to_offset(a)
        self._go(missions.WAYPOINT, a)

    def _rise(self, a):
        up = a.number("up", 0.0)
        if up != 0:
            if self._altitude is None:
                raise Misfit("up from what? Give altitude: metres above home")
            self._altitude += up

    def _move_from_home(self, a):
        self._to(geo.displace(self._home, a.number("north", 0.0), a.number("east", 0.0)))
        self._rise(a)
        self._go(missions.WAYPOINT, a)

    def _go_to(self, a):
        a.place("position")
        self._move(a)

    def _return_home(self, a):
        self._to(self._home)
        self._go(missions.WAYPOINT, a)

    def _return_home_and_loiter(self, a):
        self._to(self._home)
        self._loiter(a)

    def _return_home_and_land(self, a):
        self._return_home(a)
        self._check_approach(self._home, self._home)
        self.items.append(located(missions.LAND, self._home, 0, missions.RELATIVE))

    def _check_approach(self, start, place):
        """A plane glides from the item before to the place where it lands, as steep as that is."""
        if self._whom.frame not in ("plane", "vtol"):
            return
        if self._altitude is None:
            raise Misfit("from how high does it land? Give altitude: metres above home, before the approach")
        ahead, least = geo.distance(start, place), APPROACH * self._altitude
        if ahead < least:
            raise Misfit(
                f"a plane comes down from {self._altitude:g} m within {ahead:.0f} m: begin the approach by goPos "
                f"{least:.0f} m or more before the place, and land by landingPoint"
            )

    def _land(self, a):
        start = self._place if self._whom.frame in ("plane", "vtol") else None
        self._to_offset(a)
        self._check_approach(start, self._place)
        self.items.append(located(missions.LAND, self._place, 0, missions.RELATIVE))

    def _move_and_loiter(self, a):
        self._to_offset(a)
        self._loiter(a)

    def _loiter(self, a):
        seconds, turns, radius = a.number("duration", 0.0), a.number("turns", 0.0), a.number("radius", 0.0)
        if seconds < 0 or turns < 0 or (seconds > 0 and turns > 0):
            raise Misfit("it takes seconds or turns, above 0, not both")
        if turns > 0:
            self._go(missions.LOITER_TURNS, a, (turns, 0.0, radius, 0.0))
        elif seconds > 0:
            self._go(missions.LOITER_TIME, a, (seconds, 0.0, radius, 0.0))
        else:
            self._go(missions.LOITER_UNLIMITED, a, (0.0, 0.0, radius, 0.0))

    def _loiter_turns(self, a):
        turns = a.number("turns")
        if turns <= 0:
            raise Misfit(f"{turns:g} turns are none")
        self._to(a.place("position", None) or self._place)
        self._go(missions.LOITER_TURNS, a, (turns, 0.0, a.number("radius", 0.0), 0.0))

    def _loiter_time(self, a):
        seconds = a.number("duration")
        if seconds <= 0:
            raise Misfit("for how long? Give seconds above 0")
        self._to(a.place("position", None) or self._place)
        self._go(missions.LOITER_TIME, a, (seconds, 0.0, a.number("radius", 0.0), 0.0))

    def _delay(self, a):
        seconds = a.number("duration")
        if seconds <= 0:
            raise Misfit("for how long? Give seconds above 0")
        if self._whom.frame in ("plane", "vtol"):
            self._go(missions.LOITER_TIME, a, (seconds, 0.0, 0.0, 0.0))
        else:
            self.items.append(Item(missions.DELAY, params=(seconds, -1.0, -1.0, -1.0)))

    def _jump(self, a):
        to, times = a.number("item"), a.number("times", 1.0)
        if to != int(to) or times != int(times) or times < -1:
            raise Misfit("it takes the number of an item, and how many times, or -1 for always")
        self.jumps.append((len(self.items), int(to), int(times)))
        self.items.append(Item(missions.JUMP))

    # Photos

    def _photo(self, a):
        self.items.append(Item(IMAGE_START, params=(0.0, 0.0, 1.0, float(len(self.items) + 1))))

    def _photos(self, a):
        count, interval = a.number("count"), a.number("interval", 1.0)
        if count < 1 or interval <= 0:
            raise Misfit("it takes how many, and the seconds between two")
        self.items.append(Item(IMAGE_START, params=(0.0, interval, float(int(count)), 0.0)))

    def _photos_until_stop(self, a):
        interval = a.number("interval", 1.0)
        if interval <= 0:
            raise Misfit("the seconds between two photos are above 0")
        self.items.append(Item(IMAGE_START, params=(0.0, interval, 0.0, 0.0)))

    def _stop_photos(self, a):
        self.items.append(Item(IMAGE_STOP))

    def _survey(self, a):
        corners, spacing = a.places("area"), a.number("spacing", 20.0)
        if len(corners) < 3:
            raise Misfit("an area has at least three corners")
        if spacing <= 0:
            raise Misfit("the metres between two lines are above 0")
        z = self._z(a)
        for place in survey_lines(corners, spacing, a.number("bearing", 0.0)):
            self._to(place)
            self.items.append(located(missions.WAYPOINT, place, z, missions.RELATIVE))


def _scaled(place):
    return round(place[0] * 1e7), round(place[1] * 1e7)


_WAY = ("altitude", "speed")
_LOITER = ("duration", "turns", "radius", *_WAY)
_OFFSET = ("north", "east", "up")
# Each word, its method, its positional arguments in order, and those that only have names.
_LANGUAGE = [
    ("name", "settings_name", ("name",), ()),
    ("arm", "set_arm", ("arm",), ()),
    ("stored", "fly_stored", ("stored",), ()),
    ("speed", "speed", ("speed",), ()),
    ("altitude", "set_altitude", ("altitude",), ()),
    ("home", "set_home", ("position",), ()),
    ("takeOff", "take_off", ("altitude",), ()),
    ("takeOffWithYaw", "take_off", ("altitude", "yaw"), ()),
    ("move", "move", _OFFSET, ("position", *_WAY)),
    ("moveFromHome", "move_from_home", _OFFSET, _WAY),
    ("goPos", "go_to", ("position",), (*_OFFSET, *_WAY)),
    ("returnHome", "return_home", (), _WAY),
    ("returnHomeAndLoiter", "return_home_and_loiter", ("duration",), _LOITER[1:]),
    ("returnHomeAndLand", "return_home_and_land", (), _WAY),
    ("landingPoint", "land", ("position",), ("north", "east")),
    ("moveAndLoiter", "move_and_loiter", _OFFSET, ("position", *_LOITER)),
    ("loiterPos", "move_and_loiter", ("position",), (*_OFFSET, *_LOITER)),
    ("loiterTurns", "loiter_turns", ("turns", "position"), ("radius", *_WAY)),
    ("loiterTime", "loiter_time", ("duration", "position"), ("radius", *_WAY)),
    ("delay", "delay", ("duration",), _WAY),
    ("capturePhoto", "photo", (), ()),
    ("captureSeveralPhotos", "photos", ("count", "interval"), ()),
    ("captureUntilStop", "photos_until_stop", ("interval",), ()),
    ("stopCapturing", "stop_photos", (), ()),
    ("jumpToItem", "jump", ("item", "times"), ()),
    ("surveyArea", "survey", ("area", "spacing"), ("bearing", *_WAY)),
]
WORDS = {word: method for word, method, _, _ in _LANGUAGE}
_WORDS_TAKE = {word: (positional, named) for word, _, positional, named in _LANGUAGE}


class _Arguments:
    """The arguments of a word, by name."""

    def __init__(self, word, given, named, positional, only_named):
        if len(given) > len(positional):
            raise Misfit(f"takes {', '.join(positional) or 'nothing'}, not {len(given)} arguments")
        self._of = dict(zip(positional, given))
        for name, value in named.items():
            if name not in positional and name not in only_named:
                known = ", ".join((*positional, *only_named)) or "none"
                raise Misfit(f"has no argument '{name}': it has {known}")
            if name in self._of:
                raise Misfit(f"{name} is given twice")
            self._of[name] = value

    def _get(self, name, default, required):
        if name in self._of:
            return self._of[name]
        if required:
            raise Misfit(f"lacks {name}")
        return default

    def number(self, name, *default):
        value = self._get(name, *(default or (None,)), not default)
        if name not in self._of:
            return value
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) < 1e7:
            raise Misfit(f"{name} is not a number within range")
        return float(value)

    def truth(self, name):
        value = self._get(name, None, True)
        if not isinstance(value, bool):
            raise Misfit(f"{name} is true or false")
        return value

    def text(self, name):
        value = self._get(name, None, True)
        if not isinstance(value, str):
            raise Misfit(f"{name} is not a text")
        return value

    def place(self, name, *default):
        value = self._get(name, *(default or (None,)), not default)
        return value if name not in self._of else _place(name, value)

    def places(self, name):
        value = self._get(name, None, True)
        if not isinstance(value, list):
            raise Misfit(f"{name} is a list of positions")
        return [_place(f"a corner of {name}", corner) for corner in value]


def _place(what, value):
    if isinstance(value, dict) and "latitude" in value and "longitude" in value:
        latitude, longitude = value["latitude"], value["longitude"]
        numbers = all(isinstance(c, (int, float)) and not isinstance(c, bool) for c in (latitude, longitude))
        if numbers and abs(latitude) <= 90 and abs(longitude) <= 180:
            return float(latitude), float(longitude)
    raise Misfit(f"{what} is not a position")


def survey_lines(corners, spacing, bearing):
    """The ends of parallel lines over the area, `spacing` metres apart, along `bearing`, there and back."""
    origin = corners[0]
    turn = math.radians(bearing)
    sine, cosine = math.sin(turn), math.cos(turn)

    def along(corner):
        north, east = geo.offset(origin, corner)
        return north * cosine + east * sine, east * cosine - north * sine

    points = [along(corner) for corner in corners]
    low, high = min(y for _, y in points), max(y for _, y in points)
    lines = max(1, math.ceil((high - low) / spacing))
    if lines > MOST_ITEMS / 2:
        raise Misfit(f"it has {lines} lines: the spacing is too small")
    ends = []
    for n in range(lines):
        y = low + (n + 0.5) * (high - low) / lines
        crossings = []
        for (x1, y1), (x2, y2) in zip(points, points[1:] + points[:1]):
            if (y1 <= y) != (y2 <= y):
                crossings.append(x1 + (y - y1) / (y2 - y1) * (x2 - x1))
        crossings.sort()
        line = [(x, y) for x in crossings]
        ends += line if n % 2 == 0 else line[::-1]
    return [geo.displace(origin, x * cosine - y * sine, x * sine + y * cosine) for x, y in ends]
