"""Searches of random programs on Spark, in local[2]: the states, transitions, depth and verdicts of `dolphin explore`,
with all states and with those that partial order leaves. Run by the Python that distributed/install prints. DOLPHIN is
the command, MISSIONS the program that writes random missions (test/explore/random_missions.ml), PROGRAMS how many are
compared, 6 by default, SEED which."""

import json
import os
import random
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, ".."))

import explore  # noqa: E402
from dolphin_spark import files, ship  # noqa: E402
from dolphin_spark.local import Local  # noqa: E402
from dolphin_spark.search import Search, Store  # noqa: E402
from dolphin_spark.successors import Successors  # noqa: E402

DOLPHIN = os.path.abspath(os.environ["DOLPHIN"])
MISSIONS = os.environ["MISSIONS"]
PROGRAMS = int(os.environ.get("PROGRAMS", "6"))
MOST = 3000
LEVELS = 4  # at most as many are left for Spark: each takes half a second there, whatever it holds


class Random(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.spark = ship.context("test", "local[2]", [DOLPHIN], cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.spark.stop()
        cls.folder.cleanup()

    def mission(self, number):
        subprocess.run([MISSIONS, self.folder.name, str(number), "1"], check=True)
        program = os.path.join(self.folder.name, "%d.dol" % number)
        with open(os.path.join(self.folder.name, "%d.options" % number)) as options, open(program) as text:
            return program, text.read(), options.read().splitlines()

    def test_random(self):
        compared = levels = number = 0
        while compared < PROGRAMS:
            number += 1
            program, text, options = self.mission(number)
            shared = False
            for reduction in ("none", "por"):
                with self.subTest(text, options=options, reduction=reduction):
                    on_spark = self.agrees(program, options + ["--reduction", reduction], number)
                    levels += on_spark or 0
                    shared = shared or on_spark is not None
            compared += shared
        print("%d programs compared, of %d; %d levels on Spark" % (compared, number, levels))

    def agrees(self, program, options, number):
        """How many levels were found on Spark; None if these, or states, are too many, or cannot be listed."""
        asked = [DOLPHIN, "explore", program, "--json", "--max-states", str(MOST)] + options
        told = json.loads(subprocess.run(asked, stdout=subprocess.PIPE).stdout)
        if any(verdict["verdict"] == "inconclusive" for verdict in told["verdicts"]) or told["depth"] > 200:
            return None
        successors = Successors([DOLPHIN, "successors", program] + options)
        try:
            found, levels = self.search(program, options, successors, told["depth"], number)
            self.assertEqual((found.states, found.facts.transitions, found.depth),
                             (told["states"], told["transitions"], told["depth"]))
            for verdict in told["verdicts"]:
                self.verdict(verdict, found)
            return levels
        finally:
            successors.close()

    def search(self, program, options, successors, depth, number):
        local = Local(successors, [])
        randomly = random.Random(number)
        until = depth - randomly.randrange(1, LEVELS + 1)
        while local.depth < until:
            local.step()
        fleet = files.beside(program)
        for path in (program, fleet):
            self.spark.addFile(path)
        job = files.job(DOLPHIN, program, fleet, options)
        job.update(greeting=successors.greeting, shown=program, conditions=[], partitions=randomly.randrange(1, 4))
        folder = "file://" + tempfile.mkdtemp(dir=self.folder.name)
        search = Search(self.spark, job, Store(self.spark, folder), lambda search: None, successors)
        search.begin(local)
        search.run()
        return search, search.depth - local.depth

    def verdict(self, verdict, found):
        name, is_violated = verdict["property"], verdict["verdict"] == "violated"
        if name == "termination":
            told = explore.termination(found)
            if not told.startswith("inconclusive"):
                self.assertEqual(told == "violated", is_violated)
        elif name == "all code reached":
            self.assertEqual(is_violated, bool(found.facts.unreached))
        else:
            self.assertEqual(is_violated, name in found.facts.first, name)
            if is_violated:
                depth, known = found.facts.first[name]
                states = explore.path(found, known, depth)
                self.assertEqual(len(states), depth)


if __name__ == "__main__":
    unittest.main()
