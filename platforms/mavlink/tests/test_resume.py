"""Adapters and links that die at 100 moments of a mission: nothing is flown twice, and losses are reported."""

import json
import math
import random

from dolphin_mavlink import geo
from dolphin_mavlink.mission import Item, Mission, of_note
from dolphin_mavlink.station import Options
from dolphin_mavlink.wire import mavlink
from sim.network import Network
from sim.vehicle import SimVehicle
from seeds import seeds
from tests.support import HARBOUR, Case, one, stored, way

POINTS = 100
LENGTH = 16.0  # seconds that the mission takes, from the order to its end, and a little more


def moments():
    """Dense at the beginning, which decides most."""
    return [LENGTH * (k / POINTS) ** 2 for k in range(POINTS)]


def flight(*words):
    """A plan in the language of missions, which arms the vehicle."""
    words = (["arm", True], *words)
    items = [{"item": name, "arguments": arguments, "named": {}} for name, *arguments in words]
    return {"name": "flight", "language": "mission", "body": {"items": items}}


class Console:
    """The part of Dolphin beside an adapter: keeps orders and notes, and resumes."""

    def __init__(self, wires):
        self.wires = wires

    def restart(self, request, plan):
        """The adapter has died a second ago, and is started again."""
        ended = self.wires.end_of(request)
        notes = [r["note"] for r in reversed(self.wires.said("note", request))]
        self.wires.start_station(resumes=True)
        if ended is None:
            self.wires.order(kind="resume", request=request, vehicle="mav-1", plan=plan, timeout=60, notes=notes)

    def follow(self, request, plan):
        """The end of `request`. An absent one is ordered again, an unknown one is stopped."""
        done_before = 0
        for _ in range(3):
            self.wires.run(
                400,
                lambda: len(self.ends(request)) > done_before or self.wires.said("unknown", request),
            )
            if self.wires.said("unknown", request) and len(self.ends(request)) == done_before:
                self.wires.stop(request)
                self.wires.run(60, lambda: len(self.ends(request)) > done_before)
            ends = self.ends(request)
            if not ends or ends[-1]["kind"] != "absent":
                return ends[-1] if ends else None
            done_before = len(ends)
            self.wires.start(request, "mav-1", plan)
        return None

    def ends(self, request):
        return [r for r in self.wires.said(None, request) if r["kind"] in ("done", "failed", "stopped", "absent")]


