"""The adapter on ROS 2 itself, with simulated robots and the command: DOLPHIN. For scripts/nightly: it takes minutes.

DOLPHIN_KILLS is the number of kills of each kind; DOLPHIN_KILLS_ADAPTERS, _CONSOLES, _ROBOTS and _PARTITIONS are those
of one kind. Partitions of the network need network namespaces: root, and the command `ip`. DOLPHIN_ROS2_PARTNER is a
program with an action server of others, to try the adapter on: NAME TYPE COMMAND, such as `fibonacci
test_msgs/action/Fibonacci python3 server.py`."""

import os
import random
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time
import unittest

from in_folder import InFolder

FOLDER = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
DOLPHIN = os.environ.get("DOLPHIN", "dolphin")
DOMAIN = 1 + os.getpid() % 100
KILLS = os.environ.get("DOLPHIN_KILLS", "3")
SEED = int(os.environ.get("DOLPHIN_SEED", "0"))
PATIENCE = 60.0

ROBOTS = f"""\
domain: {DOMAIN}
answer: 3
origin: {{latitude: 41.185, longitude: -8.706}}
kinds:
  carrier:
    type: UGV
    position: {{topic: odom, type: nav_msgs/msg/Odometry}}
    battery: {{topic: battery_state}}
    readings: {{Load: {{topic: load, type: std_msgs/msg/Float64, field: data}}}}
    plans:
      short: {{action: work, type: test_msgs/action/Fibonacci, goal: {{order: 5}}}}
      long: {{action: work, type: test_msgs/action/Fibonacci, goal: {{order: 100000}}}}
      tare: {{service: tare}}
      jam: {{service: jam}}
""" + "".join(
    f"      '{action}_${{tenths}}': {{action: {action}, type: test_msgs/action/Fibonacci, "
    "goal: {order: '${tenths}'}, "
    "result: {field: 'sequence[0]', done: [0], words: {7: the bay is occupied, 9: lost its way}}}\n"
    for action in ("work", "occupied", "reject", "abort", "mute", "slow", "deaf", "lazy")
) + """\
robots:
  carrier-1: {kind: carrier, namespace: /carrier1}
  carrier-2: {kind: carrier, namespace: /carrier2}
"""


class Case(InFolder):
    robots = ROBOTS
    prefix = []
    """The words before each command."""

    def setUp(self):
        super().setUp()
        self.config, self.began = self.path("robots.yaml"), self.path("began")
        self.write("robots.yaml", self.robots)
        self.environment = dict(
            os.environ, ROS_DOMAIN_ID=str(DOMAIN), ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST",
            FASTDDS_BUILTIN_TRANSPORTS="UDPv4", DOLPHIN_ROS2=sys.executable, PYTHONPATH=FOLDER)
        self.adapter = f"{shlex.quote(os.path.join(FOLDER, 'dolphin-ros2'))} --config {shlex.quote(self.config)}"

    def spawn(self, command, **more):
        process = subprocess.Popen([*self.prefix, *command], env=self.environment, start_new_session=True, **more)
        self.addCleanup(self.kill, process)
        return process

    def kill(self, process):
        if process.poll() is None:
            process.kill()
        process.wait(10)

    def simulate(self, *namespaces):
        process = self.spawn(
            [sys.executable, "-B", "-m", "sim", "--stay", "--began", self.began,
             *(namespaces or ("/carrier1", "/carrier2"))], stdout=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True)
        process.stdout.readline()
        process.stdout.close()
        return process

    def execute(self, program, *options):
        self.write("mission.dol", program)
        return subprocess.run(
            [DOLPHIN, "exec", self.path("mission.dol"), "--platform", self.adapter, *options],
            env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300)

    def events(self, event="begins"):
        """The goals with this event, as (robot, action, goal)."""
        if not os.path.exists(self.began):
            return []
        with open(self.began, encoding="utf-8") as file:
            lines = [line.split() for line in file]
        return [(robot, action, goal) for _, robot, action, goal, what in lines if what == event]


ONE = "v = pick { id 'carrier-1'; timeout 20.seconds }\n"


