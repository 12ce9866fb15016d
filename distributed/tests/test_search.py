"""The search without Spark: in one process, and in partitions of which each has its own filter, as Spark has them. Both
find what `dolphin explore` finds, on examples with all states and with those that partial order leaves. DOLPHIN is the
command."""

import json
import os
import random
import subprocess
import sys
import tempfile
import unittest

import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))

from dolphin_spark import blocks, levels, worker  # noqa: E402
from dolphin_spark.facts import Facts, places_may_cycle, prune  # noqa: E402
from dolphin_spark.local import Local  # noqa: E402
from dolphin_spark.successors import Inconclusive, Successors, digest, run  # noqa: E402

DOLPHIN = os.environ.get("DOLPHIN", "dolphin")
EXPLORE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "explore.py")
EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples")
CASES = [("rendezvous", []), ("rendezvous", ["--faults", "fail=1"]), ("supplier", []), ("parallel", []), ("until", []),
         ("watch", ["--faults", "fail"]), ("during", []), ("photos", []), ("rotation", [])]


def explored(program, options):
    found = subprocess.run([DOLPHIN, "explore", program, "--json"] + options, stdout=subprocess.PIPE).stdout
    return json.loads(found)


class Broadcast:
    def __init__(self, value):
        self.value = value


class Told(dict):
    """Of one level, as the accumulator is on Spark."""

    def add(self, other):
        self.update(other)


class Partitions:
    """A search as on Spark, but here: `count` partitions, each with a filter of its own. With `dying`, a filter dies
    after each level, and the first of a level dies before its answer is there: another one answers for it."""

    def __init__(self, command, conditions, count, dying=False):
        self.command, self.count, self.dying = command, count, dying
        self.job = {"greeting": None, "conditions": conditions, "partitions": count}
        self.filters = [Successors(command) for _ in range(count)]
        self.job["greeting"] = self.filters[0].greeting
        local = Local(self.filters[0], conditions)
        self.facts, self.states, self.depth = Facts(), 1, 0
        self.parts, self.broadcasts = set(), []
        first = blocks.by_partition(blocks.Columns.of(local.levels[0]), count)
        initial = [(p, ("new", part.block())) for p, part in first]
        self.levels, self.seen = [initial], [[] for _ in range(count)]
        while self.step():
            self.depth += 1

    def expanded(self, index, item, told):
        """The results of the task of one item of the frontier, in a process of its own."""
        if self.dying and index == self.depth % self.count:
            lost = self.filters[index]
            list(self.task(index, item, told))
            lost.process.kill()
            lost.process.communicate()
            self.filters[index] = Successors(self.command)
        return list(self.task(index, item, told))

    def task(self, index, item, told):
        worker._filters.clear()
        worker._filters[self.job["greeting"]] = self.filters[index]
        return worker.expander(self.job, self.depth, self.broadcasts, told)(index, [item])

    def step(self):
        told, led_to = Told(), [[] for _ in range(self.count)]
        for p, item in self.levels[-1]:
            self.seen[p] = worker.runs_of(p, self.seen[p] + [(p, item)])
        for p, item in self.levels[-1]:
            for partition, what in self.expanded(p, (p, item), told):
                led_to[partition].append((partition, what))
        new = []
        for p in range(self.count):
            new += worker.merger(told)(p, self.seen[p] + led_to[p])
        for (what, _), value in told.items():
            if what == "facts":
                self.facts.add(value)
        fresh = sum(value for (what, _), value in told.items() if what == "count")
        more = sorted(self.facts.parts - self.parts)
        self.parts.update(more)
        self.broadcasts += [Broadcast(more)] if more else []
        self.facts.parts = set()
        self.states += fresh
        self.levels.append(new)
        return fresh > 0

    def close(self):
        worker._filters.clear()
        for one in self.filters:
            one.close()


def block(states):
    """The block of (digest, parent, kind, text)."""
    def numbers(texts):
        return numpy.frombuffer(b"".join(texts), blocks.WORD)
    known, parents, kinds, texts = zip(*states)
    return blocks.Columns(
        numbers(x[:8] for x in known), numbers(x[8:] for x in known), numbers(parents),
        numpy.array([len(x) for x in texts], blocks.LENGTH), numpy.array(kinds, numpy.uint8),
        numpy.frombuffer(b"".join(texts), numpy.uint8)).block()


