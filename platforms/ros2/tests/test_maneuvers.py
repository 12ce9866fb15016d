"""Plans that programs describe: the goals of their maneuvers, one after another; readiness by a lifecycle; outputs."""

import asyncio
import json
import math
import unittest
from types import SimpleNamespace

import dolphin
from dolphin.document import Faulty
from dolphin_ros2 import configuration_file, goals, interfaces, maneuvers, outputs
from dolphin_ros2.geo import Origin

from eventually import eventually
from tests.support import TEXT, converse, load
from tests.test_robot import Case

MANEUVERS = """\
    maneuvers:
      goTo: {action: go, type: fake_msgs/action/Drive, goal: {label: '${x} ${y}', pose: {x: '${x}'}}}
      path:
        action: follow
        type: fake_msgs/action/Follow
        goal: {points: '${points}', speed: '${speed}'}
        point: {x: '${x}', y: '${y}', z: '${qw}'}
      wait: {action: wait, type: fake_msgs/action/Wait, goal: {time: {sec: '${seconds}'}}}
"""
WHOLE = TEXT.replace("robots:\n", MANEUVERS + "robots:\n")
ORIGIN = Origin(41.185, -8.706)


def goto(x, y, **members):
    """A maneuver at a point of the map."""
    latitude, longitude = ORIGIN.locate(x, y)
    return {"id": "1.Goto", "maneuver": "goTo", "latitude": latitude, "longitude": longitude, "height": 0, "z": 0,
            "zUnit": "depth", "speed": 2, "speedUnit": "m/s", "payload": [], **members}


def plan(*parts, vehicles=()):
    return {"name": "tour", "language": "imcPlan",
            "body": {"description": "", "vehicles": list(vehicles), "maneuvers": list(parts)}}


PATH = {"id": "2.FollowPath", "maneuver": "followPath", "points": [[0, 10, 0], [10, 10, 0]]}
LOITER = {"id": "3.Loiter", "maneuver": "loiter", "radius": 5, "duration": 30, "direction": "clockwise"}


def compiled(*parts, text=WHOLE, **more):
    found = configuration_file.of_text(text, "r.yaml")
    return maneuvers.compile_plan(plan(*parts, **more)["body"], "carrier-1", found.kinds[0].maneuvers, found.origin)


def faults(text):
    try:
        interfaces.check(configuration_file.of_text(text, "r.yaml"), load)
    except Faulty as faulty:
        return [line.split(": ", 1)[1] for line in faulty.lines]
    return []


class Compiling(unittest.TestCase):
    def test_goals_of_maneuvers(self):
        steps, problems = compiled(goto(3, 4), goto(3, 4, **PATH), goto(3, 14, **LOITER))
        self.assertEqual(problems, [])
        self.assertEqual([step.rule.name for step in steps], ["goTo", "path", "goTo", "wait"])
        self.assertEqual((steps[0].parameters["x"], steps[0].parameters["y"]), (3.0, 4.0))
        values = steps[1].rule.values(steps[1].parameters)
        self.assertEqual(values["speed"], 2.0)
        first, second = values["points"]
        for point, (x, y, yaw) in ((first, (13, 4, 0)), (second, (13, 14, math.pi / 2))):
            self.assertAlmostEqual(point["x"], x, 2)
            self.assertAlmostEqual(point["y"], y, 2)
            self.assertAlmostEqual(point["z"], math.cos(yaw / 2), 3)
        self.assertEqual(steps[3].rule.values(steps[3].parameters), {"time": {"sec": 30}})

    def test_one_action_for_all(self):
        """Without `goTo` a place is a path of one point; without `path` a path is several places."""
        text = WHOLE.replace(MANEUVERS.splitlines(True)[1], "")
        self.assertEqual([step.rule.name for step in compiled(goto(1, 0), text=text)[0]], ["path"])
        text = WHOLE.replace("".join(MANEUVERS.splitlines(True)[2:7]), "")
        self.assertEqual([step.rule.name for step in compiled(goto(1, 0, **PATH), text=text)[0]], ["goTo"] * 2)

    def test_what_does_not_fit(self):
        without = WHOLE.replace(MANEUVERS.splitlines(True)[-1], "")
        for part, text, why in (
            (goto(0, 0, maneuver="yoyo"), WHOLE, "its robots have no yoyo"),
            (goto(0, 0, payload=[{"name": "camera", "parameters": {}}]), WHOLE,
             "its robots have no way to switch on 'camera'"),
            (goto(0, 0, speedUnit="rpm"), WHOLE, "its robots take a speed in metres a second"),
            (goto(0, 0, z=3), WHOLE, "its robots take no depth of 3 m: give z 0"),
            (goto(0, 0, **LOITER), without, "its robots have no loiter, as the configuration has no maneuver 'wait'"),
            (goto(0, 0, **{**LOITER, "duration": 0}), WHOLE, "a loiter needs a duration"),
        ):
            with self.subTest(why=why):
                self.assertEqual(compiled(part, text=text)[1], [f"maneuver {part['id']}: {why}"])
        self.assertEqual(compiled(goto(0, 0), vehicles=["x8"])[1], ["only x8 may run it"])

    def test_faults_of_the_configuration(self):
        self.assertEqual(faults(WHOLE), [])
        for old, new, why in (
            ("label: '${x} ${y}'", "label: '${xx}'",
             "the maneuver 'goTo' has no parameter 'xx'; did you mean 'x'?"),
            ("points: '${points}', speed", "speed", "the goal of 'path' has a field with the value ${points}"),
            ("        point: {x: '${x}', y: '${y}', z: '${qw}'}\n", "", "the maneuver 'path' needs the member 'point'"),
            ("y: '${y}', z: '${qw}'", "yy: '${y}'", "points: Point has no field 'yy'; did you mean 'y'?"),
            ("sec: '${seconds}'", "sec: '${yaw}.5'", "time: sec: '0.5.5' is not a whole number"),
            ("      goTo:", "      fly:", "unknown member 'fly' of 'maneuvers'; known are goTo, path, wait"),
        ):
            with self.subTest(new=new):
                self.assertIn(old, WHOLE)
                self.assertIn(why, faults(WHOLE.replace(old, new, 1)))
        without = WHOLE.replace("origin: {latitude: 41.185, longitude: -8.706}\n", "")
        self.assertIn("the maneuver 'goTo' is in metres of a map: the configuration needs 'origin'", faults(without))


