"""Missions as autopilots have them: items in order. Also read from files, of QGroundControl (`.plan`) and of MAVProxy
and Mission Planner (`.waypoints`)."""

import dataclasses
import hashlib
import json
import math
import re

from . import geo
from .wire import mavlink

WAYPOINT, LOITER_UNLIMITED, LOITER_TURNS, LOITER_TIME = 16, 17, 18, 19
RETURN, LAND, TAKE_OFF, VTOL_TAKE_OFF, VTOL_LAND, DELAY = 20, 21, 22, 84, 85, 93
JUMP, CHANGE_SPEED = 177, 178
JUMP_TO_TAG = 601

# Frames in the form of MISSION_ITEM_INT; an autopilot may give back the same frame in its other form.
GLOBAL, RELATIVE, MISSION_FRAME = 5, 6, 2
_SAME_FRAME = {0: 5, 3: 6, 10: 11}
_FRAMES = {0, 2, 3, 5, 6, 10, 11}

# In every frame but MISSION_FRAME, MISSION_ITEM_INT has places in units of 1e-7 degrees, whatever the command is. These
# commands use param5 and param6 for other numbers in all frames, as ArduPilot reads them.
_NOT_SCALED = {
    mavlink.MAV_CMD_DO_DIGICAM_CONFIGURE,
    mavlink.MAV_CMD_DO_DIGICAM_CONTROL,
    mavlink.MAV_CMD_DO_GIMBAL_MANAGER_PITCHYAW,
    mavlink.MAV_CMD_NAV_SCRIPT_TIME,
    mavlink.MAV_CMD_NAV_ATTITUDE_TIME,
}
# Commands above NAV_LAST that an autopilot fulfils before it goes on (`AP_Mission::is_nav_cmd`).
_NAVIGATION = {
    mavlink.MAV_CMD_NAV_SET_YAW_SPEED,
    mavlink.MAV_CMD_NAV_SCRIPT_TIME,
    mavlink.MAV_CMD_NAV_ATTITUDE_TIME,
}
VTOL_TRANSITION = mavlink.MAV_CMD_DO_VTOL_TRANSITION
# Commands that PX4 completes before it goes on, and ArduPilot carries out at once (PX4's `mission_block.cpp`).
_NAVIGATION_OF_PX4 = {
    VTOL_TRANSITION,
    mavlink.MAV_CMD_DO_GRIPPER,
    mavlink.MAV_CMD_DO_WINCH,
    mavlink.MAV_CMD_CONDITION_GATE,
}
# Commands that fly to their place.
DESTINATIONS = {16, 17, 18, 19, 21, 22, 31, 36, 82, 84, 85, 94}
_DEFINED = mavlink.enums["MAV_CMD"]
# ArduPilot stores a place also of these, for which MAVLink defines none: NAV_CONTINUE_AND_CHANGE_ALT,
# NAV_GUIDED_ENABLE, DO_GO_AROUND.
_STORED_PLACE = {30, 92, 191}
_NEED_A_PLACE = {16, 31, 36, 82, 195, 201, mavlink.MAV_CMD_CONDITION_GATE}

# Which parameter has the seconds that the vehicle stays at the item's place.
_SECONDS = {16: 1, 19: 1, 93: 1, mavlink.MAV_CMD_NAV_SCRIPT_TIME: 2, mavlink.MAV_CMD_NAV_ATTITUDE_TIME: 1}
_ENDED_BY_AUTOPILOT = {LOITER_TURNS, mavlink.MAV_CMD_NAV_LOITER_TO_ALT, mavlink.MAV_CMD_NAV_SET_YAW_SPEED} | (
    _NAVIGATION_OF_PX4
)

