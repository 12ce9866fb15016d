"""From messages and silence to pairs, with time as an argument."""

import json
import math
import random
import unittest
from dataclasses import replace

import dolphin
from dolphin_mqtt.configuration import Input
from dolphin_mqtt.sensor import DEEPEST, LONGEST, Pair, Remark, Sensor, Wrong, value_of

from seeds import seeds

PLAIN = Input(key="k", topic="t", field=(), field_text="", is_text=False, change=False, every=0.0, silence=None,
              silent=None, qos=1, retained=False)
FIELD = replace(PLAIN, field=("a", "b", 1), field_text="a.b[1]")


def pairs(news):
    return [tuple(each) for each in news if isinstance(each, Pair)]


def remarks(news):
    return [each.text for each in news if isinstance(each, Remark)]


class Values(unittest.TestCase):
    def test_values_of_messages(self):
        for payload, rule, value in [
            (b"21.5", PLAIN, 21.5), (b" true ", PLAIN, True), (b'"on"', PLAIN, "on"), (b"[1, [2]]", PLAIN, [1, [2]]),
            (b'{"a": {"b": [0, 7]}}', FIELD, 7), ("{\"a\": {\"b\": [0, \"é\"]}}".encode(), FIELD, "é"),
            (b'{"x": 1, "y": {"z": []}}', PLAIN, {"x": 1, "y": {"z": []}}),
            (b'{"latitude": 41.1, "longitude": -8}', PLAIN, dolphin.Position(41.1, -8)),
            (b'{"latitude": 41.1, "longitude": -8, "height": 3}', PLAIN, dolphin.Position(41.1, -8, 3)),
            (b'{"latitude": 1, "longitude": 2, "speed": 3}', PLAIN, {"latitude": 1, "longitude": 2, "speed": 3}),
            (b"ON", replace(PLAIN, is_text=True), "ON"), (b"", replace(PLAIN, is_text=True), ""),
        ]:
            with self.subTest(payload=payload):
                self.assertEqual(value_of(payload, rule), value)

    def test_an_object_is_never_a_vehicle_or_a_task(self):
        for text in ('{"vehicles": ["x8-02"]}', '{"task": "dive"}', '{"object": "queue"}', '{"map": {"a": 1}}'):
            value = value_of(text.encode(), PLAIN)
            self.assertEqual(dolphin.values.to_json(value), {"map": {
                key: dolphin.values.to_json(item) for key, item in json.loads(text).items()}})

    def test_wrong_messages(self):
        for payload, rule, reason in [
            (b"ON", PLAIN, "is not JSON: 'ON'"), (b"", PLAIN, "is not JSON: ''"),
            (b"\xff", PLAIN, "is not JSON: '\ufffd'"),
            (b"NaN", PLAIN, "is not JSON: 'NaN'"), (b"-Infinity", PLAIN, "is not JSON: '-Infinity'"),
            (b"[" * 100000, PLAIN, "is not JSON: '" + "[" * 60 + "'"),
            (b"\xff", replace(PLAIN, is_text=True), "is not a text in UTF-8: '\ufffd'"),
            (b"1e999", PLAIN, "has a number that is not finite"),
            (b"[1, -1e999]", PLAIN, "has a number that is not finite"),
            (b"1" + b"0" * 400, PLAIN, "has a number that is not finite"),
            (b"null", PLAIN, "has the value null, which programs do not have"),
            (b'{"a": [null]}', PLAIN, "has the value null, which programs do not have"),
            (b'"\\ud800"', PLAIN, "has a text with half a character of UTF-16"),
            (b'{"\\ud800": 1}', PLAIN, "has a text with half a character of UTF-16"),
            (b'{"a": {}}', FIELD, "has no field 'a.b[1]': '{\"a\": {}}'"),
            (b'{"a": {"b": [0]}}', FIELD, "has no field 'a.b[1]': '{\"a\": {\"b\": [0]}}'"),
            (b'{"a": {"b": "text"}}', FIELD, "has no field 'a.b[1]': '{\"a\": {\"b\": \"text\"}}'"),
            (b"7", FIELD, "has no field 'a.b[1]': '7'"), (b"[7]", FIELD, "has no field 'a.b[1]': '[7]'"),
            (b"[" * (DEEPEST + 2) + b"]" * (DEEPEST + 2), PLAIN, f"has a value of more than {DEEPEST} levels"),
            (b'"' + b"x" * LONGEST + b'"', PLAIN, f"has a value of more than {LONGEST} bytes: {LONGEST + 2}"),
        ]:
            with self.subTest(payload=payload[:40]), self.assertRaises(Wrong) as raised:
                value_of(payload, rule)
            self.assertEqual(str(raised.exception), reason)

    def test_any_payload(self):
        """Any bytes have a value that the run's socket can carry, or are wrong."""
        pieces = [b"{", b"}", b"[", b"]", b'"a"', b":", b",", b"1", b"e999", b"null", b"true", b"\xc3", b"\\ud800",
                  b"-"]
        for seed in seeds(300):
            draw = random.Random(seed)
            payload = b"".join(draw.choice(pieces) for _ in range(draw.randint(0, 8)))
            for rule in (PLAIN, FIELD, replace(PLAIN, is_text=True)):
                with self.subTest(payload=payload):
                    try:
                        json.dumps(dolphin.values.to_json(value_of(payload, rule)), allow_nan=False).encode()
                    except Wrong:
                        pass