TOUR = plan(goto(3, 4), goto(3, 4, **PATH), goto(3, 14, **LOITER))
"""Four goals."""


class Flying(Case):
    def converse(self, script, **more):
        return converse(self.links, script, configured=configuration_file.of_text(WHOLE, "r.yaml"), **more)

    async def each_ends(self, count):
        """Ends this many goals more, each once it has begun."""
        for _ in range(count):
            running = [goal for goal, _ in self.server.begun if self.server.states[goal] in goals.ACTIVE]
            if not running:
                before = len(self.server.begun)
                await eventually(lambda: len(self.server.begun) > before)
            self.server.end(self.server.last(), goals.SUCCEEDED)

    async def under_way(self, console, goals_done):
        """The tour is ordered, this many of its goals are done, and the next one runs."""
        await self.ready(console)
        console.task("start", "r-1", TOUR)
        await eventually(lambda: console.words("r-1") == ["taken"])
        await self.each_ends(goals_done)
        await eventually(lambda: len(self.server.begun) == goals_done + 1)

    def test_goals_one_after_another(self):
        async def script(console, robot):
            await self.under_way(console, 0)
            await self.each_ends(4)
            await self.ended(console, "r-1", "taken", "done")

        console = self.converse(script)
        self.assertEqual([goal for goal, _ in self.server.begun],
                         [goals.goal_id("carrier-1", "r-1", number) for number in range(4)])
        self.assertEqual([type(message).__name__ for _, message in self.server.begun],
                         ["Drive_Goal", "Follow_Goal", "Drive_Goal", "Wait_Goal"])
        self.assertEqual(console.reports[0]["plans"], ["name", "imcPlan"])

    def test_a_goal_that_fails_ends_the_plan(self):
        async def script(console, robot):
            await self.under_way(console, 1)
            self.server.end(self.server.last(), goals.ABORTED)
            await self.ended(console, "r-1", "taken", "failed")

        console = self.converse(script)
        self.assertEqual((console.why("r-1"), len(self.server.begun)), ("its action follow was aborted", 2))

    def test_a_stop_in_the_midst(self):
        async def script(console, robot):
            await self.under_way(console, 1)
            console.task("stop", "r-1", TOUR)
            await self.ended(console, "r-1", "taken", "stopped")

        self.converse(script)
        self.assertEqual(self.server.states[self.server.last()], goals.CANCELED)
        self.assertEqual(len(self.server.begun), 2)

    def first_life(self, goals_done):
        """An adapter dies with a goal under way; its notes, the latest first."""
        async def script(console, robot):
            await self.under_way(console, goals_done)

        console = self.converse(script)
        notes = [report["note"] for report in console.reports if report["kind"] == "note"]
        return notes[::-1]

    def test_the_next_adapter_goes_on(self):
        """With the goal that runs, or after it if it is over."""
        for goals_done in range(4):
            for is_over in (False, True):
                with self.subTest(goals_done=goals_done, is_over=is_over):
                    self.setUp()
                    notes = self.first_life(goals_done)
                    if is_over:
                        self.server.end(self.server.last(), goals.SUCCEEDED)

                    async def script(console, robot):
                        console.task("resume", "r-1", TOUR, notes=notes)
                        await self.each_ends(4 - goals_done - is_over)
                        await eventually(lambda: console.words("r-1")[-1:] == ["done"])

                    self.converse(script, resumes=True)
                    self.assertEqual(len(self.server.sent), 4)
                    self.assertEqual(len(set(self.server.sent)), 4)

    def test_lost_notes_are_a_doubt(self):
        """Whichever goal runs is cancelled, and none is sent."""
        for goals_done in range(4):
            with self.subTest(goals_done=goals_done):
                self.setUp()
                self.first_life(goals_done)

                async def script(console, robot):
                    console.task("resume", "r-1", TOUR, notes=[], doubt="notes")
                    await eventually(lambda: console.words("r-1") == ["unknown"])
                    console.task("stop", "r-1", TOUR)
                    await eventually(lambda: console.words("r-1") == ["unknown", "stopped"])

                self.converse(script, resumes=True)
                self.assertEqual(len(self.server.sent), goals_done + 1)
                self.assertEqual(self.server.states[self.server.last()], goals.CANCELED)


