"""A mission on a vehicle, from the order to the verdict, in virtual time."""

import unittest

from dolphin_mavlink.wire import mavlink
from tests.support import Case, one, stored, waypoint, way

KINDS = [
    ("copter", False),
    ("plane", False),
    ("rover", False),
    ("boat", False),
    ("sub", False),
    ("copter", True),
    ("plane", True),
]
ARM, SET_MODE = mavlink.MAV_CMD_COMPONENT_ARM_DISARM, mavlink.MAV_CMD_DO_SET_MODE


class Outcomes(Case):
    def test_every_kind_of_vehicle_flies_to_the_end(self):
        for kind, px4 in KINDS:
            with self.subTest(kind=kind, px4=px4):
                vehicle, wires = one(kind, px4)
                wires.start("r", "mav-1", stored())
                self.ends(wires, "r", "done")
                first = 0 if px4 else 1
                self.assertEqual(vehicle.reached, list(range(first, first + 5)))
                self.assertEqual(len(vehicle.began), 1)
                shares = [r["share"] for r in wires.said("progress", "r")]
                self.assertEqual(shares, sorted(shares))
                self.assertEqual(
                    [r["kind"] for r in wires.said(None, "r") if r["kind"] != "progress"], ["note", "taken", "done"]
                )

    def test_one_mission_after_another(self):
        for kind, px4 in KINDS:
            with self.subTest(kind=kind, px4=px4):
                vehicle, wires = one(kind, px4)
                for request in ("r1", "r2", "r3"):
                    wires.start(request, "mav-1", stored())
                    self.ends(wires, request, "done")
                self.assertEqual(len(vehicle.began), 3)

    def test_a_mission_may_begin_before_the_vehicle_tells_that_it_goes_home_after_the_one_before(self):
        for kind, px4 in KINDS:
            with self.subTest(kind=kind, px4=px4):
                vehicle, wires = one(kind, px4)
                act = wires._act

                def at_once():
                    act()
                    if wires.end_of("r1") is not None and not wires.said(None, "r2"):
                        wires._act = act
                        wires.start("r2", "mav-1", stored())

                wires._act = at_once
                wires.start("r1", "mav-1", stored())
                self.ends(wires, "r2", "done")
                self.assertEqual(len(vehicle.began), 2)

    def test_the_home_position_is_item_0_for_ardupilot_only(self):
        for px4, first in ((False, HOME), (True, way(5)[0].x)):
            vehicle, wires = one(px4=px4)
            wires.start("r", "mav-1", stored())
            self.ends(wires, "r", "done")
            self.assertEqual(vehicle.items[0].x, first)
            self.assertEqual(len(vehicle.items), 5 if px4 else 6)

    def test_a_mission_that_ends_with_a_landing_is_done_on_the_ground(self):
        for px4 in (False, True):
            for tells in (True, False):
                landing = (*way(3), waypoint(0, 0, 0.0, command=21))
                vehicle, wires = one(px4=px4, items=landing)
                vehicle.tells_reached = vehicle.tells_state = tells
                wires.start("r", "mav-1", stored())
                self.ends(wires, "r", "done")
                self.assertFalse(vehicle.armed)

    def test_an_unlimited_loiter_at_the_end_is_done_once_begun(self):
        for px4 in (False, True):
            vehicle, wires = one(px4=px4, items=(*way(3), waypoint(200, 0, command=17)))
            wires.start("r", "mav-1", stored())
            self.ends(wires, "r", "done")
            self.assertEqual(vehicle.state, mavlink.MISSION_STATE_ACTIVE)

    def test_a_vehicle_that_returns_home_by_itself_after_the_last_item_is_done(self):
        for kind, px4 in (("plane", False), ("rover", False), ("copter", True)):
            vehicle, wires = one(kind, px4)
            vehicle.tells_reached = vehicle.tells_state = False
            wires.start("r", "mav-1", stored())
            self.ends(wires, "r", "done")

    def test_jumps_are_gone_through_as_often_as_they_say(self):
        jump = waypoint(0, 0, command=177, params=(1.0, 2.0, 0.0, 0.0))
        for px4 in (False, True):
            for tells_state in (True, False):
                vehicle, wires = one(px4=px4, items=(*way(2), jump))
                vehicle.tells_state = tells_state
                wires.start("r", "mav-1", stored())
                self.ends(wires, "r", "done")
                self.assertEqual(len(vehicle.reached), 6)

    def test_what_is_kept_otherwise_than_sent_is_not_flown(self):
        def moved(items):
            items[-1].x += 100
            return items

        vehicle, wires = one()
        vehicle.keeps = moved
        wires.start("r", "mav-1", stored())
        end = wires.run_to_end("r")
        self.assertEqual(end["kind"], "failed")
        self.assertIn("the mission is not on board as it was sent: item 5 has ", end["why"])
        self.assertEqual(vehicle.began, [])


