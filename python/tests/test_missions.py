"""Missions as tests, and fakes."""

import inspect
import unittest

import dolphin
from tests.support import InFolder


class Missions(InFolder):
    examples = ["rendezvous.dol", "rendezvous.fleet"]

    def decorated(self, test, **options):
        test.__code__ = test.__code__.replace(co_filename=self.folder + "/test_it.py")
        return dolphin.mission("rendezvous.dol", **options)(test)

    def test_a_mission_whose_properties_hold(self):
        def test(exploration, timing, other):
            return exploration.states, timing.completed.earliest, other

        wrapped = self.decorated(test, deadline="20.min")
        self.assertEqual(list(inspect.signature(wrapped).parameters), ["other"])
        self.assertEqual(wrapped(other=7), (36, 955.125, 7))

    def test_a_violation_fails_with_its_run(self):
        def test():
            raise ZeroDivisionError("the body is not reached")

        with self.assertRaisesRegex(AssertionError, r"error: violated\n(.*\n)*  fail\(noptilus-1, survey1"):
            self.decorated(test, faults="all")()

    def test_only_some_properties(self):
        def test():
            return "reached"

        self.assertEqual(self.decorated(test, faults="fail", properties=["no deadlock"])(), "reached")

    def test_a_deadline(self):
        def test():
            pass

        with self.assertRaisesRegex(AssertionError, "in time: violated: completed between 955.125 s and 1160.71 s"):
            self.decorated(test, deadline=1000)()

    def test_an_inconclusive_exploration_fails(self):
        def test():
            pass

        with self.assertRaisesRegex(AssertionError, "inconclusive"):
            self.decorated(test, max_states=3)()


class OnFakes(InFolder):
    examples = ["rendezvous.dol", "rendezvous.fleet"]

    def test_fakes_do_what_a_function_says(self):
        self.write("m.dol", """
            boats = pick { type 'USV'; count 2 }
            locate 41.185, -8.706
            execute watch task('survey')[boats[0]] onError { why -> message why; ignore() }
                    | task('survey')[boats[1]] >> imcPlan { planName 'look'; goTo }
        """)

        async def does(vehicle, plan):
            if vehicle.name == "usv-1":
                raise dolphin.Failed("the motor is hot")

        fakes = dolphin.Fakes.of(does, USV=2)
        journal = dolphin.execute("m.dol", fleet=fakes)
        self.assertTrue(journal.completed)
        self.assertEqual(fakes["usv-2"].started, ["survey", "look"])
        self.assertTrue(any("the motor is hot" in text for text in journal.messages()))

    def test_fakes_refuse(self):
        fakes = dolphin.Fakes(dolphin.Fake("a", type="UUV", refuses=["dive"]))
        self.write("m.dol", "v = pick { type 'UUV' }\nexecute v: task('dive')\n")
        with self.assertRaisesRegex(dolphin.RunFailed, "undefined plan 'dive'"):
            dolphin.execute("m.dol", fleet=fakes)
        self.assertEqual(fakes["a"].started, [])

    def test_the_same_fakes_in_several_runs(self):
        fakes = dolphin.Fakes.of(UUV=1)
        self.write("m.dol", "v = pick { type 'UUV' }\nexecute v: task('dive')\n")
        for _ in range(3):
            dolphin.execute("m.dol", fleet=fakes)
        self.assertEqual(fakes["uuv-1"].started, ["dive"] * 3)

    def test_a_hundred_fakes(self):
        self.write("m.dol", "vs = pick { type 'UUV'; count 100 }\ndef each(i) { task('dive')[vs[i]] }\n"
                            "t = each(0)\nfor (i in 1..99) { t = t | each(i) }\nexecute t\n")
        fakes = dolphin.Fakes.of(UUV=100)
        self.assertTrue(dolphin.execute("m.dol", fleet=fakes).completed)
        self.assertEqual({tuple(fake.started) for fake in fakes.vehicles.values()}, {("dive",)})


if __name__ == "__main__":
    unittest.main()
