"""All vehicles of the network, and all orders of Dolphin. The pure core of the adapter: messages, orders and the time
go in; frames to send and lines to report come out, by `take`.

    station.hear(now, address, message)    a message came from there
    station.order(now, line)               Dolphin wrote this line, as a value
    station.tick(now)                      time has passed: at least every `pace` seconds
    station.take()                         actions to carry out, oldest first:
        ("send", address, message, version)    address None: to wherever vehicles are looked for
        ("report", line)
        ("quit",)
"""

import dataclasses
import difflib
import math

from . import geo, plans, resumption, version
from . import mission as missions
from .execution import TRANSFER, Execution
from .sightings import Sightings
from .telemetry import Telemetry
from .transfer import RoundTrip
from .vehicle import MOVE_SILENCE, Vehicle, is_autopilot
from .wire import mavlink
from .words import Unheard

PROTOCOL = 1
ANNOUNCE = 5
PATIENCE = 120
CLOSING = 5.0
UNHEARD = 10.0  # seconds in which the vehicle of a start has to be heard, and then its position
RESUMING = 10.0  # seconds in which orders to resume may come
REMEMBERED = 1000  # ended requests that are kept
SAID = 600.0  # seconds for which a text is not shown again
MOST_TEXTS = 200  # shown texts that are kept for each vehicle


@dataclasses.dataclass
class Options:
    system: int = 255
    names: dict = dataclasses.field(default_factory=dict)  # of systems, by their numbers
    kinds: dict = dataclasses.field(default_factory=dict)  # (autopilot, frame) that heartbeats do not have, by number
    payloads: dict = dataclasses.field(default_factory=dict)  # devices, by names
    stored: dict = dataclasses.field(default_factory=dict)  # items of missions, or why they cannot be read, by names
    directory: str = "."  # their directory
    on_stop: str = "hold"
    picks: bool = True  # whether vehicles may be picked; not in a replay


@dataclasses.dataclass
class _Request:
    vehicle: str
    plan: dict
    timeout: float
    since: float
    execution: Execution = None  # None until the vehicle is heard
    last: dict = None  # the last report on it
    resumes: bool = False
    stops: bool = False  # whether it is to be stopped as soon as the vehicle is heard
    note: int = None
    noted: dict = None  # of an adapter before this one
    doubt: str = None  # what the journal may have lost: "order" or "notes"
    heard_since: float = None  # since when the vehicle is heard


