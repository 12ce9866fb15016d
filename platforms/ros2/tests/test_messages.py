"""Messages from templates, fields by their path, and results, without ROS."""

import unittest
import uuid

import dolphin
from dolphin_ros2 import configuration_file, geo, goals, messages
from dolphin_ros2.messages import Path, Unfit

from tests.support import TEXT, Drive, find, message


class Templates(unittest.TestCase):
    def test_a_message(self):
        goal = messages.build(Drive.Goal, {"bay": "12", "quick": "true", "label": 5, "pose": {
            "x": 1, "cells": [{"y": "2.5"}, {}]}}, find)
        self.assertEqual((goal.bay, goal.quick, goal.label, goal.pose.x), (12, True, "5", 1.0))
        self.assertEqual([(cell.x, cell.y) for cell in goal.pose.cells], [(0.0, 2.5), (0.0, 0.0)])

    def test_types_of_fields(self):
        kind = message(
            "All", b="octet", i8="int8", u8="uint8", f="float", t="string", w="wstring", three="double[3]",
            few="sequence<int8, 2>", deep="sequence<fake_msgs/Point, 1>")
        right = [("b", 255, b"\xff"), ("i8", -128, -128), ("u8", "255", 255), ("f", "1e3", 1000.0), ("t", True, "true"),
                 ("three", [1, 2, "3"], [1.0, 2.0, 3.0]), ("few", [], [])]
        for name, value, expected in right:
            self.assertEqual(getattr(messages.build(kind, {name: value}, find), name), expected)
        wrong = [("b", 256, "b: 256 is not from 0 to 255"), ("i8", -129, "i8: -129 is not from -128 to 127"),
                 ("u8", True, "u8: True is not a whole number"), ("f", "nan", "f: 'nan' is not a finite number"),
                 ("t", [], "t: [] is not a string"), ("three", [1], "three: has 1 items, and needs 3"),
                 ("few", [1, 2, 3], "few: has 3 items, and takes 2 at most"), ("few", 1, "few: 1 is not a list"),
                 ("deep", [{"q": 1}], "deep: Point has no field 'q'; known are x, y, z"),
                 ("deep", [1], "deep: 1 is not a list of fields of fake_msgs/Point"),
                 ("four", 1, "All has no field 'four'; known are b, deep, f, few, i8, t, three, u8, w")]
        for name, value, why in wrong:
            with self.subTest(name=name, value=value), self.assertRaises(Unfit) as raised:
                messages.build(kind, {name: value}, find)
            self.assertEqual(str(raised.exception), why)

    def test_paths(self):
        goal = messages.build(Drive.Goal, {"pose": {"cells": [{"x": 4}]}}, find)
        self.assertEqual(Path.parse("pose.cells[0].x").read(goal), 4.0)
        self.assertIsNone(Path.parse("pose.cells[1]").read(goal))
        self.assertIsNone(Path.parse("pose.cells[0].x").check(Drive.Goal, find))
        self.assertIn("has no fields", Path.parse("bay.x").check(Drive.Goal, find))
        self.assertIn("is not a list", Path.parse("bay[1]").check(Drive.Goal, find))
        self.assertIn("Point has no field 'q'", Path.parse("pose.cells[0].q").check(Drive.Goal, find))


class Identity(unittest.TestCase):
    def test_a_goal_is_that_of_its_request_in_every_process(self):
        self.assertEqual(goals.goal_id("carrier-1", "k3q9x2f1-4"), uuid.UUID("0c389aa5-cb63-55f9-b061-0eab7a6e95ca"))

    def test_no_two_requests_have_one_goal(self):
        made = {goals.goal_id(f"v{v}", f"r{r}") for v in range(30) for r in range(30)}
        self.assertEqual(len(made), 900)
        self.assertNotEqual(goals.goal_id("a", "b-c"), goals.goal_id("a-b", "c"))


class Results(unittest.TestCase):
    def setUp(self):
        self.kind = configuration_file.of_text(TEXT, "r.yaml").kinds[0]

    def test_without_a_rule_the_status_decides(self):
        rule, _ = self.kind.plan("home")
        goals.judge(rule, goals.SUCCEEDED, Drive.Result(code=7))
        for status, exception in ((goals.ABORTED, dolphin.Failed), (goals.CANCELED, dolphin.Failed),
                                  (goals.UNKNOWN, dolphin.Unknown), (goals.EXECUTING, dolphin.Unknown)):
            with self.assertRaises(exception):
                goals.judge(rule, status, Drive.Result())

    def test_progress_without_sense_is_none(self):
        rule, parameters = self.kind.plan("drive_3")
        self.assertIsNone(goals.share(self.kind.plan("home")[0], {}, None))
        self.assertEqual(goals.share(rule, parameters, Drive.Feedback(done=[1])), 0.25)


class Maps(unittest.TestCase):
    def test_east_is_x(self):
        origin = geo.Origin(41.185, -8.706)
        latitude, longitude = origin.locate(1000.0, 0.0)
        self.assertAlmostEqual(latitude, 41.185, 6)
        self.assertAlmostEqual((longitude + 8.706) * 83_930, 1000.0, delta=2)

    def test_a_heading(self):
        origin = geo.Origin(41.185, -8.706, heading=0)
        self.assertEqual([a > b for a, b in zip(origin.locate(100, 0), (41.185, -8.706))], [True, False])
        self.assertLess(origin.locate(0, 100)[1], -8.706)

    def test_across_the_date_line(self):
        self.assertAlmostEqual(geo.Origin(0, 179.9999).locate(100, 0)[1], -179.9992, 3)


if __name__ == "__main__":
    unittest.main()