def items(whole):
    columns = blocks.Columns.of(whole)
    return [(columns.digest(i), columns.parents[i].tobytes(), int(columns.kinds[i]), columns.text(i))
            for i in range(columns.count)]


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
        is_cyclic = local.may_cycle()
        one.close()
        apart = Partitions(command, [], 3)
        apart.close()
        counts = (expected["states"], expected["transitions"], expected["depth"])
        self.assertEqual((local.states, local.facts.transitions, local.depth), counts)
        self.assertEqual((apart.states, apart.facts.transitions, apart.depth), counts)
        self.assertEqual(told(local.facts), told(apart.facts))
        self.assertEqual(local.facts.places, apart.facts.places)
        self.assertEqual(local.facts.unreached, apart.facts.unreached)
        for found in expected["verdicts"]:
            self.verdict(found, local, is_cyclic)

    def verdict(self, found, local, is_cyclic):
        name, is_violated = found["property"], found["verdict"] == "violated"
        if name == "termination":
            self.assertFalse(is_cyclic and not local.facts.rounds and not places_may_cycle(local.facts.places))
            if not local.facts.rounds:
                self.assertEqual(is_violated, is_cyclic)
        elif name == "all code reached":
            self.assertEqual(is_violated, bool(local.facts.unreached))
        else:
            self.assertEqual(is_violated, name in local.facts.first, name)
            # Where faults are counted, the run shown has the fewest, and others may be shorter.
            if is_violated and found["shortest"] and "faults" not in found and not local.facts.rounds:
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
            state, known = local.find(known, depth)
            states.insert(0, state)
            depth -= 1
        shown = subprocess.run(command + ["--run"], input=one.greeting + run(states, local.parts),
                               stdout=subprocess.PIPE)
        self.assertEqual(shown.returncode, 0)
        self.assertEqual(len([x for x in shown.stdout.splitlines() if x.lstrip()[:1].isdigit()]), len(states))

    def test_lost(self):
        """Filters that die lose no part: the parts named by states are sent again when these are expanded again."""
        for name, options in (("rendezvous", []), ("parallel", []), ("photos", [])):
            program = os.path.join(EXAMPLES, name + ".dol")
            expected = explored(program, options + ["--reduction", "none"])
            found = Partitions([DOLPHIN, "successors", program] + options, [], 3, dying=True)
            found.close()
            self.assertEqual((found.states, found.facts.transitions), (expected["states"], expected["transitions"]))

    def test_batches(self):
        """However few states the filter is asked at a time, the answer is the same."""
        program = os.path.join(EXAMPLES, "rendezvous.dol")
        usual, found = levels.BATCH, []
        try:
            for levels.BATCH in (usual, 7):
                one = Successors([DOLPHIN, "successors", program])
                local = Local(one, [])
                local.run(1 << 60)
                one.close()
                found.append((local.levels, local.facts.transitions, local.facts.places, local.parts))
        finally:
            levels.BATCH = usual
        self.assertEqual(found[0], found[1])

    def test_places(self):
        """Unreached code has the same name on all machines, whatever the path of the program there."""
        with tempfile.TemporaryDirectory() as folder:
            found = []
            for name in ("here", "elsewhere"):
                program = os.path.join(folder, name + ".dol")
                with open(program, "w") as text:
                    text.write("n = 1\nif (n > 1) { post x: 1 }\n")
                one = Successors([DOLPHIN, "successors", program], shown=os.path.join(folder, "here.dol"))
                local = Local(one, [])
                local.run(1 << 60)
                one.close()
                found.append(local.facts.unreached)
            self.assertEqual(len(found[0]), 1)
            self.assertEqual(found[0], found[1])

    def test_command(self):
        """The output of the command without Spark; its answers are those of `dolphin explore`."""
        with tempfile.TemporaryDirectory() as folder:
            program = os.path.join(folder, "asking.dol")
            with open(program, "w") as text:
                text.write("n = ask 'How many?'\nif (n > 1) { post x: 1 }\nassert { !(poll x: 1) }, 'none'\n")
            command = [sys.executable, EXPLORE, program, "--dolphin", DOLPHIN, "--answer", "1", "--answer", "2"]
            found = subprocess.run(command, stdout=subprocess.PIPE, text=True)
            expected = explored(program, ["--answer", "1", "--answer", "2", "--reduction", "none"])
            self.assertEqual(found.returncode, 1)
            self.assertIn("assertions: violated after 4 steps\n", found.stdout)
            self.assertIn("assertions: a run of 4 steps\n", found.stdout)
            self.assertIn("%d states, %d transitions, depth %d," % tuple(
                expected[what] for what in ("states", "transitions", "depth")), found.stdout)

    def test_verdicts(self):
        """A violation of each property is of the property that `dolphin explore` names."""
        programs = ["v = pick { count 2; timeout 1.second }\n", "v = pick { count 1 }\nexecute task('a') | task('b')\n",
                    "x = 1 / 0\n", "assert { false }, 'no'\n", "execute waitFor { poll a: 1 } then idle(1)\n",
                    "halt 'here'\n", "post a: 1\n", "message 'fine'\n"]
        with tempfile.TemporaryDirectory() as folder:
            program, fleet = os.path.join(folder, "m.dol"), os.path.join(folder, "m.fleet")
            with open(fleet, "w") as text:
                text.write("vehicle 'a', { type 'UUV' }\n")
            for source in programs:
                with self.subTest(source):
                    with open(program, "w") as text:
                        text.write(source)
                    found = subprocess.run([sys.executable, EXPLORE, program, "--dolphin", DOLPHIN],
                                           stdout=subprocess.PIPE, text=True)
                    lines = found.stdout.split("\n\n", maxsplit=1)[0].splitlines()
                    here = {line.split(":")[0] for line in lines if ": violated" in line}
                    verdicts = explored(program, ["--reduction", "none"])["verdicts"]
                    there = {v["property"] for v in verdicts if v["verdict"] == "violated"}
                    self.assertEqual({name for name in here if "note" not in name},
                                     there - {"no halt", "no leftover tuples", "all code reached"})
                    self.assertEqual(any(line.startswith("vehicles for all picks") for line in lines),
                                     "vehicles for all picks" in there)

    def test_unsettled(self):
        """Successors that cannot be listed stop the search, and are reported."""
        with tempfile.TemporaryDirectory() as folder:
            program = os.path.join(folder, "open.dol")
            with open(program, "w") as text:
                text.write("v = pick { count 1 }\npost b: battery(v)\n")
            one = Successors([DOLPHIN, "successors", program])
            with self.assertRaisesRegex(Inconclusive, "battery"):
                Local(one, []).run(1 << 60)
            one.close()


