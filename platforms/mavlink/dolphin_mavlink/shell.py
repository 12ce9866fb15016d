"""The adapter as a process: sockets, serial lines, standard streams and clocks around `station`. It decides nothing."""

import argparse
import errno
import json
import os
import selectors
import socket
import sys
import termios
import time

from . import mission as missions
from . import mission_files
from . import replay
from .options import Trouble, kinds_of, names_of, pairs
from .station import Options, Station
from .wire import Wire

COMPONENT = 190  # MAV_COMP_ID_MISSIONPLANNER: a ground station
LONGEST_LINE = 1 << 20


# Links: each has a file descriptor, `read` (pairs of an address and data) and `write`.


class Udp:
    """Listens, and answers each sender; with `to`, also speaks first."""

    def __init__(self, port, to=None):
        self._to = to
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setblocking(False)
        if to is None:
            self._socket.bind(("", port))
        self.file = self._socket.fileno()
        self.is_stream = False

    def read(self):
        try:
            data, where = self._socket.recvfrom(65536)
            return [(where, data)]
        except OSError:
            return []  # nothing there, or an earlier datagram had no receiver

    def write(self, where, data):
        where = where or self._to
        if where is not None:
            try:
                self._socket.sendto(data, where)
            except OSError:
                pass  # as if it were lost: it is repeated


class Stream:
    """TCP or a serial line: what cannot be written at once is kept, up to a limit, and then lost like a datagram."""

    def __init__(self, file, keep):
        self.file, self._keep, self._left = file, keep, b""
        self.is_stream = True

    def read(self):
        try:
            data = os.read(self.file, 65536)
        except BlockingIOError:
            return []
        except OSError:
            data = b""
        return [(None, data)] if data else None

    def write(self, where, data):
        if len(self._left) < 65536:
            self._left += data
        self.flush()

    def flush(self):
        if self._left:
            try:
                self._left = self._left[os.write(self.file, self._left) :]
            except BlockingIOError:
                pass
            except OSError:
                self._left = b""


def _address(text, what):
    host, colon, port = text.rpartition(":")
    if not colon or not port.isdigit() or not 0 < int(port) < 65536:
        raise Trouble(f"{what} {text}: it is HOST:PORT, as in 192.168.1.20:5760")
    try:
        return socket.getaddrinfo(host or "127.0.0.1", int(port), socket.AF_INET)[0][4]
    except OSError as error:
        raise Trouble(f"{what} {text}: {error.strerror or error}") from None


def _tcp(text):
    address = _address(text, "TCP")
    try:
        connection = socket.create_connection(address, timeout=5)
    except OSError as error:
        raise Trouble(f"TCP {text}: {error.strerror or error}") from None
    connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    connection.setblocking(False)
    return Stream(connection.fileno(), connection)