class Ready(Case):
    def test_by_a_lifecycle(self):
        """The robot takes plans while its node is active, and the reason names the state otherwise."""
        start = TEXT.index("    ready:")
        line = TEXT[start:TEXT.index("\n", start)]
        text = TEXT.replace(line, "    ready: {lifecycle: nav}")
        state = SimpleNamespace(current_state=SimpleNamespace(label="active"))

        async def script(console, robot):
            self.links.tare.there = False
            await eventually(lambda: console.last("unready") == "its node /carrier1/nav does not answer")
            self.links.tare.there = True
            for label, why in (("inactive", "its node /carrier1/nav is inactive"), ("active", None)):
                state.current_state.label = label
                while console.last("unready") != why:
                    if self.links.tare.replies.empty():
                        self.links.tare.replies.put_nowait(state)
                    await asyncio.sleep(0.01)

        module = __import__("dolphin_ros2.robot", fromlist=["robot"])
        before, module.STATE = module.STATE, (0.02, 0.1)
        self.addCleanup(setattr, module, "STATE", before)
        converse(self.links, script, configured=configuration_file.of_text(text, "r.yaml"))

    def test_a_pose_is_a_position(self):
        text = TEXT.replace("type: nav_msgs/msg/Odometry", "type: geometry_msgs/msg/PoseWithCovarianceStamped")
        found = configuration_file.of_text(text, "r.yaml")
        robot = __import__("dolphin_ros2.robot", fromlist=["Robot"]).Robot(found.robots[0], found)
        point = SimpleNamespace(x=0.0, y=111.0, z=2.0)
        for pose in (SimpleNamespace(position=point), SimpleNamespace(pose=SimpleNamespace(position=point))):
            robot._locate(SimpleNamespace(pose=pose))
            self.assertAlmostEqual(robot.known["latitude"], 41.186, 4)
        self.assertEqual(robot.known["height"], 2.0)


class Outputs(unittest.TestCase):
    def test_a_run_is_published(self):
        """All that it did; of a run that had begun before, what it does from now on."""
        steps = [
            {"kind": "transition", "time": time, "i": time, "rule": ["ACTION"], "label": "act",
             "N": {"posted": [f"k:{time}"]}, "effects": [{"say": f"at {time}"}]} for time in (1, 5)]

        class Run:
            async def status(self):
                return {"time": 3}

            async def __aiter__(self):
                for step in steps:
                    yield dolphin.journal.record(step)

        for is_resumed, expected in ((False, ["at 1", "at 5"]), (True, ["at 5"])):
            with self.subTest(is_resumed=is_resumed):
                published = {}
                links = SimpleNamespace(
                    publisher=lambda name: lambda text: published.setdefault(name, []).append(json.loads(text)))
                asyncio.run(outputs.Outputs({"messages": "said", "posts": "posts"}, Run(), links, is_resumed).run())
                self.assertEqual([message["text"] for message in published["said"]], expected)
                self.assertEqual(published["posts"][-1], {"time": 5, "number": 5, "key": "k", "value": "5"})


if __name__ == "__main__":
    unittest.main()
