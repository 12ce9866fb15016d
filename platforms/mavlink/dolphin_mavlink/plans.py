"""Plans of programs as missions of items: stored ones by name, those of `imcPlan { ... }`, those of `mission { ... }`.

A plan that does not fit is refused as a whole before anything is sent, with the reason for each part."""

import dataclasses
import math

from . import geo
from . import mission as missions
from . import modes
from .mission import Item, Mission
from .words import IMAGE_START, IMAGE_STOP, MOST_ITEMS, Builder, Misfit, Refused, located, speed_item


@dataclasses.dataclass(frozen=True)
class For:
    """The vehicle of a plan, as far as it is known."""

    name: str = None
    frame: str = None
    is_px4: bool = False
    home: tuple = None
    place: tuple = None  # its current position
    geoid: float = None
    known: bool = False  # whether there is a vehicle
    armed: bool = False

    @property
    def kind(self):
        return modes.TYPES.get(self.frame)


def vehicle(now, name, v):
    home = v.home or (v.armed_from if v.armed else None)
    place = v.place if v.unlocated(now) is None else None
    return For(name, v.frame, v.autopilot == modes.PX4, home, place, v.geoid, True, v.armed)


def compile_plan(plan, stored, whom):
    """The Mission of `plan`, as it is in orders, for `whom`. `stored(name)` is the items of a stored mission, or raises
    Unreadable. Raises Refused, and Unheard if it depends on a value that the vehicle has not reported yet."""
    try:
        if plan.get("language") is None:
            found = Mission(stored(plan["name"]))
        elif plan["language"] == "imcPlan":
            found = _of_imc_plan(plan["body"], whom)
        elif plan["language"] == "mission":
            _check_vehicles(plan["body"].get("vehicles") or [], whom)
            found = Builder(stored, whom).mission(plan["body"]["items"])
        else:
            raise Refused([f"plans in {plan['language']} are not known here"])
    except missions.Unreadable as error:
        raise Refused([str(error)]) from None
    except (KeyError, TypeError, AttributeError, ValueError, OverflowError):
        raise Refused(["the plan is malformed"]) from None
    if len(found.items) > MOST_ITEMS:
        raise Refused([f"it has {len(found.items)} items, more than {MOST_ITEMS}"])
    problems = missions.problems(found.items)
    if whom.known and whom.kind != "UAV":
        for n, item in enumerate(found.items, 1):
            if item.command in (missions.TAKE_OFF, missions.LAND, missions.VTOL_TAKE_OFF, missions.VTOL_LAND):
                problems.append(f"item {n}: a {whom.kind} neither takes off nor lands")
    if whom.is_px4:
        for n, item in enumerate(found.items[: found.last(True)], 1):
            if not item.autocontinue:
                problems.append(f"item {n} does not go on to the next one: set autocontinue to 1")
    if whom.is_px4 and whom.frame != "vtol":
        # PX4 would wait for it without end.
        for n, item in enumerate(found.items, 1):
            if item.command == missions.VTOL_TRANSITION:
                problems.append(f"item {n}: a {whom.frame} has no VTOL transition")
    if problems:
        raise Refused(problems)
    return found


def _check_vehicles(allowed, whom):
    if allowed and whom.name is not None and whom.name not in allowed:
        raise Refused([f"only {', '.join(allowed)} may run it"])


# imcPlan


def _of_imc_plan(body, whom):
    _check_vehicles(body["vehicles"], whom)
    items, problems, speed = [], [], None
    for maneuver in body["maneuvers"]:
        try:
            new = []
            wanted = _speed_of(maneuver)
            if wanted != speed:
                new.append(_speed_item(wanted))
                speed = wanted
            start, stop = _devices(maneuver["payload"])
            items += new + start + _maneuver(maneuver, whom) + stop
        except Misfit as misfit:
            problems.append(f"maneuver {maneuver['id']}: {misfit}")
    if problems:
        raise Refused(problems)
    last = next(item for item in reversed(items) if item.is_navigation(whom.is_px4))
    return Mission(tuple(items), endless=last.command == missions.LOITER_UNLIMITED)


def _speed_of(maneuver):
    unit, value = maneuver["speedUnit"], maneuver["speed"]
    if unit == "rpm":
        raise Misfit("MAVLink knows no revolutions per minute: give the speed in metres a second, or in percent")
    if not value > 0:
        raise Misfit(f"a speed of {value:g} does not move it")
    return unit, float(value)


def _speed_item(wanted):
    unit, value = wanted
    return speed_item(value) if unit == "m/s" else Item(missions.CHANGE_SPEED, params=(1.0, -1.0, value, 0.0))


