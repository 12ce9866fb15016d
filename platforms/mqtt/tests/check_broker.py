"""The bridge as a process, with Debian's mosquitto, a mission of `dolphin exec`, and sensors that are clients of paho.
All listen on loopback alone, at ports that the system chooses; each test ends the processes that it began."""

import contextlib
import json
import os
import pwd
import signal
import socket
import subprocess
import unittest

import paho.mqtt.client as mqtt

from eventually import SECONDS, free_port, until
from in_folder import InFolder
from tests.support import beside

MISSION = """input 'level', 'door', 'gone', 'stop'
v = pick { type 'UUV' }
execute v: until { poll stop: true } run task('survey')
"""
FLEET = "vehicle 'n-1', { type 'UUV' }\nplan 'survey', { duration 10.hours }\n"


class Case(InFolder):
    def setUp(self):
        super().setUp()
        self.port = free_port()
        self.journal = self.path("m.run")

    # The broker.

    def broker(self, settings="allow_anonymous true\n"):
        user = pwd.getpwuid(os.getuid()).pw_name
        path = self.write("mosquitto.conf", f"listener {self.port} 127.0.0.1\nuser {user}\npersistence false\n"
                          f"log_type all\n{settings}")
        process = self.start("mosquitto.log", "mosquitto", "-c", path)

        def listens():
            self.assertIsNone(process.poll(), self.text("mosquitto.log"))
            with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", self.port), 1):
                return True

        until(listens, lambda: self.text("mosquitto.log"))
        return process

    def publish(self, *messages, retain=False, cafile=None):
        """Sends messages, `(topic, payload)`, and returns once the broker has them."""
        client = mqtt.Client(mqtt.CallbackAPIVersion.VERSION2)
        if cafile is not None:
            client.tls_set(cafile)
            client.username_pw_set("sensor", "s3cret")
        client.connect("127.0.0.1", self.port)
        client.loop_start()
        for topic, payload in messages:
            client.publish(topic, payload, 1, retain).wait_for_publish(SECONDS)
        client.disconnect()
        client.loop_stop()

    # The mission.

    def mission(self):
        self.write("m.fleet", FLEET)
        return self.start("m.log", os.environ["DOLPHIN"], "exec", self.write("m.dol", MISSION), "--fleet",
                          self.path("m.fleet"), "--speed", "1", "--journal", self.journal)

    def posts(self):
        """The pairs of the journal."""
        found = []
        for line in self.text("m.run").splitlines(keepends=True):
            if line.endswith("\n"):
                found += [each for each in json.loads(line).get("N", {}).get("posted", [])]
        return found

    def stop(self, mission):
        self.post("stop", True)
        self.assertEqual(mission.wait(SECONDS), 0, self.text("m.log"))

    def post(self, key, value):
        with socket.socket(socket.AF_UNIX) as run:
            run.connect(self.journal + ".sock")
            run.sendall(json.dumps({"request": "post", "key": key, "value": value}).encode() + b"\n")
            self.assertIn(b'"ok":true', run.recv(65536))

    # The bridge.

    def bridge(self, inputs, broker="", name="bridge.log"):
        path = self.write(f"{name}.yaml", f"broker: {{host: 127.0.0.1, port: {self.port}{broker}}}\ninputs:\n{inputs}")
        return self.start(name, beside("dolphin-mqtt"), "--config", path, "--run", self.journal)

    def remarks(self, name="bridge.log"):
        return [line for line in self.text(name).splitlines() if "s for the run at most" not in line]

    def awaits(self, condition):
        return until(condition, lambda: (self.remarks(), self.posts(), self.text("mosquitto.log")[:3000]))

    def subscribed(self):
        """Returns once the broker has sent its answer to a subscription."""
        self.awaits(lambda: "Sending SUBACK" in self.text("mosquitto.log"))


LEVEL = "  level: {topic: tank/1, field: 'levels[1]', change: true}\n"


