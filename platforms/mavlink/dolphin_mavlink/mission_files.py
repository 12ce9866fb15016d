"""Missions from files: of QGroundControl (`.plan`), and of MAVProxy and Mission Planner (`.waypoints`)."""

import dataclasses
import json
import math
import re

from . import geo
from .mission import DESTINATIONS, JUMP, LAND, MISSION_FRAME, SAME_FRAME, VTOL_LAND, WAYPOINT
from .mission import Item, Unreadable, has_defined_place, is_scaled
from .wire import mavlink

_FRAMES = {0, 2, 3, 5, 6, 10, 11}
_NEED_A_PLACE = {16, 31, 36, 82, 195, 201, mavlink.MAV_CMD_CONDITION_GATE}
# These fly to a place at a height. Landings go down from any height.
_NEED_A_HEIGHT = DESTINATIONS - {LAND, VTOL_LAND, mavlink.MAV_CMD_NAV_PAYLOAD_PLACE}
_MOST = 3.4e38  # the largest number of a message
# Points of fences, and rally points: they go to the vehicle in lists of their own.
_LISTS = {
    mavlink.MAV_CMD_NAV_FENCE_RETURN_POINT: "fence",
    mavlink.MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION: "fence",
    mavlink.MAV_CMD_NAV_FENCE_POLYGON_VERTEX_EXCLUSION: "fence",
    mavlink.MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION: "fence",
    mavlink.MAV_CMD_NAV_FENCE_CIRCLE_EXCLUSION: "fence",
    mavlink.MAV_CMD_NAV_RALLY_POINT: "list of rally points",
}


def _number(value, what, default=0.0):
    if value is None:
        return default
    try:
        number = math.inf if isinstance(value, bool) else float(value) if isinstance(value, (int, float)) else math.inf
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise Unreadable(f"{what} is not a number")
    if abs(number) > _MOST:
        raise Unreadable(f"{what} is out of range")
    return number


def _item(command, frame, values, autocontinue, what):
    if not isinstance(command, int) or isinstance(command, bool) or not 0 <= command <= 65535:
        raise Unreadable(f"{what} has no command")
    if command in _LISTS:
        raise Unreadable(f"{what} (command {command}) belongs to a {_LISTS[command]}, not to a mission")
    if isinstance(frame, bool) or not isinstance(frame, int) or frame not in _FRAMES:
        raise Unreadable(f"{what} is in frame {frame}, which Dolphin does not know")
    if not isinstance(values, list) or len(values) != 7:
        raise Unreadable(f"{what} has not seven parameters")
    named = [
        _number(value, f"parameter {n} of {what}", math.nan if n == 4 else 0.0) for n, value in enumerate(values, 1)
    ]
    latitude, longitude, z = named[4:]
    unset = [value is None for value in values[4:6]]
    if has_defined_place(command) and (unset[0] != unset[1] or (any(unset) and command in _NEED_A_PLACE)):
        raise Unreadable(f"{what} has no place")
    if command in _NEED_A_HEIGHT and frame != MISSION_FRAME and values[6] is None:
        raise Unreadable(f"{what} has no height")
    if command in DESTINATIONS and frame == MISSION_FRAME and (latitude, longitude) != (0, 0):
        raise Unreadable(f"{what} flies to a place, and frame {frame} has none")
    x, y = _integers(command, frame, latitude, longitude, what)
    return Item(command, SAME_FRAME.get(frame, frame), tuple(named[:4]), x, y, z, 1 if autocontinue else 0)


def _integers(command, frame, param5, param6, what):
    """param5 and param6 as MISSION_ITEM_INT has them."""
    scaled = is_scaled(command, frame)
    if scaled and not (abs(param5) <= 90 and abs(param6) <= 180):
        raise Unreadable(f"{what} is at {param5:g}, {param6:g}, which is not a place")
    x, y = (round(p * 1e7) if scaled else round(p) for p in (param5, param6))
    if max(abs(x), abs(y)) >= 2**31:
        raise Unreadable(f"{what} has a parameter out of range")
    if (param5, param6) == (0, 0):
        return x, y
    if scaled and geo.distance((0.0, 0.0), (x / 1e7, y / 1e7)) < 1:
        raise Unreadable(f"{what} is at {param5:g}, {param6:g}, within a metre of 0, 0: give 0, 0 or its true place")
    if not scaled and has_defined_place(command) and abs(x) <= 90 and abs(y) <= 180:
        # Degrees, which the vehicle would take for units of 1e-7 degrees.
        raise Unreadable(
            f"{what} would be sent to a place within metres of 0, 0, for frame {frame} has none: give a global frame"
        )
    return x, y


def _with_jumps(items, numbers):
    """`items` with each jump to the place of its target among them, from 1. `numbers` are the items' own in the file,
    which its jumps name; None where an item has none."""
    found = []
    for n, item in enumerate(items, 1):
        if item.command == JUMP:
            target = item.params[0]
            places = [place for place, number in enumerate(numbers, 1) if number is not None and number == target]
            if len(places) != 1:
                which = "is the number of no item" if not places else f"is that of {len(places)} items"
                raise Unreadable(f"item {n} jumps to number {target:g}, which {which} of the file")
            item = dataclasses.replace(item, params=(float(places[0]), *item.params[1:]))
        found.append(item)
    return found


_LANDING_PATTERNS = ("fwLandingPattern", "vtolLandingPattern")


def _refuse_constant(name):
    raise ValueError(f"{name} is not JSON")


def _json(text):
    try:
        plan = json.loads(text, parse_constant=_refuse_constant)
    except (ValueError, RecursionError):
        return None
    return plan if isinstance(plan, dict) else None


