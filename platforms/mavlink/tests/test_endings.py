"""How missions end that land, and vehicles that are disarmed, restarted or taken away. Virtual time."""

import random
import unittest

from dolphin_mavlink.mission import Item
from dolphin_mavlink.wire import mavlink
from seeds import seeds
from tests.support import Case, one, stored, waypoint, way

LANDINGS = {
    "a landing": waypoint(0, 0, 0.0, command=21),
    "a landing where it is": Item(21, 6),
    "a return": Item(20),
}


def begun(items, px4=False, **more):
    vehicle, wires = one(px4=px4, items=items, **more)
    wires.start("r", "mav-1", stored())
    return vehicle, wires


def at_its_landing(vehicle, height):
    return lambda: 0 < len(vehicle.items) - 1 <= vehicle.current and vehicle.altitude <= height


class Landings(Case):
    def test_a_copter_that_lands_is_done(self):
        """ArduCopter goes back to its first item when it is disarmed, and reports the ground only after that."""
        for what, landing in LANDINGS.items():
            for px4 in (False, True):
                for loss in (0.0, 0.3):
                    for seed in seeds(10):
                        with self.subTest(what=what, px4=px4, loss=loss, seed=seed):
                            vehicle, wires = begun((*way(3), landing), px4, seed=seed, loss=loss, delay=0.05)
                            self.ends(wires, "r", "done")
                            self.assertFalse(vehicle.armed)
                            self.assertEqual(vehicle.altitude, 0.0)
                            self.assertEqual(len(vehicle.began), 1)

    def test_a_link_that_is_away_at_touchdown(self):
        for what, landing in LANDINGS.items():
            for before in (25.0, 15.0, 8.0, 3.0, 0.5):
                for away in (2, 8, 30, 90):
                    with self.subTest(what=what, before=before, away=away):
                        vehicle, wires = begun((*way(3), landing), delay=0.05)
                        self.assertTrue(wires.run(200, at_its_landing(vehicle, before)))
                        wires.down = True
                        wires.run(away)
                        wires.down = False
                        self.ends(wires, "r", "done")
                        self.assertEqual(len(vehicle.began), 1)

    def test_a_link_that_is_away_from_the_first_item_on(self):
        """That it landed where the mission ends is enough."""
        for what, landing in LANDINGS.items():
            with self.subTest(what=what):
                vehicle, wires = begun((*way(8), landing))
                self.assertTrue(wires.run(60, lambda: vehicle.current == 3))
                wires.down = True
                wires.run(200)
                wires.down = False
                self.ends(wires, "r", "done")

    def test_a_link_that_is_away_while_it_lands_elsewhere(self):
        vehicle, wires = begun((*way(8), waypoint(500, 0, 0.0, command=21)))
        self.assertTrue(wires.run(60, lambda: vehicle.current == 3))
        wires.down = True
        vehicle._advance(wires.now)
        vehicle.altitude, vehicle._on_ground = 0.0, True
        vehicle.disarm(wires.now)
        wires.run(20)
        wires.down = False
        why = "was disarmed while it was not heard: it may have flown its mission"
        self.ends(wires, "r", "failed", why)

    def test_the_next_mission_after_a_landing(self):
        vehicle, wires = begun((*way(3), LANDINGS["a landing"]))
        self.ends(wires, "r", "done")
        for n in range(3):
            wires.start(f"r{n}", "mav-1", stored())
            self.ends(wires, f"r{n}", "done")
        self.assertEqual(len(vehicle.began), 4)

    def test_progress_does_not_go_back(self):
        vehicle, wires = begun((*way(5), LANDINGS["a landing"]))
        self.ends(wires, "r", "done")
        shares = [r["share"] for r in wires.said("progress", "r")]
        self.assertEqual(shares, sorted(shares))
        self.assertGreater(shares[-1], 0.8)


