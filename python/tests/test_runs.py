"""Runs from Python: followed, posted to, stopped; and those that die."""

import asyncio
import os
import signal
import subprocess
import sys
import unittest

import dolphin
from eventually import eventually
from tests.support import HERE, InFolder

MISSION = """
input 'abort'
v = pick { type 'UUV' }
execute v: until { poll abort: true } run task('long')
execute v: task('home')
message 'home'
"""


def long_fakes():
    return dolphin.Fakes.of(lambda vehicle, plan: dolphin.never() if plan.name == "long" else None, UUV=1)


class Runs(InFolder):
    examples = ["rendezvous.dol", "rendezvous.fleet", "errors.dol", "errors.fleet"]

    def setUp(self):
        super().setUp()
        self.write("m.dol", MISSION)

    def go(self, script):
        return asyncio.run(asyncio.wait_for(script(), 60))

    def test_a_simulated_run_is_read_as_it_goes(self):
        async def script():
            async with dolphin.run("rendezvous.dol", seed=4) as run:
                records = [record async for record in run]
                with self.assertRaises(dolphin.DolphinError):
                    await run.post(abort=True)
            self.assertEqual(len(records), len(run.result))
            self.assertEqual(run.end.ending, "completed")
            self.assertIn("ends survey1", run.output)

        self.go(script)

    def test_posts_reach_the_run(self):
        async def script():
            async with dolphin.run("m.dol", fleet=long_fakes()) as run:
                async for record in run:
                    if isinstance(record, dolphin.Transition) and record.label == "start(uuv-1, long)":
                        status = await run.status()
                        self.assertEqual((status["inputs"], status["questions"]), (["abort"], []))
                        with self.assertRaises(dolphin.RequestRefused) as refused:
                            await run.post(abrot=True)
                        self.assertEqual(refused.exception.code, "not-declared")
                        await run.post("abort", True)
                with self.assertRaises(dolphin.RunEnded):
                    await run.post(abort=True)
            self.assertEqual(run.result.messages(), ["home"])
            self.assertEqual([(t.plan, t.outcome) for t in run.result.tasks()], [("long", "stopped"), ("home", "done")])

        self.go(script)

    def test_answers_to_questions_of_tasks(self):
        self.write("q.dol", "v = pick { type 'UUV' }\nexecute v: confirm('Dive?') >> task('dive')\n")
        prompt = "Dive?"

        async def script():
            async with dolphin.run("q.dol", fleet=long_fakes()) as run:
                while prompt not in (await run.status())["questions"]:
                    await asyncio.sleep(0.01)
                await run.answer(prompt, True)
            self.assertEqual([task.plan for task in run.result.tasks()], ["dive"])

        self.go(script)

    def test_stop(self):
        async def script():
            fakes = long_fakes()
            async with dolphin.run("m.dol", fleet=fakes) as run:
                async for record in run:
                    if isinstance(record, dolphin.Transition) and record.label.startswith("start"):
                        await eventually(lambda: fakes["uuv-1"].started)
                        await run.stop()
            self.assertEqual(run.end.ending, "interrupted")
            self.assertEqual(fakes["uuv-1"].stopped, ["long"])

        self.go(script)

    def test_a_body_that_raises_interrupts_the_run(self):
        async def script():
            fakes = long_fakes()
            with self.assertRaises(ZeroDivisionError):
                async with dolphin.run("m.dol", fleet=fakes) as run:
                    async for record in run:
                        if isinstance(record, dolphin.Transition) and record.label.startswith("start"):
                            await eventually(lambda: fakes["uuv-1"].started)
                            raise ZeroDivisionError
            self.assertEqual(run.end.ending, "interrupted")
            self.assertEqual(fakes["uuv-1"].stopped, ["long"])

        self.go(script)

    def test_an_unhandled_error_of_the_program(self):
        with self.assertRaises(dolphin.RunFailed) as caught:
            dolphin.execute("errors.dol")
        self.assertEqual(caught.exception.ending, "failed")
        self.assertIn("errors.dol:26:21: error: index 2 is out of range", str(caught.exception))
        self.assertEqual(dolphin.execute("errors.dol", check=False).end.ending, "failed")

    def test_a_program_that_cannot_begin(self):
        self.write("bad.dol", "x = unknwon")
        with self.assertRaises(dolphin.ProgramError) as caught:
            dolphin.execute("bad.dol", fleet=long_fakes())
        self.assertEqual(caught.exception.diagnostics[0].line, 1)

    def test_an_adapter_that_cannot_begin(self):
        with self.assertRaises(dolphin.PlatformError) as caught:
            dolphin.execute("m.dol", platform=["exit 7"], journal="m.run")
        self.assertTrue(str(caught.exception))

    def test_a_run_on_vehicles_needs_a_journal(self):
        with self.assertRaisesRegex(ValueError, "journal"):
            dolphin.run("m.dol", platform=["true"])

    def test_a_run_that_dies(self):
        async def script():
            with self.assertRaises(dolphin.CommandFault) as caught:
                async with dolphin.run("m.dol", fleet=long_fakes()) as run:
                    async for record in run:
                        if isinstance(record, dolphin.Transition) and record.label.startswith("start"):
                            os.kill(run._process.pid, signal.SIGKILL)
            self.assertEqual(caught.exception.status, -signal.SIGKILL)
            self.assertIsNone(run.end)
            self.assertIn("start(uuv-1, long)", [t.label for t in run.result.of(dolphin.Transition)])

        self.go(script)

    def test_a_run_that_died_is_resumed(self):
        async def script():
            fakes = long_fakes()
            with self.assertRaises(dolphin.CommandFault):
                async with dolphin.run("m.dol", fleet=fakes, journal="m.run") as run:
                    async for record in run:
                        if isinstance(record, dolphin.Transition) and record.label.startswith("start"):
                            await eventually(lambda: fakes["uuv-1"].started)
                            os.kill(run._process.pid, signal.SIGKILL)
            async with dolphin.run("m.dol", fleet=fakes, journal="m.run", resume=True) as run:
                await run.post(abort=True)
            self.assertEqual(run.result.messages(), ["home"])
            self.assertEqual(fakes["uuv-1"].started, ["long", "home"])

        self.go(script)

    def test_a_socket_that_vanishes(self):
        async def script():
            async with dolphin.run("m.dol", fleet=long_fakes()) as run:
                await run._socket.close()
                os.remove(run.journal_path + ".sock")
                with self.assertRaisesRegex(dolphin.RunGone, "does not listen"):
                    await run.post(abort=True)
                await run.stop()
            self.assertEqual(run.end.ending, "interrupted")

        self.go(script)

    def test_a_run_of_another_process(self):
        async def script():
            async with dolphin.run("m.dol", fleet=long_fakes(), journal="m.run") as run:
                async with dolphin.attach("m.run") as other:
                    async for record in other:
                        if isinstance(record, dolphin.Transition) and record.label.startswith("start"):
                            await other.post(abort=True)
                self.assertEqual(other.end.ending, "completed")
            self.assertEqual(run.result.messages(), ["home"])
            with self.assertRaises(dolphin.RunGone):
                async with dolphin.attach("m.run") as other:
                    await other.status()

        self.go(script)

    def test_ctrl_c_stops_vehicles(self):
        self.write("ctrl_c.py", f"""
import asyncio, sys
sys.path.insert(0, {os.path.join(HERE, "..")!r})
import dolphin

async def main():
    fakes = dolphin.Fakes.of(lambda vehicle, plan: dolphin.never(), UUV=1)
    async with dolphin.run("m.dol", journal="m.run", fleet=fakes) as run:
        async for record in run:
            if isinstance(record, dolphin.Transition) and record.label.startswith("start"):
                print("started", flush=True)

asyncio.run(main())
""")
        # A shell's job in the background ignores SIGINT, and so would the child.
        child = subprocess.Popen(
            [sys.executable, "ctrl_c.py"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
        try:
            self.assertEqual(child.stdout.readline(), b"started\n")
            os.killpg(child.pid, signal.SIGINT)
            child.communicate(timeout=60)
        finally:
            child.kill()
        journal = dolphin.read("m.run")
        self.assertEqual(journal.end.ending, "interrupted")
        self.assertEqual([task.outcome for task in journal.tasks()], ["stopped"])


if __name__ == "__main__":
    unittest.main()
