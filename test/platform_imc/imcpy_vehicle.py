"""A vehicle made with imcpy, for the tests of our console: it announces itself, takes plans and says how they go, as a
vehicle with DUNE does. Only this machine hears it. Usage:

  imcpy_vehicle.py FIRST-LAST LOG    the ports for announcements; what it was told to do is written to LOG, as JSON
"""
import json
import math
import select
import socket
import sys
import time

import imcpy

ME = 0x1A
KNOWN = {"survey": 0.4, "long": 60.0}
Control, State = imcpy.PlanControl, imcpy.PlanControlState


class Vehicle:
    def __init__(self, discovery, log):
        self.discovery, self.log = discovery, log
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.consoles = {}
        self.state, self.outcome, self.plan = State.StateEnum.READY, State.LastPlanOutcomeEnum.NONE, ""
        self.running = None  # The request, and when its plan ends.
        self.due = {}

    # Sending.

    def send(self, message, to, dst=0xFFFF):
        message.src, message.dst = ME, dst
        message.set_timestamp_now()
        self.socket.sendto(imcpy.Packet.serialize(message), to)

    def tell(self, message, dst=0xFFFF):
        for address in self.consoles.values():
            self.send(message, address, dst)

    def announce(self):
        message = imcpy.Announce()
        message.sys_name, message.sys_type, message.owner = "imcpy-1", imcpy.SystemType.UUV, 0xFFFF
        message.lat, message.lon = math.radians(41.185), math.radians(-8.706)
        message.services = f"imc+udp://127.0.0.1:{self.socket.getsockname()[1]}/"
        for port in self.discovery:
            self.send(message, ("127.0.0.1", port), 0)

    def say_state(self):
        message = State()
        message.state, message.last_outcome, message.plan_id = self.state, self.outcome, self.plan
        message.plan_progress, message.plan_eta = (50.0, 1) if self.running else (-1.0, 0)
        self.tell(message)

    def say_mode(self):
        message = imcpy.VehicleState()
        modes = imcpy.VehicleState.OperationModeEnum
        message.op_mode = modes.MANEUVER if self.running else modes.SERVICE
        self.tell(message)

    def say_position(self):
        message = imcpy.EstimatedState()
        message.lat, message.lon, message.x, message.y = math.radians(41.185), math.radians(-8.706), 100.0, -50.0
        self.tell(message)

    def say_battery(self):
        message = imcpy.FuelLevel()
        message.value, message.confidence = 75.0, 100.0
        self.tell(message)

    def reply(self, request, kind, info):
        message = Control()
        message.type, message.op = kind, request.op
        message.request_id, message.plan_id, message.info = request.request_id, request.plan_id, info
        self.tell(message, request.src)

    # Plans.

    def note(self, **what):
        print(json.dumps(what), file=self.log, flush=True)

    def described(self, plan):
        """What we were told to do, in degrees."""
        def maneuver(m):
            d = m.data
            return [m.maneuver_id, d.msg_name, round(math.degrees(d.lat), 6), round(math.degrees(d.lon), 6),
                    round(d.z, 2), d.z_units.name, round(d.speed, 2), d.speed_units.name,
                    [[a.name, [[p.name, p.value] for p in a.params]] for a in m.start_actions]]
        return {"start": plan.start_man_id, "maneuvers": [maneuver(m) for m in plan.maneuvers],
                "transitions": [[t.source_man, t.conditions, t.dest_man] for t in plan.transitions]}

    def start(self, request):
        arg, name = request.arg, request.plan_id
        lasts = 0.4 if isinstance(arg, imcpy.PlanSpecification) else KNOWN.get(name)
        self.state, self.running = State.StateEnum.INITIALIZING, None
        self.say_state()
        if lasts is None:
            self.note(did="refused", plan=name)
            self.state, self.outcome = State.StateEnum.READY, State.LastPlanOutcomeEnum.FAILURE
            self.reply(request, Control.TypeEnum.FAILURE, "undefined plan")
        else:
            self.note(did="started", plan=name, **(self.described(arg) if arg else {}))
            self.reply(request, Control.TypeEnum.SUCCESS, "plan loaded")
            self.state, self.plan, self.running = State.StateEnum.EXECUTING, name, (request, time.time() + lasts)
            self.say_mode()
            self.say_state()
            self.reply(request, Control.TypeEnum.SUCCESS, "1: executing maneuver")
        self.say_state()

    def end(self, outcome):
        self.running, self.state, self.outcome = None, State.StateEnum.READY, outcome
        self.say_state()
        self.say_mode()

    def obey(self, request):
        if request.type != Control.TypeEnum.REQUEST or request.dst != ME:
            return
        if request.op == Control.OperationEnum.START:
            self.start(request)
        elif request.op == Control.OperationEnum.STOP and self.running:
            self.note(did="stopped", plan=self.plan)
            self.reply(request, Control.TypeEnum.SUCCESS, "OK")
            self.end(State.LastPlanOutcomeEnum.FAILURE)
        else:
            self.reply(request, Control.TypeEnum.FAILURE, "no plan is running, request ignored")

    # Time.

    def hear(self, packet, address):
        message = imcpy.Packet.deserialize(packet)
        self.consoles[message.src] = address
        if isinstance(message, Control):
            self.obey(message)
        elif isinstance(message, imcpy.EntityList) and message.op == imcpy.EntityList.OperationEnum.QUERY:
            answer = imcpy.EntityList()
            answer.op, answer.list = imcpy.EntityList.OperationEnum.REPORT, "Daemon=0;Sidescan=60;DVL=58"
            self.send(answer, address, message.src)

    def tick(self, now):
        if self.running and now >= self.running[1]:
            self.note(did="completed", plan=self.plan)
            self.reply(self.running[0], Control.TypeEnum.SUCCESS, "plan completed")
            self.end(State.LastPlanOutcomeEnum.SUCCESS)
        streams = [(self.announce, 0.5), (self.say_state, 0.35), (self.say_mode, 0.5), (self.say_position, 0.5),
                   (lambda: self.tell(imcpy.Heartbeat()), 1.0), (self.say_battery, 1.0)]
        for i, (say, period) in enumerate(streams):
            if now >= self.due.get(i, 0):
                say()
                self.due[i] = now + period

    def live(self):
        while True:
            self.tick(time.time())
            if select.select([self.socket], [], [], 0.01)[0]:
                self.hear(*self.socket.recvfrom(65535))


def main():
    first, last = map(int, sys.argv[1].split("-"))
    with open(sys.argv[2], "w", encoding="utf-8") as log:
        Vehicle(range(first, last + 1), log).live()


if __name__ == "__main__":
    main()
