"""sensors.yaml: each fault with its place and remedy; a text of any kind leads to no other exception."""

import os
import re
import shutil
import tempfile
import unittest

from dolphin.document import Faulty
from dolphin_mqtt import configuration

from configurations import faults_of, mutated
from tests.support import TEXT, beside


def faults(text, path="s.yaml"):
    """The faults of a text, without its path."""
    return faults_of(configuration.of_text, text, path)


FAULTS = [
    ("broker: {host: localhost}\n", "", ["1:1: the configuration needs the member 'broker'"]),
    ("host: localhost", "hots: localhost", [
        "1:9: 'broker' needs the member 'host'", "1:10: unknown member 'hots' of 'broker'; did you mean 'host'?"]),
    ("host: localhost", "host: 'mqtt://broker'", [
        "1:16: 'mqtt://broker' is not a host, such as localhost or 192.168.1.7"]),
    ("host: localhost", "host: localhost, port: 0", ["1:33: 'port' is a number from 1 to 65535; this is 0"]),
    ("host: localhost", "host: localhost, port: 1.5", ["1:33: 'port' is a whole number; this is 1.5"]),
    ("host: localhost", "host: localhost, tls: maybe", ["1:32: 'tls' is true or false; this is the text 'maybe'"]),
    ("host: localhost", "host: localhost, password: x", [
        "1:27: unknown member 'password' of 'broker'; did you mean 'password_file'?"]),
    ("host: localhost", "host: localhost, password_file: good.txt", ["1:42: a password needs the member 'username'"]),
    ("host: localhost", "host: localhost, username: u, password_file: none.txt", [
        "1:55: none.txt: cannot be read: No such file or directory"]),
    ("host: localhost", "host: localhost, username: u, password_file: empty.txt", [
        "1:55: empty.txt: its first line has no password"]),
    ("host: localhost", "host: localhost, cafile: none.pem", ["1:35: none.pem: No such file or directory"]),
    ("host: localhost", "host: localhost, cafile: good.txt", ["1:35: good.txt: has no certificate"]),
    ("host: localhost", "host: localhost, tls: false, cafile: good.txt", [
        "1:47: 'cafile' is for TLS, and 'tls' is false", "1:47: good.txt: has no certificate"]),
    ("topic: harbour/quay, ", "", ["3:9: the input 'quay' needs the member 'topic'"]),
    ("topic: harbour/quay", "topic: harbour/+", [
        "3:17: 'harbour/+' stands for several topics: an input has one, without + and #"]),
    ("topic: harbour/quay", "topic: '#'", [
        "3:17: '#' stands for several topics: an input has one, without + and #"]),
    ("topic: harbour/quay", "topic: \"a\\0\"", ["3:17: 'topic' is not a topic of MQTT, such as hall/climate"]),
    ("field: smoke.level", "field: smoke..level", [
        "3:38: 'smoke..level' is not a field, such as climate.temperature or cells[2]"]),
    ("text: true", "text: true, field: state", [
        "4:50: a text has no fields: 'text' and 'field' exclude each other"]),
    ("change: true", "change: 1", ["3:59: 'change' is true or false; this is the number 1"]),
    ("every: 10", "every: -1", ["3:72: 'every' is a number from 0 to 604800; this is -1"]),
    ("silence: 60", "silence: 0", ["3:85: 'silence' is a number from 0.1 to 604800; this is 0"]),
    ("silence: 60, ", "", ["3:84: 'silent' needs 'silence', the seconds after which it is posted"]),
    ("silent: lost", "silent: [lost]", ["3:97: 'silent' is a text; this is a list"]),
    ("qos: 2", "qos: 3", ["4:64: 'qos' is a number from 0 to 2; this is 3"]),
    ("qos: 2", "qso: 2", ["4:59: unknown member 'qso' of the input 'door'; did you mean 'qos'?"]),
    ("qos: 2", "qos: [2", ["4:66: is not YAML: expected ',' or ']', but got '}'"]),
]
"""Changes of `TEXT`, and the faults that follow."""


