"""`dolphin-mavlink replay LOG`: conclusions of the adapter from a recorded flight. It sends nothing.

The messages of a telemetry log go to a station, at the times of the log. A mission is known from its transfer in the
log, in either direction, or from a file. It counts as begun when its vehicle is armed in the mode of missions."""

import argparse
import datetime
import math
import sys

from . import mission as missions
from . import mission_files
from . import modes, tlog
from .options import Trouble, kinds_of, names_of
from .station import Options, Station
from .wire import Wire

PACE = 0.1  # seconds between ticks
GAP = 60.0  # seconds of silence after which nothing more follows from it


class Transfers:
    """The missions on board, by systems, as uploads and downloads in the log show them."""

    def __init__(self):
        self._counts, self._items = {}, {}  # by the systems of the sender and the receiver
        self.on_board = {}  # items as they are numbered on board

    def hear(self, message, is_vehicle):
        """`is_vehicle`: whether a system is a vehicle."""
        kind = message.get_type()
        if getattr(message, "mission_type", 0) != 0:
            return
        ends = message.get_srcSystem(), getattr(message, "target_system", 0)
        system = ends[0] if is_vehicle(ends[0]) else ends[1]
        if kind == "MISSION_CLEAR_ALL":
            self.on_board.pop(system, None)
        elif kind == "MISSION_COUNT":
            self._counts[ends], self._items[ends] = message.count, {}
        elif kind in ("MISSION_ITEM", "MISSION_ITEM_INT") and ends in self._counts:
            items = self._items[ends]
            items[message.seq] = missions.of_message(message)
            if all(n in items for n in range(self._counts[ends])):
                self.on_board[system] = [items[n] for n in range(self._counts[ends])]

    def mission_of(self, vehicle):
        """None if the log does not have it."""
        items = self.on_board.get(vehicle.system, [])
        if vehicle.home_is_item_0:
            items = items[1:]
        else:
            items = [_with_jump_from_1(item) for item in items]
        return missions.Mission(tuple(items)) if items else None


def _with_jump_from_1(item):
    if item.command != missions.JUMP:
        return item
    return missions.dataclasses.replace(item, params=(item.params[0] + 1, *item.params[1:]))


class Replay:
    """`lines` are the conclusions: seconds since the beginning of the log, the vehicle or None, and a text."""

    def __init__(self, options, key=None, mission=None):
        self._station = Station(options)
        self._wire, self._mission = Wire(options.system, 190, key), mission
        self._transfers, self._states, self._said = Transfers(), {}, {}
        self._flights, self._now = 0, 0.0
        self.lines = []
        self._station.order(0.0, {"kind": "hello", "protocol": 1})
        self._act()

    def hear(self, now, frame):
        self._wait(now)
        for message in self._wire.decode_datagram(frame):
            self._transfers.hear(message, lambda system: system in self._station.vehicles)
            self._station.hear(self._now, "log", message)
            vehicle, flights = self._station.vehicles.get(message.get_srcSystem()), self._flights
            if vehicle is not None and message.get_type() == "HEARTBEAT":
                self._state(vehicle)
            self._act(begins=self._flights > flights)
        for system, why in self._wire.take_doubts().items():
            self._station.doubt(self._now, system, why)
            self._act()

    def finish(self):
        """The end of the log is not a loss of the link: a mission under way stays open."""
        for vehicle in self._station.vehicles.values():
            if self._station.is_busy(vehicle):
                self._say(self._station.name_of(vehicle.system), "the log ends before its mission does")

    def _wait(self, now):
        """A log may have gaps, and time stamps out of order."""
        until = max(now, self._now)
        end = min(until, self._now + GAP)
        while self._now + PACE < end:
            self._now += PACE
            self._station.tick(self._now)
            self._act()
        self._now = until
        self._station.tick(self._now)
        self._act()

    def _state(self, vehicle):
        """Its mode and whether it is armed, as far as they change; and the beginning of a mission."""
        state, before = (vehicle.mode, vehicle.armed), self._states.get(vehicle.system)
        name, flies = self._station.name_of(vehicle.system), (vehicle.modes.mission, True)
        if before is None:
            autopilot = "PX4" if vehicle.autopilot == modes.PX4 else "ArduPilot"
            self._say(name, f"{vehicle.frame} of {autopilot}")
        if state == before:
            return
        self._states[vehicle.system] = state
        self._say(name, f"{'armed' if vehicle.armed else 'disarmed'}, in mode {vehicle.mode}")
        if state != flies or self._station.is_busy(vehicle):
            return
        mission = self._transfers.mission_of(vehicle) or self._mission
        if mission is None:
            self._say(name, "flies a mission that the log does not have: give it by --mission")
            return
        self._flights += 1
        count = len(mission.items)
        self._say(name, f"begins its mission of {count} item{'' if count == 1 else 's'}")
        self._station.watch(self._now, f"flight {self._flights}", vehicle, mission)

    def _act(self, begins=False):
        """`begins`: a mission begins with this message. Until then it was another station's."""
        for kind, *what in self._station.take():
            if kind == "report":
                self._report(what[0], begins)

    def _report(self, line, begins):
        kind, vehicle = line["kind"], line.get("vehicle") or self._station.vehicle_of(line.get("request"))
        if kind == "vehicle":
            self._report_vehicle(vehicle, {k: x for k, x in line.items() if not begins or k != "unready"})
        elif kind == "log":
            self._say(vehicle, line["text"])
        elif kind == "progress":
            self._say(vehicle, f"mission at {100 * line['share']:.0f} %")
        elif kind == "done":
            self._say(vehicle, "mission done")
        elif kind == "failed":
            self._say(vehicle, f"mission failed: {line['why']}")
        elif kind == "unknown":
            self._say(vehicle, f"mission unknown: {line['why']}")

    def _report_vehicle(self, vehicle, line):
        said = self._said.setdefault(vehicle, {"link": True, "unready": None})
        if line.get("link", said["link"]) != said["link"]:
            self._say(vehicle, "is heard again" if line["link"] else "no heartbeat for 5 s: the link counts as lost")
        unready = line.get("unready", said["unready"])
        if unready != said["unready"]:
            self._say(vehicle, "can be given a plan" if unready is None else f"cannot be given a plan: {unready}")
        said.update({k: line[k] for k in ("link", "unready") if k in line})

    def _say(self, vehicle, text):
        self.lines.append((self._now, vehicle, text))


