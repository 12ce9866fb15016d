"""The package as pip installs it, with pytest's plug-in, the types and the extras, in the environment that ../install
makes. `make nightly ONLY=python` runs it; tests for every change have the standard library alone."""

import os
import subprocess
import sys
import unittest

import dolphin
from tests.support import HERE, InFolder

ROOT = os.path.abspath(os.path.join(HERE, ".."))


class Plugin(InFolder):
    examples = ["rendezvous.dol", "rendezvous.fleet"]

    def pytest(self, *words):
        done = subprocess.run(
            [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-q", *words], stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True)
        return done.returncode, done.stdout

    def test_programs_are_tests(self):
        self.write("bad.dol", "x = unknwon\n")
        status, shown = self.pytest("--dolphin")
        self.assertEqual(status, 1, shown)
        self.assertIn("2 failed, 2 passed", shown)
        self.assertIn("unknown name 'unknwon'", shown)
        status, shown = self.pytest("--dolphin", "--dolphin-faults", "fail", "rendezvous.dol")
        self.assertIn("1 failed, 1 passed", shown)
        self.assertIn("fail(noptilus-1, survey1, failure)", shown)

    def test_the_tests_of_the_documentation(self):
        with open(os.path.join(ROOT, "..", "docs", "python.md"), encoding="utf-8") as file:
            page = file.read()
        for name in ("test_rendezvous.py", "test_on_fakes.py"):
            begin = page.index(f"# {name}\n")
            self.write(name, page[begin:page.index("```", begin)])
        begin = page.index("```groovy\n") + len("```groovy\n")
        self.write("boats.dol", page[begin:page.index("```", begin)])
        status, shown = self.pytest()
        self.assertEqual(status, 0, shown)
        self.assertIn("3 passed", shown)


class Types(unittest.TestCase):
    def test_mypy_is_strict_and_finds_nothing(self):
        done = subprocess.run(
            [sys.executable, "-m", "mypy"], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)


class Extras(InFolder):
    examples = ["rendezvous.dol", "rendezvous.fleet"]

    def test_frames(self):
        import pandas
        from dolphin import frames

        journal = dolphin.execute("rendezvous.dol")
        samples, tasks = frames.samples(journal), frames.tasks(journal)
        self.assertIsInstance(samples, pandas.DataFrame)
        self.assertEqual(len(samples), len(journal.of(dolphin.Sighting)))
        self.assertEqual(set(samples.vehicle), set(journal.tracks()))
        self.assertTrue(samples.time.is_monotonic_increasing)
        self.assertEqual(list(tasks.outcome.unique()), ["done"])
        self.assertEqual(len(frames.samples(dolphin.Journal(journal.records[:1]))), 0)

    def test_timeline(self):
        import matplotlib

        matplotlib.use("Agg")
        from dolphin import frames

        axes = frames.timeline(dolphin.execute("rendezvous.dol"))
        self.assertEqual([label.get_text() for label in axes.get_yticklabels()],
                         ["noptilus-1", "noptilus-2", "noptilus-3", "x8-02"])
        self.assertEqual(len(axes.collections), 9)


if __name__ == "__main__":
    unittest.main()
