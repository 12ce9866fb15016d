"""Missions as autopilots have them: items in order."""

import dataclasses
import hashlib
import math

from .wire import mavlink

WAYPOINT, LOITER_UNLIMITED, LOITER_TURNS, LOITER_TIME = 16, 17, 18, 19
RETURN, LAND, TAKE_OFF, VTOL_TAKE_OFF, VTOL_LAND, DELAY = 20, 21, 22, 84, 85, 93
JUMP, CHANGE_SPEED = 177, 178
JUMP_TO_TAG = 601

# Frames in the form of MISSION_ITEM_INT; an autopilot may give back the same frame in its other form.
GLOBAL, RELATIVE, MISSION_FRAME = 5, 6, 2
SAME_FRAME = {0: 5, 3: 6, 10: 11}

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
    """The reason why a mission cannot be read, as a text for people."""


def is_scaled(command, frame):
    """Whether MISSION_ITEM_INT has the 1e7-fold of param5 and param6."""
    return frame != MISSION_FRAME and command not in _NOT_SCALED


def has_defined_place(command):
    return command in DESTINATIONS or (command in _DEFINED and _DEFINED[command].has_location)


def _may_drop_place(command):
    """Whether MAVLink defines no place for the command: an autopilot need not keep one, and does not fly to it."""
    return command in _DEFINED and not has_defined_place(command) and command not in _STORED_PLACE


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
        """The least time that it takes at its place; infinity if only the autopilot knows its end."""
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
    """Whether `b` may be `a` as an autopilot stores it, in few bits."""
    a, b = (0.0 if math.isnan(c) else c for c in (a, b))
    return abs(a - b) <= max(0.51, 0.02 * abs(a)) if abs(a) >= 2 else abs(a - b) <= 0.26


def difference(sent, kept):
    """How the item on board differs from the one that was sent, in words; None if they mean the same."""
    if sent.command != kept.command:
        return f"command {kept.command} instead of {sent.command}"
    for n in _DECISIVE.get(sent.command, ()):
        if not _near(sent.params[n - 1], kept.params[n - 1]):
            return (
                f"parameter {n} of command {sent.command} is {kept.params[n - 1]:g} instead of {sent.params[n - 1]:g}"
            )
    if sent.is_scaled or has_defined_place(sent.command):
        return _different_place(sent, kept)
    return None


def _different_place(sent, kept):
    if (kept.x, kept.y) == (0, 0) and _may_drop_place(sent.command):
        return None
    if max(abs(sent.x - kept.x), abs(sent.y - kept.y)) > 1:
        return f"{kept.x / 1e7:.7f}, {kept.y / 1e7:.7f} instead of {sent.x / 1e7:.7f}, {sent.y / 1e7:.7f}"
    if not sent.is_scaled or not (sent.has_place or sent.command in DESTINATIONS):
        return None
    if SAME_FRAME.get(sent.frame, sent.frame) != SAME_FRAME.get(kept.frame, kept.frame):
        return f"frame {kept.frame} instead of {sent.frame}"
    if not (math.isnan(sent.z) or abs(sent.z - kept.z) <= 0.02):
        return f"a height of {kept.z:g} m instead of {sent.z:g} m"
    return None


@dataclasses.dataclass(frozen=True)
class Mission:
    """The items for a vehicle, without the home position that ArduPilot keeps before them."""

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
        """The mission as a JSON object, by which a later adapter recognises it on board."""
        return {
            "mission": self.digest,
            "items": len(self.items),
            "arm": self.arm,
            "endless": self.endless,
            "compiled": [_to_note(item) for item in self.items],
        }


UNKNOWN = Mission((Item(0),))  # stands for an unknown mission


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


def problems(items):
    """Why no vehicle can carry out `items`: jumps that lead nowhere, or that cannot be followed, and the like."""
    found = []
    for n, item in enumerate(items, 1):
        if item.command == JUMP_TO_TAG:
            found.append(f"item {n} jumps to a tag, which Dolphin cannot follow: use DO_JUMP")
        if item.command == JUMP and not 1 <= item.params[0] <= len(items):
            found.append(f"item {n} jumps to item {item.params[0]:g}, and there are {len(items)}")
        if item.command == JUMP and (item.params[1] < -1 or item.params[1] != int(item.params[1])):
            found.append(f"item {n} jumps {item.params[1]:g} times: give a whole number, or -1 for without end")
        if item.command == VTOL_TRANSITION and item.params[0] not in (3, 4):
            found.append(f"item {n} is a VTOL transition to state {item.params[0]:g}: 3 is rotary wing, 4 fixed wing")
    return found
