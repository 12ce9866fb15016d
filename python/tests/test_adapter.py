"""The adapter, order by order, without a process: each rule of docs/platform.md that a vehicle need not care about."""

import asyncio
import contextlib
import io
import random
import unittest

import dolphin
from dolphin import adapter as adapters
from dolphin.adapter import Adapter
from eventually import eventually
from seeds import seeds
from tests.support import ENDS, Console, converse, settled


class Board(dolphin.Vehicle):
    """A vehicle whose every step waits for the test: futures by name."""

    type = "USV"

    def __init__(self, name="v", **members):
        super().__init__(name, latitude=41.0, longitude=-8.0, **members)
        self.calls = []
        self.gates = {}

    def gate(self, step):
        if step not in self.gates or self.gates[step].done():
            self.gates[step] = asyncio.get_running_loop().create_future()
        return self.gates[step]

    async def step(self, step, plan):
        self.calls.append((step, plan.request))
        await self.gate(step)

    async def start(self, plan):
        await self.step("start", plan)

    async def finish(self, plan):
        await self.step("finish", plan)

    async def stop(self, plan):
        await self.step("stop", plan)

    async def resume(self, plan):
        self.notes = plan.notes
        await self.step("resume", plan)

    async def go(self, step, error=None):
        """Lets a step end, once it has begun."""
        await eventually(lambda: step in self.gates and not self.gates[step].done())
        if error is None:
            self.gates[step].set_result(None)
        else:
            self.gates[step].set_exception(error)
        await settled()

    def commanded(self, request):
        return [step for step, of in self.calls if of == request]


