"""The robot against action servers without ROS: requests and their ends."""

import asyncio
import unittest
from types import SimpleNamespace

import dolphin
import dolphin_ros2.robot as module
from dolphin import posting
from dolphin_ros2 import configuration_file, goals, inputs

from eventually import eventually
from tests.support import TEXT, Drive, FakeLinks, converse, load, odometry


class Case(unittest.TestCase):
    def setUp(self):
        before = module.LOOK, module.SETTLE, module.PRESENT, module.ASK_AGAIN, module.CANCEL_WAIT, module.ASK_AT_MOST
        module.LOOK, module.SETTLE, module.PRESENT = 0.01, 0.05, 0.1
        module.ASK_AGAIN, module.CANCEL_WAIT, module.ASK_AT_MOST = (0.05, 0.05), 0.05, 0.01

        def restore():
            (module.LOOK, module.SETTLE, module.PRESENT, module.ASK_AGAIN, module.CANCEL_WAIT,
             module.ASK_AT_MOST) = before

        self.addCleanup(restore)
        self.links = FakeLinks()
        self.server = self.links.server

    def ready(self, console):
        return eventually(lambda: console.last("link") is True and console.last("unready") is None)

    def run_one(self, request, then, name="drive_3"):
        """Starts a plan, does something, and gives the reports on it."""

        async def script(console, robot):
            await self.ready(console)
            console.task("start", request, name)
            await then(console)

        return converse(self.links, script)

    def ended(self, console, request, *words):
        return eventually(lambda: console.words(request) == list(words))