class Motors(Case):
    def test_a_vehicle_whose_motors_are_stopped_in_flight(self):
        """At each item, also at the one that lands it: ArduCopter claims the ground at once."""
        for number in range(2, 5):
            for loss in (0.0, 0.2):
                for seed in seeds(5):
                    with self.subTest(number=number, loss=loss, seed=seed):
                        items = (*way(5), LANDINGS["a landing"])
                        vehicle, wires = begun(items, seed=seed, loss=loss, delay=0.05)
                        self.assertTrue(wires.run(60, lambda: vehicle.current == number))
                        wires.run(6, lambda: vehicle.current > number)
                        wires.say(vehicle, vehicle.kill(wires.now))
                        self.ends(wires, "r", "failed", "was disarmed in flight")

    def test_a_vehicle_whose_motors_are_stopped_while_it_lands(self):
        for height in (28.0, 20.0, 12.0, 8.0):
            for seed in seeds(10):
                with self.subTest(height=height, seed=seed):
                    vehicle, wires = begun((*way(3), LANDINGS["a landing"]), seed=seed, delay=0.05)
                    self.assertTrue(wires.run(200, at_its_landing(vehicle, height)))
                    wires.run(0.1 * (seed % 10))
                    wires.say(vehicle, vehicle.kill(wires.now))
                    self.ends(wires, "r", "failed", "was disarmed in flight")

    def test_a_vehicle_whose_motors_are_stopped_close_to_the_ground(self):
        """While a vehicle lands, it reports its position ten times a second. With one report a second it has fallen
        before it reports how fast: it fell in less than the second for which a vehicle rests."""
        for grants_rates, heights in ((True, (3.0, 1.5, 1.0, 0.7, 0.5)), (False, (4.0, 3.0, 2.0, 1.5))):
            for height in heights:
                for lands_at in (0.5, 1.5):
                    for seed in seeds(10):
                        with self.subTest(rates=grants_rates, height=height, lands_at=lands_at, seed=seed):
                            vehicle, wires = begun((*way(3), LANDINGS["a landing"]), seed=seed, delay=0.05)
                            vehicle.lands_at, vehicle.grants_rates = lands_at, grants_rates
                            wires.run(200, at_its_landing(vehicle, height + 0.1 * random.Random(seed).random()))
                            wires.say(vehicle, vehicle.kill(wires.now))
                            self.ends(wires, "r", "failed", "was disarmed in flight")

    def test_a_kill_of_which_the_heartbeat_is_late(self):
        """As of autopilots that send it once a second. From 1.2 m on, from 3 m with one position a second."""
        for grants_rates, heights in ((True, (2.7, 1.7)), (False, (4.0, 3.2))):
            for height in heights:
                for seed in seeds(20):
                    with self.subTest(rates=grants_rates, height=height, seed=seed):
                        vehicle, wires = begun((*way(3), LANDINGS["a landing"]), seed=seed, delay=0.05)
                        vehicle.lands_at, vehicle.grants_rates = 0.5, grants_rates
                        wires.run(200, at_its_landing(vehicle, height))
                        wires.run(random.Random(seed).random())
                        vehicle.kill(wires.now)  # its immediate reports are lost
                        self.ends(wires, "r", "failed", "was disarmed in flight")

    def test_positions_come_often_only_while_it_lands(self):
        for loss in (0.0, 0.3):
            for seed in seeds(5):
                with self.subTest(loss=loss, seed=seed):
                    vehicle, wires = begun((*way(6), LANDINGS["a landing"]), seed=seed, loss=loss, delay=0.05)
                    repeated = 0.1 if loss == 0 else 20  # a lost order is
                    self.assertTrue(wires.run(60 if loss == 0 else 300, lambda: vehicle.current > 3))
                    self.assertTrue(wires.run(repeated, lambda: vehicle._place_interval == 1.0))
                    self.assertTrue(wires.run(200, at_its_landing(vehicle, 8.0)))
                    self.assertTrue(wires.run(repeated, lambda: vehicle._place_interval == 0.1))
                    self.ends(wires, "r", "done")
                    wires.run(1)
                    if loss == 0:
                        self.assertEqual(vehicle._place_interval, 1.0)

    def test_landings_at_any_speed(self):
        for lands_at in (0.3, 0.5, 1.0, 1.5, 2.5):
            for loss in (0.0, 0.3):
                for seed in seeds(10):
                    with self.subTest(lands_at=lands_at, loss=loss, seed=seed):
                        items = (*way(3), LANDINGS["a landing"])
                        vehicle, wires = begun(items, seed=seed, loss=loss, delay=0.05, reordered=0.2)
                        vehicle.lands_at = lands_at
                        self.ends(wires, "r", "done")

    def test_a_vehicle_that_is_disarmed_on_the_ground(self):
        for kind in ("rover", "boat"):
            vehicle, wires = one(kind, items=way(12))
            wires.start("r", "mav-1", stored())
            self.assertTrue(wires.run(30, lambda: wires.said("taken")))
            wires.run(8)
            wires.say(vehicle, vehicle.disarm(wires.now))
            self.ends(wires, "r", "failed", "was disarmed")