class Sensors(Case):
    def test_a_sensor_from_its_first_message_to_the_end_of_the_run(self):
        self.broker()
        self.publish(("tank/1", '{"levels": [0, 1]}'), retain=True)  # old news: it is not taken
        mission, bridge = self.mission(), self.bridge(LEVEL)
        self.subscribed()
        self.publish(*(("tank/1", payload) for payload in (
            '{"levels": [0, 2.5]}', '{"levels": [0, 2.5]}', "full", "empty", '{"levels": [1e999, 7]}')))
        self.awaits(lambda: "level:7" in self.posts())
        self.assertEqual(self.posts(), ["level:2.5", "level:7"])
        self.stop(mission)
        self.assertEqual(bridge.wait(SECONDS), 0)
        self.assertEqual(self.remarks(), [
            f"broker 127.0.0.1:{self.port}: connected",
            "input 'level': a message of tank/1 is not JSON: 'full'; others like it are not reported"])

    def test_a_sensor_that_falls_silent(self):
        self.broker()
        self.mission()
        self.bridge("  door: {topic: door/1, text: true, silence: 0.3, silent: gone}\n")
        for state in ("open", "shut"):
            self.awaits(lambda: self.posts()[-1:] == ["gone:'door'"])
            self.subscribed()
            self.publish(("door/1", state))
            self.awaits(lambda: f"door:'{state}'" in self.posts())
        self.assertEqual(self.posts()[:4], ["gone:'door'", "door:'open'", "gone:'door'", "door:'shut'"])
        self.assertEqual([line for line in self.remarks() if line.startswith("input")][:3], [
            "input 'door': door/1 has been silent for 0.3 s", "input 'door': door/1 is heard again",
            "input 'door': door/1 has been silent for 0.3 s"])

    def test_retained_messages_and_the_quality_of_service(self):
        self.broker()
        self.publish(("tank/1", "7"), retain=True)
        self.mission()
        bridge = self.bridge("  level: {topic: tank/1, retained: true, qos: 2}\n  gone: {topic: tank/1, qos: 0}\n")
        self.awaits(lambda: self.posts() == ["level:7"])
        self.assertIn("tank/1 (QoS 2)", self.text("mosquitto.log"))
        bridge.send_signal(signal.SIGTERM)
        self.assertEqual(bridge.wait(SECONDS), 143)
        self.awaits(lambda: "Received DISCONNECT" in self.text("mosquitto.log"))

    def test_a_broker_that_is_away(self):
        self.mission()
        self.bridge(LEVEL.replace("change: true", "qos: 0"))
        away = f"broker 127.0.0.1:{self.port}: Connection refused; it is tried again"
        self.awaits(lambda: self.remarks() == [away])
        broker = self.broker()
        self.subscribed()
        self.publish(("tank/1", '{"levels": [0, 1]}'))
        self.awaits(lambda: self.posts() == ["level:1"])
        broker.terminate()
        broker.wait(SECONDS)
        self.awaits(lambda: len(self.remarks()) > 2)
        self.broker()
        self.subscribed()
        self.publish(("tank/1", '{"levels": [0, 2]}'))
        self.awaits(lambda: self.posts() == ["level:1", "level:2"])
        connected = f"broker 127.0.0.1:{self.port}: connected"
        remarks = self.remarks()
        self.assertEqual((remarks[:2], remarks[-1]), ([away, connected], connected))
        self.assertIn("it is tried again", remarks[2])
        self.assertIn(len(remarks), (4, 5), remarks)  # the end of the connection, and perhaps a refusal

    def test_a_key_that_the_program_does_not_declare(self):
        self.mission()
        bridge = self.bridge(LEVEL.replace("level:", "lvel:"))
        self.assertEqual(bridge.wait(SECONDS), 2)
        self.assertEqual(self.remarks(), [
            "the program declares no input 'lvel': its inputs are 'level', 'door', 'gone', 'stop'"])