def _height(maneuver, whom):
    """(z, frame)."""
    unit, z = maneuver["zUnit"], float(maneuver["z"])
    if unit == "depth" and z > 0:
        if whom.known and whom.kind != "UUV":
            what = "an aircraft" if whom.kind == "UAV" else f"a {whom.kind}"
            raise Misfit(f"{what} does not dive to a depth of {z:g} m: give z in Z.Units.ALTITUDE, or 0")
        return -z, missions.RELATIVE
    if unit == "height":
        if not whom.known:
            return z, missions.GLOBAL
        if whom.geoid is None:
            raise Misfit(
                "the vehicle does not report the distance between ellipsoid and sea level: give z in Z.Units.ALTITUDE"
            )
        return z - whom.geoid, missions.GLOBAL
    if unit == "unspecified":
        z = 0.0
    if z == 0 and whom.kind == "UAV":
        raise Misfit("an aircraft needs a z in Z.Units.ALTITUDE or Z.Units.HEIGHT")
    return z, missions.RELATIVE


def _devices(payloads):
    start, stop = [], []
    for device in payloads:
        if device["name"].lower() != "camera":
            raise Misfit(f"MAVLink has no way to switch on '{device['name']}'")
        interval = 1.0
        for name, value in device["parameters"].items():
            try:
                number = float(value)
            except ValueError:
                raise Misfit(f"'{value}' is not a number for {name} of the camera") from None
            if name.lower() == "interval" and number > 0:
                interval = number
            elif name.lower() == "rate" and number > 0:
                interval = 1 / number
            else:
                raise Misfit(f"a camera has 'interval' or 'rate', above 0, not '{name}'")
        start.append(Item(IMAGE_START, params=(0.0, interval, 0.0, 0.0)))
        stop.append(Item(IMAGE_STOP))
    return start, stop


def _maneuver(m, whom):
    kind, place = m["maneuver"], (m["latitude"], m["longitude"])
    if kind in ("yoyo", "popup", "compassCalibration"):
        raise Misfit(f"MAVLink has no {kind}")
    z, frame = _height(m, whom)
    if kind == "goTo" or (kind == "launch" and whom.kind != "UAV"):
        return [located(missions.WAYPOINT, place, z, frame)]
    if kind == "launch":
        return [located(missions.TAKE_OFF, place, z, frame)]
    if kind in ("loiter", "skeeping"):
        direction = m.get("direction", "vehicle-dependent")
        if direction == "into-wind-or-current":
            raise Misfit("MAVLink has no loiter into the wind or current")
        radius = -m["radius"] if direction == "counter-clockwise" else m["radius"]
        if m["duration"] == 0:
            return [located(missions.LOITER_UNLIMITED, place, z, frame, (0.0, 0.0, float(radius), 0.0))]
        return [located(missions.LOITER_TIME, place, z, frame, (float(m["duration"]), 0.0, float(radius), 0.0))]
    if kind == "followPath":
        points = [(geo.displace(place, north, east), down) for north, east, down in m["points"]]
        return [located(missions.WAYPOINT, p, z - down, frame) for p, down in points]
    if kind == "rows":
        return [located(missions.WAYPOINT, geo.displace(place, *p), z, frame) for p in _rows(m)]
    raise Misfit(f"'{kind}' is not known here")


def _rows(m):
    """The corners of the rows as (north, east) from their start, as DUNE runs them: the first lies `curveOffset`
    before the start; at the far end the vehicle shifts by `alternation` percent of a step, at the near end by the rest
    of two steps; a square curve shifts first and then comes back, another does both on a diagonal."""
    step, offset = m["horizontalStep"], m["curveOffset"]
    sideways = 1 if m["firstCurveRight"] else -1
    cross, share = math.radians(m["crossAngle"]), m["alternation"] / 100
    curves = int(m["width"] / step) if step > 0 else 0
    if curves > MOST_ITEMS:
        raise Misfit(f"it has more than {MOST_ITEMS} rows")
    x, y, ahead = -offset, 0.0, 1
    points = [(x, y), (0.0, 0.0)]
    x = 0.0
    while True:
        x += ahead * (m["length"] + offset)
        points.append((x, y))
        part = share if ahead == 1 else 2 - share
        if part > 0 and curves <= 0:
            break
        if part > 0:
            curves -= 1
        shift = part * step
        x, y = x - shift * math.sin(cross), y + sideways * shift * math.cos(cross)
        if m["squareCurve"]:
            points.append((x, y))
        x -= ahead * offset
        points.append((x, y))
        ahead = -ahead
    bearing = math.radians(m["bearing"])
    sine, cosine = math.sin(bearing), math.cos(bearing)
    return [(x * cosine - y * sine, x * sine + y * cosine) for x, y in points]
