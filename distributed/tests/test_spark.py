"""Searches and simulated runs on Spark: examples in local[2]; a driver that is killed, and the search resumed; a worker
of a cluster on loopback that is killed on the way. Run by the Python that distributed/install prints. DOLPHIN is the
command."""

import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
EXPLORE = os.path.join(HERE, "..", "explore.py")
RUNS = os.path.join(HERE, "..", "runs.py")
DOLPHIN = os.environ.get("DOLPHIN", "dolphin")
EXAMPLES = os.path.join(HERE, "..", "..", "examples")
CASES = [("rendezvous", []), ("supplier", ["--faults", "fail=1"]), ("watch", ["--faults", "fail"]), ("rotation", [])]


def command(name, *options):
    program = os.path.join(EXAMPLES, name + ".dol")
    return [sys.executable, EXPLORE, program, "--dolphin", DOLPHIN, *options]


def expected(name, options):
    program = os.path.join(EXAMPLES, name + ".dol")
    return json.loads(subprocess.run([DOLPHIN, "explore", program, "--json", *options], stdout=subprocess.PIPE).stdout)


class Spark(unittest.TestCase):
    def agrees(self, output, found):
        counts = re.search(r"(\d+) states, (\d+) transitions, depth (\d+)", output)
        self.assertIsNotNone(counts, output)
        self.assertEqual(tuple(map(int, counts.groups())), (found["states"], found["transitions"], found["depth"]))
        told = dict(re.findall(r"^(?:note: )?([a-z ]+): (holds|violated|inconclusive)", output, re.M))
        for verdict in found["verdicts"]:
            name = verdict["property"]
            if name in told and told[name] != "inconclusive":
                self.assertEqual(verdict["verdict"], told[name], name)
            if name == "all code reached":
                self.assertEqual(verdict["verdict"] == "violated", "no run reaches" in output)

    def test_examples(self):
        for name, options in CASES:
            for reduction in ("none", "por"):
                with self.subTest(name, options=options, reduction=reduction):
                    chosen = options + ["--reduction", reduction]
                    run = subprocess.run(command(name, "--width", "8", "--partitions", "2", *chosen),
                                         stdout=subprocess.PIPE, text=True)
                    self.agrees(run.stdout, expected(name, chosen))

    def test_runs(self):
        """Simulated runs made in parts are those of one process."""
        options = [os.path.join(EXAMPLES, "goals.dol"), "--runs", "1000", "--seed", "7", "--json"]
        spark = [sys.executable, RUNS, *options, "--dolphin", DOLPHIN, "--part", "30"]
        found = [json.loads(subprocess.run(command, stdout=subprocess.PIPE).stdout)
                 for command in (spark, [DOLPHIN, "exec", *options])]
        for answer in found:
            del answer["elapsed"]
        self.assertEqual(found[0], found[1])

    def test_runs_of_nothing(self):
        """Dolphin reports the faults of a program before Spark begins."""
        run = subprocess.run([sys.executable, RUNS, "none.dol", "--runs", "10", "--dolphin", DOLPHIN],
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertEqual(run.stderr, "dolphin: none.dol: No such file or directory\n")

    def test_cycles(self):
        """Runs without end: states without successors are removed until cycles are left, or nothing."""
        for turns, verdict in (("true", "violated"), ("n < 4", "holds")):
            with self.subTest(turns), tempfile.TemporaryDirectory() as folder:
                program = os.path.join(folder, "turns.dol")
                with open(program, "w") as text:
                    text.write("v = pick { count 1 }\nn = 0\nwhile (%s) {\n  n = (n + 1) %% 5\n" % turns)
                    text.write("  execute imcPlan('a') | action { post x: 1 }\n  consume x: 1\n}\n")
                run = subprocess.run([sys.executable, EXPLORE, program, "--dolphin", DOLPHIN, "--width", "2",
                                      "--partitions", "2"], stdout=subprocess.PIPE, text=True)
                self.assertIn("termination: " + verdict, run.stdout)

    def started(self, *options):
        return subprocess.Popen(command("rendezvous", "--width", "100", "--partitions", "3", *options),
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)

    def at_level(self, process, levels):
        """Waits until the search has reported this many levels."""
        for line in process.stderr:
            levels -= line.startswith("depth ")
            if levels == 0:
                return
        self.fail("the search ended early")

    def test_driver_killed(self):
        with tempfile.TemporaryDirectory() as folder:
            first = self.started("--folder", folder)
            self.at_level(first, 4)
            os.killpg(first.pid, signal.SIGKILL)
            first.communicate()
            resumed = ["--folder", folder, "--resume"]
            run = subprocess.run(command("rendezvous", *resumed), stdout=subprocess.PIPE, text=True)
            self.agrees(run.stdout, expected("rendezvous", ["--reduction", "none"]))
            other = subprocess.run(command("parallel", *resumed), stderr=subprocess.PIPE, text=True)
            self.assertIn("is the search of something else", other.stderr)

    def test_worker_killed(self):
        with Cluster() as cluster, tempfile.TemporaryDirectory() as folder:
            run = self.started("--folder", folder, "--master", cluster.master)
            self.at_level(run, 4)
            cluster.kill_worker()
            output, _ = run.communicate()
            self.agrees(output, expected("rendezvous", ["--reduction", "none"]))


class Cluster:
    """A master and two workers of a core each, on loopback."""

    def __enter__(self):
        import pyspark
        self.folder = tempfile.TemporaryDirectory()
        home = os.path.dirname(pyspark.__file__)
        spark = os.path.join(home, "bin", "spark-class")
        environment = dict(os.environ, SPARK_LOCAL_IP="127.0.0.1", SPARK_HOME=home, SPARK_WORKER_DIR=self.folder.name)

        def start(name, *arguments):
            with open(os.path.join(self.folder.name, name), "w") as log:
                return subprocess.Popen([spark, *arguments], env=environment, stdout=log, stderr=log,
                                        start_new_session=True)

        deploy = "org.apache.spark.deploy."
        self.processes = [start("master", deploy + "master.Master", "--host", "127.0.0.1", "--port", "0",
                                "--webui-port", "0")]
        self.master = self.wait("master", r"Starting Spark master at (spark://\S+)")
        for i in (1, 2):
            self.processes.append(start("worker%d" % i, deploy + "worker.Worker", "--cores", "1", "--memory", "1g",
                                        "--host", "127.0.0.1", "--webui-port", "0", self.master))
        for i in (1, 2):
            self.wait("worker%d" % i, r"(Successfully registered with master)")
        return self

    def wait(self, name, pattern):
        for _ in range(1200):
            with open(os.path.join(self.folder.name, name)) as log:
                found = re.search(pattern, log.read())
            if found:
                return found.group(1)
            time.sleep(0.1)
        raise RuntimeError("the cluster does not start")

    def kill_worker(self):
        os.killpg(self.processes[2].pid, signal.SIGKILL)

    def __exit__(self, *_):
        for process in self.processes:
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            process.wait()
        self.folder.cleanup()


if __name__ == "__main__":
    unittest.main()