def _serial(text):
    device, _, baud = text.partition(",")
    speed = getattr(termios, "B" + (baud or "57600"), None)
    if speed is None:
        raise Trouble(f"serial port {device}: {baud} is not a speed, such as 57600 or 115200")
    try:
        file = os.open(device, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        attributes = termios.tcgetattr(file)
    except (OSError, termios.error) as error:
        raise Trouble(f"serial port {device}: {error.args[-1].lower()}") from None
    raw = [0, 0, termios.CS8 | termios.CREAD | termios.CLOCAL, 0, speed, speed, attributes[6]]
    termios.tcsetattr(file, termios.TCSANOW, raw)
    return Stream(file, None)


def _udp(text):
    if text.isdigit() and 0 < int(text) < 65536:
        try:
            return Udp(int(text))
        except OSError as error:
            raise Trouble(f"UDP port {text}: {error.strerror.lower()}") from None
    return Udp(0, _address(text, "UDP"))


def read_missions(directory):
    """The stored missions of `directory` by their names; for an unreadable file the reason, as a text."""
    stored = {}
    if directory is None:
        return stored
    try:
        files = sorted(os.listdir(directory))
    except OSError as error:
        raise Trouble(f"missions in {directory}: {error.strerror.lower()}") from None
    for file in files:
        name, extension = os.path.splitext(file)
        if extension not in (".plan", ".waypoints"):
            continue
        if name in stored:
            stored[name] = f"{directory} has it twice, as .plan and as .waypoints"
            continue
        try:
            with open(os.path.join(directory, file), encoding="utf-8") as opened:
                text = opened.read()
            stored[name] = mission_files.of_file(file, text)
            if unused := mission_files.left_out(file, text):
                print(f"{file}: {unused}", file=sys.stderr)
        except (OSError, UnicodeDecodeError, missions.Unreadable, RecursionError) as error:
            stored[name] = f"{file}: {error}"
    return stored


def encoded(line):
    """A line for Dolphin. Texts may quote files with lone surrogates, which no JSON text in UTF-8 holds."""
    return json.dumps(line, separators=(",", ":"), ensure_ascii=False).encode(errors="replace") + b"\n"


class Shell:
    def __init__(self, links, options, key):
        self._links, self._station = links, Station(options)
        self._wire = Wire(options.system, COMPONENT, key)
        self._selector = selectors.DefaultSelector()
        self._rests = {}
        self._input, self._skips, self._output = b"", False, b""
        self._over = False
        self._begin = time.monotonic()

    def run(self):
        for file in (0, 1):
            os.set_blocking(file, False)
        self._selector.register(0, selectors.EVENT_READ, None)
        for number, link in enumerate(self._links):
            self._selector.register(link.file, selectors.EVENT_READ, number)
        ticked = -1.0
        while not self._over:
            pace = 0.01 if self._output else self._station.pace
            for ready, _ in self._selector.select(max(0.0, ticked + pace - self._now())):
                if ready.data is None:
                    self._read_orders()
                else:
                    self._read_link(ready.data)
            if self._now() - ticked >= self._station.pace:
                ticked = self._now()
                self._wire.set_date(time.time())
                self._station.tick(ticked)
                for link in self._links:
                    if link.is_stream:
                        link.flush()
            self._act()
        self._flush(wait=True)

    def _now(self):
        return time.monotonic() - self._begin

    def _read_link(self, number):
        link = self._links[number]
        received = link.read()
        if received is None:
            self._selector.unregister(link.file)
            self._report({"kind": "error", "why": "the connection to the vehicles has ended"})
            self._over = True
            return
        for where, data in received:
            if link.is_stream:
                messages, self._rests[number] = self._wire.decode(self._rests.get(number, b"") + data)
            else:
                messages = self._wire.decode_datagram(data)
            for message in messages:
                self._station.hear(self._now(), (number, where), message)
                self._act()
            for system, why in self._wire.take_doubts().items():
                self._station.doubt(self._now(), system, why)
                self._act()

    def _read_orders(self):
        try:
            data = os.read(0, 65536)
        except BlockingIOError:
            return
        if not data:
            self._over = True  # Dolphin has died: vehicles fly on
            return
        *lines, self._input = (self._input + data).split(b"\n")
        for line in lines:
            if self._skips:
                self._skips = False
            elif line.strip():
                self._order(line)
        if len(self._input) > LONGEST_LINE:
            self._input, self._skips = b"", True

    def _order(self, line):
        try:
            value = json.loads(line)
        except (ValueError, RecursionError):
            print("an order is not JSON, and is ignored", file=sys.stderr)
            return
        self._station.order(self._now(), value)
        self._act()

    def _act(self):
        for kind, *what in self._station.take():
            if kind == "send":
                self._send(*what)
            elif kind == "report":
                self._report(*what)
            else:
                self._over = True
        self._flush()

    def _send(self, address, message, version):
        if address is not None:
            number, where = address
            self._links[number].write(where, self._wire.encode(message, version))
            return
        for link in self._links:
            link.write(None, self._wire.encode(message, version))

    def _report(self, line):
        self._output += encoded(line)

    def _flush(self, wait=False):
        until = time.monotonic() + (0.5 if wait else 0)
        while self._output:
            try:
                self._output = self._output[os.write(1, self._output) :]
            except BlockingIOError:
                if time.monotonic() >= until:
                    return
                time.sleep(0.01)
            except OSError as error:
                if error.errno != errno.EPIPE:
                    raise
                self._over, self._output = True, b""


def _arguments(arguments):
    parser = argparse.ArgumentParser(
        prog="dolphin-mavlink",
        description="An adapter for vehicles that speak MAVLink (ArduPilot, PX4), for dolphin's option --platform.",
        epilog="dolphin-mavlink replay LOG prints what the adapter concludes from a recorded flight; see its --help.",
    )
    add = parser.add_argument
    add(
        "--udp",
        action="append",
        default=[],
        metavar="PORT|HOST:PORT",
        help="listen on PORT, or speak to HOST:PORT; 14550 if no link is given",
    )
    add("--tcp", action="append", default=[], metavar="HOST:PORT", help="connect to HOST:PORT")
    add(
        "--serial",
        action="append",
        default=[],
        metavar="DEVICE[,BAUD]",
        help="a serial line, at 57600 baud by default",
    )
    add("--missions", metavar="DIRECTORY", help="directory of stored missions: NAME.plan, NAME.waypoints")
    add("--name", action="append", default=[], metavar="NUMBER=VEHICLE", help="name of system NUMBER")
    add(
        "--kind",
        action="append",
        default=[],
        metavar="NUMBER=FRAME:AUTOPILOT",
        help="type and autopilot of system NUMBER, if its heartbeat has neither: 3=copter:px4, 4=boat:ardupilot",
    )
    add("--payload", action="append", default=[], metavar="VEHICLE=DEVICE,...", help="payload of a vehicle")
    add(
        "--on-stop",
        choices=["hold", "return"],
        default="hold",
        help="how a vehicle is stopped: it holds its place, or returns home",
    )
    add(
        "--key-file",
        metavar="FILE",
        help="the pass phrase by which messages are signed; others are then ignored",
    )
    add("--system", type=int, default=255, metavar="NUMBER", help="our own system number, 255 by default")
    return parser.parse_args(arguments)


def main(arguments=None):
    arguments = sys.argv[1:] if arguments is None else arguments
    if arguments[:1] == ["replay"]:
        return replay.main(arguments[1:])
    given = _arguments(arguments)
    try:
        if not 1 <= given.system <= 255:
            raise Trouble(f"--system {given.system}: it is 1 to 255")
        key = None
        if given.key_file is not None:
            try:
                with open(given.key_file, encoding="utf-8") as opened:
                    key = opened.read().strip()
            except (OSError, UnicodeDecodeError) as error:
                raise Trouble(f"key {given.key_file}: {getattr(error, 'strerror', None) or error}") from None
        options = Options(
            system=given.system,
            names=names_of(given.name),
            payloads={v: devices.split(",") for v, devices in pairs(given.payload, "--payload").items()},
            kinds=kinds_of(given.kind),
            stored=read_missions(given.missions),
            directory=given.missions or "the directory of missions: there is none (--missions DIRECTORY)",
            on_stop=given.on_stop,
        )
        asked = [(_udp, x) for x in given.udp] + [(_tcp, x) for x in given.tcp] + [(_serial, x) for x in given.serial]
        links = [make(x) for make, x in asked or [(_udp, "14550")]]
    except Trouble as trouble:
        sys.stdout.buffer.write(encoded({"kind": "error", "why": str(trouble)}))
        sys.stdout.buffer.flush()
        return 1
    Shell(links, options, key).run()
    return 0
