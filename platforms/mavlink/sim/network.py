"""Vehicles and an adapter's station, wired together in virtual time: no sockets, no clock. Every message goes through
the wire's bytes. Links lose, double, delay and reorder datagrams, by a seed."""

import heapq
import random

from dolphin_mavlink.station import Options, Station
from dolphin_mavlink.wire import Wire


class Network:
    def __init__(self, vehicles, seed=1, loss=0.0, doubled=0.0, reordered=0.0, delay=0.01, options=None, key=None):
        self.random = random.Random(seed)
        self.loss, self.doubled, self.reordered, self.delay = loss, doubled, reordered, delay
        self.now, self.reports, self.reported_at = 0.0, [], []
        self.sent, self.sent_messages = 0, []  # of the station
        self.down = False  # whether the links are dead
        self.log = None  # what a ground station records: the time and the frame of each message that it hears or sends
        self.loses = lambda message: False  # which messages are lost
        self.vehicles = {v.system: v for v in vehicles}
        self._wires = {v.system: Wire(v.system, v.component, key) for v in vehicles}
        self._queue, self._number = [], 0
        self._options, self._key = options or Options(), key
        self.gone = False
        self.start_station()

    def start_station(self, resumes=False):
        """A new adapter; an old one is dead."""
        self.station, self._wire, self.gone = (
            Station(self._options),
            Wire(self._options.system, 190, self._key),
            False,
        )
        self.order(kind="hello", protocol=1, dolphin="test", purpose="run", resumes=resumes)

    def order(self, **line):
        self.station.order(self.now, line)
        self._act()

    def start(self, request, vehicle, plan, timeout=60):
        self.order(kind="start", request=request, vehicle=vehicle, plan=plan, timeout=timeout)

    def stop(self, request, vehicle="mav-1"):
        self.order(kind="stop", request=request, vehicle=vehicle)

    def said(self, kind=None, request=None):
        return [r for r in self.reports if kind in (None, r["kind"]) and request in (None, r.get("request"))]

    def end_of(self, request):
        ends = [r for r in self.said(None, request) if r["kind"] in ("done", "failed", "stopped", "absent")]
        return ends[0] if ends else None

    def vehicle_said(self, name):
        """The state of a vehicle by all reports about it."""
        known = {}
        for report in self.said("vehicle"):
            if report["vehicle"] == name:
                known.update(report)
        return known

    def run(self, seconds, until=None, step=0.05):
        """Lets time pass until `until()` holds. Returns whether it does."""
        end = self.now + seconds
        while self.now < end:
            if until is not None and until():
                return True
            tick = min(self.now + step, end)
            while self._queue and self._queue[0][0] <= tick:
                self.now, _, deliver = heapq.heappop(self._queue)
                deliver()
            self.now = tick
            for vehicle in self.vehicles.values():
                self.say(vehicle, vehicle.tick(self.now))
            if not self.gone:
                self.station.tick(self.now)
                self._act()
        return until is None or until()

    def run_to_end(self, request, seconds=600):
        self.run(seconds, lambda: self.end_of(request) is not None)
        return self.end_of(request)

    def say(self, vehicle, messages):
        wire = self._wires[vehicle.system]
        for message in messages:
            data = wire.encode(message)
            if not self.loses(message):
                self._transmit(data, lambda data, v=vehicle: self._to_station(v, data))

    def repeat(self, message, system=1):
        """A copy of a message of the station arrives, however late."""
        self._to_vehicle(self.vehicles[system], self._wire.encode(message))

    def inject(self, data, address="elsewhere"):
        """A datagram of another sender."""
        for message in self._wire.decode_datagram(data):
            self.station.hear(self.now, address, message)
        self._act()

    def _transmit(self, data, deliver):
        copies = 2 if self.random.random() < self.doubled else 1
        for _ in range(copies):
            if self.down or self.random.random() < self.loss:
                continue
            late = self.random.random() * 0.3 if self.random.random() < self.reordered else 0.0
            self._number += 1
            heapq.heappush(self._queue, (self.now + self.delay + late, self._number, lambda: deliver(data)))

    def _record(self, data):
        if self.log is not None:
            self.log.append((self.now, data))

    def _to_station(self, vehicle, data):
        if self.gone:
            return
        self._record(data)
        for message in self._wire.decode_datagram(data):
            self.station.hear(self.now, ("link", vehicle.system), message)
        for system, why in self._wire.take_doubts().items():
            self.station.doubt(self.now, system, why)
        self._act()

    def _to_vehicle(self, vehicle, data):
        for message in self._wires[vehicle.system].decode_datagram(data):
            self.say(vehicle, vehicle.hear(self.now, message))

    def _act(self):
        for kind, *what in self.station.take():
            if kind == "report":
                self.reports.append(what[0])
                self.reported_at.append(self.now)
                if what[0]["kind"] == "note":
                    self.order(kind="kept", id=what[0]["id"])
            elif kind == "send":
                address, message, version = what
                if address is not None and address[1] in self.vehicles:
                    self.sent += 1
                    self.sent_messages.append(message)
                    vehicle = self.vehicles[address[1]]
                    data = self._wire.encode(message, version)
                    self._record(data)
                    if self.loses(message):
                        continue
                    self._transmit(data, lambda data, v=vehicle: self._to_vehicle(v, data))