class Killed(Case):
    def killed_adapters(self, **network):
        outcomes = {}
        for number, moment in enumerate(moments()):
            with self.subTest(moment=moment):
                vehicle, wires = one(px4=number % 2 == 1, items=way(8), seed=number, delay=0.03, **network)
                wires.run(20, lambda: "link" in wires.vehicle_said("mav-1"))
                console, plan = Console(wires), stored()
                wires.start("r", "mav-1", plan)
                wires.run(moment)
                wires.gone = True
                wires.run(1)
                console.restart("r", plan)
                end = console.follow("r", plan)
                self.assertIsNotNone(end)
                self.assertLessEqual(len(vehicle.began), 1)
                if end["kind"] == "done":
                    self.assertEqual(len(vehicle.reached), 8)
                else:
                    self.assertEqual(end["kind"], "failed")
                    self.assertTrue(end["why"])
                    self.assertNotEqual(vehicle.state, mavlink.MISSION_STATE_ACTIVE)
                outcomes[end["kind"]] = outcomes.get(end["kind"], 0) + 1
        return outcomes

    def test_killed_adapters(self):
        outcomes = self.killed_adapters()
        self.assertGreaterEqual(outcomes["done"], 75, outcomes)

    def test_killed_adapters_on_a_bad_link(self):
        outcomes = self.killed_adapters(loss=0.2, doubled=0.1, reordered=0.1)
        self.assertGreaterEqual(outcomes["done"], 70, outcomes)

    def test_killed_consoles_whose_journal_loses_its_end(self):
        """With the note, or with note and order: nothing is begun twice, whatever mission it is."""
        relative = flight(["takeOff", 20], ["move", 50, 0], ["move", 0, 50], ["loiterTime", 2])
        landing = flight(["takeOff", 20], ["move", 30, 0], ["returnHomeAndLand"])
        outcomes = {}
        for number, moment in enumerate(moments()):
            for doubt in ("order", "notes"):
                with self.subTest(moment=moment, doubt=doubt):
                    plan = (stored(), relative, landing)[number % 3]
                    vehicle, wires = one(px4=number % 2 == 1, items=way(8), seed=number, delay=0.03)
                    wires.run(20, lambda: "link" in wires.vehicle_said("mav-1"))
                    wires.start("r", "mav-1", plan)
                    wires.run(moment * (3 if plan is landing else 1))
                    wires.gone = True
                    wires.run(1)
                    end = self.resumed_without_notes(wires, plan, doubt)
                    self.assertIsNotNone(end)
                    self.assertLessEqual(len(vehicle.began), 1)
                    outcomes[end["kind"]] = outcomes.get(end["kind"], 0) + 1
        self.assertGreater(outcomes["done"], 10, outcomes)
        self.assertGreater(outcomes["stopped"], 10, outcomes)

    def resumed_without_notes(self, wires, plan, doubt):
        """The end of r, which had no end when its console died."""
        had_end = wires.end_of("r")
        if had_end is not None:
            return had_end
        wires.start_station(resumes=True)
        wires.order(
            kind="resume", request="r", vehicle="mav-1", plan=plan, timeout=60, notes=[], doubt=doubt
        )
        return Console(wires).follow("r", plan)

    def test_a_landed_vehicle_whose_note_is_lost(self):
        """ArduCopter reports a mission that has landed as one that has not begun: it is not flown again."""
        landing = flight(["takeOff", 20], ["move", 30, 0], ["returnHomeAndLand"])
        elsewhere = flight(["takeOff", 20], ["move", 300, 0], ["landingPoint"])
        for tells_state in (False, True):
            for plan in (landing, elsewhere):
                with self.subTest(tells_state=tells_state, plan=plan):
                    vehicle, wires = one()
                    vehicle.tells_state = tells_state
                    wires.start("r", "mav-1", plan)
                    self.assertTrue(wires.run(60, lambda: vehicle.began))
                    wires.gone = True
                    self.assertTrue(wires.run(300, lambda: not vehicle.armed))
                    wires.run(5)
                    end = self.resumed_without_notes(wires, plan, "notes")
                    self.assertEqual((end["kind"], len(vehicle.began)), ("stopped", 1))

    def test_another_mission_is_on_board(self):
        """No note of the mission, and the vehicle has flown another one: it is started."""
        for doubt in ("order", "notes"):
            with self.subTest(doubt=doubt):
                vehicle, wires = one(items=way(8))
                wires.start("q", "mav-1", flight(["takeOff", 20], ["move", 30, 0], ["loiterTime", 1]))
                self.assertTrue(wires.run(60, lambda: wires.end_of("q")))
                wires.gone = True
                wires.run(1)
                end = self.resumed_without_notes(wires, stored(), doubt)
                self.assertEqual((end["kind"], len(vehicle.began)), ("done", 2))

    def test_a_plan_that_is_refused_has_not_run(self):
        vehicle, wires = one(items=way(8))
        wires._options.stored.clear()
        end = self.resumed_without_notes(wires, stored(), "order")
        self.assertEqual((end["kind"], vehicle.began), ("failed", []))

    def test_killed_links(self):
        """For 8 s, then they are back: the mission is flown once, and done."""
        for number, moment in enumerate(moments()):
            with self.subTest(moment=moment):
                vehicle, wires = one(px4=number % 2 == 1, items=way(8), seed=number, delay=0.03)
                wires.start("r", "mav-1", stored())
                wires.run(moment)
                wires.down = True
                wires.run(8)
                wires.down = False
                self.ends(wires, "r", "done")
                self.assertEqual((len(vehicle.began), len(vehicle.reached)), (1, 8))

    def test_killed_links_that_stay_dead(self):
        """A mission that was certainly not begun has failed; nothing is claimed about others."""
        for number, moment in enumerate(moments()):
            with self.subTest(moment=moment):
                vehicle, wires = one(px4=number % 2 == 1, items=way(8), seed=number, delay=0.03)
                wires.start("r", "mav-1", stored(), timeout=10)
                wires.run(moment)
                wires.down = True
                wires.run(60)
                end = wires.end_of("r")
                if end is not None and end["kind"] == "failed":
                    self.assertEqual(vehicle.began, [])
                elif end is None:
                    self.assertFalse(wires.vehicle_said("mav-1")["link"])
                    wires.stop("r")
                    wires.run(20)
                    self.assertIsNone(wires.end_of("r"))
                    wires.down = False
                    self.assertIn(wires.run_to_end("r", 30)["kind"], ("stopped", "done"))

    def test_a_stop_for_a_vehicle_that_is_not_heard_yet(self):
        vehicle, wires = one(items=way(30))
        plan = stored()
        wires.start("r", "mav-1", plan)
        self.assertTrue(wires.run(20, lambda: wires.said("taken")))
        notes = [r["note"] for r in wires.said("note", "r")]
        wires.run(2)
        wires.gone = True
        wires.run(1)
        wires.start_station(resumes=True)
        wires.order(kind="resume", request="r", vehicle="mav-1", plan=plan, timeout=60, notes=notes)
        wires.stop("r")
        self.ends(wires, "r", "stopped")
        self.assertEqual(vehicle.mode, "BRAKE")

    def test_another_mission_is_not_taken_for_ours(self):
        vehicle, wires = one(items=way(30))
        plan = stored()
        wires.start("r", "mav-1", plan)
        wires.run(10, lambda: wires.said("taken"))
        wires.gone = True
        wires.run(1)
        vehicle.items[3].x += 5000
        wires.start_station(resumes=True)
        wires.order(kind="resume", request="r", vehicle="mav-1", plan=plan, timeout=60, notes=[{"mission": "x"}])
        self.assertTrue(wires.run(20, lambda: wires.said("unknown", "r")))
        self.assertIn("the mission on board is another one", wires.said("unknown", "r")[0]["why"])
        self.assertEqual((wires.end_of("r"), vehicle.mode), (None, "AUTO"))
        wires.stop("r")
        self.ends(wires, "r", "stopped")
        self.assertEqual(vehicle.mode, "BRAKE")

    def test_another_mission_that_was_to_be_stopped(self):
        vehicle, wires = self.flying(stored(), way(30))
        vehicle.items[3].x += 5000
        self.resume(wires, stored())
        wires.stop("r")
        self.ends(wires, "r", "stopped")
        self.assertEqual(vehicle.mode, "BRAKE")

    def test_another_mission_that_is_not_flown(self):
        vehicle, wires = self.flying(stored(), way(30))
        vehicle.items[3].x += 5000
        vehicle.pilot(wires.now, "LOITER")
        self.resume(wires, stored())
        end = wires.run_to_end("r")
        self.assertEqual(end["kind"], "failed")
        self.assertIn("is in mode LOITER, and may have flown the mission that it was to begin", end["why"])
        self.assertEqual(vehicle.mode, "LOITER")

    def flying(self, plan, items=None, px4=False, seconds=4.0, **more):
        """A vehicle whose mission has been under way for some seconds when its adapter dies."""
        vehicle, wires = one(px4=px4, items=items, **more)
        wires.start("r", "mav-1", plan)
        self.assertTrue(wires.run(30, lambda: wires.said("taken")), wires.reports[-3:])
        wires.run(seconds)
        wires.gone = True
        wires.run(1)
        return vehicle, wires

    def resume(self, wires, plan, notes=None):
        """A new adapter, which hears no position before it is asked to resume."""
        noted = [r["note"] for r in reversed(wires.said("note", "r"))]
        noted = json.loads(json.dumps(noted, allow_nan=False))
        wires.start_station(resumes=True)
        wires.order(
            kind="resume", request="r", vehicle="mav-1", plan=plan, timeout=60, notes=noted if notes is None else notes
        )

    def test_missions_relative_to_where_the_vehicle_was(self):
        """And those that begin with a take-off from there. They are resumed from elsewhere, and go on."""
        relative = flight(["takeOff", 20], ["move", 50, 0], ["move", 0, 50], ["move", -50, 0], ["loiterTime", 5])
        here = {"latitude": HARBOUR[0] + 0.002, "longitude": HARBOUR[1], "height": 0}
        absolute = flight(["takeOffWithYaw", 20, 90], ["goPos", here], ["loiterTime", 5])
        unturned = flight(["takeOff", 20], ["goPos", here], ["returnHomeAndLand"])
        for plan in (relative, absolute, unturned):
            for px4 in (False, True):
                for seconds in (0.2, 3.0, 6.0):
                    with self.subTest(plan=plan, px4=px4, seconds=seconds):
                        vehicle, wires = self.flying(plan, px4=px4, seconds=seconds)
                        flown = len(vehicle.items)
                        self.resume(wires, plan)
                        self.ends(wires, "r", "done")
                        self.assertEqual((len(vehicle.began), len(vehicle.items)), (1, flown))
                        self.assertEqual(wires.said("unknown"), [])

    def test_a_note_without_the_items(self):
        """As earlier adapters wrote it. Now the plan becomes another mission: it is stopped."""
        plan = flight(["takeOff", 20], ["move", 500, 0], ["move", 0, 500])
        vehicle, wires = self.flying(plan)
        self.resume(wires, plan, notes=[{"mission": "x", "items": 3}])
        self.assertTrue(wires.run(20, lambda: wires.said("unknown", "r")))
        wires.stop("r")
        self.ends(wires, "r", "stopped")
        self.assertEqual(vehicle.mode, "BRAKE")

    def test_notes_that_are_malformed(self):
        good = [16, 6, 1, 2, 3.0]
        for compiled in (7, [], [7], [["x"]], [[16, 6, None]], [[16, 6, 1.5]], [good + [0] * 6], [[True]]):
            with self.subTest(compiled=compiled):
                vehicle, wires = self.flying(stored(), way(30))
                self.resume(wires, stored(), notes=[{"mission": "x", "items": 1, "compiled": compiled}])
                self.assertTrue(wires.run(20, lambda: wires.said("unknown", "r")))
                wires.stop("r")
                self.ends(wires, "r", "stopped")
                self.assertEqual(vehicle.mode, "BRAKE")

    def test_a_plan_that_cannot_be_made_any_more(self):
        """Its stored mission is gone, and the note has no items."""
        vehicle, wires = self.flying(stored(), way(30))
        wires._options.stored.clear()
        self.resume(wires, stored(), notes=[{"mission": "x", "items": 30}])
        self.assertTrue(wires.run(20, lambda: wires.said("unknown", "r")))
        self.assertIn("there is no mission 'survey'", wires.said("unknown", "r")[0]["why"])
        wires.stop("r")
        self.ends(wires, "r", "stopped")
        self.assertEqual(vehicle.mode, "BRAKE")

    def test_a_note_outlives_its_file(self):
        vehicle, wires = self.flying(stored(), way(8))
        wires._options.stored.clear()
        self.resume(wires, stored())
        self.ends(wires, "r", "done")

    def test_a_vehicle_that_has_landed_in_the_meantime(self):
        plan = flight(["takeOff", 20], ["move", 30, 0], ["returnHomeAndLand"])
        vehicle, wires = self.flying(plan, seconds=1)
        wires.gone = True
        self.assertTrue(wires.run(120, lambda: not vehicle.armed))
        wires.run(5)
        vehicle.tells_state = False
        self.resume(wires, plan)
        end = wires.run_to_end("r", 60)
        self.assertEqual(end["kind"], "failed")
        self.assertIn("may have flown it: it is not armed", end["why"])
        self.assertEqual(len(vehicle.began), 1)

    def test_notes_give_missions_back(self):
        for seed in seeds(20):
            generator = random.Random(seed)

            def number():
                return generator.choice((0.0, -0.0, 7.5, math.nan, generator.uniform(-1e6, 1e6)))

            items = tuple(
                Item(
                    generator.choice((16, 22, 93, 178, 203)),
                    generator.choice((2, 5, 6, 11)),
                    tuple(number() for _ in range(4)),
                    generator.choice((0, generator.randrange(-(2**31), 2**31))),
                    generator.choice((0, generator.randrange(-(2**31), 2**31))),
                    generator.choice((0.0, generator.uniform(-100, 100))),
                    generator.randrange(2),
                )
                for _ in range(generator.randrange(1, 9))
            )
            sent = Mission(items, generator.choice((True, False)), generator.choice((True, False)))
            note = json.loads(json.dumps(sent.note, allow_nan=False))
            found = of_note(note)
            self.assertEqual(repr(found).replace("-0.0", "0.0"), repr(sent).replace("-0.0", "0.0"))


