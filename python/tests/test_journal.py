"""Journals as records."""

import json
import os
import subprocess
import unittest

import dolphin
from dolphin import command
from tests.support import InFolder


class Journals(InFolder):
    examples = ["rendezvous.dol", "rendezvous.fleet", "watch.dol", "watch.fleet", "abort.dol", "abort.fleet"]

    def test_records(self):
        journal = dolphin.execute("rendezvous.dol", journal="r.run")
        self.assertEqual((journal.header.program, journal.header.platform), ("rendezvous.dol", "sim"))
        self.assertTrue(journal.completed)
        self.assertEqual(journal.messages(), ["Done!"])
        self.assertEqual(len(journal.of(dolphin.Transition)), 35)
        self.assertEqual(sorted(journal.tracks()), ["noptilus-1", "noptilus-2", "noptilus-3", "x8-02"])
        answer = journal.of(dolphin.Event)[0]
        self.assertEqual((answer.event, answer.value), ("answer", "2"))
        self.assertEqual([r.raw for r in dolphin.read("r.run")], [r.raw for r in journal])

    def test_tasks(self):
        journal = dolphin.execute("rendezvous.dol")
        tasks = {(task.vehicle, task.plan): task for task in journal.tasks()}
        self.assertEqual(len(tasks), 9)
        self.assertEqual({task.outcome for task in tasks.values()}, {"done"})
        labels = {t.label: t.time for t in journal.of(dolphin.Transition)}
        for (vehicle, plan), task in tasks.items():
            self.assertEqual(task.start, labels[f"start({vehicle}, {plan})"])
            self.assertEqual(task.end, labels[f"done({vehicle}, {plan})"])

    def test_tasks_that_fail_and_are_stopped(self):
        self.write("m.dol", """
            v = pick { type 'UUV' }
            watch_it = during 10.seconds run task('long')
            execute v: watch_it
            execute v: watch task('bad') onError { why -> ignore() }
        """)
        self.write("m.fleet", """
            vehicle 'a', { type 'UUV' }
            plan 'long', { duration 5.min }
            plan 'bad', { fails }
        """)
        outcomes = [(task.plan, task.outcome, task.why) for task in dolphin.execute("m.dol").tasks()]
        self.assertEqual(outcomes[0], ("long", "stopped", None))
        self.assertEqual(outcomes[1][:2], ("bad", "failed"))
        self.assertTrue(outcomes[1][2])

    def test_a_torn_line_is_left_out(self):
        journal = dolphin.execute("rendezvous.dol", journal="r.run")
        with open("r.run", "rb") as file:
            data = file.read()
        with open("torn.run", "wb") as file:
            file.write(data[:-20])
        torn = dolphin.read("torn.run")
        self.assertEqual(len(torn), len(journal) - 1)
        self.assertIsNone(torn.end)

    def test_files_that_are_not_journals(self):
        for text in ["", "{}\n", "hello\n", '{"format":"dolphin-journal","version":2}\n',
                     '{"format":"dolphin-journal","version":1}\n']:
            self.write("x.run", text)
            with self.assertRaises(dolphin.JournalError, msg=text):
                dolphin.read("x.run")

    def test_a_journal_that_is_written_again_is_one_of_the_same_run(self):
        dolphin.execute("rendezvous.dol", journal="r.run").write("again.run")
        checked = command.call(["trace", "check", "rendezvous.dol", "again.run"])
        self.assertEqual(checked.status, 0, checked.stderr)

    def test_geojson_and_pictures_also_of_a_run_without_a_file(self):
        journal = dolphin.execute("rendezvous.dol")
        self.assertFalse(os.path.exists(journal.path))
        features = journal.geojson()["features"]
        lines = [f for f in features if f["geometry"] and f["geometry"]["type"].endswith("LineString")]
        self.assertEqual(len(lines), 4)
        self.assertIn("<svg", journal._repr_svg_())

    def test_every_line_of_every_example_is_a_record(self):
        folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples")
        seen = set()
        for name in sorted(os.listdir(folder)):
            if name.endswith(".dol"):
                done = subprocess.run(
                    [command.find(), "exec", os.path.join(folder, name), "--journal", name + ".run"],
                    stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                if os.path.exists(name + ".run"):
                    journal = dolphin.read(name + ".run")
                    self.assertIsNotNone(journal.end, (name, done.stderr))
                    self.assertEqual(journal.of(dolphin.Other), [], name)
                    self.assertTrue(all(task.outcome for task in journal.tasks()) or not journal.completed, name)
                    seen |= {type(record) for record in journal}
        self.assertEqual(seen, {dolphin.Header, dolphin.Sighting, dolphin.Event, dolphin.Transition, dolphin.End})

    def test_records_of_other_kinds(self):
        lines = [{"kind": "platform", "time": 3, "vehicle": "a", "note": {}}, {"kind": "later", "time": 4}]
        for line in lines:
            found = dolphin.journal.record(line)
            self.assertEqual((type(found), found.raw), (dolphin.Other, line))
        self.assertIsInstance(dolphin.journal.record({"kind": "resumed", "time": 3}), dolphin.Resumed)
        with self.assertRaisesRegex(dolphin.JournalError, "ending"):
            dolphin.journal.record(json.loads('{"kind": "end", "time": 3}'))


if __name__ == "__main__":
    unittest.main()