class Reading(unittest.TestCase):
    def setUp(self):
        folder = tempfile.mkdtemp(prefix="dolphin-test-")
        self.addCleanup(shutil.rmtree, folder)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder)
        for name, text in (("good.txt", "s3cret\n"), ("empty.txt", "\n")):
            with open(name, "w", encoding="utf-8") as file:
                file.write(text)

    def test_members_and_their_defaults(self):
        found = configuration.of_text(TEXT, "s.yaml")
        self.assertEqual((str(found.broker), found.broker.tls, found.broker.username), ("localhost:1883", False, None))
        quay, door = found.inputs
        self.assertEqual((quay.field, quay.change, quay.every, quay.silence, quay.silent, quay.qos, quay.retained),
                         (("smoke", "level"), True, 10.0, 60.0, "lost", 1, False))
        self.assertEqual((door.field, door.is_text, door.silence, door.silent, door.qos, door.retained),
                         ((), True, None, None, 2, True))
        self.assertEqual(found.keys(), ("quay", "lost", "door"))
        self.assertEqual(found.topics(), {"harbour/quay": 1, "harbour/door": 2})

    def test_the_greatest_quality_of_service_of_a_topic(self):
        found = configuration.of_text(TEXT.replace("harbour/door", "harbour/quay"), "s.yaml")
        self.assertEqual(found.topics(), {"harbour/quay": 2})

    def test_passwords_and_certificates_of_files(self):
        text = TEXT.replace("localhost", "localhost, tls: true, username: u, password_file: good.txt")
        broker = configuration.of_text(text, "s.yaml").broker
        self.assertEqual((str(broker), broker.username, broker.password), ("localhost:8883", "u", "s3cret"))

    def test_files_are_relative_to_the_configuration(self):
        text = TEXT.replace("localhost", "localhost, username: u, password_file: good.txt")
        here = os.getcwd()
        os.chdir("/")
        found = configuration.of_text(text, os.path.join(here, "s.yaml"))
        self.assertEqual(found.broker.password, "s3cret")

    def test_paths_have_plain_keys_and_indices(self):
        text = TEXT.replace("smoke.level", "'DS18B20-1.values[0][2].°C'")
        found = configuration.of_text(text, "s.yaml")
        self.assertEqual(found.inputs[0].field, ("DS18B20-1", "values", 0, 2, "°C"))

    def test_faults(self):
        """A change of the text, and the faults that follow."""
        for old, new, expected in FAULTS:
            with self.subTest(new=new):
                changed = TEXT.replace(old, new, 1)
                self.assertNotEqual(changed, TEXT)
                self.assertEqual(faults(changed), expected)

    def test_inputs_are_needed(self):
        self.assertEqual(faults("broker: {host: h}"), ["1:1: the configuration needs the member 'inputs'"])
        self.assertEqual(faults("broker: {host: h}\ninputs: {}"), ["2:9: there is no input"])
        self.assertEqual(faults("broker: {host: h}\ninputs: [a]"), [
            "2:9: 'inputs' is a list of names, each with its members; this is a list"])

    def test_a_file_that_is_not_there(self):
        with self.assertRaises(Faulty) as raised:
            configuration.read("none.yaml")
        self.assertEqual(raised.exception.why, "none.yaml:1:1: cannot be read: No such file or directory")

    def test_any_text(self):
        """Mutated texts are configurations or faults."""
        pieces = ["{", "}", "[", "]", ": ", "- ", "'", "\n", "  ", "&a ", "*a", "<<: ", "null", "1e999", "\\0", "\t",
                  "2020-01-01", "no", "\u00e9", "?", "|", "#", "+", ".inf", "!!binary x", "...", "tls: true, ",
                  "cafile: x, ", "username: x, ", "password_file: x, "]
        for seed, text in mutated(TEXT, pieces):
            with self.subTest(seed=seed):
                faults(text)


class Documents(unittest.TestCase):
    def test_the_page_has_the_example_and_every_member(self):
        with open(beside("../../docs/mqtt.md"), encoding="utf-8") as file:
            page = file.read()
        with open(beside("example/sensors.yaml"), encoding="utf-8") as file:
            self.assertIn("```yaml\n" + file.read() + "```", page)
        with open(beside("example/smoke.dol"), encoding="utf-8") as file:
            self.assertIn("```groovy\n" + file.read() + "```", page)
        listed = re.findall(r"^\| `(\w+)` \|", page, re.MULTILINE)
        self.assertEqual(listed, [*configuration.BROKER, *configuration.INPUT])

    def test_the_example(self):
        found = configuration.read(beside("example/sensors.yaml"))
        self.assertEqual(found.keys(), ("quay", "lost", "depot"))


if __name__ == "__main__":
    unittest.main()
