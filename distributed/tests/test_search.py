"""The search without Spark: in one process, and in partitions of which each has its own filter, as Spark has them. Both
find what `dolphin explore` finds, on examples with all states and with those that partial order leaves. DOLPHIN is the
command."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))

from dolphin_spark import levels, worker  # noqa: E402
from dolphin_spark.facts import Facts, places_may_cycle, prune  # noqa: E402
from dolphin_spark.local import Local  # noqa: E402
from dolphin_spark.successors import Inconclusive, Successors, digest, pack  # noqa: E402

DOLPHIN = os.environ.get("DOLPHIN", "dolphin")
EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples")
CASES = [("rendezvous", []), ("rendezvous", ["--faults", "fail=1"]), ("supplier", []), ("parallel", []), ("until", []),
         ("watch", ["--faults", "fail"]), ("during", []), ("photos", []), ("rotation", [])]


def explored(program, options):
    found = subprocess.run([DOLPHIN, "explore", program, "--json"] + options, stdout=subprocess.PIPE).stdout
    return json.loads(found)


class Partitions:
    """A search as on Spark, but here: `count` partitions, each with a filter of its own."""

    def __init__(self, command, conditions, count):
        self.job = {"conditions": conditions, "partitions": count}
        self.filters = [Successors(command, len(conditions)) for _ in range(count)]
        local = Local(self.filters[0], conditions)
        self.facts, self.states, self.depth = Facts(), 1, 0
        self.seen = [b""] * count
        for partition, (_, (text, _, _)) in worker.known(self.job, local.levels):
            self.seen[partition] = text
        self.levels = [[local.levels[0]]]
        while self.step():
            self.depth += 1

    def step(self):
        count = self.job["partitions"]
        items = [[(p, ("seen", (text, 0, [])))] for p, text in enumerate(self.seen)]
        for index, block in enumerate(self.levels[-1]):
            found, facts = levels.expand(self.filters[index % count], [block], self.depth, self.job["conditions"])
            for partition, text in levels.by_partition(found, count):
                items[partition].append((partition, ("block", text)))
            items[index % count].append((index % count, ("facts", facts)))
        new, fresh = [], 0
        for partition in range(count):
            for _, (kind, value) in worker.merger()(partition, items[partition]):
                if kind == "new":
                    new.append(value)
                else:
                    self.seen[partition], more, told = value
                    fresh += more
                    for facts in told:
                        self.facts.add(facts)
        self.states += fresh
        self.levels.append(new)
        return fresh > 0

    def close(self):
        for one in self.filters:
            one.close()


def told(facts):
    return {name: depth for name, (depth, _) in facts.first.items()}


class Agreement(unittest.TestCase):
    def check(self, name, options, reduction):
        program = os.path.join(EXAMPLES, name + ".dol")
        options = options + ["--reduction", reduction]
        expected = explored(program, options)
        command = [DOLPHIN, "successors", program] + options
        one = Successors(command)
        local = Local(one, [])
        local.run(1 << 60)
        one.close()
        apart = Partitions(command, [], 3)
        apart.close()
        counts = (expected["states"], expected["transitions"], expected["depth"])
        self.assertEqual((local.states, local.facts.transitions, len(local.levels) - 1), counts)
        self.assertEqual((apart.states, apart.facts.transitions, apart.depth), counts)
        self.assertEqual(told(local.facts), told(apart.facts))
        self.assertEqual(local.facts.places, apart.facts.places)
        self.assertEqual(local.facts.unreached, apart.facts.unreached)
        for found in expected["verdicts"]:
            self.verdict(found, local)

    def verdict(self, found, local):
        name, is_violated = found["property"], found["verdict"] == "violated"
        if name == "termination":
            is_cyclic = bool(prune(local.edges))
            self.assertFalse(is_cyclic and not local.facts.rounds and not places_may_cycle(local.facts.places))
            if not local.facts.rounds:
                self.assertEqual(is_violated, is_cyclic)
        elif name == "all code reached":
            self.assertEqual(is_violated, bool(local.facts.unreached))
        else:
            self.assertEqual(is_violated, name in local.facts.first, name)
            if is_violated and found["shortest"] and not local.facts.rounds:
                self.assertGreaterEqual(local.facts.first[name][0], len(found["run"]), name)

    def test_examples(self):
        for name, options in CASES:
            for reduction in ("none", "por"):
                with self.subTest(name, options=options, reduction=reduction):
                    self.check(name, options, reduction)

    def test_invariants(self):
        program = os.path.join(EXAMPLES, "rendezvous.dol")
        condition = "!running('rv1')"
        options = ["--invariant", condition]
        expected = explored(program, options + ["--reduction", "none"])["verdicts"][-1]
        found = Partitions([DOLPHIN, "successors", program] + options, [condition], 2)
        found.close()
        self.assertEqual(found.facts.first["invariant " + condition][0], len(expected["run"]))

    def test_runs(self):
        """The run to a state, read back from the levels, is one of the program."""
        program = os.path.join(EXAMPLES, "rendezvous.dol")
        command = [DOLPHIN, "successors", program, "--faults", "fail=1"]
        one = Successors(command)
        local = Local(one, [])
        local.run(1 << 60)
        one.close()
        depth, known = local.facts.first["no unhandled error"]
        states = []
        while depth:
            _, parent, _, state = local.find(known, depth)
            states.insert(0, state)
            known, depth = parent, depth - 1
        shown = subprocess.run(command + ["--run"], input=one.greeting + pack(states), stdout=subprocess.PIPE)
        self.assertEqual(shown.returncode, 0)
        self.assertEqual(len([x for x in shown.stdout.splitlines() if x.lstrip()[:1].isdigit()]), len(states))


    def test_unsettled(self):
        """What nobody can list stops the search, and is told."""
        with tempfile.TemporaryDirectory() as folder:
            program = os.path.join(folder, "open.dol")
            with open(program, "w") as text:
                text.write("v = pick { count 1 }\npost b: battery(v)\n")
            one = Successors([DOLPHIN, "successors", program])
            with self.assertRaisesRegex(Inconclusive, "battery"):
                Local(one, []).run(1 << 60)
            one.close()


class Parts(unittest.TestCase):
    def test_records(self):
        items = [(digest(b"%d" % i), digest(b"p"), i, b"x" * i) for i in range(5)]
        self.assertEqual(list(levels.records(b"".join(levels.record(*item) for item in items))), items)

    def test_merge(self):
        """What is new is new once, with the least parent, whatever comes first."""
        a, b, low, high = digest(b"a"), digest(b"b"), b"\0" * 16, b"\1" * 16
        blocks = [levels.record(a, high, 0, b"a"), levels.record(a, low, 0, b"a") + levels.record(b, low, 0, b"b")]
        for order in (blocks, blocks[::-1]):
            seen = {b}
            block, count = levels.merge(seen, order)
            self.assertEqual((count, list(levels.records(block)), seen), (1, [(a, low, 0, b"a")], {a, b}))

    def test_prune(self):
        self.assertEqual(prune({1: [2, 3], 2: [3], 3: []}), set())
        self.assertEqual(prune({1: [2], 2: [3, 4], 3: [2], 4: []}), {1, 2, 3})
        self.assertTrue(places_may_cycle({(b"a", b"b"), (b"b", b"a")}))
        self.assertFalse(places_may_cycle({(b"a", b"b"), (b"a", b"c"), (b"b", b"c")}))

    def test_facts(self):
        facts = Facts()
        facts.broken("assertions", 3, b"\2" * 16)
        facts.broken("assertions", 3, b"\1" * 16)
        facts.broken("assertions", 4, b"\0" * 16)
        facts.places.add((b"\3" * 16, b"\4" * 16))
        facts.reaches("a\nb")
        facts.reaches("b\nc")
        again = Facts.of_json(facts.to_json())
        self.assertEqual(vars(again), vars(facts))
        self.assertEqual(again.first, {"assertions": (3, b"\1" * 16)})
        self.assertEqual(again.unreached, {"b"})

    def test_other_program(self):
        command = [DOLPHIN, "successors", os.path.join(EXAMPLES, "parallel.dol")]
        with self.assertRaises(RuntimeError):
            Successors(command, greeting=b"another\n")


if __name__ == "__main__":
    unittest.main()
