"""robots.yaml: each fault with its place and remedy; a text of any kind leads to no other exception."""

import os
import unittest

from dolphin.document import Faulty
from dolphin_ros2 import configuration_file, interfaces

from configurations import faults_of, mutated
from tests.support import TEXT, load

EXAMPLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "example", "robots.yaml")


def faults(text):
    """The faults of a text, without its path, with those of its types."""

    def read(text, path):
        interfaces.check(configuration_file.of_text(text, path), load)

    return faults_of(read, text, "r.yaml")


FAULTS = [
    ("type: UGV", "tpye: UGV", [
        "7:5: the kind 'carrier' needs the member 'type'",
        "7:5: unknown member 'tpye' of the kind 'carrier'; did you mean 'type'?",
    ]),
    ("answer: 0.6", "answer: soon", [
        "1:9: 'answer' is a number; this is the text 'soon'",
    ]),
    ("latitude: 41.185", "latitude: 411.85", [
        "2:20: 'latitude' is a number from -89.9 to 89.9; this is 411.85",
    ]),
    ("origin: {latitude: 41.185, longitude: -8.706}\n", "", [
        "9:35: an Odometry is in metres from the origin of its map: the configuration needs 'origin', with "
        "its 'latitude' and 'longitude'",
    ]),
    ("kind: carrier,", "kind: carier,", [
        "25:21: unknown kind 'carier'; did you mean 'carrier'?",
    ]),
    ("namespace: /carrier1", "namespace: carrier 1", [
        "25:41: 'carrier 1' is not a namespace of ROS, such as /carrier_1",
    ]),
    ("field: done, of", "field: 'done[', of", [
        "21:27: 'done[' is not a field, such as pose.position.x or cells[2]",
    ]),
    ("goal: {bay: '${bay}'", "goal: {bay: '${bya}'", [
        "20:21: the plan's name 'drive_${bay}' has no parameter 'bya': call it 'drive_${bay}_${bya}'",
    ]),
    ("done: [0, 1], ", "", [
        "22:17: 'result' has 'field' and 'done', the values of the field that mean success",
    ]),
    ("tare: {service", "tare: {srvice", [
        "23:7: the plan 'tare' needs one of the members 'action' and 'service'",
    ]),
    ("'drive_${bay}':", "'drive_${bay}${':", [
        "17:7: two parameters of 'drive_${bay}${' have nothing between them: separate them, as by '_'",
    ]),
    ("'drive_${bay}':", "'drive_${bay}${bay}':", [
        "17:7: the name 'drive_${bay}${bay}' has a parameter twice",
    ]),
    ("type: nav_msgs/msg/Odometry", "type: nav_msgs/msg/Path", [
        "10:35: a position is of type sensor_msgs/msg/NavSatFix, nav_msgs/msg/Odometry, geometry_msgs/msg/PoseStamped "
        "or geometry_msgs/msg/PoseWithCovarianceStamped; this is nav_msgs/msg/Path",
    ]),
    ("    payload: [tray]", "    payload: tray", [
        "8:14: 'payload' is a list, such as [a, b]; this is the text 'tray'",
    ]),
    ("answer: 0.6", "answer: 0.6\nanswer: 0.7", [
        "2:1: 'answer' is given twice; the first time in line 1",
    ]),
    ("answer: 0.6", "answer: &a [*a]", [
        "1:9: this value contains itself",
    ]),
    ("answer: 0.6", "answer: [0.6", [
        "2:7: is not YAML: expected ',' or ']', but got ':'",
    ]),
    ("of: 4", "of: 0", [
        "21:37: 'of' is a number of at least 0.001; this is 0",
    ]),
    ("is: idle, ", "", [
        "12:12: 'ready' needs the member 'is'",
    ]),
    ("action: drive, type", "action: drive, service: a, type", [
        "16:7: the plan 'home' cannot have both the members 'action' and 'service'",
    ]),
    ("label: 'bay ${bay}'", "lable: 'bay ${bay}'", [
        "20:31: Drive_Goal has no field 'lable'; did you mean 'label'?",
    ]),
    ("pose: {x: 1}", "pose: {y: 1}", [
        "20:59: Pose has no field 'y'; known are cells, x",
    ]),
    ("pose: {x: 1}", "pose: {x: far}", [
        "20:62: x: 'far' is not a number",
    ]),
    ("goal: {bay: 0}", "goal: {bay: 0.5}", [
        "16:71: bay: 0.5 is not a whole number",
    ]),
    ("field: code", "field: cod", [
        "22:17: 'cod': Drive_Result has no field 'cod'; did you mean 'code'?",
    ]),
    ("remaining: left", "remaining: left.hours", [
        "21:19: 'left.hours': fake_msgs/Duration has no field 'hours'; known are nanosec, sec",
    ]),
    ("type: fake_msgs/action/Drive\n        goal: {bay: '", "type: fake_msgs/action/Dive\n        goal: {bay: '", [
        "19:15: the action drive is of type fake_msgs/action/Drive in line 16",
    ]),
    ("type: fake_msgs/srv/Trigger", "type: nav2_msgs/srv/Trigger", [
        "23:35: there is no package nav2_msgs with a folder srv: source the workspace that has it (No module "
        "named 'nav2_msgs.srv')",
    ]),
    ("home: {action: drive, type: fake_msgs/action/Drive", "home: {action: drive, type: fake_msgs/action/Dock", [
        "19:15: the action drive is of type fake_msgs/action/Dock in line 16",
    ]),
]
"""Changes of `TEXT`, and the faults that follow."""