class Unheard(Case):
    """A plan waits for reports of the vehicle that it depends on."""

    def one(self, hidden, armed=False):
        vehicle = SimVehicle(1, "copter", False, HARBOUR, armed=armed)
        vehicle.hidden = {hidden}
        wires = Network([vehicle], options=Options(stored={"survey": way(5)}))
        wires.loses = lambda message: message.get_type() in vehicle.hidden
        wires.run(3)
        return vehicle, wires

    def test_the_position(self):
        plan = flight(["takeOff", 20], ["move", 50, 0])
        vehicle, wires = self.one("GLOBAL_POSITION_INT")
        wires.start("r", "mav-1", plan)
        wires.run(4)
        self.assertEqual(vehicle.items, [])
        vehicle.hidden = set()
        self.ends(wires, "r", "done")
        self.assertLess(geo.distance(vehicle.place, geo.displace(HARBOUR, 50, 0)), 1)
        vehicle, wires = self.one("GLOBAL_POSITION_INT")
        wires.start("r", "mav-1", plan)
        self.ends(wires, "r", "failed", "its position was not heard for 10 seconds")
        self.assertEqual(vehicle.items, [])

    def test_a_position_that_is_old(self):
        """After a link that was away, a mission relative to the vehicle is made from its current position."""
        vehicle, wires = one(armed=True)
        wires.loses = lambda message: message.get_type() == "GLOBAL_POSITION_INT"
        vehicle.place = geo.displace(HARBOUR, 500, 0)
        wires.run(5)
        wires.start("r", "mav-1", flight(["altitude", 20], ["move", 50, 0]))
        wires.run(4)
        self.assertEqual(vehicle.items, [])
        wires.loses = lambda message: False
        self.ends(wires, "r", "done")
        self.assertLess(geo.distance(vehicle.place, geo.displace(HARBOUR, 550, 0)), 1)

    def test_the_home_position(self):
        """On the ground it is the vehicle's position; in flight it has to be known."""
        plan = flight(["altitude", 20], ["returnHomeAndLand"])
        vehicle, wires = self.one("HOME_POSITION")
        wires.start("r", "mav-1", flight(["takeOff", 20], ["move", 50, 0], ["returnHome"]))
        self.ends(wires, "r", "done")
        self.assertLess(geo.distance(vehicle.place, HARBOUR), 1)
        vehicle, wires = self.one("HOME_POSITION", armed=True)
        wires.start("r", "mav-1", plan)
        self.ends(wires, "r", "failed", "its home position was not heard for 10 seconds")
        self.assertEqual(vehicle.items, [])

    def test_a_plan_that_needs_neither(self):
        vehicle, wires = self.one("GLOBAL_POSITION_INT")
        wires.start("r", "mav-1", stored())
        self.assertTrue(wires.run(5, lambda: vehicle.began))

    def test_a_check(self):
        _, wires = self.one("GLOBAL_POSITION_INT")
        wires.order(kind="check", id=3, plan=flight(["takeOff", 20], ["move", 50, 0]), vehicle="mav-1")
        self.assertEqual(wires.reports[-1], {"kind": "checked", "id": 3, "problems": []})
