"""The platform protocol, and the senders that the station believes."""

import unittest

from dolphin_mavlink import geo
from dolphin_mavlink.station import Options, Station
from dolphin_mavlink.wire import Wire, mavlink
from sim.network import Network
from sim.vehicle import SimVehicle
from tests.support import HARBOUR, Case, one, stored, way


class Protocol(Case):
    def test_greeting(self):
        _, wires = one()
        hello = wires.reports[0]
        self.assertEqual((hello["kind"], hello["protocol"], hello["name"]), ("hello", 1, "mavlink"))
        self.assertEqual(hello["plans"], ["name", "imcPlan", "mission"])

    def test_nothing_is_reported_before_the_greeting(self):
        vehicle, wire = SimVehicle(1), Wire(1, 1, "dolphins")
        station, ours = Station(Options()), Wire(255, 190)
        for message in vehicle.tick(0.0):
            for heard in ours.decode_datagram(wire.encode(message)):
                station.hear(0.0, "link", heard)
        station.tick(0.1)
        self.assertEqual([what for what in station.take() if what[0] == "report"], [])
        station.order(0.2, {"kind": "hello", "protocol": 1})
        kinds = [what[1]["kind"] for what in station.take() if what[0] == "report"]
        self.assertEqual(kinds, ["hello", "log", "vehicle"])

    def test_another_version(self):
        station = Station(Options())
        station.order(0.0, {"kind": "hello", "protocol": 2})
        kinds = [what[1]["kind"] if what[0] == "report" else what[0] for what in station.take()]
        self.assertEqual(kinds, ["error", "quit"])

    def test_pings(self):
        _, wires = one()
        wires.order(kind="ping", id=7)
        self.assertEqual(wires.reports[-1], {"kind": "pong", "id": 7})

    def test_vehicles(self):
        kinds = [("copter", "UAV"), ("plane", "UAV"), ("rover", "UGV"), ("boat", "USV"), ("sub", "UUV")]
        vehicles = [SimVehicle(n, kind, n % 2 == 0, HARBOUR) for n, (kind, _) in enumerate(kinds, 1)]
        wires = Network(vehicles, options=Options(names={3: "x8-02"}, payloads={"mav-1": ["DVL", "camera"]}))
        wires.run(3)
        names = ["mav-1", "mav-2", "x8-02", "mav-4", "mav-5"]
        for name, (_, kind) in zip(names, kinds):
            seen = wires.vehicle_said(name)
            self.assertEqual((seen["type"], seen["link"], seen["unready"]), (kind, True, None))
            self.assertAlmostEqual(seen["latitude"], HARBOUR[0], 6)
            self.assertEqual(seen["battery"], 0.9)
        self.assertEqual(wires.vehicle_said("mav-1")["payload"], ["DVL", "camera"])

    def test_depths_and_altitudes(self):
        vehicles = [SimVehicle(1, "copter"), SimVehicle(2, "sub")]
        vehicles[0].altitude, vehicles[1].altitude = 43.5, -12.5
        wires = Network(vehicles)
        wires.run(3)
        up, down = wires.vehicle_said("mav-1"), wires.vehicle_said("mav-2")
        self.assertEqual((up["altitude"], up.get("depth")), (43.5, None))
        self.assertEqual((down.get("altitude"), down["depth"]), (None, 12.5))

    def test_an_unknown_battery_is_unknown(self):
        wires = Network([SimVehicle(1, battery=-1)])
        wires.run(3)
        self.assertIsNone(wires.vehicle_said("mav-1")["battery"])

    def test_a_camera_that_is_a_component_of_its_own(self):
        vehicle, wires = one()
        camera = SimVehicle(1)
        camera.component = 100
        beat = mavlink.MAVLink_heartbeat_message(mavlink.MAV_TYPE_CAMERA, mavlink.MAV_AUTOPILOT_INVALID, 0, 0, 4, 3)
        wires._wires[1]._codec.srcComponent = 100
        wires.say(vehicle, [beat])
        wires._wires[1]._codec.srcComponent = 1
        wires.run(2)
        self.assertEqual(wires.vehicle_said("mav-1")["payload"], ["camera"])

    def test_a_place_is_reported_whole(self):
        """Dolphin refuses a line with one coordinate, and with it a failsafe or a battery in it."""
        vehicle, wires = one()
        wires.order(kind="telemetry", on=True)
        latitude, longitude = HARBOUR
        for n in range(40):
            vehicle.place = latitude + 1e-5 * (n % 3), longitude + 1e-5 * (n // 3)
            vehicle.battery = 90 - n
            wires.run(1)
        wires.run(3)
        told = wires.said("vehicle")
        self.assertGreater(len([r for r in told if "latitude" in r]), 35)
        for report in told:
            self.assertEqual("latitude" in report, "longitude" in report, report)
        seen = wires.vehicle_said("mav-1")
        self.assertAlmostEqual(seen["latitude"], vehicle.place[0], 6)
        self.assertAlmostEqual(seen["longitude"], vehicle.place[1], 6)

    def test_a_vehicle_is_not_ready_before_its_position_is_known(self):
        """A pick compares distances."""
        for kind in ("copter", "plane", "rover", "sub"):
            vehicle = SimVehicle(1, kind, False, HARBOUR)
            wires = Network([vehicle])
            hidden = {"GLOBAL_POSITION_INT"}
            wires.loses = lambda message: message.get_type() in hidden
            wires.run(4)
            self.assertEqual(wires.vehicle_said("mav-1")["unready"], "has not reported its position yet")
            hidden.clear()
            wires.run(2)
            seen = [r for r in wires.said("vehicle") if "unready" in r][-1]
            self.assertEqual((seen["unready"], "latitude" in seen), (None, True))
            hidden.add("GLOBAL_POSITION_INT")
            wires.run(5)
            self.assertEqual(wires.vehicle_said("mav-1")["unready"], "has not reported its position for 3 s")
            vehicle.place = (41.2, -8.7)
            hidden.clear()
            wires.run(1.5)
            seen = [r for r in wires.said("vehicle") if "unready" in r][-1]
            self.assertIsNone(seen["unready"])
            self.assertAlmostEqual(seen["latitude"], 41.2, 6)

    def test_a_vehicle_without_a_fix_is_not_ready(self):
        """Autopilots report 0, 0 then."""
        wires = Network([SimVehicle(1, place=(0.0, 0.0))])
        wires.run(4)
        self.assertEqual(wires.vehicle_said("mav-1")["unready"], "has not reported its position yet")

    def test_a_position_that_is_lost_now_and_then(self):
        """It does not make a vehicle unready, nor does it fail a start."""
        for seed in range(10):
            _, wires = one(seed=seed, loss=0.1)
            wires.run(60)
            self.assertLess(len([r for r in wires.said("vehicle") if r.get("unready")]), 3)

    def test_a_ready_vehicle_that_moves_is_reported_within_a_second(self):
        vehicle, wires = one(armed=True)
        for n in range(20):
            vehicle.place = geo.displace(HARBOUR, 20.0 * n, 0)
            wires.run(2.2)
            self.assertAlmostEqual(wires.vehicle_said("mav-1")["latitude"], vehicle.place[0], 6)

    def test_a_report_that_was_refused_is_followed_by_a_whole_one(self):
        vehicle, wires = one()
        wires.run(10)
        before = wires.vehicle_said("mav-1")
        count = len(wires.reports)
        wires.order(kind="refused", why="is not a valid 'vehicle'")
        wires.run(1.5)
        [again] = [r for r in wires.reports[count:] if r["kind"] == "vehicle"]
        self.assertEqual(set(before), set(again))

    def test_links(self):
        vehicle, wires = one()
        vehicle.silent = True
        wires.run(8)
        self.assertFalse(wires.vehicle_said("mav-1")["link"])
        vehicle.silent = False
        wires.run(2)
        self.assertTrue(wires.vehicle_said("mav-1")["link"])

    def test_a_start_that_comes_twice_is_one(self):
        vehicle, wires = one()
        wires.start("r", "mav-1", stored())
        wires.start("r", "mav-1", stored())
        self.ends(wires, "r", "done")
        wires.start("r", "mav-1", stored())
        self.assertEqual(wires.reports[-1], {"kind": "done", "request": "r"})
        self.assertEqual(len(vehicle.began), 1)

    def test_stops_of_what_is_over_or_unknown(self):
        _, wires = one()
        wires.stop("nothing")
        self.assertEqual(wires.reports[-1], {"kind": "stopped", "request": "nothing"})
        wires.start("r", "mav-1", {"name": "nowhere"})
        refused = wires.reports[-1]
        self.assertEqual((refused["kind"], refused["why"]), ("failed", "there is no mission 'nowhere' in missions"))
        wires.stop("r")
        self.assertEqual(wires.reports[-1], refused)

    def test_a_vehicle_that_nobody_heard(self):
        _, wires = one()
        wires.start("r", "mav-9", stored())
        self.ends(wires, "r", "failed", "no mav-9 was heard for 10 seconds")

    def test_resuming_without_a_note(self):
        _, wires = one()
        wires.order(kind="resume", request="r", vehicle="mav-1", plan=stored(), timeout=60, notes=[])
        self.ends(wires, "r", "absent")

    def test_checks_move_nothing(self):
        vehicle, wires = one()
        wires.order(kind="check", id=3, plan=stored(), vehicle="mav-1")
        self.assertEqual(wires.reports[-1], {"kind": "checked", "id": 3, "problems": []})
        wires.order(kind="check", id=4, plan={"name": "servey"})
        self.assertEqual(wires.reports[-1]["problems"], ["there is no mission 'servey': did you mean 'survey'?"])
        wires.run(5)
        self.assertEqual(vehicle.items, [])

    def test_orders_that_are_malformed(self):
        _, wires = one()
        for line in (
            None,
            7,
            [],
            {},
            {"kind": 4},
            {"kind": "nonsense"},
            {"kind": "start"},
            {"kind": "ping"},
            {"kind": "stop", "request": []},
            {
                "kind": "start",
                "request": "x",
                "vehicle": "mav-1",
                "timeout": 60,
                "plan": {"name": 4, "language": "mission", "body": 3},
            },
        ):
            wires.station.order(wires.now, line)
        wires._act()
        wires.run(2)
        self.assertEqual(wires.end_of("x")["why"], "the plan is malformed")

    def test_the_end(self):
        vehicle, wires = one()
        wires.order(kind="close")
        self.assertEqual(wires.reports[-1], {"kind": "quiet"})
        vehicle, wires = one(items=way(30))
        wires.start("r", "mav-1", stored())
        wires.run(5)
        wires.order(kind="close")
        wires.run(1)
        self.assertEqual([r["kind"] for r in wires.reports[-2:]], ["stopped", "quiet"])
        self.assertEqual(vehicle.mode, "BRAKE")
        vehicle, wires = one(items=way(30))
        wires.start("r", "mav-1", stored())
        wires.run(5)
        wires.down = True
        wires.order(kind="close")
        wires.run(3)
        self.assertEqual(wires.said("quiet"), [])
        wires.run(3)
        self.assertEqual(wires.reports[-1]["kind"], "quiet")


class Trust(Case):
    """No other sender ends our task."""

    def flying(self):
        vehicle, wires = one(items=way(40))
        wires.start("r", "mav-1", stored())
        self.assertTrue(wires.run(20, lambda: wires.said("taken")))
        wires.run(2)
        return vehicle, wires

    def forged(self, system):
        ends = [
            mavlink.MAVLink_mission_item_reached_message(40),
            mavlink.MAVLink_mission_current_message(40, 40, 5),
            mavlink.MAVLink_heartbeat_message(2, 3, 1, 5, 4, 3),
            mavlink.MAVLink_heartbeat_message(2, 3, 129, 5, 5, 3),
            mavlink.MAVLink_mission_ack_message(255, 190, 5),
            mavlink.MAVLink_command_ack_message(176, 4, 0, 0, 255, 190),
            mavlink.MAVLink_mission_current_message(40, 3, 5),
            mavlink.MAVLink_statustext_message(1, b"Failsafe"),
        ]
        wire = Wire(system, 1)
        for _ in range(200):
            wire.encode(ends[0])
        return [wire.encode(message) for message in ends * 3]

    def test_a_foreign_system_cannot_end_our_task(self):
        for address in (("link", "other"), ("link", 1)):
            for system in (2, 3, 200):
                vehicle, wires = self.flying()
                for data in self.forged(system):
                    wires.inject(data, address)
                wires.run(2)
                self.assertIsNone(wires.end_of("r"))

    def test_nor_can_its_own_number_from_elsewhere(self):
        vehicle, wires = self.flying()
        for data in self.forged(1):
            wires.inject(data, "elsewhere")
        wires.run(2)
        self.assertIsNone(wires.end_of("r"))
        logs = [r["text"] for r in wires.said("log")]
        self.assertEqual(logs, ["another system has number 1 too: its messages are ignored"])

    def test_nor_can_answers_to_another_station(self):
        vehicle, wires = one(items=way(100), delay=0.05)
        wires.start("r", "mav-1", stored())
        wires.run(1)
        wires.say(vehicle, [mavlink.MAVLink_mission_ack_message(254, 190, mavlink.MAV_MISSION_NO_SPACE)])
        self.ends(wires, "r", "done")

    def test_with_a_key_only_what_is_signed_is_believed(self):
        vehicle = SimVehicle(1)
        wires = Network([vehicle], options=Options(stored={"survey": way(3)}), key="dolphins")
        wires.run(3)
        wires.start("r", "mav-1", stored())
        self.ends(wires, "r", "done")
        stranger = Network([SimVehicle(1)], key="dolphins")
        stranger._wires[1] = Wire(1, 1)
        stranger.run(5)
        self.assertEqual(stranger.said("vehicle"), [])

    def test_a_vehicle_that_wants_signed_messages_and_no_key(self):
        """It does not answer: that is reported at once, and it is not ready for a pick."""
        vehicle = SimVehicle(1)
        wires = Network([vehicle], options=Options(stored={"survey": way(3)}))
        wires._wires[1] = Wire(1, 1, "dolphins")
        wires.run(2)
        logs = ["signs its messages, and may not answer ours: no key was given (--key-file)"]
        self.assertEqual([r["text"] for r in wires.said("log")], logs)
        hint = "signs its messages: --key-file gives the pass phrase by which ours are signed"
        wires.start("r", "mav-1", stored())
        self.ends(wires, "r", "failed", f"no answer from its autopilot for 10 seconds (upload); it {hint}")
        self.assertEqual(wires.vehicle_said("mav-1")["unready"], f"does not answer, and {hint}")
        wires.start("r2", "mav-1", stored())
        self.ends(wires, "r2", "failed", f"does not answer, and {hint}")
        self.assertEqual(len(wires.said("log")), 1)

    def test_a_vehicle_that_signs_and_answers_all_the_same(self):
        """As ArduPilot does on its USB port."""
        vehicle = SimVehicle(1)
        wires = Network([vehicle], options=Options(stored={"survey": way(3)}))
        signs = Wire(1, 1, "dolphins")
        signs.decode_datagram = Wire(1, 1).decode_datagram
        wires._wires[1] = signs
        wires.run(8)
        self.assertIsNone(wires.vehicle_said("mav-1")["unready"])
        wires.start("r", "mav-1", stored())
        self.ends(wires, "r", "done")

    def test_vehicles_whose_messages_a_key_does_not_let_in(self):
        for key, why in ((None, "not signed"), ("whales", "signed with another key")):
            wires = Network([SimVehicle(1)], key="dolphins", doubled=0.3)
            wires._wires[1] = Wire(1, 1, key)
            wires.run(5)
            logs = [f"the messages of system 1 are {why}, and are not believed (--key-file)"]
            self.assertEqual([r["text"] for r in wires.said("log")], logs)
            wires.start("r", "mav-1", stored())
            self.ends(wires, "r", "failed", f"no mav-1 was heard for 10 seconds: its messages are {why} (--key-file)")
        wires = Network([SimVehicle(1)], key="dolphins")
        wires._wire.set_date(1e9 + 1420070400)
        wires.run(5)
        [log] = wires.said("log")
        self.assertIn("are signed by a clock that is more than a minute behind ours", log["text"])

    def test_copies_of_signed_messages_are_not_remarked_on(self):
        wires = Network([SimVehicle(1)], key="dolphins", doubled=0.5, reordered=0.3)
        wires.run(20)
        self.assertEqual(wires.said("log"), [])
        self.assertTrue(wires.vehicle_said("mav-1")["link"])

    def test_a_vehicle_moves_to_another_address_once_it_was_silent(self):
        vehicle, wires = one()
        wires.inject(self.forged(1)[2], "elsewhere")
        self.assertEqual(wires.station._vehicles[1].address, ("link", 1))
        vehicle.silent = True
        wires.run(12)
        wires.inject(self.forged(1)[2], ("link", 1, "new"))
        self.assertEqual(wires.station._vehicles[1].address, ("link", 1, "new"))


if __name__ == "__main__":
    unittest.main()
