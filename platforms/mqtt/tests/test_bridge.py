"""The process against a run and a broker of this very process: starts, refusals and ends; and its command line."""

import asyncio
import contextlib
import io
import os
import shutil
import tempfile
import unittest

import dolphin
from dolphin import posting
from dolphin_mqtt import configuration, shell

from eventually import eventually
from tests.support import TEXT, FakeBroker, FakeRun


class Bridges(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="dolphin-test-")
        self.addCleanup(shutil.rmtree, self.folder)
        self.journal = os.path.join(self.folder, "m.run")
        self.remarks, self.broker = [], FakeBroker()
        for module in (shell, posting):
            self.addCleanup(setattr, module, "AGAIN", module.AGAIN)
            module.AGAIN = 0.01

    def run_one(self, script, inputs=("quay", "door", "lost"), text=TEXT, wait=20.0):
        """The exit status of a bridge for a run that declares these inputs, while a script goes on."""

        async def go():
            run = FakeRun(self.journal, list(inputs))
            bridge = shell.Bridge(
                configuration.of_text(text, "s.yaml"), self.journal, wait, self.broker.connect,
                posting.Remarks(self.remarks.append))
            work = asyncio.ensure_future(bridge.serve())
            await script(run)
            return await asyncio.wait_for(work, 20)

        return asyncio.run(go())

    async def opened(self, run):
        await run.open()
        await eventually(lambda: self.broker.is_open)

    def test_messages_become_pairs_and_the_end_of_the_run_is_the_end(self):
        async def script(run):
            await self.opened(run)
            self.assertEqual(self.broker.topics, {"harbour/quay": 1, "harbour/door": 2})
            self.broker.hear("harbour/quay", b'{"smoke": {"level": 0.5}}', False)
            self.broker.hear("harbour/door", b"open", True)
            self.broker.hear("harbour/other", b"1", False)
            await eventually(lambda: len(run.posts) == 2)
            run.end()
            self.posts = run.posts

        self.assertEqual(self.run_one(script), 0)
        self.assertEqual(self.posts, [("quay", 0.5), ("door", "open")])
        self.assertIs(self.broker.is_open, False)
        self.assertEqual([r for r in self.remarks if "s for the run at most" not in r], [])

    def test_silence_is_posted_as_time_passes(self):
        text = TEXT.replace("silence: 60", "silence: 0.1").replace("every: 10", "every: 0.1")

        async def script(run):
            await self.opened(run)
            await eventually(lambda: run.posts == [("lost", "quay")])
            for level in (1, 2, 3):
                self.broker.hear("harbour/quay", b'{"smoke": {"level": %d}}' % level, False)
            await eventually(lambda: run.posts[1:] == [("quay", 1), ("quay", 3), ("lost", "quay")])
            run.end()

        self.assertEqual(self.run_one(script, text=text), 0)

    def test_keys_that_the_program_does_not_declare(self):
        async def script(run):
            await run.open()

        self.assertEqual(self.run_one(script, inputs=["quay", "abort"]), 2)
        self.assertEqual(self.remarks[-1].split("\n"), [
            "the program declares no input 'lost': its inputs are 'quay', 'abort'",
            "the program declares no input 'door': its inputs are 'quay', 'abort'"])
        self.assertIsNone(self.broker.is_open)

    def test_a_program_without_inputs(self):
        async def script(run):
            await run.open()

        self.assertEqual(self.run_one(script, inputs=[]), 2)
        self.assertIn("the program declares no input 'quay': it declares no inputs", self.remarks[-1])

    def test_a_run_that_never_listens(self):
        async def script(run):
            pass

        self.assertEqual(self.run_one(script, wait=0.05), 3)
        gone = f"{self.journal}.sock: the run does not listen: No such file or directory"
        self.assertEqual(self.remarks, [
            f"{gone}; waits 0.05 s for the run at most", f"the run cannot be reached: {gone}"])

    def test_a_run_that_begins_later(self):
        async def script(run):
            await asyncio.sleep(0.1)
            await self.opened(run)
            run.end()

        self.assertEqual(self.run_one(script), 0)

    def test_a_console_that_dies_and_is_started_again(self):
        async def script(run):
            await self.opened(run)
            run.die()
            self.broker.hear("harbour/door", b"open", False)
            await asyncio.sleep(0.1)
            await run.open()
            await eventually(lambda: run.posts == [("door", "open")])
            run.end()

        self.assertEqual(self.run_one(script), 0)
        self.assertTrue(any("inputs wait" in remark for remark in self.remarks), self.remarks)

    def test_a_console_that_dies_for_good(self):
        async def script(run):
            await self.opened(run)
            run.die()

        self.assertEqual(self.run_one(script, wait=0.1), 3)
        self.assertIn("the run cannot be reached", self.remarks[-1])

    def test_a_run_that_was_resumed_and_ended_meanwhile(self):
        async def script(run):
            await self.opened(run)
            run.die()
            run.end()

        self.assertEqual(self.run_one(script, wait=0.1), 0)

    def test_a_run_that_cannot_be_followed(self):
        async def script(run):
            run.refusals["follow"] = ("no-journal", "the journal is a pipe")
            await run.open()

        self.assertEqual(self.run_one(script), 3)
        self.assertEqual(self.remarks[-1], "the run cannot be followed: the journal is a pipe")

    def test_a_run_that_ended_between_two_requests(self):
        async def script(run):
            run.refusals["follow"] = ("ended", "the run has ended")
            await run.open()

        self.assertEqual(self.run_one(script), 0)

    def test_wrong_messages_and_refusals_are_remarked_once(self):
        async def script(run):
            await self.opened(run)
            for payload in (b"?", b"!", b'{"smoke": 1}', b'{"smoke": 2}', b'{"smoke": {"level": null}}', b"?"):
                self.broker.hear("harbour/quay", payload, False)
            run.refusals["post"] = ("bad-value", "a latitude in numbers is expected")
            for _ in range(3):
                self.broker.hear("harbour/door", b"open", False)
            await eventually(lambda: any("is refused" in remark for remark in self.remarks))
            await asyncio.sleep(0.05)
            run.end()

        self.assertEqual(self.run_one(script), 0)
        self.assertEqual([r for r in self.remarks if "s for the run at most" not in r], [
            "input 'quay': a message of harbour/quay is not JSON: '?'; others like it are not reported",
            "input 'quay': a message of harbour/quay has no field 'smoke.level': '{\"smoke\": 1}'; others like it are "
            "not reported",
            "input 'quay': a message of harbour/quay has the value null, which programs do not have; others like it "
            "are not reported",
            "input 'door' is refused: a latitude in numbers is expected",
        ])

    def test_too_many_inputs_for_a_run_that_does_not_listen(self):
        self.addCleanup(setattr, posting, "MOST", posting.MOST)
        posting.MOST = 2

        async def script(run):
            await self.opened(run)
            run.die()
            for number in range(4):
                self.broker.hear("harbour/door", b"%d" % number, False)
            await asyncio.sleep(0.05)
            await run.open()
            await eventually(lambda: run.posts == [("door", "2"), ("door", "3")])
            run.end()

        self.assertEqual(self.run_one(script), 0)
        self.assertIn("more than 2 inputs wait for the run; the oldest are dropped", self.remarks)

    def test_a_fault_of_the_bridge_ends_it(self):
        async def script(run):
            await self.opened(run)
            self.addCleanup(setattr, dolphin.Run, "post", dolphin.Run.post)
            dolphin.Run.post = None
            self.broker.hear("harbour/door", b"open", False)

        with self.assertRaises(TypeError):
            self.run_one(script)


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="dolphin-test-")
        self.addCleanup(shutil.rmtree, self.folder)
        self.path = os.path.join(self.folder, "s.yaml")
        self.write(TEXT)

    def write(self, text):
        with open(self.path, "w", encoding="utf-8") as file:
            file.write(text)

    def call(self, *arguments):
        """The exit status, the output, and the errors of a call."""
        output, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
            try:
                status = shell.main(arguments)
            except SystemExit as ended:
                status = ended.code
        return status, output.getvalue(), errors.getvalue()

    def test_a_configuration_is_checked(self):
        self.assertEqual(self.call("--config", self.path, "--check"), (
            0, f"{self.path}: 2 inputs from 2 topics of localhost:1883\n", ""))

    def test_all_faults_of_a_configuration_are_listed(self):
        self.write(TEXT.replace("qos: 2", "qos: 3").replace("every: 10", "every: x"))
        self.assertEqual(self.call("--config", self.path, "--run", "m.run"), (
            2, "", f"{self.path}:3:72: 'every' is a number; this is the text 'x'\n"
            f"{self.path}:4:64: 'qos' is a number from 0 to 2; this is 3\n"))

    def test_options(self):
        for arguments, why in [
            ([], "the following arguments are required: --config"),
            (["--config", self.path], "--run JOURNAL is needed"),
            (["--config", self.path, "--run", "m", "--wait", "-1"], "invalid seconds value: '-1'"),
            (["--config", self.path, "--run", "m", "--wait", "x"], "invalid seconds value: 'x'"),
        ]:
            with self.subTest(arguments=arguments):
                status, _, errors = self.call(*arguments)
                self.assertEqual(status, 2)
                self.assertIn(why, errors)

    def test_help_and_version(self):
        status, output, _ = self.call("--help")
        self.assertEqual(status, 0)
        for word in ("--config", "--run", "--wait", "--check", "docs/mqtt.md", "exit status"):
            self.assertIn(word, output)
        self.assertEqual(self.call("--version")[:2], (0, "dolphin-mqtt 0.1\n"))


if __name__ == "__main__":
    unittest.main()