HOME = 411850000


class Refusals(Case):
    def test_never_arms_unless_the_plan_says_so(self):
        for kind, px4 in KINDS:
            vehicle, wires = one(kind, px4)
            wires.start("r", "mav-1", stored(arm=False))
            self.ends(wires, "r", "failed", "is not armed, and the plan has no arm: true")
            self.assertNotIn(ARM, [c for c, *_ in vehicle.commands])
            self.assertEqual(vehicle.items, [])

    def test_an_armed_vehicle_needs_no_arming(self):
        vehicle, wires = one(armed=True)
        wires.start("r", "mav-1", stored(arm=False))
        self.ends(wires, "r", "done")
        self.assertNotIn(ARM, [c for c, *_ in vehicle.commands])

    def test_disarmed_while_the_mission_is_on_its_way(self):
        vehicle, wires = one(armed=True, delay=0.2)
        wires.start("r", "mav-1", stored(arm=False))
        wires.run(1.2)
        wires.say(vehicle, vehicle.disarm(wires.now))
        self.ends(wires, "r", "failed", "was disarmed, and the plan has no arm: true")
        self.assertNotIn(ARM, [c for c, *_ in vehicle.commands])

    def test_its_autopilot_refuses_the_mission(self):
        words = {
            mavlink.MAV_MISSION_NO_SPACE: "item 0: it has no space for so many items",
            mavlink.MAV_MISSION_UNSUPPORTED: "item 0: it does not support the command",
            mavlink.MAV_MISSION_DENIED: "item 0: it was denied",
            mavlink.MAV_MISSION_INVALID_PARAM3: "item 0: parameter 3 is invalid",
        }
        for code, why in words.items():
            vehicle, wires = one()
            vehicle.refuses_upload = code
            wires.start("r", "mav-1", stored())
            self.ends(wires, "r", "failed", "its autopilot refuses the mission: " + why)

    def test_its_autopilot_does_not_arm(self):
        for kind, px4 in KINDS:
            vehicle, wires = one(kind, px4)
            mode = vehicle.mode
            vehicle.results[ARM] = mavlink.MAV_RESULT_FAILED
            wires.start("r", "mav-1", stored())
            self.ends(wires, "r", "failed", "its autopilot does not arm: failed")
            self.assertEqual(vehicle.began, [])
            self.assertEqual(vehicle.mode, mode, "a plane must not take off when somebody arms it later")

    def test_its_autopilot_does_not_go_into_the_mode(self):
        vehicle, wires = one(armed=True)
        vehicle.results[SET_MODE] = mavlink.MAV_RESULT_DENIED
        wires.start("r", "mav-1", stored())
        self.ends(wires, "r", "failed", "its autopilot does not go into mode AUTO: denied")

    def test_a_mode_that_is_refused_for_now_is_asked_for_again(self):
        for kind, px4 in KINDS:
            vehicle, wires = one(kind, px4, armed=True)
            vehicle.results[SET_MODE] = mavlink.MAV_RESULT_TEMPORARILY_REJECTED
            wires.start("r", "mav-1", stored())
            wires.run(4)
            self.assertEqual(wires.said("failed", "r"), [])
            del vehicle.results[SET_MODE]
            self.ends(wires, "r", "done")
            self.assertEqual(len(vehicle.began), 1)

    def test_a_mode_that_is_refused_for_now_all_the_time(self):
        vehicle, wires = one(armed=True)
        vehicle.results[SET_MODE] = mavlink.MAV_RESULT_TEMPORARILY_REJECTED
        wires.start("r", "mav-1", stored())
        self.ends(wires, "r", "failed", "its autopilot does not go into mode AUTO: not now")

    def test_the_words_of_the_autopilot_are_the_reason(self):
        vehicle, wires = one()
        vehicle.results[ARM] = mavlink.MAV_RESULT_FAILED
        wires.start("r", "mav-1", stored())
        text = mavlink.MAVLink_statustext_message(mavlink.MAV_SEVERITY_WARNING, b"PreArm: GPS 1: not healthy")
        wires.say(vehicle, [text])
        self.ends(wires, "r", "failed", "its autopilot does not arm: PreArm: GPS 1: not healthy")

    def test_an_autopilot_that_answers_nothing(self):
        for deaf, stage in (
            ("MISSION_COUNT", "upload"),
            ("MISSION_REQUEST_LIST", "verify"),
            (ARM, "arm"),
        ):
            vehicle, wires = one()
            vehicle.deaf_to.add(deaf)
            wires.start("r", "mav-1", stored(), timeout=20)
            self.ends(wires, "r", "failed", f"no answer from its autopilot for 20 seconds ({stage})")
            self.assertEqual(vehicle.began, [])

    def test_an_autopilot_that_does_not_know_the_command_to_begin_anew(self):
        vehicle, wires = one()
        vehicle.deaf_to.add(mavlink.MAV_CMD_DO_SET_MISSION_CURRENT)
        wires.start("r", "mav-1", stored())
        self.ends(wires, "r", "done")

    def test_a_mode_that_may_or_may_not_have_been_set_is_unknown(self):
        vehicle, wires = one(armed=True)
        wires.start("r", "mav-1", stored(), timeout=20)
        self.assertTrue(wires.run(10, lambda: wires.said("note")))
        vehicle.deaf_to.add(SET_MODE)
        self.assertTrue(wires.run(60, lambda: wires.said("unknown", "r")))
        self.assertIsNone(wires.end_of("r"))
        vehicle.deaf_to.clear()
        wires.stop("r")
        self.ends(wires, "r", "stopped")
        self.assertNotEqual(vehicle.mode, "AUTO")