class Plans(Case):
    def test_a_goal_to_its_end(self):
        async def then(console):
            await self.ended(console, "r-1", "taken")
            goal, message = self.server.begun[0]
            self.assertEqual(goal, goals.goal_id("carrier-1", "r-1"))
            self.assertEqual((message.bay, message.label, message.pose.x), (3, "bay 3", 1.0))
            feedback = Drive.Feedback(done=[1, 2, 3], left=SimpleNamespace(sec=5, nanosec=500000000))
            feedback.left.get_fields_and_field_types = lambda: {"sec": "int32", "nanosec": "uint32"}
            self.server.news[goal] = feedback
            await eventually(lambda: any(report["kind"] == "progress" for report in console.reports))
            self.server.end(goal, goals.SUCCEEDED, code=1)
            await self.ended(console, "r-1", "taken", "done")

        console = self.run_one("r-1", then)
        progress = next(report for report in console.reports if report["kind"] == "progress")
        self.assertEqual((progress["share"], progress["remaining"]), (0.75, 5.5))

    def test_results_and_reasons(self):
        ends = [
            (goals.SUCCEEDED, {"code": 7}, "the bay is occupied"),
            (goals.SUCCEEDED, {"code": 5}, "its action drive ends with code 5"),
            (goals.SUCCEEDED, {"code": 7, "text": "Bay 3."}, "the bay is occupied: Bay 3"),
            (goals.ABORTED, {"code": 9, "text": "no path"}, "no path"),
            (goals.ABORTED, {"code": 9}, "its action drive was aborted"),
            (goals.CANCELED, {}, "its action drive was cancelled by another client"),
        ]

        async def script(console, robot):
            await self.ready(console)
            for number, (status, fields, why) in enumerate(ends):
                request = f"r-{number}"
                console.task("start", request)
                await self.ended(console, request, "taken")
                self.server.end(self.server.last(), status, **fields)
                await self.ended(console, request, "taken", "failed")
                self.assertEqual(console.why(request), why)

        converse(self.links, script)
        self.assertEqual(len(self.server.begun), len(ends))

    def test_a_goal_that_is_rejected_is_a_refusal(self):
        self.server.accepts = False
        console = self.run_one("r-1", lambda console: self.ended(console, "r-1", "failed"))
        self.assertEqual(console.why("r-1"), "its action drive rejects the goal")

    def test_no_server_is_a_refusal(self):
        self.server.there = False
        console = self.run_one("r-1", lambda console: self.ended(console, "r-1", "failed"))
        self.assertEqual(console.why("r-1"), "has no action /carrier1/drive")

    def test_names_and_values_of_plans(self):
        async def script(console, robot):
            await self.ready(console)
            names = {"a": "dive", "b": "drive_x", "c": "drive_99999999999", "d": "drive_123456789"}
            for request, name in names.items():
                console.task("start", request, name)
                await self.ended(console, request, "failed")

        console = converse(self.links, script)
        self.assertEqual(console.why("a"), "undefined plan 'dive'; known are drive_${bay}, home, tare")
        self.assertEqual(console.why("b"), "plan 'drive_x': bay: 'x' is not a whole number")
        self.assertIn("is not from -2147483648 to 2147483647", console.why("c"))
        self.assertEqual(console.why("d"), "plan 'drive_123456789': label: 'bay 123456789' is longer than 12")
        self.assertEqual(self.server.begun, [])

    def test_a_silent_server_leaves_the_goal_unknown_until_it_answers(self):
        self.server.accepts = None

        async def then(console):
            await self.ended(console, "r-1", "unknown")
            console.task("stop", "r-1")
            await eventually(lambda: len(self.server.cancelled) > 3)
            self.assertEqual(console.words("r-1"), ["unknown"])  # the server may still accept the goal
            self.server.accepts = True
            await self.ended(console, "r-1", "unknown", "stopped")

        console = self.run_one("r-1", then)
        self.assertEqual(console.why("r-1"), "its action drive has not answered the goal for 0.6 seconds")
        self.assertEqual(self.server.states[self.server.last()], goals.CANCELED)

    def test_an_answer_that_is_lost_is_replaced_by_the_status(self):
        self.server.accepts = None

        async def then(console):
            await eventually(lambda: any(report["kind"] == "note" for report in console.reports))
            goal = goals.goal_id("carrier-1", "r-1")
            self.server.states[goal] = goals.EXECUTING
            await self.ended(console, "r-1", "taken")
            self.server.end(goal, goals.SUCCEEDED)
            await self.ended(console, "r-1", "taken", "done")

        self.run_one("r-1", then)

    def test_a_server_that_restarts_has_lost_the_goal(self):
        async def then(console):
            await self.ended(console, "r-1", "taken")
            self.server.restart()
            await self.ended(console, "r-1", "taken", "unknown")
            console.task("stop", "r-1")
            await self.ended(console, "r-1", "taken", "unknown", "stopped")

        console = self.run_one("r-1", then)
        self.assertEqual(console.why("r-1"), "its action drive no longer knows the goal")
        self.assertEqual(len(self.server.begun), 1)

    def test_services(self):
        async def script(console, robot):
            await self.ready(console)
            for request, fields, words in (("a", (True, ""), ["taken", "done"]),
                                           ("b", (False, "It is jammed."), ["taken", "failed"])):
                console.task("start", request, "tare")
                await self.ended(console, request, "taken")
                self.links.tare.replies.put_nowait(SimpleNamespace(success=fields[0], message=fields[1]))
                await self.ended(console, request, *words)
            console.task("start", "c", "tare")
            await self.ended(console, "c", "taken")
            console.task("stop", "c")
            await self.ended(console, "c", "taken", "unknown")
            self.links.tare.replies.put_nowait(SimpleNamespace(success=True, message=""))
            await self.ended(console, "c", "taken", "unknown", "stopped")
            console.task("start", "d", "tare")
            await self.ended(console, "d", "taken")
            self.links.tare.there = False
            await self.ended(console, "d", "taken", "unknown")

        console = converse(self.links, script)
        self.assertEqual(console.why("b"), "It is jammed")
        self.assertEqual(console.why("c"), "its service tare has not replied, and a call cannot be cancelled")
        self.assertEqual(console.why("d"), "its service tare went away before it replied")