class Refusals(Case):
    def test_a_broker_that_refuses_a_subscription(self):
        """One of a few lines: mosquitto grants subscriptions that its access list forbids, and sends no message."""
        with socket.create_server(("127.0.0.1", self.port)) as server:
            self.mission()
            bridge = self.bridge("  level: {topic: tank/1}\n  gone: {topic: secret/1}\n")
            server.settimeout(SECONDS)
            connection, _ = server.accept()
            with connection:
                connection.settimeout(SECONDS)
                connection.recv(1000)
                connection.sendall(bytes([0x20, 2, 0, 0]))  # CONNACK: accepted
                packet = connection.recv(1000)
                connection.sendall(bytes([0x90, 4, *packet[2:4], 1, 0x80]))  # SUBACK: granted, failure
                broker = f"broker 127.0.0.1:{self.port}: "
                self.awaits(lambda: self.remarks() == [
                    broker + "connected", broker + "refuses the subscription to secret/1"])
                bridge.send_signal(signal.SIGINT)
                self.assertEqual(bridge.wait(SECONDS), 130)


class Security(Case):
    """A broker with TLS and passwords."""

    def setUp(self):
        super().setUp()
        self.certificates()
        self.write("users", "sensor:s3cret\n")
        subprocess.run(["mosquitto_passwd", "-U", self.path("users")], check=True)
        self.write("good", "s3cret\n")
        self.write("bad", "secret\n")
        self.broker(
            f"allow_anonymous false\npassword_file {self.path('users')}\n"
            f"cafile {self.path('ca.pem')}\ncertfile {self.path('server.pem')}\nkeyfile {self.path('server.key')}\n")
        self.mission()

    def certificates(self):
        """An authority, a certificate by it for 127.0.0.1, and another authority."""
        self.write("extension", "subjectAltName=IP:127.0.0.1\n")
        key = "-newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 2"
        for words in (
            f"req -x509 {key} -subj /CN=ours -keyout ca.key -out ca.pem",
            f"req -x509 {key} -subj /CN=other -keyout other.key -out other.pem",
            f"req {key} -subj /CN=broker -keyout server.key -out server.csr",
            "x509 -req -in server.csr -CA ca.pem -CAkey ca.key -CAcreateserial -days 2 -extfile extension "
            "-out server.pem",
        ):
            subprocess.run(["openssl", *words.split()], cwd=self.folder, check=True, stderr=subprocess.DEVNULL,
                           stdout=subprocess.DEVNULL)

    def login(self, password, cafile="ca.pem"):
        return f", username: sensor, password_file: {password}, cafile: {cafile}"

    def test_who_may_connect(self):
        inputs = "  level: {topic: tank/1}\n"
        bridges = {name: self.bridge(inputs, self.login(*login), name) for name, login in (
            ("right", ("good",)), ("password", ("bad",)), ("authority", ("good", "other.pem")))}
        bridges["plain"] = self.bridge(inputs, ", username: sensor, password_file: good", "plain")
        self.subscribed()
        self.publish(("tank/1", "7"), cafile=self.path("ca.pem"))
        self.awaits(lambda: self.posts() == ["level:7"])
        self.assertEqual(self.remarks("right"), [f"broker 127.0.0.1:{self.port}: connected"])
        for name, why in (
            ("password", "refuses the connection: not authorized; it is tried again"),
            ("authority", "its certificate is not accepted: "),
            ("plain", "the connection ended before it was accepted; it is tried again"),
        ):
            until(lambda: self.remarks(name), lambda: (name, self.text("mosquitto.log")))
            with self.subTest(name=name):
                self.assertEqual(len(self.remarks(name)), 1, self.remarks(name))
                self.assertIn(why, self.remarks(name)[0])
        self.assertEqual([bridge.poll() for bridge in bridges.values()], [None] * 4)


if __name__ == "__main__":
    unittest.main()