class Times(unittest.TestCase):
    def test_each_message_is_a_pair(self):
        sensor = Sensor(PLAIN, 0.0)
        self.assertEqual([pairs(sensor.hear(b"1", False, now)) for now in (0.0, 0.0, 1.0)], [[("k", 1)]] * 3)
        self.assertEqual(sensor.due(), math.inf)

    def test_only_changes(self):
        sensor = Sensor(replace(PLAIN, change=True), 0.0)
        heard = [pairs(sensor.hear(text, False, 0.0)) for text in (b"1", b"1", b"true", b"true", b"2", b"1")]
        self.assertEqual(heard, [[("k", 1)], [], [("k", True)], [], [("k", 2)], [("k", 1)]])

    def test_one_every_ten_seconds_and_then_the_latest(self):
        sensor = Sensor(replace(PLAIN, every=10.0), 0.0)
        self.assertEqual(pairs(sensor.hear(b"1", False, 0.0)), [("k", 1)])
        self.assertEqual(pairs(sensor.hear(b"2", False, 1.0) + sensor.hear(b"3", False, 2.0)), [])
        self.assertEqual(sensor.due(), 10.0)
        self.assertEqual(pairs(sensor.tick(9.9)), [])
        self.assertEqual(pairs(sensor.tick(10.0)), [("k", 3)])
        self.assertEqual(sensor.due(), math.inf)
        self.assertEqual(pairs(sensor.tick(30.0)), [])
        self.assertEqual(pairs(sensor.hear(b"4", False, 30.0)), [("k", 4)])

    def test_a_value_that_came_back_meanwhile_has_not_changed(self):
        sensor = Sensor(replace(PLAIN, every=10.0, change=True), 0.0)
        sensor.hear(b"1", False, 0.0)
        self.assertEqual(pairs(sensor.hear(b"2", False, 1.0) + sensor.hear(b"1", False, 2.0) + sensor.tick(10.0)), [])
        self.assertEqual(pairs(sensor.hear(b"2", False, 11.0)), [("k", 2)])

    def test_silence_is_reported_once_and_the_first_value_after_it_is_posted(self):
        sensor = Sensor(replace(PLAIN, silence=5.0, silent="lost", change=True, every=100.0), 0.0)
        self.assertEqual(sensor.due(), 5.0)
        sensor.hear(b"1", False, 1.0)
        self.assertEqual(sensor.due(), 6.0)
        self.assertEqual(sensor.tick(5.9), [])
        news = sensor.tick(6.0)
        self.assertEqual((pairs(news), remarks(news)), ([("lost", "k")], ["input 'k': t has been silent for 5 s"]))
        self.assertEqual((sensor.tick(100.0), sensor.due()), ([], math.inf))
        news = sensor.hear(b"1", False, 7.0)
        self.assertEqual((pairs(news), remarks(news)), ([("k", 1)], ["input 'k': t is heard again"]))
        self.assertEqual(pairs(sensor.tick(12.0)), [("lost", "k")])

    def test_silence_from_the_start_without_a_key(self):
        sensor = Sensor(replace(PLAIN, silence=5.0), 2.0)
        news = sensor.tick(7.0)
        self.assertEqual((pairs(news), remarks(news)), ([], ["input 'k': t has been silent for 5 s"]))

    def test_retained_messages(self):
        self.assertEqual(Sensor(PLAIN, 0.0).hear(b"1", True, 0.0), [])
        sensor = Sensor(replace(PLAIN, retained=True, silence=5.0, silent="lost"), 0.0)
        self.assertEqual(pairs(sensor.hear(b"1", True, 4.0)), [("k", 1)])
        self.assertEqual(pairs(sensor.tick(5.0)), [("lost", "k")])  # it may be old: not a sign of life
        self.assertEqual(remarks(sensor.hear(b"1", True, 6.0)), [])

    def test_wrong_messages_are_no_sign_of_life(self):
        sensor = Sensor(replace(PLAIN, silence=5.0, silent="lost"), 0.0)
        self.assertEqual(sensor.hear(b"?", False, 4.0), [Remark(
            "input 'k': a message of t is not JSON: '?'; others like it are not reported", ("k", "is not JSON"))])
        self.assertEqual(pairs(sensor.tick(5.0)), [("lost", "k")])


if __name__ == "__main__":
    unittest.main()