class StopsAndStarts(Case):
    def test_a_start_right_after_a_stop(self):
        """A heartbeat ends a stop: the acknowledgement comes before it, on a slow radio by a second."""
        for px4 in (False, True):
            for lag in (0.02, 0.3, 0.9):
                for loss in (0.0, 0.2):
                    for seed in seeds(5):
                        with self.subTest(px4=px4, lag=lag, loss=loss, seed=seed):
                            vehicle, wires = one(px4=px4, items=way(12), delay=0.1, loss=loss, seed=seed)
                            vehicle.lag = lag
                            wires.start("a", "mav-1", stored())
                            wires.run(6 + 0.1 * (seed % 10))
                            act, begun = wires._act, []

                            def at_once():
                                act()
                                if wires.end_of("a") is not None and not begun:
                                    begun.append(True)
                                    wires.start("b", "mav-1", stored())

                            wires._act = at_once
                            wires.stop("a")
                            self.assertEqual(wires.run_to_end("a", 60)["kind"], "stopped")
                            self.assertNotEqual(vehicle.mode, vehicle.modes.mission if not begun else None)
                            self.ends(wires, "b", "done")

    def test_a_stop_that_is_refused_at_first_is_repeated(self):
        vehicle, wires = begun(way(30))
        self.assertTrue(wires.run(30, lambda: wires.said("taken")))
        wires.run(3)
        vehicle.results[mavlink.MAV_CMD_DO_SET_MODE] = mavlink.MAV_RESULT_FAILED
        wires.stop("r")
        wires.run(5)
        self.assertIsNone(wires.end_of("r"))
        del vehicle.results[mavlink.MAV_CMD_DO_SET_MODE]
        self.ends(wires, "r", "stopped")
        self.assertEqual(vehicle.mode, "BRAKE")


ARM, SET_MODE = mavlink.MAV_CMD_COMPONENT_ARM_DISARM, mavlink.MAV_CMD_DO_SET_MODE
FAILED, CRITICAL, WARNING, NOTICE = mavlink.MAV_RESULT_FAILED, 2, 4, 5


