"""Simulated vehicles on a network: python -m sim --to 127.0.0.1:14550 copter plane:px4 ... Each has its own UDP socket.
They fly until the input ends."""

import argparse
import os
import selectors
import socket
import sys
import time

from dolphin_mavlink import geo
from dolphin_mavlink.wire import Wire

from .vehicle import SimVehicle


class Peer:
    def __init__(self, vehicle, to, signing):
        self.vehicle, self.to = vehicle, to
        self.wire = Wire(vehicle.system, vehicle.component, signing)
        self.wire.set_date(time.time())
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.setblocking(False)

    def send(self, messages):
        for message in messages:
            try:
                self.socket.sendto(self.wire.encode(message), self.to)
            except OSError:
                pass

    def receive(self, now):
        while True:
            try:
                data, _ = self.socket.recvfrom(65536)
            except OSError:
                return
            for message in self.wire.decode_datagram(data):
                self.send(self.vehicle.hear(now, message))


def main():
    parser = argparse.ArgumentParser(prog="sim", description=__doc__)
    parser.add_argument(
        "--to", default="127.0.0.1:14550", metavar="HOST:PORT", help="where the ground station listens"
    )
    parser.add_argument("--time", type=float, default=1.0, metavar="FACTOR", help="how many times as fast they fly")
    parser.add_argument("--armed", action="store_true", help="they are armed already, and in the air")
    parser.add_argument("--place", default="41.185,-8.706", metavar="LATITUDE,LONGITUDE", help="where they are")
    parser.add_argument("--first", type=int, default=1, metavar="NUMBER", help="the first one's system number")
    parser.add_argument("--began", metavar="FILE", help="a line for each mission begun: how many items it has")
    parser.add_argument("--key", metavar="PHRASE", help="messages are signed by this pass phrase")
    parser.add_argument("vehicles", nargs="+", metavar="KIND[:px4]", help="copter, plane, vtol, rover, boat or sub")
    given = parser.parse_args()
    host, _, port = given.to.rpartition(":")
    place = tuple(float(c) for c in given.place.split(","))
    peers = []
    for n, text in enumerate(given.vehicles):
        kind, _, autopilot = text.partition(":")
        speed = given.time * {"plane": 18.0, "copter": 8.0}.get(kind, 1.5)
        where = geo.displace(place, 0, 20 * n)
        vehicle = SimVehicle(given.first + n, kind, autopilot == "px4", where, speed, given.armed)
        vehicle.pace = given.time
        peers.append(Peer(vehicle, (host or "127.0.0.1", int(port)), given.key))
    fly(peers, given.began)


def fly(peers, began=None):
    told = 0
    selector = selectors.DefaultSelector()
    for peer in peers:
        selector.register(peer.socket, selectors.EVENT_READ, peer)
    watches_input = not sys.stdin.isatty()
    if watches_input:
        try:
            selector.register(sys.stdin.fileno(), selectors.EVENT_READ, None)
        except OSError:
            pass  # /dev/null: it never ends
    begin, ticked = time.monotonic(), -1.0
    while True:
        for ready, _ in selector.select(0.02):
            if ready.data is not None:
                ready.data.receive(time.monotonic() - begin)
            elif not os.read(sys.stdin.fileno(), 4096):
                return
        now = time.monotonic() - begin
        if now - ticked >= 0.02:
            ticked = now
            for peer in peers:
                peer.send(peer.vehicle.tick(now))
            begun = [items for peer in peers for _, items in peer.vehicle.began]
            if began is not None and len(begun) > told:
                with open(began, "a", encoding="utf-8") as file:
                    file.writelines(f"{items}\n" for items in begun[told:])
                told = len(begun)


if __name__ == "__main__":
    main()
