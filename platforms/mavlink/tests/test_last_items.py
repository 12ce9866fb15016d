"""Missions whose last item takes time: VTOL transitions of PX4, delays, holds, turns. Virtual time."""

import random
import unittest

from dolphin_mavlink.mission import Item
from dolphin_mavlink.wire import mavlink
from seeds import seeds
from tests.support import Case, one, stored, waypoint

TRANSITION = mavlink.MAV_CMD_DO_VTOL_TRANSITION
WAY = (waypoint(20, 0), waypoint(40, 0))


def started(kind, px4, last, **more):
    vehicle, wires = one(kind, px4, items=(*WAY, last), **more)
    wires.start("r", "mav-1", stored())
    return vehicle, wires


def at_last(vehicle):
    return len(vehicle.items) > 2 and vehicle.current == len(vehicle.items) - 1


class Transitions(Case):
    def test_a_transition_that_ends_a_mission_is_waited_for(self):
        """PX4 completes it. Before that the mission is not done."""
        for state in (3, 4):
            for loss in (0.0, 0.3):
                for tells_state in (True, False):
                    for seed in seeds(10):
                        with self.subTest(state=state, loss=loss, tells_state=tells_state, seed=seed):
                            last = Item(TRANSITION, 2, (float(state), 0.0, 0.0, 0.0))
                            vehicle, wires = started("vtol", True, last, seed=seed, loss=loss, delay=0.05)
                            vehicle.tells_state = tells_state
                            self.assertTrue(wires.run(200, lambda: at_last(vehicle)))
                            wires.run(vehicle.transition - 1)
                            self.assertIsNone(wires.end_of("r"))
                            self.assertEqual(vehicle.mode, "MISSION")
                            if loss == 0:
                                self.ends(wires, "r", "done")

    def test_a_hand_during_the_transition(self):
        """In any mode, also the one that PX4 takes after a mission."""
        for mode, why in (
            ("HOLD", "taken over by its pilot in mode HOLD"),
            ("POSCTL", "taken over by its pilot in mode POSCTL"),
            ("RTL", "returns home in mode RTL, set by its pilot or another station"),
        ):
            for tells_state in (True, False):
                for seed in seeds(5):
                    with self.subTest(mode=mode, tells_state=tells_state, seed=seed):
                        last = Item(TRANSITION, 2, (3.0, 0.0, 0.0, 0.0))
                        vehicle, wires = started("vtol", True, last, seed=seed, delay=0.05)
                        vehicle.tells_state = tells_state
                        self.assertTrue(wires.run(60, lambda: at_last(vehicle)))
                        wires.run(random.Random(seed).uniform(0.5, 6.0))
                        wires.say(vehicle, vehicle.pilot(wires.now, mode))
                        self.ends(wires, "r", "failed", why)

    def test_ardupilot_carries_it_out_at_once(self):
        last = Item(TRANSITION, 2, (3.0, 0.0, 0.0, 0.0))
        _, wires = started("plane", False, last)
        self.ends(wires, "r", "done")

    def test_a_transition_that_never_ends_is_refused(self):
        for kind, state, why in (
            ("vtol", 0.0, "item 3 is a VTOL transition to state 0: 3 is rotary wing, 4 fixed wing"),
            ("vtol", 2.0, "item 3 is a VTOL transition to state 2: 3 is rotary wing, 4 fixed wing"),
            ("copter", 4.0, "item 3: a copter has no VTOL transition"),
            ("rover", 3.0, "item 3: a rover has no VTOL transition"),
        ):
            with self.subTest(kind=kind, state=state):
                vehicle, wires = started(kind, True, Item(TRANSITION, 2, (state, 0.0, 0.0, 0.0)))
                self.ends(wires, "r", "failed", why)
                self.assertEqual(vehicle.began, [])


class Times(Case):
    """A hand during an item that takes time is not the end of the mission, also in the mode that follows the end."""

    LASTS = [
        Item(93, 2, (40.0, -1.0, -1.0, -1.0)),
        waypoint(60, 0, params=(40.0, 0.0, 0.0, 0.0)),
        waypoint(60, 0, command=19, params=(40.0, 0.0, 0.0, 0.0)),
    ]

    def test_a_hand_while_the_last_item_goes_on(self):
        for kind, px4, mode in (("copter", True, "HOLD"), ("plane", False, "RTL"), ("rover", False, "HOLD")):
            for last in self.LASTS:
                for seed in seeds(5):
                    with self.subTest(kind=kind, px4=px4, command=last.command, seed=seed):
                        vehicle, wires = started(kind, px4, last, seed=seed, loss=0.1, delay=0.05)
                        self.assertTrue(wires.run(100, lambda: at_last(vehicle)))
                        wires.run(random.Random(seed).uniform(5.0, 25.0))
                        wires.say(vehicle, vehicle.pilot(wires.now, mode))
                        end = wires.run_to_end("r")
                        self.assertEqual(end["kind"], "failed")
                        self.assertIn(f"in mode {mode}", end["why"])

    def test_an_end_of_which_the_last_word_is_lost(self):
        """The time at the last place decides then."""
        for kind, px4 in (("copter", True), ("plane", False), ("rover", False)):
            for last in self.LASTS:
                with self.subTest(kind=kind, px4=px4, command=last.command):
                    vehicle, wires = started(kind, px4, last)
                    vehicle.tells_state = False
                    wires.loses = lambda m: m.get_type() == "MISSION_ITEM_REACHED" and m.seq == len(vehicle.items) - 1
                    self.ends(wires, "r", "done")
                    self.assertEqual(vehicle.reached[-1], len(vehicle.items) - 1)


if __name__ == "__main__":
    unittest.main()