def _of_plan(text):
    """A `.plan` of QGroundControl, of simple items, and of complex ones that list their items."""
    mission = (_json(text) or {}).get("mission")
    if not isinstance(mission, dict) or "items" not in mission:
        raise Unreadable("it is not a plan of QGroundControl")
    flat, numbers = [], []

    def add_complex(entry):
        kind = entry.get("complexItemType")
        if not isinstance(kind, str):
            raise Unreadable(f"item {len(flat) + 1} is a complex item without a type")
        if kind in _LANDING_PATTERNS:
            raise Unreadable(
                f"its landing pattern ({kind}) is not flown: replace it by way points and LAND, or by a return"
            )
        transects = entry.get("TransectStyleComplexItem")
        inner = transects if isinstance(transects, dict) else entry
        if "Items" not in inner:
            raise Unreadable(f"its item of type {kind} lists no items: save it again")
        add(inner["Items"])

    def add(entries):
        if not isinstance(entries, list):
            raise Unreadable("it has no list of items")
        for entry in entries:
            if not isinstance(entry, dict):
                raise Unreadable("an item is not an object")
            kind = entry.get("type", "SimpleItem")
            if kind == "ComplexItem":
                add_complex(entry)
            elif kind == "SimpleItem":
                command, frame, params = (entry.get(key) for key in ("command", "frame", "params"))
                flat.append(_item(command, frame, params, entry.get("autoContinue", True), f"item {len(flat) + 1}"))
                numbers.append(entry.get("doJumpId"))
            else:
                raise Unreadable(f"item {len(flat) + 1} is of type {kind}, which Dolphin does not know")

    add(mission["items"])
    if all(number is None for number in numbers):
        numbers = list(range(1, len(flat) + 1))
    return _with_jumps(flat, numbers)


def left_out(name, text):
    """The parts of the file `name` that are not flown, in words, or None."""
    if not name.endswith(".plan"):
        return None
    plan = _json(_plain(text)) or {}
    fence, rally = plan.get("geoFence"), plan.get("rallyPoints")
    has_fence = isinstance(fence, dict) and (fence.get("polygons") or fence.get("circles"))
    has_rally = isinstance(rally, dict) and rally.get("points")
    parts = ["its fence"] * bool(has_fence) + ["its rally points"] * bool(has_rally)
    return f"{' and '.join(parts)} {'is' if parts == ['its fence'] else 'are'} not uploaded" if parts else None


_WHOLE = re.compile(r"[0-9]{1,9}")
_DECIMAL = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")


def _column(text):
    """The number in a column, None for `nan`: the autopilot's own choice."""
    if text.lower() in ("nan", "-nan"):
        return None
    if not _DECIMAL.fullmatch(text):
        raise ValueError(text)
    return float(text)


def _whole_column(text):
    if not _WHOLE.fullmatch(text):
        raise ValueError(text)
    return int(text)


# A row 0 with WAYPOINT is the home position. Ground stations take any first row as that, and lose it.
def _check_home(number, item):
    if number == 0 and item.command != WAYPOINT:
        raise Unreadable(
            f"row 0 is the home position, a WAYPOINT ({WAYPOINT}), and has command {item.command}: put a row before it"
        )
    if number != 0 and item.command == WAYPOINT:
        raise Unreadable(
            f"its first row is number {number}: number the home position 0, or put a row 0 with it before this one"
        )


# Ground stations count the rows again when they read a file, and upload jumps as they are.
def _check_rows_of_jumps(items, numbers):
    for n, item in enumerate(items, 1):
        target = item.params[0]
        if item.command == JUMP and numbers.count(target) == 1 and numbers.index(target) + 1 != target:
            raise Unreadable(
                f"item {n} jumps to number {target:g}, and that row is number {numbers.index(target) + 1} if rows are "
                "counted from the home position, 0: number the rows one after another"
            )


def _of_waypoints(text):
    """A `.waypoints`: a first line `QGC WPL 110`, then rows of twelve columns; a row 0 is the home position. A file
    that begins with another row, a take-off, has none."""
    lines = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    if not lines or lines[0].split()[:3] != ["QGC", "WPL", "110"]:
        raise Unreadable("its first line is not QGC WPL 110")
    items, numbers = [], []
    for line in lines[1:]:
        what = f"item {len(items)}"
        columns = line.split()
        if len(columns) != 12:
            raise Unreadable(f"{what} has {len(columns)} columns instead of 12")
        try:
            number, _, frame, command = (_whole_column(c) for c in columns[:4])
            values = [_column(c) for c in columns[4:11]]
        except ValueError:
            raise Unreadable(f"{what} has a column that is not a number") from None
        if not items and number == 0 and command in (0, WAYPOINT):  # Mission Planner may write 0
            command = WAYPOINT
            values = [value or 0.0 for value in values]  # the home position is not flown
        items.append(_item(command, frame, values, columns[11] != "0", what))
        numbers.append(number)
    if items:
        _check_home(numbers[0], items[0])
    if numbers and numbers[0] == 0:
        del items[0], numbers[0]
    _check_rows_of_jumps(items, numbers)
    return _with_jumps(items, numbers)


_MARK = "\ufeff"  # of byte order
_END = "\x1a"  # of a file of DOS


def _plain(text):
    return text.removeprefix(_MARK).removesuffix(_END)


def of_file(name, text):
    """The items of the file `name`, which has `text`. Raises Unreadable."""
    text = _plain(text)
    items = _of_plan(text) if name.endswith(".plan") else _of_waypoints(text)
    if not items:
        raise Unreadable("it has no items")
    return tuple(items)
