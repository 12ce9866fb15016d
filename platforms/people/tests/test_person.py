"""Instructions from their offer to their end: with the adapter of the package `dolphin`, and a Dolphin that the test
plays; drawn orders and decisions, adapters that are started again, and what a page is shown."""

import asyncio
import dataclasses
import random
import time
import unittest

import dolphin
from dolphin.channel import Channel
from dolphin_people import configuration
from dolphin_people.person import Gone, Person, Refused

from eventually import eventually
from seeds import seeds
from tests.support import TEXT, Clock, FakeAnswers, settled

FOUND = configuration.of_text(TEXT, "people.yaml")
VALUES = {"depth": 12.5, "colour": "red", "look": "a ray", "where": {"latitude": 41.2, "longitude": -8.7}}


class FakeDolphin(Channel):
    """Keeps notes at once, and all reports in `reports`."""

    def __init__(self):
        self.orders, self.reports, self.notes = asyncio.Queue(), [], {}
        self.is_heard = True

    async def receive(self):
        return await self.orders.get()

    def send(self, message):
        if not self.is_heard:
            return
        self.reports.append(dict(message))
        if message["kind"] == "note":
            self.notes.setdefault(message["request"], []).insert(0, message["note"])
            self.order("kept", id=message["id"])

    def order(self, kind, **members):
        self.orders.put_nowait({"kind": kind, **members})

    def about(self, request):
        """The kinds of the reports on a request, in order."""
        return [each["kind"] for each in self.reports if each.get("request") == request and each["kind"] != "note"]

    def last(self, request):
        return [each for each in self.reports if each.get("request") == request and each["kind"] != "note"][-1]


class World:
    """An adapter with one person, who is seen, and the Dolphin that it speaks to."""

    def __init__(self, answers=None, clock=time.monotonic, **changes):
        self.answers = answers or FakeAnswers()
        self.asked = set()
        self.person = Person(FOUND.people[0], dataclasses.replace(FOUND, **changes), self.answers, clock=clock)
        self.person.was_seen()
        self.adapter = dolphin.Adapter("people", [self.person])
        self.dolphin = FakeDolphin()
        self.dolphin.order("hello", protocol=1, purpose="run")
        self.work = asyncio.ensure_future(self.adapter.converse(self.dolphin))

    async def start(self, request, plan):
        self.asked.add(request)
        self.dolphin.order("start", request=request, vehicle="ana", plan={"name": plan}, timeout=60)
        await settled()

    async def stop(self, request):
        self.dolphin.order("stop", request=request, vehicle="ana")
        await settled()

    async def resume(self, request, plan):
        self.asked.add(request)
        notes = self.dolphin.notes.get(request, [])
        self.dolphin.order("resume", request=request, vehicle="ana", plan={"name": plan}, notes=notes)
        await settled()

    async def decide(self, request, act, value=None, why=""):
        """Whether the decision was taken."""
        try:
            await self.person.decide(request, act, value, why)
            return True
        except (Refused, Gone):
            return False
        finally:
            await settled()

    async def shown(self):
        return (await self.person.state(None))["instruction"]

    def knows(self, request):
        """Whether this adapter has had orders about a request: one that was started again is asked about none that has
        ended."""
        return request in self.asked

    def die(self):
        self.dolphin.is_heard = False
        for task in asyncio.all_tasks():
            if task is not asyncio.current_task():
                task.cancel()


