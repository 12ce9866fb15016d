"""Analyses as typed results."""

import os
import shutil
import unittest
import unittest.mock

import dolphin
from dolphin import command
from tests.support import InFolder


class Analyses(InFolder):
    examples = ["rendezvous.dol", "rendezvous.fleet", "errors.dol", "errors.fleet"]

    def test_check(self):
        self.assertTrue(dolphin.check("rendezvous.dol").ok)
        warned = dolphin.check("errors.dol")
        self.assertTrue(warned.ok)
        self.assertEqual([(d.line, d.severity) for d in warned.warnings], [(26, "warning")])

    def test_check_of_a_program_with_errors(self):
        self.write("bad.dol", "x = 1\ny = unknwon\n")
        found = dolphin.check("bad.dol")
        self.assertFalse(found.ok)
        error = found.errors[0]
        self.assertEqual((error.file, error.line, error.column), ("bad.dol", 2, 5))
        self.assertEqual(error.message, "unknown name 'unknwon'")
        self.assertIn("y = unknwon", error.details)

    def test_what_is_not_there(self):
        for analysis in (dolphin.check, dolphin.explore, dolphin.time):
            with self.assertRaises(dolphin.ProgramError) as caught:
                analysis("nothere.dol")
            self.assertIn("nothere.dol: No such file", str(caught.exception))

    def test_explore(self):
        found = dolphin.explore("rendezvous.dol")
        self.assertTrue(found.holds and found.is_conclusive)
        self.assertEqual((found.states, found.transitions, found.depth), (36, 35, 35))
        self.assertTrue(found["no deadlock"].holds)
        self.assertEqual(found.violated, ())
        self.assertEqual(found.reductions, ("partial order", "symmetry"))

    def test_a_violated_property_is_a_result(self):
        found = dolphin.explore("rendezvous.dol", faults={"fail": 1})
        self.assertFalse(found.holds)
        verdict = found["no unhandled error"]
        self.assertTrue(verdict.violated and verdict.shortest)
        self.assertEqual(verdict.run[-1], "fail(noptilus-1, survey1, failure)")
        self.assertIn("  fail(noptilus-1, survey1, failure)", str(verdict))
        with self.assertRaises(KeyError):
            found["no such property"]

    def test_a_bound_is_inconclusive(self):
        found = dolphin.explore("rendezvous.dol", max_states=3)
        self.assertFalse(found.holds or found.is_conclusive)
        self.assertEqual(found["no deadlock"].bound, "the bound on states was met")

    def test_strict_invariants_and_formulas(self):
        self.assertFalse(dolphin.explore("errors.dol", strict=True).holds)
        found = dolphin.explore("rendezvous.dol", invariants=["!running('rv1')"], ltl=["F start(rv1)"])
        self.assertEqual([v.verdict for v in found.verdicts if "rv1" in v.name], ["violated", "holds"])

    def test_options_and_parameters_reach_the_command(self):
        self.write("n.dol", "parameter n = 2\nfor (i in 1..n) { message i }\n")
        self.assertGreater(dolphin.explore("n.dol", set={"n": 9}).states, dolphin.explore("n.dol").states)
        with self.assertRaises(dolphin.ProgramError):
            dolphin.explore("n.dol", set={"m": 9})
        with self.assertRaisesRegex(ValueError, "range"):
            dolphin.explore("n.dol", set={"n": "1..3"})

    def test_time(self):
        found = dolphin.time("rendezvous.dol", deadline="30.min", slack=True)
        self.assertTrue(found.holds)
        self.assertEqual(found.completed, dolphin.Window(955.125, 1160.71))
        visit = found.task("rv1")
        self.assertEqual((visit.vehicle, visit.at), ("x8-02", "rendezvous.dol:33:26"))
        self.assertEqual(visit.starts, dolphin.Window(240, 580))
        self.assertIsNotNone(visit.slack)
        self.assertEqual({battery.verdict for battery in found.batteries}, {"holds"})

    def test_a_deadline_that_is_missed(self):
        found = dolphin.time("rendezvous.dol", deadline=1000)
        self.assertFalse(found.holds)
        self.assertEqual((found.in_time, found.status), ("violated", 1))


class TheCommand(unittest.TestCase):
    def test_a_command_that_is_not_there(self):
        named = os.environ.get("DOLPHIN")
        self.addCleanup(lambda: os.environ.update(DOLPHIN=named) if named else os.environ.pop("DOLPHIN"))
        os.environ["DOLPHIN"] = "/nonexistent/dolphin"
        with self.assertRaisesRegex(dolphin.CommandNotFound, "/nonexistent/dolphin"):
            dolphin.check("m.dol")

    def test_the_command_of_a_wheel(self):
        """It goes before the path; DOLPHIN goes before it."""
        before = command.BUNDLED
        self.addCleanup(setattr, command, "BUNDLED", before)
        command.BUNDLED = shutil.which("true")
        with unittest.mock.patch.dict(os.environ):
            self.assertNotEqual(command.find(), command.BUNDLED)
            os.environ.pop("DOLPHIN")
            self.assertEqual(command.find(), command.BUNDLED)
            command.BUNDLED = "/nonexistent/dolphin"
            os.environ["PATH"] = ""
            with self.assertRaisesRegex(dolphin.CommandNotFound, "on the path"):
                command.find()

    def test_the_kinds_of_errors(self):
        for status, kind in [(2, dolphin.ProgramError), (3, dolphin.PlatformError), (125, dolphin.CommandFault),
                             (-9, dolphin.CommandFault), (1, dolphin.CommandError)]:
            error = command.error_of(["dolphin", "exec"], status, "its own text\n")
            self.assertIs(type(error), kind)
            self.assertEqual((str(error), error.status), ("its own text", status))


if __name__ == "__main__":
    unittest.main()