class Orders(unittest.TestCase):
    def setUp(self):
        self.board = Board()
        self.adapter = Adapter("test", [self.board])

    def run_script(self, script, **options):
        with contextlib.redirect_stderr(io.StringIO()) as errors:
            closed = converse(self.adapter, script, **options)
        self.errors = errors.getvalue()
        return closed

    def test_greeting_comes_first_and_names_the_languages(self):
        self.board.languages = ("mission",)

        async def script(console):
            await eventually(lambda: len(console.reports) >= 2)
            hello, vehicle = console.reports[:2]
            self.assertEqual((hello["kind"], hello["protocol"], hello["plans"]), ("hello", 1, ["name", "mission"]))
            self.assertEqual(vehicle["kind"], "vehicle")
            self.assertEqual((vehicle["type"], vehicle["link"], vehicle["latitude"]), ("USV", True, 41.0))

        self.assertFalse(self.run_script(script))

    def test_another_version_is_an_error(self):
        async def script(console):
            console.hello(protocol=2)
            await eventually(lambda: console.reports)
            self.assertEqual([r["kind"] for r in console.reports], ["error"])

        self.run_script(script, hello=False)

    def test_links_that_do_not_open_are_an_error_in_words(self):
        class Broken(Adapter):
            async def open(self):
                raise OSError("serial port /dev/ttyUSB0: no such file")

        self.adapter = Broken("test", [self.board])

        async def script(console):
            await eventually(lambda: console.reports)
            self.assertEqual(console.reports, [
                {"kind": "error", "why": "OSError: serial port /dev/ttyUSB0: no such file"}])

        self.run_script(script)

    def test_a_plan_from_start_to_end(self):
        async def script(console):
            console.start("r")
            await self.board.go("start")
            self.assertEqual(console.words("r"), ["taken"])
            await self.board.go("finish")
            self.assertEqual(console.words("r"), ["taken", "done"])

        self.run_script(script)

    def test_nothing_is_commanded_before_the_note_is_kept(self):
        async def script(console):
            console.keeps = False
            console.start("r")
            await eventually(lambda: console.notes("r"))
            await settled()
            self.assertEqual(self.board.calls, [])
            console.stop("r")
            await eventually(lambda: console.words("r"))
            self.assertEqual(console.words("r"), ["stopped"])
            self.assertEqual(self.board.calls, [])

        self.run_script(script)

    def test_a_request_without_a_note_is_absent_and_then_started(self):
        async def script(console):
            console.resume("r", [])
            await eventually(lambda: console.words("r"))
            self.assertEqual(console.words("r"), ["absent"])
            console.start("r")
            await self.board.go("start")
            await self.board.go("finish")
            self.assertEqual(console.words("r"), ["absent", "taken", "done"])

        self.run_script(script)

    def test_a_stop_of_an_absent_request_is_stopped(self):
        async def script(console):
            console.resume("r", [])
            await eventually(lambda: console.words("r") == ["absent"])
            console.stop("r")
            await eventually(lambda: console.words("r") == ["absent", "stopped"])
            console.resume("s", [])
            console.stop("s")
            await eventually(lambda: console.words("s")[-1:] == ["stopped"])
            self.assertEqual(self.board.calls, [])

        self.run_script(script)

    def test_resume_waits_for_its_vehicle_and_gives_it_its_own_notes(self):
        async def script(console):
            console.resume("r", [{"note": {"items": 12}}, {"commanded": True}], vehicle="late")
            await settled()
            self.assertEqual(console.words("r"), [])
            late = Board("late")
            self.adapter.add(late)
            await late.go("resume")
            self.assertEqual(late.notes, [{"items": 12}])
            self.assertEqual(console.words("r"), ["taken"])
            await late.go("finish", dolphin.Failed("ran aground"))
            self.assertEqual((console.words("r"), console.why("r")), (["taken", "failed"], "ran aground"))

        self.run_script(script)

    def test_a_request_whose_notes_may_be_lost_is_not_absent_before_the_vehicle_is_asked(self):
        async def script(console):
            for n, doubt in enumerate(("order", "notes")):
                console.order("resume", request=f"r{n}", vehicle="v", plan={"name": "p"}, notes=[], doubt=doubt)
                await self.board.go("resume", dolphin.Unknown("a plan of this name has run"))
                self.assertEqual(console.words(f"r{n}"), ["unknown"])
            console.order("resume", request="s", vehicle="v", plan={"name": "p"}, notes=[], doubt=None)
            await eventually(lambda: console.words("s") == ["absent"])

        self.run_script(script)

    def test_each_outcome_of_resume(self):
        outcomes = [(dolphin.Done(), "done"), (dolphin.Stopped(), "stopped"), (dolphin.Absent(), "absent"),
                    (dolphin.Failed("x"), "failed"), (dolphin.Unknown("x"), "unknown"), (OSError("x"), "unknown")]

        async def script(console):
            for n, (error, word) in enumerate(outcomes):
                console.resume(f"r{n}", [{"commanded": True}])
                await self.board.go("resume", error)
                self.assertEqual(console.words(f"r{n}"), [word])
                console.resume(f"r{n}", [{"commanded": True}])
                await eventually(lambda: len(console.words(f"r{n}")) == 2)
                self.assertEqual(console.words(f"r{n}"), [word, word])

        self.run_script(script)

    def test_notes_of_a_vehicle_come_back(self):
        async def with_note(plan):
            await plan.note({"items": 12})

        self.board.start = with_note

        async def script(console):
            console.start("r")
            await eventually(lambda: console.words("r") == ["taken"])
            self.assertEqual(console.notes("r"), [{"note": {"items": 12}}, {"commanded": True}])

        self.run_script(script)

    def test_a_start_that_comes_twice_is_one(self):
        async def script(console):
            console.start("r")
            console.start("r")
            await self.board.go("start")
            console.start("r")
            await eventually(lambda: console.words("r") == ["taken", "taken"])
            await self.board.go("finish")
            console.start("r")
            await eventually(lambda: console.words("r") == ["taken", "taken", "done", "done"])
            self.assertEqual(self.board.commanded("r"), ["start", "finish"])

        self.run_script(script)

    def test_a_stop_cancels_what_runs_and_is_answered_once_the_vehicle_rests(self):
        async def script(console):
            console.start("r")
            await self.board.go("start")
            console.stop("r")
            console.stop("r")
            await eventually(lambda: self.board.commanded("r")[-1] == "stop")
            self.assertEqual(console.words("r"), ["taken"])
            await self.board.go("stop")
            self.assertEqual(console.words("r"), ["taken", "stopped"])
            self.assertEqual(self.board.commanded("r"), ["start", "finish", "stop"])

        self.run_script(script)

    def test_a_stop_that_fails_is_tried_again_and_unknown_meanwhile(self):
        self.addCleanup(setattr, adapters, "STOP_AGAIN", adapters.STOP_AGAIN)
        adapters.STOP_AGAIN = 0.01

        async def script(console):
            console.start("r")
            await self.board.go("start")
            console.stop("r")
            for _ in range(3):
                await self.board.go("stop", OSError("no answer"))
            await self.board.go("stop")
            self.assertEqual(console.words("r"), ["taken", "unknown", "stopped"])

        self.run_script(script)

    def test_a_hand_on_the_vehicle_answers_the_stop(self):
        async def script(console):
            console.start("r")
            await self.board.go("start")
            console.stop("r")
            await self.board.go("stop", dolphin.Failed("taken over by its pilot"))
            self.assertEqual((console.words("r")[-1], console.why("r")), ("failed", "taken over by its pilot"))

        self.run_script(script)

    def test_a_stop_of_a_stranger(self):
        async def script(console):
            console.stop("r")
            console.start("r")
            await eventually(lambda: len(console.words("r")) == 2)
            self.assertEqual(console.words("r"), ["stopped", "stopped"])
            self.assertEqual(self.board.calls, [])

        self.run_script(script)

    def test_a_fault_of_the_vehicles_code_leaves_the_plan_unknown(self):
        async def script(console):
            console.start("r")
            await self.board.go("start")
            await self.board.go("finish", KeyError("speed"))
            self.assertEqual((console.words("r"), console.why("r")), (["taken", "unknown"], "KeyError: 'speed'"))
            console.stop("r")
            await self.board.go("stop")
            self.assertEqual(console.words("r"), ["taken", "unknown", "stopped"])

        self.run_script(script)
        self.assertIn("Traceback", self.errors)

    def test_code_that_cancels_itself_leaves_the_plan_unknown(self):
        async def script(console):
            console.start("r")
            await self.board.go("start")
            await eventually(lambda: "finish" in self.board.gates)
            self.board.gates["finish"].cancel()
            await eventually(lambda: console.words("r") == ["taken", "unknown"])

        self.run_script(script)

    def test_refusals_command_nothing(self):
        async def problems(plan):
            return {"bad": ["undefined plan 'bad'"]}.get(plan.name, [])

        async def broken(plan):
            raise KeyError("depth")

        async def script(console):
            self.board.problems = problems
            console.start("a", name="bad")
            console.start("b", language="imcPlan", body={})
            console.start("c", vehicle="w")
            self.board.report(unready="is flown by its pilot")
            console.start("d")
            await eventually(lambda: all(console.words(r) for r in "abcd"))
            self.board.problems = broken
            console.start("e")
            await eventually(lambda: console.words("e"))
            for request, why in [("a", "undefined plan 'bad'"),
                                 ("b", "plans in the language imcPlan are not for this vehicle"),
                                 ("c", "there is no vehicle w"), ("d", "is flown by its pilot"),
                                 ("e", "the plan cannot be checked: KeyError: 'depth'")]:
                self.assertEqual((console.words(request), console.why(request)), (["failed"], why))
            self.assertEqual(self.board.calls, [])

        self.run_script(script)

    def test_a_second_plan_is_refused_while_one_runs(self):
        async def script(console):
            console.start("r")
            await self.board.go("start")
            console.start("s")
            await eventually(lambda: console.words("s"))
            self.assertEqual((console.words("s"), console.why("s")), (["failed"], "runs another plan"))

        self.run_script(script)

    def test_a_plan_replaces_one_whose_stop_has_no_answer(self):
        async def script(console):
            console.start("r")
            await self.board.go("start")
            console.stop("r")
            await eventually(lambda: "stop" in self.board.gates)
            console.start("s")
            await eventually(lambda: self.board.commanded("s") == ["start"])
            self.assertEqual(console.words("r"), ["taken"])
            await self.board.go("start")
            self.assertEqual((console.words("r"), console.words("s")), (["taken", "failed"], ["taken"]))
            await self.board.go("finish")
            self.assertEqual(console.words("s"), ["taken", "done"])

        self.run_script(script)

    def test_a_plan_that_fails_to_replace_another_leaves_it_being_stopped(self):
        async def script(console):
            console.start("r")
            await self.board.go("start")
            console.stop("r")
            await eventually(lambda: "stop" in self.board.gates)
            console.start("s")
            await eventually(lambda: self.board.commanded("s") == ["start"])
            await self.board.go("start", dolphin.Failed("the battery is at 2 %"))
            self.assertEqual((console.words("r"), console.words("s")), (["taken"], ["failed"]))
            await self.board.go("stop")
            self.assertEqual(console.words("r"), ["taken", "stopped"])

        self.run_script(script)

    def test_a_stop_of_both_ends_both(self):
        async def script(console):
            console.start("r")
            await self.board.go("start")
            console.stop("r")
            await eventually(lambda: "stop" in self.board.gates)
            console.start("s")
            await eventually(lambda: self.board.commanded("s") == ["start"])
            console.stop("s")
            await eventually(lambda: "stop" in self.board.commanded("s"))
            await self.board.go("stop")
            self.assertEqual((console.words("r"), console.words("s")), (["taken", "stopped"], ["stopped"]))

        self.run_script(script)

    def test_close_stops_all_and_reports_quiet_last(self):
        async def script(console):
            console.start("r")
            await self.board.go("start")
            console.order("close")
            await self.board.go("stop")
            await eventually(lambda: [r["kind"] for r in console.reports[-1:]] == ["quiet"])
            self.assertEqual(console.words("r"), ["taken", "stopped"])

        self.assertTrue(self.run_script(script))

    def test_the_end_of_the_input_stops_nothing(self):
        async def script(console):
            console.start("r")
            await self.board.go("start")

        self.assertFalse(self.run_script(script))
        self.assertNotIn("stop", self.board.commanded("r"))

    def test_orders_that_lack_members_are_no_harm(self):
        async def script(console):
            for kind in ("start", "stop", "resume", "check", "ping", "kept", "telemetry", "hold", "dance"):
                console.order(kind)
            console.order("ping", id=7)
            await eventually(lambda: {"kind": "pong", "id": 7} in console.reports)

        self.run_script(script)

    def test_checks_move_nothing(self):
        async def script(console):
            console.order("check", id=1, vehicle="v", plan={"name": "p"})
            console.order("check", id=2, plan={"name": "p", "language": "imcPlan", "body": {}})
            console.order("check", id=3, vehicle="w", plan={"name": "p"})
            await eventually(lambda: len([r for r in console.reports if r["kind"] == "checked"]) == 3)
            found = {r["id"]: r["problems"] for r in console.reports if r["kind"] == "checked"}
            self.assertEqual(found, {1: [], 2: ["plans in the language imcPlan are not for this vehicle"],
                                     3: ["there is no vehicle w"]})
            self.assertEqual(self.board.calls, [])

        self.run_script(script)

    def test_vehicles_are_held_and_released(self):
        async def script(console):
            console.order("hold", vehicles=["v", "w"])
            await eventually(lambda: self.board.held)
            console.order("release", vehicles=["v"])
            await eventually(lambda: not self.board.held)

        self.run_script(script)