class Refusals(Case):
    def test_the_reason_comes_after_the_acknowledgement(self):
        reasons = [
            (ARM, CRITICAL, "Arm: GPS 1: Bad fix", "its autopilot does not arm: Arm: GPS 1: Bad fix"),
            (
                SET_MODE,
                WARNING,
                "Mode change to GUIDED failed: requires position",
                "its autopilot does not go into mode GUIDED: Mode change to GUIDED failed: requires position",
            ),
            (
                SET_MODE,
                NOTICE,
                "Mode change to AUTO denied, in fence recovery",
                "its autopilot does not go into mode GUIDED: Mode change to AUTO denied, in fence recovery",
            ),
        ]
        for command, severity, text, why in reasons:
            for loss in (0.0, 0.2):
                for seed in seeds(5):
                    with self.subTest(text=text, loss=loss, seed=seed):
                        vehicle, wires = one(loss=loss, seed=seed, delay=0.05)
                        vehicle.results[command] = FAILED
                        vehicle.reasons[command] = severity, text
                        mode = vehicle.mode
                        wires.start("r", "mav-1", stored())
                        end = wires.run_to_end("r")
                        # A text is sent once for each refusal: it may be lost.
                        known = (why,) if loss == 0 else (why, why.split(": ")[0] + ": failed")
                        self.assertIn(end["why"], known)
                        self.assertEqual(vehicle.mode, mode)

    def test_several_reasons(self):
        vehicle, wires = one()
        vehicle.results[ARM] = FAILED
        vehicle.reasons[ARM] = CRITICAL, "Arm: GPS 1: Bad fix"
        wires.start("r", "mav-1", stored())
        self.assertTrue(wires.run(10, lambda: vehicle._soon))
        wires.say(vehicle, [mavlink.MAVLink_statustext_message(4, b"EKF3 IMU0 is using GPS")])
        wires.say(vehicle, [mavlink.MAVLink_statustext_message(2, b"Arm: Compass not calibrated")])
        why = "its autopilot does not arm: Arm: Compass not calibrated; Arm: GPS 1: Bad fix"
        self.ends(wires, "r", "failed", why)

    def test_a_copter_that_does_not_arm_goes_back_into_its_mode(self):
        for loss in (0.0, 0.3):
            for seed in seeds(20):
                with self.subTest(loss=loss, seed=seed):
                    vehicle, wires = one(loss=loss, seed=seed, delay=0.05)
                    vehicle.results[ARM] = FAILED
                    wires.start("r", "mav-1", stored())
                    self.ends(wires, "r", "failed", "its autopilot does not arm: failed")
                    self.assertEqual(vehicle.mode, "STABILIZE")

    def test_a_copter_that_is_stopped_before_it_is_armed_goes_back_too(self):
        for tenths in range(0, 30):
            with self.subTest(tenths=tenths):
                vehicle, wires = one(delay=0.1)
                vehicle.deaf_to.add(ARM)
                wires.start("r", "mav-1", stored())
                wires.run(tenths / 10)
                wires.stop("r")
                self.ends(wires, "r", "stopped")
                wires.run(2)
                self.assertEqual(vehicle.mode, "STABILIZE")

    def test_a_mode_is_put_back_over_a_slow_link(self):
        for delay in (0.5, 1.0, 2.0):
            with self.subTest(delay=delay):
                vehicle, wires = one(delay=delay)
                wires.run(10)
                vehicle.results[ARM] = FAILED
                vehicle.reasons[ARM] = CRITICAL, "Arm: GPS 1: Bad fix"
                wires.start("r", "mav-1", stored())
                self.ends(wires, "r", "failed", "its autopilot does not arm: Arm: GPS 1: Bad fix")
                self.assertEqual(vehicle.mode, "STABILIZE")

    def test_a_mode_that_cannot_be_put_back(self):
        vehicle, wires = one(delay=0.2)
        vehicle.results[ARM] = FAILED
        wires.start("r", "mav-1", stored())
        self.assertTrue(wires.run(10, lambda: vehicle.mode == "GUIDED"))
        vehicle.deaf_to.add(SET_MODE)
        self.ends(wires, "r", "failed", "its autopilot does not arm: failed, and stays in mode GUIDED")

    def test_a_hand_while_the_mode_is_put_back(self):
        vehicle, wires = one(delay=0.2)
        vehicle.results[ARM] = FAILED
        wires.start("r", "mav-1", stored())
        self.assertTrue(wires.run(10, lambda: vehicle.mode == "GUIDED"))
        vehicle.deaf_to.add(SET_MODE)
        wires.run(1.5)
        wires.say(vehicle, vehicle.pilot(wires.now, "LOITER"))
        wires.run(1)
        vehicle.deaf_to.clear()
        self.ends(wires, "r", "failed", "its autopilot does not arm: failed")
        self.assertEqual(vehicle.mode, "LOITER")