class Reading(unittest.TestCase):
    def test_what_is_right(self):
        self.assertEqual(faults(TEXT), [])
        found = configuration_file.of_text(TEXT, "r.yaml")
        self.assertEqual([robot.name for robot in found.robots], ["carrier-1"])
        self.assertEqual(found.robots[0].payload, ("tray",))
        self.assertEqual(found.robots[0].resolve("odom"), "/carrier1/odom")
        self.assertEqual(found.robots[0].resolve("/tf"), "/tf")
        self.assertEqual(found.kinds[0].silence, 1000)

    def test_the_example(self):
        found = configuration_file.read(EXAMPLE)
        self.assertEqual([robot.name for robot in found.robots], ["carrier-1", "carrier-2"])
        self.assertEqual((found.kinds[0].silence, found.answer), (3.0, 10.0))

    def test_plans_by_their_names(self):
        kind = configuration_file.of_text(TEXT, "r.yaml").kinds[0]
        self.assertEqual(kind.plan("home")[1], {})
        rule, parameters = kind.plan("drive_3")
        self.assertEqual(rule.values(parameters), {"bay": "3", "label": "bay 3", "pose": {"x": 1}})
        self.assertIsNone(kind.plan("drive_"))
        self.assertIsNone(kind.plan("drive"))

    def test_faults(self):
        """A change of the text, and the faults that follow."""
        for old, new, expected in FAULTS:
            with self.subTest(new=new):
                changed = TEXT.replace(old, new, 1)
                self.assertNotEqual(changed, TEXT)
                self.assertEqual(faults(changed), expected)

    def test_places(self):
        text = TEXT.replace("battery: {topic: battery_state}", "battery: {topic: battery state}")
        line = text[:text.index("battery: {")].count("\n") + 1
        column = text.splitlines()[line - 1].index("battery state") + 1
        self.assertEqual(faults(text), [
            f"{line}:{column}: 'battery state' is not the name of a topic, such as odom or /odom"])

    def test_two_robots_of_one_namespace(self):
        text = TEXT + "  carrier-2: {kind: carrier, namespace: /carrier1}\n"
        self.assertIn("'carrier-2' and 'carrier-1' have one namespace, /carrier1: give each its own", faults(text)[0])

    def test_a_file_that_is_not_there(self):
        with self.assertRaises(Faulty) as raised:
            configuration_file.read("/nowhere/robots.yaml")
        self.assertEqual(raised.exception.why, "/nowhere/robots.yaml:1:1: cannot be read: No such file or directory")

    def test_any_text(self):
        """Mutated texts are configurations or faults."""
        pieces = ["{", "}", "[", "]", ": ", "- ", "'", "\n", "  ", "&a ", "*a", "<<: ", "null", "1e999", "${x}", "\t",
                  "!!python/object", "2020-01-01", "no", "\u00e9", "?", "|", "#", "robots", "a: b", ".inf", "0x",
                  "!!binary x", "..."]
        for seed, text in mutated(TEXT, pieces):
            with self.subTest(seed=seed):
                faults(text)


if __name__ == "__main__":
    unittest.main()