# The parameters that decide what a vehicle does: they must come back as they were sent.
_DECISIVE = {
    16: (1,),
    18: (1,),
    19: (1,),
    93: (1,),
    112: (1,),
    177: (1, 2),
    178: (2,),
    mavlink.MAV_CMD_NAV_SET_YAW_SPEED: (1, 2),
    mavlink.MAV_CMD_NAV_SCRIPT_TIME: (1, 2),
    mavlink.MAV_CMD_NAV_ATTITUDE_TIME: (1,),
    VTOL_TRANSITION: (1,),
}


class Unreadable(Exception):
    """Why there is no mission; a text for people."""


def is_scaled(command, frame):
    """Whether MISSION_ITEM_INT has the 1e7-fold of param5 and param6."""
    return frame != MISSION_FRAME and command not in _NOT_SCALED


def _has_defined_place(command):
    return command in DESTINATIONS or (command in _DEFINED and _DEFINED[command].has_location)


def _may_drop_place(command):
    """Whether MAVLink defines no place for the command: an autopilot need not keep one, and does not fly to it."""
    return command in _DEFINED and not _has_defined_place(command) and command not in _STORED_PLACE


@dataclasses.dataclass(frozen=True)
class Item:
    command: int
    frame: int = MISSION_FRAME
    params: tuple = (0.0, 0.0, 0.0, 0.0)
    x: int = 0  # param5 as MISSION_ITEM_INT has it: the latitude in 1e-7 degrees, if it is scaled
    y: int = 0  # param6: the longitude
    z: float = 0.0
    autocontinue: int = 1

    def is_navigation(self, px4):
        """Whether the autopilot, PX4 or ArduPilot, completes this item before it goes on to the next one."""
        if px4 and self.command in _NAVIGATION_OF_PX4:
            return True
        return self.command <= mavlink.MAV_CMD_NAV_LAST or self.command in _NAVIGATION

    @property
    def seconds(self):
        """How long it takes where it takes place, at least; infinity if only the autopilot knows when it ends."""
        if self.command in _ENDED_BY_AUTOPILOT:
            return math.inf
        n = _SECONDS.get(self.command)
        return self.params[n - 1] if n is not None and math.isfinite(self.params[n - 1]) else 0.0

    @property
    def is_scaled(self):
        return is_scaled(self.command, self.frame)

    @property
    def has_place(self):
        """Whether it has a place other than 0, 0, which stands for the vehicle's own."""
        return self.is_scaled and (self.x, self.y) != (0, 0)

    @property
    def is_destination(self):
        """Whether the vehicle flies to its place; not so a region of interest, or a home position that is set."""
        return self.command in DESTINATIONS and self.has_place

    @property
    def place(self):
        return self.x / 1e7, self.y / 1e7

    def message(self, target, seq):
        return mavlink.MAVLink_mission_item_int_message(
            target[0],
            target[1],
            seq,
            self.frame,
            self.command,
            1 if seq == 0 else 0,
            self.autocontinue,
            *self.params,
            self.x,
            self.y,
            self.z,
        )


def of_message(message):
    """The item in a MISSION_ITEM_INT or MISSION_ITEM."""
    x, y = message.x, message.y
    if message.get_type() == "MISSION_ITEM":
        scale = 1e7 if is_scaled(message.command, message.frame) else 1
        x, y = (round(c * scale) if math.isfinite(c) else 0 for c in (x, y))
    params = (message.param1, message.param2, message.param3, message.param4)
    return Item(message.command, message.frame, params, x, y, message.z, message.autocontinue)


def _near(a, b):
    """Whether an autopilot that stores numbers in few bits may have made `b` of `a`."""
    a, b = (0.0 if math.isnan(c) else c for c in (a, b))
    return abs(a - b) <= max(0.51, 0.02 * abs(a)) if abs(a) >= 2 else abs(a - b) <= 0.26


