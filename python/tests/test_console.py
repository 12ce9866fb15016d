"""The client of the console, with a console."""

import os
import re
import signal
import subprocess
import unittest

import dolphin
from dolphin import command
from tests.support import InFolder

PROGRAM = """
input 'go'
x = ask 'How many?'
message "$x"
execute condition { consume go: 'south' }
"""


class AConsole(InFolder):
    options = []

    def setUp(self):
        super().setUp()
        self.write("mission.dol", PROGRAM)
        self.write("mission.fleet", "answer 'How many?', 2\n")
        self.write("wrong.dol", "message askk\n")
        environment = {**os.environ, "XDG_STATE_HOME": self.folder, "XDG_CONFIG_HOME": self.folder}
        self.server = subprocess.Popen(
            [command.find(), "console", ".", "--port", "0", "--no-browser", *self.options], stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment, start_new_session=True)
        self.addCleanup(self.end)
        self.links = []
        shown = ""
        while len(self.links) < self.wanted:
            line = self.server.stdout.readline()
            self.assertTrue(line, shown)
            shown += line
            self.links += re.findall(r"https?://\S+", line)

    wanted = 1

    def end(self):
        self.server.send_signal(signal.SIGINT)
        self.server.communicate(timeout=60)


class Local(AConsole):
    def test_a_run(self):
        console = dolphin.Console(self.links[0])
        self.assertIn("mission.dol", console.get("files")["programs"])
        events = console.events()
        self.assertEqual(next(events).kind, "role")
        run = console.start("mission.dol", speed=60, people=True)
        kinds, messages, posted, answered = set(), [], False, False
        for event in events:
            kinds.add(event.kind)
            if event.kind == "log":
                messages.append(event.data["text"])
            if event.kind == "status":
                state = event.data["run"] or {"question": None, "state": "none"}
                if state["question"] and not answered:
                    answered = True
                    self.assertEqual(state["question"]["prompt"], "How many?")
                    console.answer(state["question"]["number"], "7")
                if state["state"] == "over":
                    break
            if event.kind == "waiting" and event.data["for"] and not posted:
                posted = True
                console.post_input("go", "south")
        self.assertLessEqual({"run", "journal", "log", "status", "waiting"}, kinds)
        self.assertTrue(any("7" in text for text in messages), messages)
        self.assertEqual(console.status()["run"]["outcome"]["how"], "completed")
        self.assertTrue(run)

    def test_refusals(self):
        console = dolphin.Console(self.links[0])
        with self.assertRaises(dolphin.ConsoleRefused) as refused:
            console.start("wrong.dol")
        self.assertEqual(refused.exception.status, 422)
        self.assertTrue(refused.exception.reply["error"])
        with self.assertRaises(dolphin.ConsoleRefused) as refused:
            console.get("file", path="../mission.dol")
        self.assertTrue(refused.exception.code)
        text = console.get("file", path="mission.dol")
        self.assertEqual(text["text"], PROGRAM)
        console.put("file", {"path": "mission.dol", "text": "message 1\n", "hash": text["hash"]})
        with self.assertRaises(dolphin.ConsoleRefused) as refused:
            console.put("file", {"path": "mission.dol", "text": "", "hash": text["hash"]})
        self.assertEqual(refused.exception.status, 409)
        console.delete("exploration")


class WithTokens(AConsole):
    options = ["--listen", "127.0.0.1"]
    wanted = 2

    def test_links_with_tokens_and_fingerprints(self):
        links = [link for link in self.links if "token=" in link]
        steers = dolphin.Console(links[0])
        steers.start("mission.dol", speed=60)
        steers.stop()
        watches = dolphin.Console(links[1])
        with self.assertRaises(dolphin.ConsoleRefused) as refused:
            watches.stop()
        self.assertEqual((refused.exception.status, refused.exception.code), (403, "watches"))
        place, _, digest = links[0].partition("#sha256=")
        another = digest[:-1] + ("0" if digest[-1] != "0" else "1")
        with self.assertRaisesRegex(dolphin.DolphinError, "certificate"):
            dolphin.Console(f"{place}#sha256={another}").status()
        with self.assertRaises(dolphin.DolphinError):
            dolphin.Console(place).status()
        with self.assertRaises(dolphin.ConsoleRefused) as refused:
            dolphin.Console(f"{place.partition('?')[0]}#sha256={digest}").status()
        self.assertEqual(refused.exception.status, 401)


class Nowhere(unittest.TestCase):
    def test_links(self):
        with self.assertRaises(ValueError):
            dolphin.Console("mission.dol")
        with self.assertRaisesRegex(dolphin.DolphinError, "cannot be reached"):
            dolphin.Console("http://127.0.0.1:1").status()


if __name__ == "__main__":
    unittest.main()
