"""Shared by tests of the adapter: missions, and networks of one vehicle."""

import unittest

from dolphin_mavlink import geo
from dolphin_mavlink.mission import Item
from dolphin_mavlink.station import Options
from sim.network import Network
from sim.vehicle import SimVehicle

HARBOUR = (41.185, -8.706)


def waypoint(north, east, z=30.0, command=16, params=(0.0, 0.0, 0.0, 0.0)):
    latitude, longitude = geo.displace(HARBOUR, north, east)
    return Item(command, 6, params, round(latitude * 1e7), round(longitude * 1e7), z)


def way(n):
    """A mission of `n` waypoints, some 30 m apart."""
    return tuple(waypoint(30.0 * (k % 2 + 1), 10.0 * k) for k in range(n))


def stored(arm=True, name="survey"):
    """A plan that flies the stored mission."""
    items = [{"item": "arm", "arguments": [True], "named": {}}] if arm else []
    items.append({"item": "stored", "arguments": [name], "named": {}})
    return {"name": name, "language": "mission", "body": {"items": items}}


def one(kind="copter", px4=False, items=None, armed=False, **network):
    """A network of one vehicle, mav-1, which has been heard, with the stored mission `survey`."""
    vehicle = SimVehicle(1, kind, px4, HARBOUR, armed=armed)
    options = Options(stored={"survey": items or way(5)}, directory="missions")
    wires = Network([vehicle], options=options, **network)
    wires.run(3)
    return vehicle, wires


class Case(unittest.TestCase):
    def ends(self, wires, request, kind, why=None, seconds=600):
        end = wires.run_to_end(request, seconds)
        self.assertIsNotNone(end, "no end: " + str(wires.reports[-3:]))
        self.assertEqual((end["kind"], end.get("why")), (kind, why))
        wires.run(2)
        again = [r for r in wires.said(None, request) if r["kind"] in ("done", "failed", "stopped", "absent")]
        self.assertEqual(len(again), 1, again)
