"""The adapter as a process: the kit of situations, missions of `dolphin exec` whose adapter and console are killed, TLS
and the terminal. All listen on loopback alone, at ports that the system chooses; each test ends the processes that it
began. DOLPHIN_KILLED is the number of missions that are played with kills."""

import json
import os
import random
import re
import signal
import socket
import subprocess
import sys
import time
import unittest

from eventually import SECONDS, free_port, until
from in_folder import InFolder
from seeds import seeds
from tests.support import beside

ADAPTER = beside("dolphin-people")
DOLPHIN = os.environ["DOLPHIN"]

PEOPLE = """listen: {{port: {port}{more}}}
people:
  ana: {{skills: [crane], position: {{latitude: 41.185, longitude: -8.706}}}}
  bruno: {{skills: [crane], position: {{latitude: 41.185, longitude: -8.706}}}}
instructions:
  short: {{text: short work}}
  long: {{text: long work}}
  "depth_${{place}}": {{text: "Depth at ${{place}}", answer: number, input: depth}}
accept: 20
"""

MISSION = """input 'depth'
people = pick { type 'Human'; count 2; timeout 50.seconds }
def measure(p, place) {
    task("depth_$place")[p] >> waitFor { consume depth: _ } then { d -> action { post got: d } }
}
def all(p, name) { measure(p, "$name-1") >> measure(p, "$name-2") >> measure(p, "$name-3") }
execute all(people[0], 'a') | all(people[1], 'b')
"""


class Case(InFolder):
    def setUp(self):
        super().setUp()
        self.port = free_port()
        self.journal = self.path("m.run")

    def configured(self, more=""):
        return self.write("people.yaml", PEOPLE.format(port=self.port, more=more))

    def links(self):
        """The links by name."""
        printed = subprocess.run(
            [ADAPTER, "--config", self.path("people.yaml"), "--links"], stdout=subprocess.PIPE, text=True, check=True)
        return dict(re.findall(r"^(\w+): (\S+)$", printed.stdout, re.MULTILINE))

    def crew(self):
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join([beside("."), beside("../../python")])}
        self.start(
            "crew.txt", sys.executable, "-B", beside("tests/crew.py"), *self.links().values(), env=environment)

    def exec(self, option="--journal"):
        command = f"echo $$ > pid; exec '{ADAPTER}' --config people.yaml --run m.run"
        return self.start(
            "exec.txt", DOLPHIN, "exec", self.write("m.dol", MISSION), "--platform", command, option, self.journal,
            adds=True, cwd=self.folder)

    def records(self):
        return [json.loads(line) for line in self.text("m.run").splitlines() if line.endswith("}")]

    def endings(self):
        return [each["ending"] for each in self.records() if each.get("kind") == "end"]

    def depths(self):
        return [(each["key"], each["value"]) for each in self.records() if each.get("event") == "input"]