class Parts(unittest.TestCase):
    def test_columns(self):
        """A state keeps its own text under all operations on rows."""
        states = [(digest(b"%d" % i), b"%07d." % i, i % 200, b"x" * (i * 7 % 13) + b"%d" % i) for i in range(500)]
        whole = block(states)
        columns = blocks.Columns.of(whole)
        self.assertEqual(items(whole), states)
        self.assertEqual(columns.block(), whole)
        rows = numpy.array([499, 3, 77, 3, 0])
        self.assertEqual(items(columns.taken(rows).block()), [states[i] for i in rows])
        parts = blocks.by_partition(columns, 7)
        self.assertEqual(sorted(x for _, part in parts for x in items(part.block())), sorted(states))
        for partition, part in parts:
            self.assertEqual({int.from_bytes(x[0][12:], "little") % 7 for x in items(part.block())}, {partition})
        self.assertEqual(columns.find(states[42][0]), 42)
        self.assertEqual(columns.find(states[42][0][:8]), 42)
        self.assertIsNone(columns.find(b"?" * 16))
        self.assertEqual(items(blocks.NOTHING), [])

    def test_merge(self):
        """A new state is new once, in order, with the least parent, in any order of arrival."""
        a, b, low, high = digest(b"a"), digest(b"b"), b"\0" * 8, b"\1" * 8
        found = [block([(a, high, 0, b"a")]), block([(a, low, 0, b"a"), (b, low, 0, b"b")])]
        for order in (found, found[::-1]):
            merged = blocks.merge([blocks.digests(block([(b, low, 0, b"b")]))], order)
            self.assertEqual(items(merged), [(a, low, 0, b"a")])
        self.assertEqual(blocks.merge([], []), blocks.NOTHING)

    def test_merge_many(self):
        """Merging is union of sets, also for digests with the same beginning."""
        random.seed(20261125)
        for _ in range(200):
            firsts = [random.randbytes(8) for _ in range(4)]

            def some(n):
                names = [random.choice(firsts) + bytes([random.randrange(6)]) * 8 for _ in range(n)]
                return [(name, random.randbytes(8), 1, name[7:9]) for name in names]

            seen = [blocks.merge([], [block(some(random.randrange(1, 9)))]) for _ in range(random.randrange(4))]
            runs = [blocks.digests(x) for x in seen]
            if len(runs) > 1 and random.randrange(2):
                runs = [blocks.joined(runs)]
            known = {x[0] for whole in seen for x in items(whole)}
            found = [some(random.randrange(1, 9)) for _ in range(3)]
            merged = items(blocks.merge(runs, [block(states) for states in found]))
            number = int.from_bytes
            expected = {}
            for name, parent, kind, text in (x for states in found for x in states if x[0] not in known):
                other = expected.get(name, (parent,))[0]
                expected[name] = (min(parent, other, key=lambda p: number(p, "little")), kind, text)
            self.assertEqual({x[0]: x[1:] for x in merged}, expected)
            order = [(number(x[0][:8], "little"), number(x[0][8:], "little")) for x in merged]
            self.assertEqual(order, sorted(order))

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
        facts.reaches(["a", "b"])
        facts.reaches(["b", "c"])
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