class Hands(Case):
    """A hand on the vehicle wins."""

    def fly(self, kind="copter", px4=False, seconds=4.0, **more):
        vehicle, wires = one(kind, px4, items=way(12), **more)
        wires.start("r", "mav-1", stored())
        self.assertTrue(wires.run(30, lambda: wires.said("taken")))
        wires.run(seconds)
        return vehicle, wires

    def test_taken_over_by_its_pilot(self):
        for kind, px4, mode in (
            ("copter", False, "LOITER"),
            ("plane", False, "LOITER"),
            ("rover", False, "MANUAL"),
            ("copter", True, "POSCTL"),
            ("copter", True, "HOLD"),
            ("sub", False, "STABILIZE"),
        ):
            with self.subTest(kind=kind, px4=px4, mode=mode):
                vehicle, wires = self.fly(kind, px4)
                commands = len(vehicle.commands)
                wires.say(vehicle, vehicle.pilot(wires.now, mode))
                self.ends(wires, "r", "failed", f"taken over by its pilot in mode {mode}")
                self.assertEqual(wires.vehicle_said("mav-1")["unready"], f"is flown by its pilot in mode {mode}")
                wires.start("r2", "mav-1", stored())
                self.ends(wires, "r2", "failed", f"is flown by its pilot in mode {mode}")
                wires.run(20)
                self.assertEqual((vehicle.mode, len(vehicle.commands)), (mode, commands))

    def test_a_stop_does_not_go_over_the_pilot(self):
        vehicle, wires = self.fly()
        wires.say(vehicle, vehicle.pilot(wires.now, "LOITER"))
        wires.run(0.2)
        wires.stop("r")
        self.ends(wires, "r", "failed", "taken over by its pilot in mode LOITER")
        self.assertEqual(vehicle.mode, "LOITER")

    def test_a_pilot_gives_it_back(self):
        vehicle, wires = self.fly()
        wires.say(vehicle, vehicle.pilot(wires.now, "LOITER"))
        self.ends(wires, "r", "failed", "taken over by its pilot in mode LOITER")
        wires.say(vehicle, vehicle.pilot(wires.now, "GUIDED"))
        wires.run(1)
        self.assertIsNone(wires.vehicle_said("mav-1")["unready"])
        wires.start("r2", "mav-1", stored())
        self.ends(wires, "r2", "done")

    def test_a_hand_before_the_mission_has_begun(self):
        for seconds in (0.05, 0.5, 1.0, 2.0, 3.0):
            vehicle, wires = one(armed=True, delay=0.1, items=way(12))
            wires.start("r", "mav-1", stored())
            wires.run(seconds)
            wires.say(vehicle, vehicle.pilot(wires.now, "STABILIZE"))
            self.ends(wires, "r", "failed", "taken over by its pilot in mode STABILIZE")
            self.assertEqual(vehicle.mode, "STABILIZE")

    def test_failsafe(self):
        vehicle, wires = self.fly()
        wires.say(vehicle, vehicle.failsafe(wires.now, "Battery 1 is low 10.4V used 1200 mAh", "RTL"))
        self.ends(wires, "r", "failed", "failsafe: Battery 1 is low 10.4V used 1200 mAh, in mode RTL")
        self.assertEqual(
            wires.vehicle_said("mav-1")["unready"], "is in failsafe: Battery 1 is low 10.4V used 1200 mAh"
        )

    def test_disarmed_in_flight(self):
        vehicle, wires = self.fly(seconds=8)
        vehicle.armed = False
        self.ends(wires, "r", "failed", "was disarmed in flight")

    def test_its_mission_was_replaced(self):
        vehicle, wires = self.fly()
        vehicle.items = vehicle.items[:7]
        self.ends(wires, "r", "failed", "its mission was replaced by another station")

    def test_a_mission_of_another_station(self):
        vehicle, wires = one(armed=True)
        vehicle.items = [i.message((1, 1), n) for n, i in enumerate((waypoint(0, 0), *way(30)))]
        vehicle._rewind()
        wires.say(vehicle, vehicle.pilot(wires.now, "AUTO"))
        wires.run(2)
        why = "flies a mission of another station in mode AUTO"
        self.assertEqual(wires.vehicle_said("mav-1")["unready"], why)
        wires.start("r", "mav-1", stored())
        self.ends(wires, "r", "failed", why)
        self.assertEqual(vehicle.mode, "AUTO")


