"""The kit of Dolphin, `dolphin platform check`, judges adapters that are built on the package."""

import os
import shlex
import subprocess
import sys
import unittest

from dolphin import command
from tests.support import HERE, InFolder


DEATHS = ["completion", "stop", "killed", "killed-after-end", "lost-notes", "resume-twice", "never-ordered",
          "console-dies", "close"]


class Kit(InFolder):
    def judge(self, *words, only=()):
        adapter = " ".join(shlex.quote(word) for word in (sys.executable, *words))
        options = [f"--only={name}" for name in only]
        done = subprocess.run(
            [command.find(), "platform", "check", adapter, *options], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            text=True)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def test_every_situation(self):
        verdicts = self.judge(os.path.join(HERE, "boat.py"), "40")
        self.assertIn("40 at once", verdicts)
        self.assertIn("a request that was never ordered (it reports 'absent')", verdicts)

    def test_a_vehicle_that_outlives_its_adapter(self):
        verdicts = self.judge(os.path.join(HERE, "ship.py"), os.path.join(self.folder, "board.json"), only=DEATHS)
        self.assertIn("after its death reports the outcome of a plan that ran (it reports 'taken')", verdicts)


if __name__ == "__main__":
    unittest.main()