class Stops(Case):
    def stop(self, *words):
        async def then(console):
            await self.ended(console, "r-1", "taken")
            console.task("stop", "r-1")
            await self.ended(console, "r-1", *words)

        return self.run_one("r-1", then)

    def test_a_stop_is_answered_when_the_goal_is_over(self):
        self.stop("taken", "stopped")
        self.assertEqual(self.server.states[self.server.last()], goals.CANCELED)

    def test_a_stop_before_anything_was_sent(self):
        """It is certain that no goal runs, though the server cannot be asked."""
        self.server.there = False

        async def then(console):
            await eventually(lambda: any(report["kind"] == "note" for report in console.reports))
            console.task("stop", "r-1")
            await eventually(lambda: console.words("r-1") in (["stopped"], ["failed"]))

        self.run_one("r-1", then)
        self.assertEqual(self.server.cancelled, [])

    def test_a_cancellation_that_is_rejected_is_not_a_stop(self):
        self.server.cancels = goals.ERROR_REJECTED
        console = self.stop("taken", "unknown")
        self.assertEqual(console.why("r-1"), "its action drive rejects the cancellation")

    def test_a_goal_that_is_being_cancelled_counts_as_running(self):
        """rcl answers a second cancellation with ERROR_GOAL_TERMINATED while the goal still comes to rest."""
        self.server.cancels = goals.ERROR_GOAL_TERMINATED

        async def then(console):
            await self.ended(console, "r-1", "taken")
            console.task("stop", "r-1")
            await eventually(lambda: len(self.server.cancelled) > 2)
            self.assertEqual(console.words("r-1"), ["taken"])
            self.server.end(self.server.last(), goals.CANCELED)
            await self.ended(console, "r-1", "taken", "stopped")

        self.run_one("r-1", then)

    def test_without_a_server_a_stop_waits(self):
        async def then(console):
            await self.ended(console, "r-1", "taken")
            self.server.there = False
            console.task("stop", "r-1")
            await asyncio.sleep(0.1)
            self.assertEqual(console.words("r-1"), ["taken"])
            self.server.there = True
            await self.ended(console, "r-1", "taken", "stopped")

        self.run_one("r-1", then)


class Deaths(Case):
    """An adapter dies, and another one is asked about its requests."""

    def first(self, name="drive_3"):
        self.run_one("r-1", lambda console: self.ended(console, "r-1", "taken"), name)

    def second(self, *words, notes=({"commanded": True},), name="drive_3", then=None):
        async def script(console, robot):
            await self.ready(console)
            console.task("resume", "r-1", name, notes=list(notes))
            await self.ended(console, "r-1", *words)
            if then is not None:
                await then(console)

        return converse(self.links, script, resumes=True)

    def test_a_goal_that_still_runs(self):
        self.first()

        async def then(console):
            self.server.end(self.server.last(), goals.SUCCEEDED)
            await self.ended(console, "r-1", "taken", "done")

        self.second("taken", then=then)
        self.assertEqual(len(self.server.begun), 1)

    def test_a_goal_that_has_ended(self):
        for status, words in ((goals.SUCCEEDED, "done"), (goals.ABORTED, "failed"), (goals.CANCELED, "failed")):
            with self.subTest(status=status):
                self.links = FakeLinks()
                self.server = self.links.server
                self.first()
                self.server.end(self.server.last(), status)
                self.second(words)

    def test_a_goal_that_nobody_knows_is_unknown_and_then_stopped(self):
        async def then(console):
            console.task("stop", "r-1")
            await self.ended(console, "r-1", "unknown", "stopped")

        console = self.second("unknown", then=then)
        self.assertIn("does not know the goal", console.why("r-1"))
        self.assertEqual(self.server.begun, [])
        self.assertGreaterEqual(len(self.server.cancelled), 2)

    def test_without_a_note_it_was_never_sent(self):
        self.second("absent", notes=())

    def test_the_reply_of_a_service_is_lost(self):
        self.first("tare")
        self.second("unknown", name="tare")

    def test_a_server_that_is_gone(self):
        self.first()
        self.server.there = False
        console = self.second("unknown")
        self.assertEqual(console.why("r-1"), "its action drive does not answer")