MANEUVERS = """\
    maneuvers:
      goTo: {action: work, type: test_msgs/action/Fibonacci, goal: {order: 3}}
      wait: {action: work, type: test_msgs/action/Fibonacci, goal: {order: '${seconds}'}}
"""
INLINE = """\
tour = imcPlan { planName 'tour'; z 0; speed 1.0, Speed.Units.METERS_PS
    locate location(41.1851, -8.7060); goTo(); move 20, 0; goTo(); loiter duration: 4 }
far = imcPlan { planName 'far'; speed 1.0, Speed.Units.METERS_PS; locate location(41.1851, -8.7060); yoyo() }
"""
LISTENER = """\
import sys
import rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("listener")
for topic in sys.argv[1:]:
    node.create_subscription(String, topic, lambda message, topic=topic: print(topic, message.data, flush=True), 100)
rclpy.spin(node)
"""
MANAGED = """\
import sys
import time
import rclpy
from rclpy.lifecycle import LifecycleNode
rclpy.init()
node = LifecycleNode("driver", namespace="/carrier1")
node.trigger_configure()
end = time.monotonic() + float(sys.argv[1])
while time.monotonic() < end:
    rclpy.spin_once(node, timeout_sec=0.1)
node.trigger_activate()
rclpy.spin(node)
"""


