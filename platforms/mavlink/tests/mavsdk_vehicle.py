"""A vehicle that is not ours: the vehicle's side of MAVSDK 4.1, in C++, which speaks as PX4 does.

    mavsdk_vehicle.py PORT [SYSTEM]

It flies a mission by reporting that each item is complete, ten a second, at the item's place. MAVSDK reports each item
once. Ends when its input ends. Letters on its input: S, it takes 2 s for each item; F, a tenth of a second again; R, L
and H, another station sends it home, to land, or holds it.
"""

import os
import sys
import threading
import time

from mavsdk.component_type import ComponentType
from mavsdk.mavsdk import Configuration, Mavsdk
from mavsdk.plugins.action_server import ActionServer, AllowableFlightModes, FlightMode
from mavsdk.plugins.mission_raw_server import MissionRawServer
from mavsdk.plugins.telemetry_server import Heading, Position, TelemetryServer, VelocityNed

HARBOUR = (41.185, -8.706)
PACES = {b"S": 2.0, b"F": 0.1}
MODES = {b"R": FlightMode.RETURN_TO_LAUNCH, b"L": FlightMode.LAND, b"H": FlightMode.HOLD}
DESTINATIONS = range(16, 22)  # the commands of waypoints, loiters, landings


class Flight:
    def __init__(self):
        self.items, self.armed, self.mode = [], False, FlightMode.HOLD
        self.seconds = 0.1
        self.place = HARBOUR

    def flies(self):
        return self.armed and self.mode == FlightMode.MISSION and self.items

    def reach(self, item):
        if item.command in DESTINATIONS and (item.x, item.y) != (0, 0):
            self.place = item.x / 1e7, item.y / 1e7


def main(port, system=1):
    configuration = Configuration.create_with_component_type(ComponentType.AUTOPILOT)
    configuration.system_id = system
    mavsdk = Mavsdk(configuration)
    component = mavsdk.server_component()
    action, telemetry, missions = ActionServer(component), TelemetryServer(component), MissionRawServer(component)
    flight = Flight()

    def mission(result, plan, _):
        flight.items = list(plan.mission_items)
        print("mission", [item.command for item in flight.items], file=sys.stderr, flush=True)

    def mode(result, wanted, _):
        if wanted == FlightMode.MISSION:  # MAVSDK calls this also for the modes that it refuses
            flight.mode = wanted
        print("mode", result, wanted, file=sys.stderr, flush=True)

    def arm(result, wanted, _):
        flight.armed = bool(wanted.arm)
        print("arm", flight.armed, file=sys.stderr, flush=True)

    missions.subscribe_incoming_mission(mission)
    action.subscribe_flight_mode_change(mode)
    action.subscribe_arm_disarm(arm)
    action.set_allowable_flight_modes(AllowableFlightModes(True, True, True))
    action.set_armable(True, True)
    action.set_disarmable(True, True)
    action.set_flight_mode_internal(FlightMode.HOLD)
    # Last, so that the first heartbeat has the mode: a change of it is a pilot's hand.
    mavsdk.add_any_connection(f"udpout://127.0.0.1:{port}")
    ended = threading.Event()

    def obey():
        while letter := os.read(0, 1):
            if letter in PACES:
                flight.seconds = PACES[letter]
            else:
                flight.mode = MODES[letter]
                action.set_flight_mode_internal(flight.mode)
        ended.set()

    threading.Thread(target=obey, daemon=True).start()
    left = None
    while not ended.is_set():
        telemetry.publish_position(Position(*flight.place, 30.0, 30.0), VelocityNed(0, 0, 0), Heading(0))
        if flight.flies():
            left = len(flight.items) if left is None else left
            if left > 0:
                flight.reach(flight.items[-left])
                missions.set_current_item_complete()
                left -= 1
            else:
                # As PX4 does after the last item. MAVSDK's vehicle refuses this mode from a ground station.
                flight.mode = FlightMode.HOLD
                action.set_flight_mode_internal(FlightMode.HOLD)
        else:
            left = None
        time.sleep(flight.seconds)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