class FakeRun:
    """A run that listens from the third attempt on, and does not know the input `stranger`."""

    def __init__(self):
        self.posts, self.attempts = [], 0

    async def status(self):
        self.attempts += 1
        if self.attempts < 3:
            raise dolphin.RunGone("the run does not listen")

    async def post(self, key, value):
        if key == "stranger":
            raise dolphin.RequestRefused("not-declared", "the program declares no such input")
        self.posts.append((key, value))


class FromTopics(unittest.TestCase):
    def test_messages_are_posted_in_order_once_the_run_listens(self):
        hears, run = {}, FakeRun()
        links = SimpleNamespace(every=lambda name, class_, hear: hears.update({name: hear}))
        text = TEXT.replace("inputs:", "inputs:\n  stranger: {topic: /other, type: fake_msgs/msg/Text, field: data}")
        before, posting.AGAIN = posting.AGAIN, 0.01
        self.addCleanup(setattr, posting, "AGAIN", before)

        async def go():
            bridge = inputs.Inputs(configuration_file.of_text(text, "r.yaml").inputs, run, links, load)
            work = asyncio.ensure_future(bridge.run())
            for value in ("reef", "wreck", b"no text", ["a", 1, True]):
                hears["/detections"](SimpleNamespace(data=value))
                hears["/other"](SimpleNamespace(data=value))
            await eventually(lambda: len(run.posts) == 3)
            work.cancel()

        asyncio.run(go())
        self.assertEqual(run.posts, [("sighting", "reef"), ("sighting", "wreck"), ("sighting", ["a", 1, True])])


class Telemetry(Case):
    def test_what_topics_report(self):
        async def script(console, robot):
            await self.ready(console)
            console.order("telemetry", on=True)
            self.links.speak(
                odom=odometry(0.0, 111.0), battery_state=SimpleNamespace(percentage=0.5),
                load=SimpleNamespace(data=3.5))
            await eventually(lambda: any(report.get("readings") == {"Load": 3.5} for report in console.reports))
            self.assertEqual((console.last("speed"), console.last("battery")), (5.0, 0.5))
            self.assertAlmostEqual(console.last("latitude"), 41.186, 5)
            self.links.speak(state=SimpleNamespace(data="charging"))
            await eventually(lambda: console.last("unready") == "is charging")
            self.links.speak(battery_state=SimpleNamespace(percentage=83.0))  # a fault of the robot: not believed
            await eventually(lambda: console.last("unready") is None)
            self.assertEqual(robot.known["battery"], 0.5)

        converse(self.links, script)

    def test_silence_takes_the_link(self):
        async def script(console, robot):
            await self.ready(console)
            robot._clock = lambda: module.time.monotonic() + 3600
            await eventually(lambda: console.last("link") is False)
            self.links.speak()
            await eventually(lambda: console.last("link") is True)

        converse(self.links, script)

    def test_a_goal_of_another_client_wins(self):
        async def script(console, robot):
            await self.ready(console)
            foreign = goals.goal_id("somebody", "else")
            self.server.states[foreign] = goals.EXECUTING
            await eventually(lambda: console.last("unready") == "runs a goal of another client on its action drive")
            console.task("start", "r-1")
            await self.ended(console, "r-1", "failed")
            self.server.states[foreign] = goals.SUCCEEDED
            await eventually(lambda: console.last("unready") is None)
            console.task("start", "r-2")
            await self.ended(console, "r-2", "taken")

        console = converse(self.links, script)
        self.assertEqual(console.why("r-1"), "runs a goal of another client on its action drive")
        self.assertEqual(len(self.server.begun), 1)


if __name__ == "__main__":
    unittest.main()