class Station:
    def __init__(self, options):
        self._options = options
        self._out = []
        self._vehicles = {}  # by system
        self._sightings = Sightings(options.picks)
        self._requests, self._over = {}, {}
        self._telemetry = {}  # by system
        self._foreign = set()
        self._early = []  # lines of the log that wait for the greeting
        self._doubts = {}  # by systems: the reason why their messages are not believed
        self._texts = {}  # by systems: the texts that were shown, and the last time of each
        self._trips = {}
        self._greeted, self._closing, self._heartbeat_at = False, None, None
        self._resumes_until = 0.0
        self._notes = 0

    def take(self):
        out, self._out = self._out, []
        return out

    @property
    def pace(self):
        return 0.05 if self._requests or self._closing is not None else 0.25

    # Flights that others have ordered

    @property
    def vehicles(self):
        """By their systems."""
        return self._vehicles

    def is_busy(self, vehicle):
        return self._request_on(vehicle) is not None

    def vehicle_of(self, name):
        """The name of the vehicle of a request, also of one that is over."""
        request = self._known(name)
        return request and request.vehicle

    def watch(self, now, name, vehicle, mission):
        """Judges a mission that another station has begun, as the request `name`."""
        request = self._requests[name] = _Request(self.name_of(vehicle.system), {}, math.inf, now)
        request.execution = self._execution(now, vehicle, mission, math.inf)
        self._do(now, request, request.execution.watch(now))

    # Names

    def name_of(self, system):
        return self._options.names.get(system, f"mav-{system}")

    def _find(self, name):
        return next((v for v in self._vehicles.values() if self.name_of(v.system) == name), None)

    # From vehicles

    def hear(self, now, address, message):
        system = message.get_srcSystem()
        if system in (0, self._options.system):
            return
        vehicle = self._vehicles.get(system)
        if vehicle is None:
            kind = self._options.kinds.get(system)
            if message.get_type() != "HEARTBEAT":
                return
            if not is_autopilot(message) and (kind is None or message.get_srcComponent() != 1):
                return
            vehicle = self._vehicles[system] = Vehicle(now, address, message, kind)
            self._trips[system] = RoundTrip()
            if getattr(message, "needs_key", False):
                self._log("signs its messages, and may not answer ours: no key was given (--key-file)", vehicle)
            self._telemetry[system] = Telemetry(now, vehicle)
            self._send_all(vehicle, self._telemetry[system].ask(now))
            self._send_heartbeat(vehicle.address, vehicle.version)
        if not self._believed(now, vehicle, address):
            return
        before = vehicle.mode, vehicle.armed
        if not self._is_for_us(message) or not vehicle.hear(now, message):
            return
        request = self._request_on(vehicle)
        if request is not None and request.execution is not None:
            self._do(now, request, request.execution.hear(now, message))
        if message.get_type() not in TRANSFER:
            self._show(now, vehicle, before != (vehicle.mode, vehicle.armed))

    def doubt(self, now, system, why):
        """A vehicle's messages are not believed, by our key."""
        if system not in self._doubts:
            self._log(f"the messages of system {system} are {why}, and are not believed (--key-file)")
        self._doubts[system] = why

    def _believed(self, now, vehicle, address):
        """A vehicle that is there is not suddenly elsewhere: it moves only after it was silent."""
        if address == vehicle.address:
            return True
        if now - vehicle.heard_at > MOVE_SILENCE:
            vehicle.address = address
            return True
        if (vehicle.system, address) not in self._foreign and len(self._foreign) < 1000:
            self._foreign.add((vehicle.system, address))
            self._log(f"another system has number {vehicle.system} too: its messages are ignored", vehicle)
        return False

    def _is_for_us(self, message):
        """Answers to other ground stations are not for us. Older autopilots leave the receiver open."""
        target = getattr(message, "target_system", 0)
        return target in (0, self._options.system)

    # From Dolphin

    def order(self, now, line):
        """`line` is any JSON value. Unknown orders are ignored, as the protocol demands."""
        kind = line.get("kind") if isinstance(line, dict) else None
        take = getattr(self, "_order_" + kind, None) if isinstance(kind, str) and kind.isidentifier() else None
        if take is None:
            return
        try:
            take(now, line)
        except (KeyError, TypeError):
            self._log(f"an order of kind {kind} lacks something, and is ignored")

    def _order_hello(self, now, line):
        if line["protocol"] != PROTOCOL:
            why = f"it speaks version {PROTOCOL} of the platform protocol, and Dolphin version {line['protocol']}"
            self._report({"kind": "error", "why": why})
            self._out.append(("quit",))
            return
        self._greeted = True
        self._resumes_until = now + RESUMING if line.get("resumes") is True else now
        self._report(
            {
                "kind": "hello",
                "protocol": PROTOCOL,
                "name": "mavlink",
                "version": version,
                "plans": ["name", "imcPlan", "mission"],
                "announce": ANNOUNCE,
                "patience": PATIENCE,
            }
        )
        early, self._early = self._early, []
        for line in early:
            self._report(line)
        for vehicle in self._vehicles.values():
            self._show(now, vehicle, True)

    def _order_telemetry(self, now, line):
        self._sightings.telemetry = bool(line["on"])

    def _order_refused(self, now, line):
        """A report was not understood. Vehicles are reported again, in a second at the latest."""
        self._sightings.forget()

    def _order_ping(self, now, line):
        self._report({"kind": "pong", "id": line["id"]})

    def _order_check(self, now, line):
        vehicle = self._find(line.get("vehicle"))
        whom = plans.For() if vehicle is None else plans.vehicle(now, line["vehicle"], vehicle)
        problems = []
        try:
            plans.compile_plan(line["plan"], self._stored, whom)
        except plans.Refused as refused:
            problems = refused.problems
        except Unheard:
            pass  # the plan fits; a start waits for it
        self._report({"kind": "checked", "id": line["id"], "problems": problems})

    def _order_kept(self, now, line):
        for request in list(self._requests.values()):
            if request.note == line["id"] and request.execution is not None:
                request.note = None
                self._do(now, request, request.execution.kept(now))

    def _order_start(self, now, line):
        known = self._known(line["request"])
        if known is not None and known.last is not None and known.last["kind"] == "absent":
            # It was never started: it is ordered again, with the same request.
            del self._over[line["request"]]
            known = None
        if known is not None:
            if known.last is not None:
                self._report(known.last)
            return
        self._give_up_older(now, line)
        self._enter(now, line)
        self._try_to_begin(now, line["request"])

    def _order_resume(self, now, line):
        known = self._known(line["request"])
        if known is not None:
            if known.last is not None:
                self._report(known.last)
            return
        request = self._enter(now, line)
        request.resumes = True
        request.doubt = line.get("doubt") if not line["notes"] else None
        if line["notes"] or request.doubt in ("order", "notes"):
            request.noted = line["notes"][0] if line["notes"] else None
            self._try_to_begin(now, line["request"])
        else:
            # Nothing is sent that begins a mission before its note is kept.
            self._end(now, line["request"], {"kind": "absent"})

    def _try_to_begin(self, now, name):
        """Once the vehicle is heard."""
        request = self._requests[name]
        vehicle = self._find(request.vehicle)
        if vehicle is None:
            patience = min(request.timeout, UNHEARD)
            if not request.resumes and now - request.since >= patience:
                why = f"no {request.vehicle} was heard for {patience:g} seconds"
                for system, doubt in self._doubts.items():
                    if self.name_of(system) == request.vehicle:
                        why += f": its messages are {doubt} (--key-file)"
                self._end(now, name, {"kind": "failed", "why": why})
            return
        if request.heard_since is None:
            request.heard_since = now
        why = None
        try:
            mission = self._mission(now, request, vehicle)
        except Unheard as unheard:
            patience = min(request.timeout, UNHEARD)
            if now - request.heard_since < patience:
                return
            why = f"its {unheard} was not heard for {patience:g} seconds"
        except plans.Refused as refused:
            why = str(refused)
        if why is not None and not request.resumes:
            self._end(now, name, {"kind": "failed", "why": why})
            return
        if why is not None and request.doubt is not None:
            # A start is refused for the same reason.
            self._end(now, name, {"kind": "absent"})
            return
        # A mission that may have been begun is stopped, even if it cannot be recognised.
        request.execution = self._execution(now, vehicle, missions.UNKNOWN if why else mission, request.timeout)
        execution = request.execution
        if request.doubt is not None:
            doubt = resumption.Doubt(
                request.doubt == "order", self._is_relative(now, request, vehicle), why is None and mission.arm)
            out = execution.resume(now, doubt=doubt)
        else:
            out = execution.resume(now, why) if request.resumes else execution.begin(now)
        if request.stops:
            out += execution.stop(now)
        self._do(now, request, out)

    def _mission(self, now, request, vehicle):
        """The mission noted when it was to begin, if there is a note: a plan may depend on the vehicle's place."""
        try:
            noted = missions.of_note(request.noted)
        except missions.Unreadable as unreadable:
            raise plans.Refused([str(unreadable)]) from None
        if noted is not None:
            return noted
        return plans.compile_plan(request.plan, self._stored, plans.vehicle(now, request.vehicle, vehicle))

    def _is_relative(self, now, request, vehicle):
        """Whether the mission depends on the place of the vehicle."""
        here = plans.vehicle(now, request.vehicle, vehicle)
        if here.place is None:
            return False
        there = dataclasses.replace(here, place=geo.displace(here.place, 1000, 1000))
        made = [plans.compile_plan(request.plan, self._stored, whom) for whom in (here, there)]
        return made[0].items != made[1].items

    def _execution(self, now, vehicle, mission, timeout):
        vehicle.begins(now)
        return Execution(vehicle, self._trips[vehicle.system], mission, timeout, self._options.on_stop)

    def _order_stop(self, now, line):
        name = line["request"]
        request = self._known(name)
        if request is None:
            self._report({"kind": "stopped", "request": name})
        elif name in self._over:
            self._report(request.last)
        elif request.execution is not None:
            self._do(now, request, request.execution.stop(now))
        elif request.resumes:
            request.stops = True
        else:
            self._end(now, name, {"kind": "stopped"})

    def _order_close(self, now, line):
        self._closing = now
        for name, request in list(self._requests.items()):
            self._order_stop(now, {"request": name})
        self._quit_if_quiet(now)

    # Requests

    def _known(self, name):
        return self._requests.get(name) or self._over.get(name)

    def _enter(self, now, line):
        request = _Request(line["vehicle"], line["plan"], float(line["timeout"]), now)
        self._requests[line["request"]] = request
        return request

    def _request_on(self, vehicle):
        name = self.name_of(vehicle.system)
        return next((r for r in self._requests.values() if r.vehicle == name), None)

    def _give_up_older(self, now, line):
        """Dolphin orders a second start only after a stop that was not confirmed: the first one is over."""
        older = [n for n, r in self._requests.items() if r.vehicle == line["vehicle"] and n != line["request"]]
        for name in older:
            self._over[name] = self._requests.pop(name)
            self._over[name].last = {"kind": "stopped", "request": name}

    def _name(self, request):
        return next(n for n, r in self._requests.items() if r is request)

    def _do(self, now, request, messages):
        """Sends the messages of an execution, and reports its events."""
        execution = request.execution
        self._send_all(execution.vehicle, messages)
        events, execution.events = execution.events, []
        for event in events:
            self._tell(now, request, *event)

    def _tell(self, now, request, kind, *what):
        name = self._name(request)
        if kind == "note":
            self._notes += 1
            request.note = self._notes
            self._report({"kind": "note", "request": name, "note": what[0], "id": request.note})
        elif kind == "progress":
            self._report({"kind": "progress", "request": name, "share": round(what[0], 3)})
        elif kind in ("done", "failed", "stopped", "absent"):
            self._end(now, name, {"kind": kind, **({"why": what[0]} if what else {})})
        elif kind in ("taken", "unknown"):
            request.last = {"kind": kind, "request": name, **({"why": what[0]} if what else {})}
            self._report(request.last)

    def _end(self, now, name, report):
        request = self._requests.pop(name)
        request.last = {"kind": report["kind"], "request": name, **report}
        vehicle = self._find(request.vehicle)
        if vehicle is not None:
            self._show(now, vehicle, True)
        self._report(request.last)
        self._over[name] = request
        if len(self._over) > REMEMBERED:
            del self._over[next(iter(self._over))]

    def _stored(self, name):
        found = self._options.stored.get(name)
        if isinstance(found, tuple):
            return found
        if found is not None:
            raise missions.Unreadable(f"mission '{name}': {found}")
        near = difflib.get_close_matches(name, self._options.stored, 1)
        hint = f": did you mean '{near[0]}'?" if near else f" in {self._options.directory}"
        raise missions.Unreadable(f"there is no mission '{name}'{hint}")

    # Time

    def tick(self, now):
        if self._heartbeat_at is None or now - self._heartbeat_at >= 1:
            self._heartbeat_at = now
            self._send_heartbeat(None, 2)
            for vehicle in self._vehicles.values():
                self._send_heartbeat(vehicle.address, 2)
                if vehicle.version == 1:
                    self._send_heartbeat(vehicle.address, 1)
        for name, request in list(self._requests.items()):
            if request.execution is not None:
                self._do(now, request, request.execution.tick(now))
            else:
                self._try_to_begin(now, name)
        for vehicle in self._vehicles.values():
            request = self._request_on(vehicle)
            execution = None if request is None else request.execution
            flies, lands = execution is not None, execution is not None and execution.lands
            self._send_all(vehicle, self._telemetry[vehicle.system].tick(now, flies, lands))
            self._show_texts(now, vehicle)
            self._show(now, vehicle)
        self._quit_if_quiet(now)

    def _quit_if_quiet(self, now):
        if self._closing is not None and (not self._requests or now - self._closing >= CLOSING):
            self._closing = None
            self._report({"kind": "quiet"})
            self._out.append(("quit",))

    # To Dolphin

    def _show(self, now, vehicle, at_once=False):
        if not self._greeted:
            return
        name = self.name_of(vehicle.system)
        # While orders to resume may follow, the mission of a vehicle may be ours.
        may_be_ours = vehicle.mode == vehicle.modes.mission and now < self._resumes_until
        has_plan = may_be_ours or self._request_on(vehicle) is not None
        payload = self._options.payloads.get(name, vehicle.devices)
        news = self._sightings.news(now, name, vehicle, payload, has_plan, at_once)
        if news is not None:
            self._report(news)

    def _show_texts(self, now, vehicle):
        """Shows texts of severity 0 to 2, each once. The pieces of a long text come one after another."""
        while vehicle.to_show and now - vehicle.to_show[0].at >= 0.5:
            words = vehicle.to_show.pop(0).words
            shown = self._texts.setdefault(vehicle.system, {})
            is_new = now - shown.get(words, -SAID) >= SAID
            shown[words] = now
            if is_new:
                self._log(words, vehicle)
            if len(shown) > MOST_TEXTS:
                del shown[next(iter(shown))]

    def _log(self, text, vehicle=None):
        about = {} if vehicle is None else {"vehicle": self.name_of(vehicle.system)}
        line = {"kind": "log", **about, "text": text}
        if self._greeted:
            self._report(line)
        else:
            self._early.append(line)  # the greeting comes first

    def _report(self, line):
        self._out.append(("report", line))

    # To vehicles

    def _send_all(self, vehicle, messages):
        self._out += [("send", vehicle.address, message, vehicle.version) for message in messages]

    def _send_heartbeat(self, address, version):
        heartbeat = mavlink.MAVLink_heartbeat_message(
            mavlink.MAV_TYPE_GCS, mavlink.MAV_AUTOPILOT_INVALID, 0, 0, mavlink.MAV_STATE_ACTIVE, 3
        )
        self._out.append(("send", address, heartbeat, version))