class Telemetry(unittest.TestCase):
    def setUp(self):
        for name, seconds in (("TELEMETRY_ON", 0.02), ("TELEMETRY_OFF", 3600.0)):
            self.addCleanup(setattr, adapters, name, getattr(adapters, name))
            setattr(adapters, name, seconds)
        self.board = Board()
        self.adapter = Adapter("test", [self.board])

    def sightings(self, console):
        return [r for r in console.reports if r["kind"] == "vehicle"][1:]

    def check(self, script):
        async def after_the_first(console):
            await eventually(lambda: len(console.reports) >= 2)
            await script(console)

        with contextlib.redirect_stderr(io.StringIO()):
            converse(self.adapter, after_the_first)

    def test_positions_wait_for_the_pace_and_links_do_not(self):
        async def script(console):
            self.board.report(latitude=42.0, battery=0.5)
            await settled()
            self.assertEqual(self.sightings(console), [])
            self.board.report(link=False)
            self.assertEqual(self.sightings(console), [
                {"kind": "vehicle", "vehicle": "v", "latitude": 42.0, "longitude": -8.0, "battery": 0.5,
                 "link": False}])
            console.order("telemetry", on=True)
            self.board.report(battery=0.4)
            await eventually(lambda: len(self.sightings(console)) == 2)
            self.assertEqual(self.sightings(console)[1], {"kind": "vehicle", "vehicle": "v", "battery": 0.4})

        self.check(script)

    def test_positions_go_before_the_end_of_a_task(self):
        async def script(console):
            console.start("r")
            await self.board.go("start")
            self.board.report(latitude=43.0)
            await self.board.go("finish")
            kinds = [r["kind"] for r in console.reports]
            self.assertLess(len(kinds) - kinds[::-1].index("vehicle") - 1, kinds.index("done"))
            self.assertEqual(self.sightings(console)[-1]["latitude"], 43.0)

        self.check(script)

    def test_a_refused_line_brings_all_again(self):
        async def script(console):
            self.board.report(readings={"Temperature": 14.2, "Salinity": 35})
            console.order("refused", why="is not valid")
            await eventually(lambda: self.sightings(console))
            again = self.sightings(console)[0]
            self.assertEqual((again["type"], again["link"], again["longitude"]), ("USV", True, -8.0))
            self.assertEqual(again["readings"], {"Temperature": 14.2, "Salinity": 35})

        self.check(script)

    def test_what_is_not_new_is_not_sent(self):
        async def script(console):
            self.board.report(battery=0.5, readings={"Temperature": 14.2}, link=True)
            self.board.report(link=False)
            self.board.report(battery=0.5, readings={"Temperature": 14.2}, link=False)
            self.board.report(link=True)
            self.assertEqual(self.sightings(console)[1], {"kind": "vehicle", "vehicle": "v", "link": True})

        self.check(script)

    def test_numbers_that_json_lacks(self):
        nan = float("nan")

        async def script(console):
            self.board.report(battery=nan, readings={"Temperature": nan}, link=False)
            sent = self.sightings(console)[-1]
            self.assertEqual((sent["battery"], sent["readings"]), (None, {"Temperature": None}))
            self.board.report(latitude=nan, longitude=-9.0, link=True)
            self.assertEqual((self.board.known["latitude"], self.board.known["longitude"]), (41.0, -8.0))
            for wrong in ({"battery": 83}, {"latitude": 91}, {"longitude": -181.0}):
                with self.assertRaises(ValueError):
                    self.board.report(**wrong)
            for wrong in ({"speed": "fast"}, {"readings": {"a": object()}}, {"payload": [object()]}):
                with self.assertRaises(TypeError):
                    self.board.report(**wrong)
            with self.assertRaises(TypeError):
                self.board.report(batery=0.5)

        self.check(script)

    def test_numbers_of_other_libraries(self):
        from fractions import Fraction

        async def script(console):
            self.board.report(battery=Fraction(1, 2), readings={"Temperature": Fraction(57, 4)}, link=False)
            sent = self.sightings(console)[-1]
            self.assertEqual((sent["battery"], sent["readings"]), (0.5, {"Temperature": 14.25}))

        self.check(script)

    def test_estimates_are_within_bounds(self):
        async def script(console):
            console.start("r")
            await self.board.go("start")
            plan = dolphin.Plan("p", request="r", _adapter=self.adapter)
            for share, remaining in [(0.5, 20), (1.2, -3), (float("nan"), float("inf"))]:
                plan.progress(share, remaining)
            self.assertEqual([r for r in console.reports if r["kind"] == "progress"], [
                {"kind": "progress", "request": "r", "share": 0.5, "remaining": 20},
                {"kind": "progress", "request": "r", "share": 1.0, "remaining": 0.0},
                {"kind": "progress", "request": "r"}])

        self.check(script)

    def test_reports_from_another_thread(self):
        async def script(console):
            await asyncio.get_running_loop().run_in_executor(None, lambda: self.board.report(link=False))
            await eventually(lambda: self.sightings(console))

        self.check(script)

    def test_vehicles_that_come_and_go(self):
        async def script(console):
            late = Board("late")
            self.adapter.add(late)
            self.assertEqual(self.sightings(console)[-1]["type"], "USV")
            self.adapter.remove(late)
            self.assertEqual(console.reports[-1], {"kind": "gone", "vehicle": "late"})
            late.report(link=False)
            self.adapter.add(late)
            self.assertEqual(self.sightings(console)[-1]["link"], False)

        self.check(script)

    def test_a_listener_that_fails_takes_the_link(self):
        class Deaf(Board):
            async def run(self):
                raise OSError("the port is closed")

        self.adapter = Adapter("test", [Deaf()])

        async def script(console):
            await eventually(lambda: any(r.get("link") is False for r in console.reports))
            logs = [r for r in console.reports if r["kind"] == "log"]
            self.assertEqual(logs[0]["text"], "listening to v failed: OSError: the port is closed")

        self.check(script)