def difference(sent, kept):
    """What a vehicle keeps otherwise than it was sent, in words; None if the two mean the same."""
    if sent.command != kept.command:
        return f"command {kept.command} instead of {sent.command}"
    for n in _DECISIVE.get(sent.command, ()):
        if not _near(sent.params[n - 1], kept.params[n - 1]):
            return (
                f"parameter {n} of command {sent.command} is {kept.params[n - 1]:g} instead of {sent.params[n - 1]:g}"
            )
    if sent.is_scaled or _has_defined_place(sent.command):
        return _different_place(sent, kept)
    return None


def _different_place(sent, kept):
    if (kept.x, kept.y) == (0, 0) and _may_drop_place(sent.command):
        return None
    if max(abs(sent.x - kept.x), abs(sent.y - kept.y)) > 1:
        return f"{kept.x / 1e7:.7f}, {kept.y / 1e7:.7f} instead of {sent.x / 1e7:.7f}, {sent.y / 1e7:.7f}"
    if not sent.is_scaled or not (sent.has_place or sent.command in DESTINATIONS):
        return None
    if _SAME_FRAME.get(sent.frame, sent.frame) != _SAME_FRAME.get(kept.frame, kept.frame):
        return f"frame {kept.frame} instead of {sent.frame}"
    if not (math.isnan(sent.z) or abs(sent.z - kept.z) <= 0.02):
        return f"a height of {kept.z:g} m instead of {sent.z:g} m"
    return None


@dataclasses.dataclass(frozen=True)
class Mission:
    """What a vehicle is to do. `items` are without the home position that ArduPilot keeps before them."""

    items: tuple
    arm: bool = False  # whether the vehicle may be armed in order to begin
    endless: bool = False  # whether its last item goes on until it is stopped

    def last(self, px4):
        """The index of the last item that is navigated: later ones are carried out at once."""
        return max((n for n, item in enumerate(self.items) if item.is_navigation(px4)), default=len(self.items) - 1)

    def visits(self, px4):
        """How many times the last navigated item is reached: jumps after it lead back."""
        times = 1
        for item in self.items[self.last(px4) + 1 :]:
            if item.command == JUMP:
                times *= math.inf if item.params[1] < 0 else 1 + item.params[1]
        return times

    @property
    def digest(self):
        return hashlib.sha256(repr((self.items, self.arm)).encode()).hexdigest()[:16]

    @property
    def note(self):
        """All that a later adapter needs to recognise the mission on board, as a JSON object."""
        return {
            "mission": self.digest,
            "items": len(self.items),
            "arm": self.arm,
            "endless": self.endless,
            "compiled": [_to_note(item) for item in self.items],
        }


UNKNOWN = Mission((Item(0),))  # stands for a mission of which nothing is known


def _to_note(item):
    params = [None if math.isnan(value) else value for value in item.params]
    values = [item.command, item.frame, item.x, item.y, item.z, item.autocontinue, *params]
    while values and values[-1] == 0:
        values.pop()
    return values


def _of_note(values):
    numbers = isinstance(values, list) and all(
        value is None or (isinstance(value, (int, float)) and not isinstance(value, bool)) for value in values
    )
    if not numbers or len(values) > 10:
        raise Unreadable("its note is malformed")
    command, frame, x, y, z, autocontinue, *params = [*values, *(0,) * (10 - len(values))]
    if any(not isinstance(value, int) for value in (command, frame, x, y, autocontinue)) or z is None:
        raise Unreadable("its note is malformed")
    params = tuple(math.nan if value is None else float(value) for value in params)
    return Item(command, frame, params, x, y, float(z), autocontinue)


def of_note(note):
    """The mission in a note; None if it has none, as those of earlier versions. Raises Unreadable."""
    if not isinstance(note, dict) or "compiled" not in note:
        return None
    if not isinstance(note["compiled"], list) or not note["compiled"]:
        raise Unreadable("its note is malformed")
    items = tuple(_of_note(values) for values in note["compiled"])
    return Mission(items, note.get("arm") is True, note.get("endless") is True)


# Files


def _number(value, what, default=0.0):
    if value is None:
        return default
    try:
        number = math.inf if isinstance(value, bool) else float(value) if isinstance(value, (int, float)) else math.inf
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise Unreadable(f"{what} is not a number")
    return number