class Rules(unittest.IsolatedAsyncioTestCase):
    async def test_from_the_offer_to_the_answer(self):
        world = World()
        await world.start("r1", "depth")
        shown = await world.shown()
        self.assertEqual((shown["state"], shown["text"]), ("offered", "Measure the depth."))
        self.assertEqual(shown["answer"], {"kind": "number", "unit": "m", "least": 0, "most": 50})
        self.assertEqual(world.dolphin.about("r1"), [])
        self.assertTrue(await world.decide("r1", "accept"))
        self.assertEqual(world.dolphin.about("r1"), ["taken"])
        self.assertFalse(await world.decide("r1", "done", 51))
        self.assertFalse(await world.decide("r1", "cannot", why="  "))
        self.assertTrue(await world.decide("r1", "done", 12.5))
        self.assertEqual(world.dolphin.about("r1"), ["taken", "done"])
        self.assertEqual(world.answers.posts, [("r1", "depth", 12.5, False)])
        self.assertIsNone(await world.shown())

    async def test_a_refusal_and_the_pause_after_it(self):
        clock = Clock()
        world = World(clock=clock)
        await world.start("r1", "launch_noptilus-1")
        self.assertTrue(await world.decide("r1", "decline", why="I am eating."))
        self.assertEqual(world.dolphin.last("r1")["why"], "has declined: I am eating")
        self.assertEqual(world.person.unready, "has just declined")
        clock.now += 4.9
        world.person.look_at_the_clock()
        self.assertEqual(world.person.unready, "has just declined")
        clock.now += 0.2
        world.person.look_at_the_clock()
        self.assertIsNone(world.person.unready)
        world.person.set_duty(False)
        await world.start("r2", "launch_noptilus-1")
        self.assertEqual(world.dolphin.last("r2")["why"], "has a break")

    async def test_what_is_not_accepted_or_not_done_in_time(self):
        world = World(accept=0.05)
        await world.start("r1", "depth")
        await eventually(lambda: world.dolphin.about("r1") == ["failed"])
        self.assertEqual(world.dolphin.last("r1")["why"], "has not accepted in 0.05 s")
        rules = tuple(dataclasses.replace(rule, within=0.05) for rule in FOUND.rules)
        world = World(rules=rules)
        await world.start("r2", "depth")
        await world.decide("r2", "accept")
        await eventually(lambda: world.person._open is not None and world.person._open.state == "stopping")
        self.assertEqual(world.dolphin.about("r2"), ["taken"])  # the work may still go on
        self.assertTrue(await world.decide("r2", "stopped"))
        self.assertEqual(world.dolphin.last("r2")["why"], "is not done after 0.05 s")

    async def test_a_stop_is_confirmed_by_the_person(self):
        world = World()
        await world.start("r1", "launch_noptilus-1")
        await world.decide("r1", "accept")
        await world.stop("r1")
        self.assertEqual((await world.shown())["state"], "stopping")
        self.assertFalse(await world.decide("r1", "done"))
        self.assertEqual(world.dolphin.about("r1"), ["taken"])
        self.assertTrue(await world.decide("r1", "stopped"))
        self.assertEqual(world.dolphin.about("r1"), ["taken", "stopped"])

    async def test_a_stop_that_needs_no_confirmation(self):
        world = World()
        for request, plan, accepts in (("r1", "ring", True), ("r2", "launch_noptilus-1", False)):
            await world.start(request, plan)
            if accepts:
                await world.decide(request, "accept")
            await world.stop(request)
            self.assertEqual(world.dolphin.about(request)[-1], "stopped")
        notices = (await world.person.state(None))["notices"]
        self.assertEqual([each["text"] for each in notices], [
            "No longer needed: Ring the bell.", "No longer needed: Launch noptilus-1."])

    async def test_what_cannot_be_given(self):
        world = World()
        world.answers.missing["depth"] = "the program declares no input 'depth'"
        for request, plan, why in (
                ("r1", "depht", "undefined instruction 'depht'; did you mean 'depth'?"),
                ("r2", "depth", "the program declares no input 'depth'"),
                ("r3", "launch_" + "x" * 2000, "the instruction has 2008 characters: at most 2000")):
            await world.start(request, plan)
            self.assertEqual(world.dolphin.last(request), {"kind": "failed", "request": request, "why": why})
            self.assertIsNone(await world.shown())

    async def test_a_page_gets_a_change_at_once(self):
        world = World()
        await settled()
        state = await world.person.state(None)
        waiting = asyncio.ensure_future(world.person.state(state["version"]))
        await settled()
        self.assertFalse(waiting.done())
        await world.start("r1", "depth")
        self.assertEqual((await waiting)["instruction"]["state"], "offered")

    async def test_the_link_is_lost_when_no_page_is_seen(self):
        clock = Clock()
        world = World(clock=clock)
        await settled()
        clock.now += 29
        world.person.look_at_the_clock()
        self.assertTrue(world.person.known["link"])
        clock.now += 2
        world.person.look_at_the_clock()
        self.assertFalse(world.person.known["link"])
        world.person.was_seen()
        self.assertTrue(world.person.known["link"])

    async def test_orders_and_decisions_in_any_order(self):
        """Each request ends once, as the decisions that were taken have it; each answer is posted once; a decision that
        was taken is taken again; and an adapter that is started again goes on from the notes."""
        for seed in seeds(120):
            with self.subTest(seed=seed):
                await self.play(random.Random(seed))

    async def play(self, draw):
        world, taken, stopped, plans = World(declined=0.0), {}, set(), {}
        for number in range(draw.randint(1, 4)):
            request, plan = f"r{number}", draw.choice([*VALUES, "launch_a", "ring"])
            plans[request] = plan
            await world.start(request, plan)
            for _ in range(draw.randint(0, 8)):
                about = draw.choice([request, request, request, f"r{draw.randrange(number + 1)}"])
                step = draw.choice(["stop", "die", "again", *["decide"] * 6])
                if step == "decide":
                    act = draw.choice(["accept", "accept", "done", "done", "decline", "cannot", "stopped"])
                    value = VALUES.get(plans[about]) if act == "done" else None
                    if await world.decide(about, act, value, draw.choice(["", "why"])):
                        taken.setdefault(about, []).append(act)
                elif step == "again" and taken.get(about) and world.knows(about):
                    self.assertTrue(await world.decide(about, draw.choice(taken[about])))
                elif step == "stop" and about == request:
                    stopped.add(request)
                    await world.stop(request)
                elif step == "die" and world.dolphin.about(request)[-1:] in ([], ["taken"]):
                    world = await self.again(world, request, plan, stopped)
            await self.finish(world, request, plan, taken, stopped)
        ends = {"done", "failed", "stopped"}
        for request, plan in plans.items():
            reports = [each for each in world.dolphin.about(request) if each in ends]
            # A stop that comes later is answered by the same end.
            self.assertEqual(len(set(reports)), 1, (request, world.dolphin.reports))
            acts = taken.get(request, [])
            if request not in stopped:
                wanted = "done" if "done" in acts else "failed"
                self.assertEqual(reports[0], wanted, (request, acts))
            posts = [each for each in world.answers.posts if each[0] == request]
            if reports[0] == "done":
                self.assertIn("done", acts)
                self.assertEqual(len({each[:2] for each in posts}), int(plan in VALUES), request)
                self.assertEqual(sum(not each[3] for each in posts) <= 1, True, posts)
            elif "done" not in acts:
                self.assertEqual(posts, [])
        self.assertIsNone(await world.shown())
        world.die()
        await settled()

    async def again(self, world, request, plan, stopped):
        """The adapter dies, and another one goes on."""
        world.die()
        await settled()
        reports, notes = world.dolphin.reports, world.dolphin.notes
        world = World(answers=world.answers, declined=0.0)
        world.dolphin.reports, world.dolphin.notes = reports, notes
        await world.resume(request, plan)
        if request in stopped:
            await world.stop(request)
        return world

    async def finish(self, world, request, plan, taken, stopped):
        """The person goes on until the request has ended."""
        for act in ("accept", "stopped", "done"):
            if world.dolphin.about(request)[-1:] in ([], ["taken"]):
                if await world.decide(request, act, VALUES.get(plan) if act == "done" else None):
                    taken.setdefault(request, []).append(act)


if __name__ == "__main__":
    unittest.main()