def clock(seconds):
    tenths = math.floor(10 * seconds + 0.5)
    hours, minutes, rest = tenths // 36000, tenths // 600 % 60, tenths % 600
    return f"{hours}:{minutes:02}:{rest // 10:02}.{rest % 10}"


def _arguments(arguments):
    parser = argparse.ArgumentParser(
        prog="dolphin-mavlink replay",
        description="Print what the adapter concludes from a telemetry log (.tlog) of a flight, message by message: "
        "vehicles, modes, links, failsafes, and how each mission ended and why. Nothing is sent.",
    )
    add = parser.add_argument
    add("log", metavar="LOG", help="a .tlog of Mission Planner, MAVProxy, QGroundControl or pymavlink")
    add("--mission", metavar="FILE", help="the mission that was flown, if the log lacks its transfer")
    add("--name", action="append", default=[], metavar="NUMBER=VEHICLE", help="name of system NUMBER")
    add(
        "--kind",
        action="append",
        default=[],
        metavar="NUMBER=FRAME:AUTOPILOT",
        help="kind of system NUMBER, if its heartbeat does not report it: 3=copter:px4, 4=boat:ardupilot",
    )
    add("--key-file", metavar="FILE", help="the pass phrase by which its messages are signed")
    add("--system", type=int, default=255, metavar="NUMBER", help="the recording station's number, 255 by default")
    return parser.parse_args(arguments)


def _read(path, what, mode="rb"):
    try:
        with open(path, mode, encoding=None if "b" in mode else "utf-8") as opened:
            return opened.read()
    except (OSError, UnicodeDecodeError) as error:
        raise Trouble(f"{what} {path}: {(getattr(error, 'strerror', None) or str(error)).lower()}") from None


def _mission(path):
    if path is None:
        return None
    try:
        items = mission_files.of_file(path, _read(path, "mission", "r"))
    except (missions.Unreadable, RecursionError) as error:
        raise Trouble(f"mission {path}: {error}") from None
    return missions.Mission(tuple(items))


def main(arguments):
    given = _arguments(arguments)
    try:
        options = Options(system=given.system, names=names_of(given.name), kinds=kinds_of(given.kind), picks=False)
        key = None if given.key_file is None else _read(given.key_file, "key", "r").strip()
        mission = _mission(given.mission)
        try:
            records, left_out = tlog.read(_read(given.log, "log"))
        except tlog.Unreadable as error:
            raise Trouble(f"{given.log}: {error}") from None
    except Trouble as trouble:
        print(trouble, file=sys.stderr)
        return 1
    begin = records[0][0]
    date = datetime.datetime.fromtimestamp(begin, datetime.timezone.utc)
    print(f"log of {len(records)} messages from {date:%Y-%m-%d %H:%M:%S} UTC on")
    if left_out:
        print(f"{left_out} bytes are not of a message, and were left out", file=sys.stderr)
    replay, printed = Replay(options, key, mission), 0
    for at, frame in records:
        replay.hear(at - begin, frame)
        printed = _print(replay.lines, printed)
    replay.finish()
    _print(replay.lines, printed)
    return 0


def _print(lines, printed):
    for at, vehicle, text in lines[printed:]:
        print(f"{clock(at)}  {vehicle + ': ' if vehicle else ''}{text}")
    return len(lines)