class Pilots(Case):
    def test_a_pilot_who_arms_while_the_mission_is_on_its_way(self):
        """The vehicle is the pilot's, though its mode is the one in which it was."""
        for kind in ("copter", "plane", "rover"):
            for tenths in range(1, 20):
                with self.subTest(kind=kind, tenths=tenths):
                    vehicle, wires = one(kind, items=way(12), delay=0.1)
                    mode = vehicle.mode
                    wires.start("r", "mav-1", stored())
                    wires.run(tenths / 10)
                    self.assertEqual(vehicle.mode, mode)
                    vehicle.armed = True
                    wires.say(vehicle, vehicle.pilot(wires.now, mode))
                    self.ends(wires, "r", "failed", f"taken over by its pilot in mode {mode}")
                    self.assertEqual((vehicle.mode, vehicle.armed), (mode, True))
                    self.assertEqual(vehicle.began, [])


class Departures(Case):
    """The cause that took a vehicle out of its mission is named."""

    def flying(self, kind="copter", px4=False, **more):
        vehicle, wires = one(kind, px4, items=way(40), **more)
        wires.start("r", "mav-1", stored())
        self.assertTrue(wires.run(30, lambda: wires.said("taken")))
        wires.run(6)
        return vehicle, wires

    def text(self, wires, vehicle, severity, words, **more):
        wires.say(vehicle, [mavlink.MAVLink_statustext_message(severity, words.encode(), **more)])

    def test_a_breach_of_its_fence(self):
        breaches = [
            (mavlink.FENCE_BREACH_BOUNDARY, "Fence Breached", "fence breach (boundary), in mode RTL"),
            (mavlink.FENCE_BREACH_MAXALT, None, "fence breach (maximum altitude), in mode RTL"),
            (mavlink.FENCE_BREACH_MINALT, None, "fence breach (minimum altitude), in mode RTL"),
        ]
        for kind in ("copter", "plane", "rover"):
            for breach, text, why in breaches:
                vehicle, wires = self.flying(kind)
                wires.say(vehicle, vehicle.breach(wires.now, "RTL", breach, text))
                self.ends(wires, "r", "failed", why)
                self.assertEqual(wires.vehicle_said("mav-1")["unready"], "is in mode RTL after a fence breach")
        vehicle, wires = self.flying()
        self.text(wires, vehicle, NOTICE, "Fence Breached")
        wires.say(vehicle, vehicle.pilot(wires.now, "LAND"))
        self.ends(wires, "r", "failed", "fence breach, in mode LAND")

    def test_a_fence_that_is_not_breached(self):
        vehicle, wires = self.flying()
        wires.say(vehicle, [mavlink.MAVLink_fence_status_message(0, 0, 0, 0)])
        wires.say(vehicle, vehicle.pilot(wires.now, "LOITER"))
        self.ends(wires, "r", "failed", "taken over by its pilot in mode LOITER")

    def test_a_breach_that_goes_on_is_not_the_reason(self):
        """Of a fence that only reports, for example."""
        vehicle, wires = self.flying()
        for _ in range(30):
            wires.say(vehicle, [mavlink.MAVLink_fence_status_message(1, 1, mavlink.FENCE_BREACH_BOUNDARY, 5000)])
            wires.run(0.5)
        wires.say(vehicle, vehicle.pilot(wires.now, "LOITER"))
        self.ends(wires, "r", "failed", "taken over by its pilot in mode LOITER")
        vehicle, wires = self.flying()
        for count in (1, 2):
            wires.say(vehicle, [mavlink.MAVLink_fence_status_message(1, count, mavlink.FENCE_BREACH_MAXALT, 5000)])
            wires.run(12 if count == 1 else 0.1)
        wires.say(vehicle, vehicle.pilot(wires.now, "LAND"))
        self.ends(wires, "r", "failed", "fence breach (maximum altitude), in mode LAND")

    def test_a_failsafe_that_is_over_is_not_the_reason(self):
        for end in ("GCS Failsafe Cleared", "Radio Failsafe Cleared", "EKF Failsafe Cleared", "GCS Failsafe Off"):
            for before in (None, end.rpartition(" ")[0]):
                vehicle, wires = self.flying()
                if before is not None:
                    self.text(wires, vehicle, WARNING, before)
                    wires.run(1)
                self.text(wires, vehicle, WARNING, end)
                wires.run(1)
                wires.say(vehicle, vehicle.pilot(wires.now, "LOITER"))
                self.ends(wires, "r", "failed", "taken over by its pilot in mode LOITER")

    def test_a_failsafe_that_is_over_after_it_took_the_vehicle_home(self):
        vehicle, wires = self.flying()
        self.text(wires, vehicle, WARNING, "Radio Failsafe")
        wires.say(vehicle, vehicle.pilot(wires.now, "RTL"))
        wires.run(1)
        self.text(wires, vehicle, WARNING, "Radio Failsafe Cleared")
        self.ends(wires, "r", "failed", "failsafe: Radio Failsafe, in mode RTL")

    def test_a_return_that_another_station_orders(self):
        for kind, px4, mode in (
            ("copter", False, "RTL"),
            ("copter", False, "SMART_RTL"),
            ("plane", False, "RTL"),
            ("rover", False, "RTL"),
            ("copter", True, "RTL"),
        ):
            vehicle, wires = self.flying(kind, px4)
            wires.say(vehicle, vehicle.pilot(wires.now, mode))
            why = f"returns home in mode {mode}, set by its pilot or another station"
            self.ends(wires, "r", "failed", why)
            self.assertEqual(wires.vehicle_said("mav-1")["unready"], f"returns home in mode {mode}")
        vehicle, wires = self.flying()
        wires.say(vehicle, vehicle.pilot(wires.now, "LAND"))
        self.ends(wires, "r", "failed", "lands in mode LAND, set by its pilot or another station")

    def test_an_autopilot_that_restarts_in_flight(self):
        for kind in ("copter", "plane"):
            for away in (0.5, 2.0, 6.0):
                for seed in seeds(5):
                    with self.subTest(kind=kind, away=away, seed=seed):
                        vehicle, wires = self.flying(kind, seed=seed, delay=0.05)
                        wires.run(0.2 * (seed % 5))
                        vehicle.restart(wires.now, away)
                        self.ends(wires, "r", "failed", "its autopilot restarted in flight")

    def test_a_crash_is_named(self):
        vehicle, wires = self.flying()
        self.text(wires, vehicle, 0, "Crash: Disarming: AngErr=163>30, Accel=1.2<3.0")
        wires.say(vehicle, vehicle.kill(wires.now))
        why = "was disarmed in flight: Crash: Disarming: AngErr=163>30, Accel=1.2<3.0"
        self.ends(wires, "r", "failed", why)

    def test_grave_texts_are_shown(self):
        vehicle, wires = self.flying()
        for severity in range(8):
            self.text(wires, vehicle, severity, f"text {severity}")
        self.text(wires, vehicle, 0, "Potential Thrust Loss (2)")
        wires.run(2)
        shown = ["text 0", "text 1", "text 2", "Potential Thrust Loss (2)"]
        self.assertEqual([(r["vehicle"], r["text"]) for r in wires.said("log")], [("mav-1", t) for t in shown])
        for _ in range(20):
            self.text(wires, vehicle, 0, "Potential Thrust Loss (2)")
            wires.run(10)
        self.assertEqual(len(wires.said("log")), 4)

    def test_a_long_text_comes_in_pieces(self):
        vehicle, wires = self.flying()
        long = "PreArm: " + "a reason that is much longer than one message can hold " * 2
        pieces = [long[i : i + 50] for i in range(0, len(long), 50)]
        for n, piece in enumerate(pieces):
            self.text(wires, vehicle, 2, piece, id=7, chunk_seq=n)
        self.text(wires, vehicle, 2, "another one")
        wires.run(2)
        self.assertEqual([r["text"] for r in wires.said("log")], [long.strip(), "another one"])

    def test_telemetry_that_was_not_granted_is_asked_for_again(self):
        vehicle, wires = self.flying()
        vehicle._streams = False
        place = vehicle.place
        wires.run(6)
        self.assertTrue(vehicle._streams)
        self.assertNotEqual(wires.station._vehicles[1].place, place)


if __name__ == "__main__":
    unittest.main()