class Stops(Case):
    def test_a_stop_at_any_moment(self):
        for kind, px4 in KINDS:
            for moment in range(0, 60, 4):
                vehicle, wires = one(kind, px4, items=way(12), delay=0.03)
                wires.start("r", "mav-1", stored())
                wires.run(0.1 * moment)
                wires.stop("r")
                end = wires.run_to_end("r", 20)
                self.assertEqual(end, {"kind": "stopped", "request": "r"})
                wires.run(5)
                self.assertNotEqual((vehicle.mode, vehicle.armed), (vehicle.modes.mission, True))

    def test_the_next_mission_after_a_stop(self):
        vehicle, wires = one(items=way(12))
        for n in range(5):
            wires.start(f"a{n}", "mav-1", stored())
            wires.run(2 + n)
            wires.stop(f"a{n}")
            self.ends(wires, f"a{n}", "stopped")
        wires.start("b", "mav-1", stored())
        self.ends(wires, "b", "done")

    def test_a_stop_by_returning(self):
        vehicle, wires = one(items=way(12))
        wires._options.on_stop = "return"
        wires.start("r", "mav-1", stored())
        wires.run(5)
        wires.stop("r")
        self.ends(wires, "r", "stopped")
        self.assertEqual(vehicle.mode, "RTL")

    def test_a_stop_without_a_link_is_delivered_later(self):
        vehicle, wires = one(items=way(50))
        wires.start("r", "mav-1", stored())
        wires.run(5)
        wires.down = True
        wires.run(1)
        wires.stop("r")
        wires.run(30)
        self.assertIsNone(wires.end_of("r"))
        self.assertFalse(wires.vehicle_said("mav-1")["link"])
        wires.down = False
        self.ends(wires, "r", "stopped")
        self.assertEqual(vehicle.mode, "BRAKE")


if __name__ == "__main__":
    unittest.main()