class Robots(Case):
    def test_the_kit_of_situations(self):
        self.simulate()
        run = subprocess.run(
            [DOLPHIN, "platform", "check", self.adapter], env=self.environment, stdout=subprocess.PIPE, text=True,
            timeout=600)
        self.assertEqual(run.returncode, 0, run.stdout)
        self.assertIn("22 of 22 situations passed", run.stdout)

    def test_plans_and_their_reasons(self):
        self.simulate("/carrier1")
        for plan, why in [
            ("work_3", None), ("tare", None), ("slow_1", None),
            ("occupied_2", "the bay is occupied"), ("abort_4", "lost its way"), ("jam", "The gripper is jammed"),
            ("reject_1", "its action reject rejects the goal"),
            ("work_x", "plan 'work_x': order: 'x' is not a whole number"),
            ("mute_1", "its action mute has not answered the goal for 3 seconds"),
        ]:
            with self.subTest(plan=plan):
                run = self.execute(ONE + f"execute v: task('{plan}')\n")
                if plan == "mute_1":  # it is never certain that the goal will not begin
                    self.assertIn("may still run", run.stdout)
                if why is None:
                    self.assertIn(f"ends {plan}", run.stdout)
                else:
                    self.assertIn(why, run.stdout)

    def test_stops(self):
        self.simulate("/carrier1")
        for action, word in (("work", "is-cancelled"), ("lazy", "is-cancelled")):
            with self.subTest(action=action):
                run = self.execute(ONE + f"execute task('{action}_9000')[v] during 2.seconds\nmessage 'home'\n")
                self.assertEqual(run.returncode, 0, run.stdout)
                self.assertEqual(len(self.events(word)), len(self.events()))
        run = self.execute(ONE + "execute task('deaf_80')[v] during 1.seconds\n")
        self.assertIn("may still run plan deaf_80", run.stdout)

    def test_bad_configurations(self):
        for old, new, why in [
            ("goal: {order: 5}", "goal: {oder: 5}", "Fibonacci_Goal has no field 'oder'; did you mean 'order'?"),
            ("short: {action: work, type: test_msgs/action/Fibonacci",
             "short: {action: spin, type: nav2_msgs/action/Spin",
             "source the workspace that has it"),
            ("topic: odom", "topic: 'od om'", "is not the name of a topic"),
        ]:
            with self.subTest(new=new):
                self.write("robots.yaml", ROBOTS.replace(old, new, 1))
                run = self.execute(ONE)
                self.assertEqual(run.returncode, 3, run.stdout)
                self.assertNotIn("Traceback", run.stdout)
                self.assertRegex(run.stdout, r"robots\.yaml:\d+:\d+: ")
                self.assertIn(why, run.stdout)

    def test_inputs(self):
        """The load of a carrier while it works, from its topic."""
        load = "{topic: /carrier1/load, type: std_msgs/msg/Float64, field: data}"
        self.write("robots.yaml", ROBOTS + f"inputs:\n  load: {load}\n")
        self.simulate("/carrier1")
        self.adapter += f" --run {self.path('run')}"
        run = self.execute(
            "input 'load'\n" + ONE + "execute v: task('work_20')\nexecute waitFor { consume load: 1.0 } then "
            "action { message 'was loaded' }\n", "--journal", self.path("run"))
        self.assertIn("was loaded", run.stdout)

    def test_plans_that_the_program_describes(self):
        self.write("robots.yaml", ROBOTS.replace("robots:\n", MANEUVERS + "robots:\n"))
        self.simulate("/carrier1")
        run = self.execute(INLINE.replace("far", "f") + ONE + "execute v: tour\nmessage 'toured'\n")
        self.assertIn("toured", run.stdout)
        self.assertEqual(len(self.events("ends")), 4)
        self.write("far.fleet", "vehicle 'carrier-1', { type 'UGV'; at 41.185, -8.706; speed 1 }\n")
        checked = subprocess.run(
            [DOLPHIN, "check", self.write("far.dol", INLINE + ONE + "execute v: far\n"), "--platform", self.adapter],
            env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=60)
        self.assertEqual(checked.returncode, 2, checked.stdout)
        self.assertIn("its robots have no yoyo", checked.stdout)

    def test_the_building(self):
        """The carriers of the example share a lift and a charger; each delivery is made once."""
        with open(os.path.join(FOLDER, "example", "building.yaml"), encoding="utf-8") as file:
            self.write("robots.yaml", file.read().replace("domain: 42", f"domain: {DOMAIN}"))
        self.simulate("/carrier1", "/carrier2", "/lift1")
        with open(os.path.join(FOLDER, "example", "building.dol"), encoding="utf-8") as file:
            run = self.execute(file.read())
        self.assertIn("3 of 3 parcels are delivered", run.stdout)
        for room in ("ward", "office", "lab"):
            self.assertEqual(run.stdout.count(f"{room} has its parcel"), 1, run.stdout)

    def test_a_node_that_is_not_active(self):
        self.write("robots.yaml", ROBOTS.replace("    plans:\n", "    ready: {lifecycle: driver}\n    plans:\n", 1))
        self.simulate("/carrier1")
        self.spawn([sys.executable, "-c", MANAGED, "6"], stdin=subprocess.DEVNULL)
        run = self.execute(ONE.replace("20", "4"))
        self.assertIn("its node /carrier1/driver is inactive", run.stdout)
        run = self.execute(ONE + "message 'ready'\n")
        self.assertIn("ready", run.stdout)

    def test_outputs(self):
        """A node hears the messages and posts of a run, each once."""
        self.write("robots.yaml", ROBOTS + "outputs: {messages: dolphin/messages, posts: dolphin/posts}\n")
        self.simulate("/carrier1")
        heard = open(self.path("heard"), "w+", encoding="utf-8")
        self.addCleanup(heard.close)
        self.spawn([sys.executable, "-c", LISTENER, "/dolphin/messages", "/dolphin/posts"], stdout=heard)
        self.adapter += f" --run {self.path('run')}"
        self.execute(ONE + "execute v: task('work_20')\npost bay: 3\nmessage 'loaded'\nexecute v: task('work_5')\n",
                     "--journal", self.path("run"))
        with open(self.path("heard"), encoding="utf-8") as file:
            text = file.read()
        self.assertEqual(text.count('"text": "loaded"'), 1, text)
        self.assertEqual(text.count('"key": "bay", "value": "3"'), 1, text)

    @unittest.skipUnless(os.environ.get("DOLPHIN_ROS2_PARTNER"), "DOLPHIN_ROS2_PARTNER is not set")
    def test_a_partner(self):
        """It has the goal `order`, and cannot be asked for more than it does."""
        name, type_, *command = shlex.split(os.environ["DOLPHIN_ROS2_PARTNER"])
        self.write("robots.yaml", f"""\
domain: {DOMAIN}
kinds:
  partner:
    type: UGV
    position: {{latitude: 41.185, longitude: -8.706}}
    plans:
      'count_${{n}}':
        {{action: {name}, type: {type_}, goal: {{order: '${{n}}'}}, progress: {{field: sequence, of: '${{n}}'}}}}
robots:
  carrier-1: {{kind: partner, namespace: /}}
""")
        self.spawn(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        run = self.execute(ONE + "execute v: task('count_5')\nmessage 'counted'\n")
        self.assertIn("counted", run.stdout)
        run = self.execute(ONE + "execute task('count_30')[v] during 3.seconds\nmessage 'stopped'\n")
        self.assertIn("stopped", run.stdout)


MISSION = """\
vs = pick { type 'UGV'; count 2; timeout 20.seconds }
def trip(v) { task('work_8')[v] >> task('work_9')[v] }
execute trip(vs[0]) | trip(vs[1])
message 'Done!'
"""
REASONS = re.compile(
    r"does not know the goal|no longer knows the goal|does not answer|has not answered|adapter was started again"
    r"|no word from the vehicle|has no action|may still run|no answer to the order|rejects the goal"
    r"|connection to Dolphin")


class Kills(Case):
    """Adapters, consoles and robots are killed at drawn moments. No goal begins twice; a mission is completed, or its
    log names the reason; and then every goal that began has ended, or is named."""

    def begin(self):
        self.write("mission.dol", MISSION)
        self.log = open(self.path("log"), "w+", encoding="utf-8")
        self.addCleanup(self.log.close)
        return self.spawn(
            [DOLPHIN, "exec", self.path("mission.dol"), "--platform", self.adapter, "--journal", self.path("run")],
            stdout=self.log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)

    def text(self):
        with open(self.path("log"), encoding="utf-8") as file:
            return file.read()

    def wait(self, process):
        process.wait(180)
        return process.returncode

    def until(self, condition):
        end = time.monotonic() + PATIENCE
        while not condition():
            self.assertLess(time.monotonic(), end, self.text())
            time.sleep(0.02)

    def judge(self, status, text, note):
        goals = [goal for _, _, goal in self.events()]
        self.assertEqual(len(goals), len(set(goals)), f"{note}: a goal began twice: {text}")
        if status == 0:
            self.assertIn("Done!", text)
            self.assertEqual(len(self.events("ends")), 4, f"{note}: {text}")
            self.assertEqual(len(goals), 4, f"{note}: {text}")
        else:
            self.assertRegex(text, REASONS, note)
            self.assertLessEqual(len(goals), 4, note)
            for reason in set(REASONS.findall(text)):
                self.reasons[reason] = self.reasons.get(reason, 0) + 1
            if note.split()[0] != "robot":
                self.until(lambda: len(self.events()) == len(self.events("ends")) + len(self.events("is-cancelled")))

    def each(self, seed, how):
        counts, self.reasons = {0: 0}, {}
        kills = int(os.environ.get(f"DOLPHIN_KILLS_{seed.upper()}", KILLS))
        for number in range(kills):
            with self.subTest(number=number, seed=seed):
                for name in ("run", "log"):
                    if os.path.exists(self.path(name)):
                        os.unlink(self.path(name))
                self.write("began", "")  # robots have it open, and append
                status = how(random.Random(f"{SEED} {seed} {number}"), number)
                counts[status] = counts.get(status, 0) + 1
        completed = counts.pop(0)
        failed = sum(counts.values())
        reasons = "".join(f"; {count} {reason!r}" for reason, count in sorted(self.reasons.items()))
        print(f"{seed}: of {kills} missions {completed} completed, {failed} failed with a reason{reasons}", flush=True)

    def adapters(self):
        """The processes of adapters with our configuration."""
        found = []
        for name in os.listdir("/proc"):
            if name.isdigit():
                try:
                    with open(f"/proc/{name}/cmdline", encoding="utf-8") as file:
                        words = file.read().split("\0")
                except OSError:
                    continue
                if "dolphin_ros2" in words and self.config in words:
                    found.append(int(name))
        return found

    def test_adapters(self):
        self.simulate()

        def one(draw, number):
            console = self.begin()
            self.until(lambda: "starts work_8" in self.text())
            time.sleep(draw.uniform(0, 2.2))
            for pid in self.adapters():
                os.kill(pid, signal.SIGKILL)
            status = self.wait(console)
            self.judge(status, self.text(), f"adapter {number}")
            return status

        self.each("adapters", one)

    def test_consoles(self):
        self.simulate()

        def one(draw, number):
            console = self.begin()
            self.until(lambda: "starts work_8" in self.text())
            time.sleep(draw.uniform(0, 2.2))
            console.kill()
            console.wait(10)
            with open(self.path("run"), encoding="utf-8") as file:
                if '"kind":"end"' in file.read():
                    return 0
            resumed = subprocess.run(
                [DOLPHIN, "exec", "--resume", self.path("run"), self.path("mission.dol"), "--platform", self.adapter],
                env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=180)
            self.judge(resumed.returncode, self.text() + resumed.stdout, f"console {number}")
            return resumed.returncode

        self.each("consoles", one)

    def test_robots(self):
        robots = [self.simulate()]

        def one(draw, number):
            console = self.begin()
            self.until(lambda: "starts work_8" in self.text())
            time.sleep(draw.uniform(0, 2.2))
            self.kill(robots[0])
            time.sleep(draw.uniform(0, 1))
            robots[0] = self.simulate()
            status = self.wait(console)
            self.judge(status, self.text(), f"robot {number}")
            return status

        self.each("robots", one)


class Network:
    """Two network namespaces, of robots and of consoles, on one bridge, which parts them on request."""

    def __init__(self):
        self.names = [f"dolphin{os.getpid()}{end}" for end in ("r", "c", "m")]
        robots, consoles, middle = self.names
        for name in self.names:
            self.ip("netns", "add", name)
        self.ip("-n", middle, "link", "add", "name", "bridge0", "type", "bridge")
        self.ip("-n", middle, "link", "set", "bridge0", "up")
        for number, name in enumerate((robots, consoles)):
            self.ip("-n", name, "link", "add", "eth0", "type", "veth", "peer", "name", f"port{number}", "netns", middle)
            self.ip("-n", middle, "link", "set", f"port{number}", "master", "bridge0", "up")
            self.ip("-n", name, "addr", "add", f"10.77.0.{number + 1}/24", "dev", "eth0")
            for device in ("lo", "eth0"):
                self.ip("-n", name, "link", "set", device, "up")
            self.ip("-n", name, "route", "add", "224.0.0.0/4", "dev", "eth0")

    def ip(self, *words):
        subprocess.run(["ip", *words], check=True, stderr=subprocess.PIPE)

    def part(self):
        self.ip("-n", self.names[2], "link", "set", "port0", "nomaster")

    def join(self):
        self.ip("-n", self.names[2], "link", "set", "port0", "master", "bridge0")

    def close(self):
        for name in self.names:
            subprocess.run(["ip", "netns", "del", name], stderr=subprocess.DEVNULL)


def has_namespaces():
    if os.geteuid() != 0 or shutil.which("ip") is None:
        return False
    try:
        Network().close()
    except subprocess.CalledProcessError:
        return False
    return True


class Partitions(Kills):
    """The network between the robots and the console is parted at a drawn moment, for a drawn time: every tenth time
    for longer than DDS keeps a participant that it does not hear."""

    test_adapters = test_consoles = test_robots = None

    @unittest.skipUnless(has_namespaces(), "there are no network namespaces here")
    def test_partitions(self):
        network = Network()
        self.addCleanup(network.close)
        self.environment["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "SUBNET"
        self.prefix = ["ip", "netns", "exec", network.names[0]]
        self.simulate()
        self.prefix = ["ip", "netns", "exec", network.names[1]]

        def one(draw, number):
            console = self.begin()
            self.until(lambda: "starts work_8" in self.text())
            time.sleep(draw.uniform(0, 2.2))
            network.part()
            time.sleep(draw.uniform(21, 26) if number % 10 == 9 else draw.uniform(0.1, 8))
            network.join()
            status = self.wait(console)
            self.judge(status, self.text(), f"partition {number}")
            return status

        self.each("partitions", one)


if __name__ == "__main__":
    unittest.main()
