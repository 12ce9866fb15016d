"""Drawn lives of an adapter and of a robot: orders, faults of the action server, and deaths at any moment. No goal is
sent twice, a request has one end, and an end promises that its goal does not run."""

import asyncio
import random
import unittest

import dolphin_ros2.robot as module
from dolphin_ros2 import goals

from eventually import eventually
from seeds import seeds
from tests.support import Console, FakeLinks, converse

ENDS = ("done", "failed", "stopped", "absent")


class World:
    """The robot and the console's memory, which outlive adapters."""

    def __init__(self, draw):
        self.draw, self.links = draw, FakeLinks()
        self.server = self.links.server
        self.requests, self.ends, self.notes, self.faults = 0, {}, {}, []
        self.open = None

    def hear(self, report):
        """A report, at the moment at which it is made."""
        request, kind = report.get("request"), report["kind"]
        if kind == "note":
            self.notes.setdefault(request, []).insert(0, report["note"])
        if kind in ENDS:
            goal = goals.goal_id("carrier-1", request)
            if self.server.states.get(goal) in goals.ACTIVE:
                self.faults.append(f"{request} is {kind} while its goal runs")
            if self.ends.setdefault(request, kind) != kind:
                self.faults.append(f"{request} is {self.ends[request]}, then {kind}")
            if request == self.open:
                self.open = None

    def disturb(self):
        server = self.server
        active = [goal for goal, status in server.states.items() if status in goals.ACTIVE]
        event = self.draw.choice(["accepts", "cancels", "there", "restart", "end", "end", "end"])
        if event == "accepts":
            server.accepts = self.draw.choice([True, False, None])
        elif event == "cancels":
            server.cancels = self.draw.choice([goals.ERROR_NONE, goals.ERROR_REJECTED, goals.ERROR_GOAL_TERMINATED])
        elif event == "there":
            server.there = not server.there
        elif event == "restart":
            server.restart()
        elif active:
            server.end(self.draw.choice(active), self.draw.choice(sorted(goals.OVER)), code=self.draw.choice([0, 7]))

    def calm(self):
        self.server.there, self.server.accepts, self.server.cancels = True, True, goals.ERROR_NONE


class Drawn(unittest.TestCase):
    def setUp(self):
        constants = {"LOOK": 0.005, "SETTLE": 0.02, "PRESENT": 0.03, "ASK_AGAIN": (0.03, 0.05), "CANCEL_WAIT": 0.02,
                     "ASK_AT_MOST": 0.005}
        for name, value in constants.items():
            self.addCleanup(setattr, module, name, getattr(module, name))
            setattr(module, name, value)
        self.addCleanup(setattr, Console, "send", Console.send)

    def live(self, world, first, last):
        """One life of an adapter. The last one ends in calm, with every request at its end."""
        draw = world.draw

        async def script(console, robot):
            await eventually(lambda: console.last("link") is not ...)
            if world.open is not None:
                request = world.open
                console.task("resume", request, notes=world.notes.get(request, []))
            for _ in range(draw.randint(3, 12)):
                if world.open is None and draw.random() < 0.6:
                    world.requests += 1
                    world.open = f"r-{world.requests}"
                    console.task("start", world.open)
                elif world.open is not None and draw.random() < 0.25:
                    console.task("stop", world.open)
                else:
                    world.disturb()
                await asyncio.sleep(draw.choice([0, 0, 0.01, 0.04]))
            if last:
                world.calm()
                if world.open is not None:
                    console.task("stop", world.open)
                await eventually(lambda: world.open is None)

        converse(world.links, script, resumes=not first)

    def test_lives(self):
        send = Console.send
        for seed in seeds(8):
            with self.subTest(seed=seed):
                world = World(random.Random(seed))

                def heard(console, report):
                    world.hear(report)
                    send(console, report)

                Console.send = heard
                lives = world.draw.randint(1, 4)
                for number in range(lives):
                    self.live(world, number == 0, number == lives - 1)
                self.assertEqual(world.faults, [])
                self.assertEqual(len(world.server.sent), len(set(world.server.sent)), "a goal was sent twice")


if __name__ == "__main__":
    unittest.main()