class Kit(Case):
    def test_every_situation(self):
        self.configured()
        self.crew()
        done = subprocess.run(
            [DOLPHIN, "platform", "check", f"'{ADAPTER}' --config people.yaml"], stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("after its death reports the outcome of a plan that ran", done.stdout)


class Missions(Case):
    def test_adapters_and_consoles_that_die(self):
        """The answers of people come once each, and each instruction is given once, whatever dies when."""
        for seed in seeds(int(os.environ.get("DOLPHIN_KILLED", "2"))):
            with self.subTest(seed=seed):
                self.setUp()
                self.play(random.Random(seed))
                self.doCleanups()

    def play(self, draw):
        self.configured()
        self.crew()
        console = self.exec()
        for _ in range(draw.randint(1, 4)):
            time.sleep(draw.uniform(0.1, 1.5))
            if console.poll() is None and draw.random() < 0.5:
                self.kill_adapter()
            else:
                console.kill()
                if self.is_over(console):
                    break
                console = self.go_on()
        while not self.is_over(console):
            console = self.go_on()
        said = self.text("exec.txt") + self.text("crew.txt") + self.text("m.run")
        self.assertEqual(self.endings(), ["completed"], said)
        self.assertEqual(sorted(self.depths()), sorted([("depth", 1), ("depth", 2), ("depth", 3)] * 2), said)
        starts = [each["label"] for each in self.records() if each.get("label", "").startswith("start(")]
        self.assertEqual(len(starts), 6, said)

    def go_on(self):
        return self.exec("--resume" if self.text("m.run") else "--journal")

    def is_over(self, console):
        """Whether the run is over, once its console has ended. If not, it was killed, or its adapter was early on."""
        until(lambda: console.poll() is not None, lambda: self.text("exec.txt") + self.text("crew.txt"))
        if self.endings():
            return True
        if console.returncode != -signal.SIGKILL:
            self.assertIn("before it greeted", self.text("exec.txt"))
        return False

    def kill_adapter(self):
        """Kills the adapter of the run, if there is one: by its number, which it has written."""
        try:
            os.kill(int(self.text("pid")), signal.SIGKILL)
        except (ValueError, ProcessLookupError):
            pass


class Terminals(Case):
    def converse(self, link, *more):
        """A person at a terminal, with a function that sends a line once the output has a text."""
        terminal = self.start("terminal.txt", ADAPTER, "--terminal", link, *more, stdin=subprocess.PIPE)
        self.addCleanup(terminal.stdin.close)

        def once(text, line):
            until(lambda: text in self.text("terminal.txt"), lambda: self.text("terminal.txt") + self.text("exec.txt"))
            terminal.stdin.write(line.encode() + b"\n")
            terminal.stdin.flush()

        return terminal, once

    def play(self, link, *more):
        self.write(
            "one.dol", "input 'depth'\nv = pick { id 'ana'; timeout 50.seconds }\nexecute v: task('depth_quay')\n")
        command = f"'{ADAPTER}' --config people.yaml --run m.run"
        console = self.start(
            "exec.txt", DOLPHIN, "exec", self.path("one.dol"), "--platform", command, "--journal", self.journal,
            cwd=self.folder)
        terminal, once = self.converse(link, *more)
        once("NEW: Depth at quay", "accept")
        once("YOURS: Depth at quay", "done deep")
        once("give a number", "done 12.5")
        self.assertEqual(console.wait(SECONDS), 0, self.text("exec.txt"))
        self.assertEqual(self.depths(), [("depth", 12.5)])
        once("no connection since", "quit")
        self.assertEqual(terminal.wait(SECONDS), 0)

    def test_an_instruction_at_a_terminal(self):
        self.configured()
        self.play(self.links()["ana"])

    def test_over_tls(self):
        subprocess.run(
            ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-keyout", self.path("key.pem"), "-out",
             self.path("cert.pem"), "-days", "2", "-subj", "/CN=localhost", "-addext", "subjectAltName=DNS:localhost"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
        self.configured(", name: localhost, certificate: cert.pem, key: key.pem")
        link = self.links()["ana"]
        self.assertTrue(link.startswith("https://localhost:"), link)
        self.play(link, "--cafile", self.path("cert.pem"))

    def test_a_link_that_is_not_known(self):
        self.configured()
        console = self.exec()
        link = re.sub("#.*", "#" + "0" * 32, self.links()["ana"])
        terminal, once = self.converse(link)
        once("the link is not known", "accept")
        self.assertEqual(terminal.wait(SECONDS), 2)
        console.send_signal(signal.SIGINT)
        console.wait(SECONDS)

    def test_options_that_are_not_right(self):
        for arguments, text in (
                (["--config", "none.yaml", "--check"], "none.yaml:1:1: cannot be read: No such file or directory"),
                ([], "--config FILE is needed"), (["--terminal", "ship.local"], "'ship.local' is not a link")):
            done = subprocess.run([ADAPTER, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self.assertEqual((done.returncode, text in done.stderr), (2, True), done.stderr)

    def test_two_adapters_at_one_port(self):
        self.configured()
        with socket.socket() as other:
            other.bind(("127.0.0.1", self.port))
            other.listen()
            console = self.exec()
            self.assertEqual(console.wait(SECONDS), 3)
        self.assertIn(f"cannot listen at 127.0.0.1:{self.port}: Address already in use", self.text("exec.txt"))


if __name__ == "__main__":
    unittest.main()
