"""Adapters and links that die at 100 moments of a mission: nothing is flown twice, nothing is lost, or it is said."""

from dolphin_mavlink.wire import mavlink
from tests.support import Case, one, stored, way

POINTS = 100
LENGTH = 16.0  # seconds that the mission takes, from the order to its end, and a little more


def moments():
    """Dense at the beginning, where most is decided."""
    return [LENGTH * (k / POINTS) ** 2 for k in range(POINTS)]


class Console:
    """What Dolphin does beside an adapter: keeps what was ordered and noted, and resumes."""

    def __init__(self, wires):
        self.wires = wires

    def restart(self, request, plan):
        """The adapter has died a second ago, and is started anew."""
        ended = self.wires.end_of(request)
        notes = [r["note"] for r in reversed(self.wires.said("note", request))]
        self.wires.start_station(resumes=True)
        if ended is None:
            self.wires.order(kind="resume", request=request, vehicle="mav-1", plan=plan, timeout=60, notes=notes)

    def follow(self, request, plan):
        """The end of `request`; what is absent is ordered again, what is unknown is stopped."""
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
        """A mission that was not begun has failed; of one that may have, nothing is claimed."""
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
        wires.stop("r")
        end = wires.run_to_end("r")
        self.assertEqual(end["kind"], "failed")
        self.assertIn("the mission on board is another one", end["why"])
        self.assertEqual(vehicle.mode, "AUTO")
