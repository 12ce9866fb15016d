"""The examples of docs/python.md and of the package's docstrings have the results that they show."""

import doctest
import importlib
import os
import pkgutil
import re
import runpy
import signal
import subprocess
import sys
import unittest

import dolphin
from dolphin import command
from tests.support import HERE, InFolder

PAGE = os.path.join(HERE, "..", "..", "docs", "python.md")
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
NAME = re.compile(r"^# (\w+\.py)$", re.MULTILINE)


class Page(InFolder):
    examples = ["rendezvous.dol", "rendezvous.fleet", "abort.dol", "abort.fleet"]

    def setUp(self):
        super().setUp()
        with open(PAGE, encoding="utf-8") as file:
            self.blocks = BLOCK.findall(file.read())
        self.files = {}
        for language, text in self.blocks:
            name = NAME.search(text) if language == "python" else None
            if name:
                self.files[name[1]] = self.write(name[1], text)
        self.environment = {**os.environ, "PYTHONPATH": os.path.abspath(os.path.join(HERE, ".."))}

    def call(self, *words):
        done = subprocess.run(
            words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            env=self.environment)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_the_files(self):
        self.assertEqual(
            sorted(self.files),
            ["boats.py", "over_http.py", "supply.py", "test_on_fakes.py", "test_rendezvous.py", "watch.py"])

    def test_the_adapter_passes_the_kit(self):
        situations = ["greeting", "completion", "stop", "refusal", "killed", "close"]
        words = [word for name in situations for word in ("--only", name)]
        self.call(command.find(), "platform", "check", *words, f"{sys.executable} boats.py")

    def test_the_supplier(self):
        self.write("supplied.dol", "s = getSupplier()\nv = pick { type 'UUV' }\n"
                                   "while (s.active()) { execute v: s.await() }\n")
        shown = self.call(command.find(), "exec", "supplied.dol", "--supplier", f"{sys.executable} supply.py")
        self.assertIn("ends survey2", shown)

    def test_the_run(self):
        shown = next(text for (before, (kind, text)) in zip(self.blocks, self.blocks[1:])
                     if kind == "text" and "# watch.py" in before[1])
        self.assertEqual(self.call(sys.executable, "watch.py"), shown)

    def test_the_client_of_a_console(self):
        server = subprocess.Popen(
            [command.find(), "console", ".", "--port", "0", "--no-browser"], stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True,
            env={**os.environ, "XDG_STATE_HOME": self.folder})
        try:
            link = None
            while link is None:
                line = server.stdout.readline()
                self.assertTrue(line, "the console ended")
                link = re.search(r"http://\S+", line)
            self.assertIn("ends survey3", self.call(sys.executable, "over_http.py", link[0]))
        finally:
            server.send_signal(signal.SIGINT)
            server.communicate(timeout=60)

    def test_the_dialogues(self):
        parser, runner, names = doctest.DocTestParser(), doctest.DocTestRunner(verbose=False), {}
        dialogues = [text for language, text in self.blocks if language == "python" and text.startswith(">>>")]
        self.assertEqual(len(dialogues), 3)
        for number, text in enumerate(dialogues):
            test = parser.get_doctest(text, names, f"dialogue {number}", "docs/python.md", 0)
            shown = []
            runner.run(test, out=shown.append, clear_globs=False)
            names = test.globs
            self.assertEqual("".join(shown), "")

    def test_the_tests(self):
        program = next(text for language, text in self.blocks if language == "groovy")
        self.write("boats.dol", program)
        tests = runpy.run_path(os.path.join(self.folder, "test_rendezvous.py"))
        tests["test_every_run"]()
        tests["test_no_fault_leads_to_a_deadlock"]()
        on_fakes = runpy.run_path("test_on_fakes.py")
        on_fakes["test_the_other_boat_goes_on"](lambda program, fleet: dolphin.execute(program, fleet=fleet))


class Docstrings(unittest.TestCase):
    def test_their_examples(self):
        examples = 0
        for module in pkgutil.iter_modules(dolphin.__path__):
            if module.name != "pytest_plugin":
                loaded = importlib.import_module(f"dolphin.{module.name}")
                self.assertTrue(loaded.__doc__, module.name)
                found = doctest.testmod(loaded)
                self.assertEqual(found.failed, 0, module.name)
                examples += found.attempted
        self.assertGreaterEqual(examples, 8)


class Types(unittest.TestCase):
    def test_all_names_are_there_and_documented(self):
        for name in dolphin.__all__:
            self.assertTrue(getattr(dolphin, name).__doc__, name)

    def test_the_version_is_that_of_the_command(self):
        self.assertEqual(command.call(["--version"]).stdout.strip(), dolphin.__version__)


if __name__ == "__main__":
    unittest.main()