def _item(command, frame, values, autocontinue, what):
    if not isinstance(command, int) or isinstance(command, bool) or not 0 <= command <= 65535:
        raise Unreadable(f"{what} has no command")
    if frame not in _FRAMES:
        raise Unreadable(f"{what} is in frame {frame}, which Dolphin does not know")
    if not isinstance(values, list) or len(values) != 7:
        raise Unreadable(f"{what} has not seven parameters")
    named = [
        _number(value, f"parameter {n} of {what}", math.nan if n == 4 else 0.0) for n, value in enumerate(values, 1)
    ]
    latitude, longitude, z = named[4:]
    unset = [value is None for value in values[4:6]]
    if _has_defined_place(command) and (unset[0] != unset[1] or (any(unset) and command in _NEED_A_PLACE)):
        raise Unreadable(f"{what} has no place")
    if command in DESTINATIONS and frame == MISSION_FRAME and (latitude, longitude) != (0, 0):
        raise Unreadable(f"{what} flies to a place, and frame {frame} has none")
    x, y = _integers(command, frame, latitude, longitude, what)
    return Item(command, _SAME_FRAME.get(frame, frame), tuple(named[:4]), x, y, z, 1 if autocontinue else 0)


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
    if not scaled and _has_defined_place(command) and abs(x) <= 90 and abs(y) <= 180:
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


_LANDING_PATTERNS = {"fwLandingPattern", "vtolLandingPattern"}


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
        raise Unreadable("it is no plan of QGroundControl")
    flat, numbers = [], []

    def add_complex(entry):
        kind = entry.get("complexItemType")
        if kind in _LANDING_PATTERNS:
            raise Unreadable(
                f"its landing pattern ({kind}) is not flown: replace it by way points and LAND, or by a return"
            )
        transects = entry.get("TransectStyleComplexItem")
        inner = transects if isinstance(transects, dict) else entry
        if "Items" not in inner:
            raise Unreadable(f"its item of type {kind} lists no items: save it anew")
        add(inner["Items"])

    def add(entries):
        if not isinstance(entries, list):
            raise Unreadable("it has no list of items")
        for entry in entries:
            if not isinstance(entry, dict):
                raise Unreadable("an item is no object")
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
    """The parts of the file `name` that are not flown, in words; None if there are none."""
    if not name.endswith(".plan"):
        return None
    plan = _json(text.removeprefix(_MARK)) or {}
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
            raise Unreadable(f"{what} has a column that is no number") from None
        items.append(_item(command, frame, values, columns[11] != "0", what))
        numbers.append(number)
    if items:
        _check_home(numbers[0], items[0])
    if numbers and numbers[0] == 0:
        del items[0], numbers[0]
    return _with_jumps(items, numbers)


_MARK = "\ufeff"  # of byte order


def of_file(name, text):
    """The items of the file `name`, which has `text`. Raises Unreadable."""
    text = text.removeprefix(_MARK)
    items = _of_plan(text) if name.endswith(".plan") else _of_waypoints(text)
    if not items:
        raise Unreadable("it has no items")
    return tuple(items)


def problems(items):
    """What keeps any vehicle from carrying out `items`: jumps that lead nowhere, or that cannot be followed."""
    found = []
    for n, item in enumerate(items, 1):
        if item.command == JUMP_TO_TAG:
            found.append(f"item {n} jumps to a tag, which Dolphin cannot follow: use DO_JUMP")
        if item.command == JUMP and not 1 <= item.params[0] <= len(items):
            found.append(f"item {n} jumps to item {item.params[0]:g}, and there are {len(items)}")
        if item.command == VTOL_TRANSITION and item.params[0] not in (3, 4):
            found.append(f"item {n} is a VTOL transition to state {item.params[0]:g}: 3 is rotary wing, 4 fixed wing")
    return found