class Drawn(unittest.TestCase):
    """Of random orders, outcomes and faults: each request has at most one end, which is repeated; no plan is started
    twice; and at the end of the run each request has its end."""

    def test_random_conversations(self):
        self.addCleanup(setattr, adapters, "STOP_AGAIN", adapters.STOP_AGAIN)
        adapters.STOP_AGAIN = 0.01
        for seed in seeds(150):
            with self.subTest(seed=seed), contextlib.redirect_stderr(io.StringIO()):
                self.one(random.Random(seed))

    def one(self, random):
        board = Board()
        adapter = Adapter("test", [board])
        requests = [f"r{n}" for n in range(random.randint(1, 4))]
        errors = [None, None, None, dolphin.Failed("x"), dolphin.Unknown("x"), OSError("x")]
        noted = [[], [{"commanded": True}]]

        async def script(console):
            for _ in range(random.randint(5, 40)):
                request = random.choice(requests)
                waiting = [gate for gate in board.gates.values() if not gate.done()]
                deed = random.choice(["start", "start", "stop", "resume", "step", "step", "step", "ping", "settle"])
                if deed == "start":
                    console.start(request)
                elif deed == "stop":
                    console.stop(request)
                elif deed == "resume":
                    console.resume(request, random.choice(noted))
                elif deed == "ping":
                    console.order("ping", id=1)
                elif deed == "step" and waiting:
                    error = random.choice(errors)
                    gate = random.choice(waiting)
                    gate.set_result(None) if error is None else gate.set_exception(error)
                if random.random() < 0.6:
                    await settled()
            console.order("close")

            def quiet():
                for gate in board.gates.values():
                    if not gate.done():
                        gate.set_result(None)
                return [r["kind"] for r in console.reports[-1:]] == ["quiet"]

            await eventually(quiet)
            for request in requests:
                self.judge(console, board, request)

        self.assertTrue(converse(adapter, script))

    def judge(self, console: Console, board: Board, request: str):
        words = console.words(request)
        starts = board.commanded(request).count("start")
        ends = [word for word in words if word in ENDS and word != "absent"]
        self.assertLessEqual(len(set(ends)), 1, words)
        self.assertLessEqual(starts, 1, board.calls)
        if ends:
            self.assertEqual(set(words[words.index(ends[0]):]), {ends[0]}, words)
        elif request in {r.get("request") for r in console.reports} and words:
            self.assertEqual(words[-1], "absent", words)
        if "taken" in words and "unknown" in words:
            self.assertNotIn("taken", words[words.index("unknown"):], words)


if __name__ == "__main__":
    unittest.main()
