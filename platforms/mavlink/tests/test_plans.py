"""Stored missions and inline plans: their items, and the reasons of refusals."""

import json
import math
import os
import struct
import tempfile
import unittest

from dolphin_mavlink import geo, mission, mission_files, plans
from dolphin_mavlink import words as language
from dolphin_mavlink.mission import Item, Unreadable
from dolphin_mavlink.shell import encoded, read_missions
from tests.support import HARBOUR, waypoint, way

UAV = plans.For("x8", "plane", False, HARBOUR, HARBOUR, 53.0, True)
COPTER = plans.For("c1", "copter", True, HARBOUR, HARBOUR, None, True)
SUB = plans.For("s1", "sub", False, HARBOUR, HARBOUR, None, True)
BOAT = plans.For("b1", "boat", False, HARBOUR, HARBOUR, None, True)
HERE = {"latitude": HARBOUR[0], "longitude": HARBOUR[1], "height": 0}

PLAN = """{"fileType": "Plan", "version": 1, "mission": {"items": [
  {"type": "SimpleItem", "command": 22, "frame": 3, "params": [0, 0, 0, null, 41.185, -8.706, 30]},
  {"type": "ComplexItem", "complexItemType": "survey", "TransectStyleComplexItem": {"Items": [
    {"type": "SimpleItem", "command": 16, "frame": 3, "params": [0, 0, 0, null, 41.186, -8.706, 30]},
    {"type": "SimpleItem", "command": 206, "frame": 2, "params": [25, 0, 1, 0, 0, 0, 0], "autoContinue": true}]}},
  {"type": "SimpleItem", "command": 177, "frame": 2, "params": [2, 3, 0, 0, 0, 0, 0], "autoContinue": true},
  {"type": "SimpleItem", "command": 20, "frame": 2, "params": [0, 0, 0, 0, 0, 0, 0], "autoContinue": true}]}}"""
WAYPOINTS = """QGC WPL 110
0\t1\t0\t16\t0\t0\t0\t0\t41.185\t-8.706\t0\t1
1\t0\t3\t22\t0\t0\t0\t0\t41.185\t-8.706\t30\t1
2\t0\t3\t16\t5\t0\t0\t0\t41.186\t-8.706\t30\t1
"""


def read(plan, whom=UAV, stored=None):
    def find(name):
        if stored is None or name not in stored:
            raise Unreadable(f"there is no mission '{name}'")
        return stored[name]

    return plans.compile_plan(plan, find, whom)


def maneuver(kind, **more):
    m = {
        "id": "1." + kind,
        "maneuver": kind,
        "latitude": HARBOUR[0],
        "longitude": HARBOUR[1],
        "height": 0,
        "z": 30,
        "zUnit": "altitude",
        "speed": 18,
        "speedUnit": "m/s",
        "payload": [],
    }
    return {**m, **more}


def inline(*maneuvers, vehicles=()):
    return {
        "name": "p",
        "language": "imcPlan",
        "body": {"description": "", "vehicles": list(vehicles), "maneuvers": list(maneuvers)},
    }


def items(*words):
    entries = [
        {
            "item": w[0],
            "arguments": list(w[1:]) if not isinstance(w[-1], Named) else list(w[1:-1]),
            "named": w[-1] if isinstance(w[-1], Named) else {},
        }
        for w in words
    ]
    return {"name": "m", "language": "mission", "body": {"items": entries}}


class Named(dict):
    pass


class Files(unittest.TestCase):
    def test_a_plan_of_qgroundcontrol(self):
        found = mission_files.of_file("a.plan", PLAN)
        self.assertEqual([i.command for i in found], [22, 16, 206, 177, 20])
        self.assertEqual((found[1].x, found[1].y, found[1].z, found[1].frame), (411860000, -87060000, 30.0, 6))
        self.assertEqual(found[3].params[:2], (2.0, 3.0))

    def test_waypoints(self):
        found = mission_files.of_file("a.waypoints", WAYPOINTS)
        self.assertEqual([(i.command, i.params[0]) for i in found], [(22, 0.0), (16, 5.0)])

    def test_jumps_of_plans_name_items_by_their_ids(self):
        def plan(*items):
            place = {16: [0, 0, 0, None, 41.19, -8.7, 50], 22: [0, 0, 0, None, 41.185, -8.706, 30]}
            entries = [
                {
                    "type": "SimpleItem",
                    "command": command,
                    "frame": 2 if command == 177 else 3,
                    "params": [to, 2, 0, 0, 0, 0, 0] if command == 177 else place[command],
                    "doJumpId": number,
                }
                for command, number, to in items
            ]
            return json.dumps({"fileType": "Plan", "mission": {"items": entries}})

        found = mission_files.of_file("a.plan", plan((22, 2, 0), (16, 3, 0), (16, 4, 0), (177, 5, 3)))
        self.assertEqual(found[3].params[:2], (2.0, 2.0))
        found = mission_files.of_file("a.plan", plan((22, 9, 0), (177, 3, 9), (16, 1, 0), (177, 4, 1)))
        self.assertEqual([i.params[0] for i in found if i.command == 177], [1.0, 3.0])
        for items, why in (
            (((22, 2, 0), (177, 3, 1)), "item 2 jumps to number 1, which is the number of no item of the file"),
            (((22, 2, 0), (16, 2, 0), (177, 3, 2)), "item 3 jumps to number 2, which is that of 2 items of the file"),
            (((22, 2, 0), (177, 3, 2.5)), "item 2 jumps to number 2.5, which is the number of no item of the file"),
        ):
            with self.assertRaises(Unreadable) as caught:
                mission_files.of_file("a.plan", plan(*items))
            self.assertEqual(str(caught.exception), why)

    def test_jumps_to_tags_are_refused(self):
        with self.assertRaises(plans.Refused) as caught:
            read({"name": "a"}, stored={"a": (*way(2), Item(601, params=(1.0, -1.0, 0.0, 0.0)))})
        self.assertEqual(
            caught.exception.problems, ["item 3 jumps to a tag, which Dolphin cannot follow: use DO_JUMP"]
        )

    def test_what_is_left_out_of_a_plan_is_named(self):
        fence = '"geoFence": {"polygons": [[0]], "circles": []}'
        rally = '"rallyPoints": {"points": [[1, 2, 3]]}'
        self.assertIsNone(mission_files.left_out("a.plan", PLAN))
        self.assertIsNone(mission_files.left_out("a.waypoints", WAYPOINTS))
        self.assertEqual(mission_files.left_out("a.plan", "{%s}" % fence), "its fence is not uploaded")
        self.assertEqual(
            mission_files.left_out("a.plan", "{%s, %s}" % (fence, rally)),
            "its fence and its rally points are not uploaded",
        )

    def test_the_first_row_of_waypoints(self):
        head, home, *rows = WAYPOINTS.splitlines()
        take_off = "1\t0\t3\t84\t0\t0\t-0.0\t0\t41.185\t-8.706\t10\t1"

        def commands(*lines):
            return [i.command for i in mission_files.of_file("a.waypoints", "\n".join([head, *lines]))]

        self.assertEqual(commands(home, *rows), [22, 16])
        self.assertEqual(commands(take_off, *rows), [84, 22, 16])
        for first, why in (
            (
                "0" + take_off[1:],
                "row 0 is the home position, a WAYPOINT (16), and has command 84: put a row before it",
            ),
            (
                "1" + home[1:],
                "its first row is number 1: number the home position 0, or put a row 0 with it before this one",
            ),
        ):
            with self.assertRaises(Unreadable) as caught:
                commands(first, *rows)
            self.assertEqual(str(caught.exception), why)

    def test_jumps_of_waypoints_name_rows(self):
        head, home, *rows = WAYPOINTS.splitlines()
        jump = "3\t0\t2\t177\t2\t4\t0\t0\t0\t0\t0\t1"
        found = mission_files.of_file("a.waypoints", "\n".join([head, home, *rows, jump]))
        self.assertEqual(found[2].params[:2], (2.0, 4.0))
        take_off = rows[0].replace("\t22\t", "\t84\t")
        with self.assertRaises(Unreadable):
            mission_files.of_file("a.waypoints", "\n".join([head, take_off, *rows, jump.replace("177\t2", "177\t1")]))

    def test_comments_a_byte_order_mark_and_nan_in_waypoints(self):
        text = "\ufeff# mine\n" + WAYPOINTS.replace("22\t0\t0\t0\t0\t", "22\t0\tNaN\t0\tnan\t") + "# end\n"
        found = mission_files.of_file("a.waypoints", text)
        self.assertEqual([i.command for i in found], [22, 16])
        self.assertEqual(found[0].params[1], 0.0)
        self.assertTrue(math.isnan(found[0].params[3]))
        self.assertEqual(len(mission_files.of_file("a.plan", "\ufeff" + PLAN)), 5)

    def test_numbers_are_those_of_the_format(self):
        for bad in ("1_0", "0x29", "inf", "1e999", "\u0661", "--1", "1e", "."):
            for column in ("\t5\t", "\t41.186\t"):
                with self.assertRaises(Unreadable):
                    mission_files.of_file("a.waypoints", WAYPOINTS.replace(column, f"\t{bad}\t"))
        for bad in ("NaN", "Infinity", "1e999", "1" + "0" * 400, "true", '"5"'):
            with self.assertRaises(Unreadable):
                mission_files.of_file("a.plan", PLAN.replace("41.186", bad))

    def test_values_of_any_type_in_a_plan(self):
        """Each value of a plan, replaced by one of each type: the items can be sent, or the plan is unreadable."""

        def places(value):
            for key in value if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else ():
                yield value, key
                yield from places(value[key])

        read = 0
        for index in range(len(list(places(json.loads(PLAN))))):
            for other in (None, True, 2.5, 3.0, "text", [], [[]], {}, {"a": 1}):
                plan = json.loads(PLAN)
                container, key = list(places(plan))[index]
                container[key] = other
                text = json.dumps(plan)
                mission_files.left_out("a.plan", text)
                try:
                    items = mission_files.of_file("a.plan", text)
                except Unreadable:
                    continue
                read += 1
                for item in items:
                    struct.pack("<HBffffiifB", item.command, item.frame, *item.params, item.x, item.y, item.z, 1)
        self.assertGreater(read, 0)

    def test_a_lone_surrogate_in_a_plan_can_be_reported(self):
        with self.assertRaises(Unreadable) as caught:
            mission_files.of_file("a.plan", json.dumps({"mission": {"items": [{"type": "\ud800\u00e9"}]}}))
        why = json.loads(encoded({"kind": "checked", "problems": [str(caught.exception)]}).decode())["problems"][0]
        self.assertEqual(why, "item 1 is of type ?\u00e9, which Dolphin does not know")

    def test_unreadable_ones_say_why(self):
        for name, text, why in (
            ("a.plan", "{", "it is not a plan of QGroundControl"),
            ("a.plan", "[]", "it is not a plan of QGroundControl"),
            ("a.plan", '{"mission": {"items": []}}', "it has no items"),
            ("a.plan", '{"mission": {"items": [3]}}', "an item is not an object"),
            (
                "a.plan",
                '{"mission": {"items": [{"command": 16, "frame": 3, "params": [1]}]}}',
                "item 1 has not seven parameters",
            ),
            (
                "a.plan",
                '{"mission": {"items": [{"command": 16, "frame": 3, "params": [0,0,0,0,91,0,0]}]}}',
                "item 1 is at 91, 0, which is not a place",
            ),
            (
                "a.plan",
                '{"mission": {"items": [{"type": "ComplexItem", "complexItemType": "survey"}]}}',
                "its item of type survey lists no items: save it again",
            ),
            (
                "a.plan",
                '{"mission": {"items": [{"type": "ComplexItem", "complexItemType": "fwLandingPattern"}]}}',
                "its landing pattern (fwLandingPattern) is not flown: "
                "replace it by way points and LAND, or by a return",
            ),
            (
                "a.plan",
                '{"mission": {"items": [{"type": "Marker"}]}}',
                "item 1 is of type Marker, which Dolphin does not know",
            ),
            (
                "a.plan",
                '{"mission": {"items": [{"command": 16, "frame": 3, "params": [0,0,0,0,null,null,0]}]}}',
                "item 1 has no place",
            ),
            (
                "a.plan",
                '{"mission": {"items": [{"command": 16, "frame": 2, "params": [0,0,0,0,41,-8,0]}]}}',
                "item 1 flies to a place, and frame 2 has none",
            ),
            ("a.plan", "[" * 100000, "it is not a plan of QGroundControl"),
            ("a.waypoints", "", "its first line is not QGC WPL 110"),
            ("a.waypoints", WAYPOINTS + "1 2\n", "item 3 has 2 columns instead of 12"),
            ("a.waypoints", WAYPOINTS.replace("41.186", "north"), "item 2 has a column that is not a number"),
        ):
            with self.assertRaises(Unreadable) as caught:
                mission_files.of_file(name, text)
            self.assertEqual(str(caught.exception), why)

    def test_a_directory(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (
                ("a.plan", PLAN),
                ("b.waypoints", WAYPOINTS),
                ("b.plan", PLAN),
                ("c.plan", "{"),
                ("d.txt", ""),
            ):
                with open(os.path.join(folder, name), "w") as file:
                    file.write(text)
            found = read_missions(folder)
            self.assertEqual(len(found["a"]), 5)
            self.assertEqual(found["b"], f"{folder} has it twice, as .plan and as .waypoints")
            self.assertEqual(found["c"], "c.plan: it is not a plan of QGroundControl")
            self.assertNotIn("d", found)

    def test_what_may_come_back_otherwise(self):
        sent = waypoint(10, 10, params=(5.0, 0.0, 0.0, math.nan))
        self.assertIsNone(mission.difference(sent, Item(16, 3, (5.0, 2.0, 1.0, 0.0), sent.x + 1, sent.y, 30.01)))
        self.assertEqual(mission.difference(sent, Item(17, 3)), "command 17 instead of 16")
        self.assertIn("parameter 1", mission.difference(sent, waypoint(10, 10, params=(7.0, 0.0, 0.0, 0.0))))
        self.assertIn("instead of", mission.difference(sent, waypoint(11, 10, params=sent.params)))
        self.assertIn("height", mission.difference(sent, waypoint(10, 10, 31.0, params=sent.params)))

    def test_jumps_that_lead_nowhere(self):
        jump = Item(177, params=(9.0, 1.0, 0.0, 0.0))
        with self.assertRaises(plans.Refused) as caught:
            read({"name": "a"}, stored={"a": (*way(2), jump)})
        self.assertEqual(caught.exception.problems, ["item 3 jumps to item 9, and there are 3"])


class Inline(unittest.TestCase):
    def commands(self, plan, whom=UAV):
        return [i.command for i in read(plan, whom).items]

    def refused(self, plan, whom=UAV):
        with self.assertRaises(plans.Refused) as caught:
            read(plan, whom)
        return caught.exception.problems

    def test_maneuvers(self):
        rows = maneuver(
            "rows",
            bearing=0,
            crossAngle=0,
            width=40,
            length=200,
            horizontalStep=20,
            curveOffset=15,
            alternation=100,
            squareCurve=True,
            firstCurveRight=False,
        )
        path = maneuver("followPath", points=[[0, 0, 0], [100, 0, 5]])
        loiter = maneuver("loiter", radius=80, duration=120, direction="counter-clockwise")
        self.assertEqual(self.commands(inline(maneuver("launch"), maneuver("goTo"), loiter)), [178, 22, 16, 19])
        found = read(inline(loiter)).items[1]
        self.assertEqual(found.params, (120.0, 0.0, -80.0, 0.0))
        self.assertEqual([i.z for i in read(inline(path)).items[1:]], [30.0, 25.0])
        corners = [tuple(round(c) for c in geo.offset(HARBOUR, i.place)) for i in read(inline(rows)).items[1:]]
        self.assertEqual(
            corners,
            [(-15, 0), (0, 0), (215, 0), (215, -20), (200, -20), (-15, -20), (-15, -40), (0, -40), (215, -40)],
        )
        self.assertTrue(read(inline(maneuver("skeeping", radius=20, duration=0))).endless)

    def test_the_speed_is_set_when_it_changes(self):
        plan = inline(maneuver("goTo"), maneuver("goTo"), maneuver("goTo", speed=50, speedUnit="percent"))
        self.assertEqual(self.commands(plan), [178, 16, 16, 178, 16])
        self.assertEqual(read(plan).items[3].params, (1.0, -1.0, 50.0, 0.0))

    def test_heights(self):
        height = inline(maneuver("goTo", zUnit="height", z=100))
        self.assertEqual((read(height).items[1].z, read(height).items[1].frame), (47.0, mission.GLOBAL))
        self.assertIn("does not report the distance between ellipsoid", self.refused(height, COPTER)[0])
        depth = inline(maneuver("goTo", zUnit="depth", z=5))
        self.assertEqual(read(depth, SUB).items[1].z, -5.0)
        self.assertEqual(
            self.refused(depth),
            ["maneuver 1.goTo: an aircraft does not dive to a depth of 5 m: give z in Z.Units.ALTITUDE, or 0"],
        )
        self.assertEqual(
            self.refused(depth, BOAT),
            ["maneuver 1.goTo: a USV does not dive to a depth of 5 m: give z in Z.Units.ALTITUDE, or 0"],
        )

    def test_what_does_not_fit_is_refused_with_all_its_reasons(self):
        plan = inline(
            maneuver("yoyo", amplitude=10, pitch=15),
            maneuver("goTo", speedUnit="rpm"),
            maneuver("goTo", payload=[{"name": "Sidescan", "parameters": {}}]),
            maneuver("loiter", radius=20, duration=10, direction="into-wind-or-current"),
        )
        self.assertEqual(
            self.refused(plan),
            [
                "maneuver 1.yoyo: MAVLink has no yoyo",
                "maneuver 1.goTo: MAVLink knows no revolutions per minute: give the speed in metres a second, "
                "or in percent",
                "maneuver 1.goTo: MAVLink has no way to switch on 'Sidescan'",
                "maneuver 1.loiter: MAVLink has no loiter into the wind or current",
            ],
        )
        self.assertEqual(self.refused(inline(maneuver("goTo"), vehicles=["x9"])), ["only x9 may run it"])

    def test_a_camera(self):
        plan = inline(maneuver("goTo", payload=[{"name": "Camera", "parameters": {"rate": "2"}}]))
        self.assertEqual(self.commands(plan), [178, 2000, 16, 2001])
        self.assertEqual(read(plan).items[1].params[1], 0.5)


class Missions(unittest.TestCase):
    def found(self, *words, whom=COPTER):
        return read(items(*words), whom, {"s": way(2)})

    def refused(self, *words, whom=COPTER):
        with self.assertRaises(plans.Refused) as caught:
            self.found(*words, whom=whom)
        return caught.exception.problems

    def test_a_flight(self):
        found = self.found(
            ("name", "photos"),
            ("arm", True),
            ("takeOff", 30),
            ("speed", 5),
            ("move", Named(north=10)),
            ("capturePhoto",),
            ("moveFromHome", 100, 50),
            ("goPos", HERE, Named(altitude=40)),
            ("captureUntilStop", 2),
            ("loiterTurns", 2, Named(radius=20)),
            ("stopCapturing",),
            ("loiterTime", 30),
            ("delay", 5),
            ("jumpToItem", 3, 2),
            ("returnHomeAndLand",),
        )
        self.assertTrue(found.arm)
        self.assertEqual(
            [i.command for i in found.items], [22, 178, 16, 2000, 16, 16, 2000, 18, 2001, 19, 93, 177, 16, 21]
        )
        self.assertEqual(found.items[11].params[:2], (3.0, 2.0))
        north, east = geo.offset(HARBOUR, found.items[2].place)
        self.assertAlmostEqual(north, 10, 1)
        self.assertAlmostEqual(east, 0, 1)
        self.assertEqual(found.items[5].z, 40.0)

    def test_every_word(self):
        area = [
            {**HERE, "latitude": HARBOUR[0] + a, "longitude": HARBOUR[1] + b}
            for a, b in ((0, 0), (0.002, 0), (0.002, 0.002), (0, 0.002))
        ]
        examples = {
            "name": ("x",),
            "arm": (True,),
            "stored": ("s",),
            "speed": (3,),
            "altitude": (20,),
            "home": (HERE,),
            "takeOff": (20,),
            "takeOffWithYaw": (20, 90),
            "move": (1, 2, 3),
            "moveFromHome": (1, 2),
            "goPos": (HERE,),
            "returnHome": (),
            "returnHomeAndLoiter": (10,),
            "returnHomeAndLand": (),
            "landingPoint": (HERE,),
            "moveAndLoiter": (5, 5),
            "loiterPos": (HERE,),
            "loiterTurns": (2,),
            "loiterTime": (9,),
            "delay": (3,),
            "capturePhoto": (),
            "captureSeveralPhotos": (3, 2),
            "captureUntilStop": (2,),
            "stopCapturing": (),
            "jumpToItem": (1,),
            "surveyArea": (area, 30),
        }
        self.assertEqual(set(examples), set(language.WORDS))
        for word, arguments in examples.items():
            found = self.found(("takeOff", 10), (word, *arguments))
            self.assertGreaterEqual(len(found.items), 1, word)

    def test_places_that_are_moved_and_turns(self):
        found = self.found(
            ("takeOff", 30),
            ("move", Named(position=HERE, north=10, east=-5)),
            ("goPos", Named(position=HERE, north=100)),
            ("landingPoint", Named(position=HERE, east=20)),
            ("moveAndLoiter", Named(position=HERE, turns=3, up=5)),
            ("loiterPos", Named(position=HERE, duration=40, radius=-30)),
        ).items
        offsets = [tuple(round(c) for c in geo.offset(HARBOUR, i.place)) for i in found[1:]]
        self.assertEqual(offsets, [(10, -5), (100, 0), (0, 20), (0, 0), (0, 0)])
        self.assertEqual((found[4].command, found[4].params[0], found[4].z), (mission.LOITER_TURNS, 3.0, 35.0))
        self.assertEqual((found[5].command, found[5].params), (mission.LOITER_TIME, (40.0, 0.0, -30.0, 0.0)))
        self.assertEqual(
            self.refused(("takeOff", 5), ("loiterPos", Named(turns=2, duration=5))),
            ["item 2, loiterPos: it takes seconds or turns, above 0, not both"],
        )

    def test_landings_of_planes(self):
        """They need an approach of 5 m ahead for each metre of height; copters do not."""
        far, near = ({**HERE, "latitude": geo.displace(HARBOUR, north, 0)[0]} for north in (260, 240))
        flight = (("takeOff", 50), ("move", 500))
        self.assertEqual([i.command for i in self.found(*flight, ("returnHomeAndLand",)).items], [22, 16, 16, 21])
        for whom in (UAV, plans.For("v1", "vtol", True, HARBOUR, HARBOUR, None, True)):
            why = self.refused(*flight, ("returnHomeAndLand",), whom=whom)
            self.assertEqual(
                why,
                [
                    "item 3, returnHomeAndLand: a plane comes down from 50 m within 0 m: begin the approach by goPos "
                    "250 m or more before the place, and land by landingPoint"
                ],
            )
            for words in ((("goPos", near), ("landingPoint", HERE)), (("landingPoint",),)):
                self.assertIn("a plane comes down from 50 m", self.refused(*flight, *words, whom=whom)[0])
            found = self.found(*flight, ("goPos", far), ("landingPoint", HERE), whom=whom).items
            self.assertEqual([i.command for i in found], [22, 16, 16, 21])
            self.assertIn("from how high", self.refused(("stored", "s"), ("landingPoint", HERE), whom=whom)[0])

    def test_a_home_that_is_set_on_the_way(self):
        found = self.found(("takeOff", 30), ("move", 100), ("home",), ("move", 50), ("returnHome",)).items
        self.assertEqual(found[-1].place, found[1].place)

    def test_whose_it_is(self):
        plan = items(("takeOff", 5))
        plan["body"]["vehicles"] = ["x9"]
        with self.assertRaises(plans.Refused) as caught:
            read(plan, COPTER)
        self.assertEqual(caught.exception.problems, ["only x9 may run it"])

    def test_a_survey_covers_its_area(self):
        area = [
            {**HERE, "latitude": HARBOUR[0] + a, "longitude": HARBOUR[1] + b}
            for a, b in ((0, 0), (0.002, 0), (0.002, 0.002), (0, 0.002))
        ]
        lines = self.found(("altitude", 30), ("surveyArea", area, Named(spacing=20, bearing=0))).items
        offsets = [geo.offset(HARBOUR, i.place) for i in lines]
        self.assertEqual(len(lines) % 2, 0)
        easts = sorted({round(east) for _, east in offsets})
        self.assertLessEqual(max(b - a for a, b in zip(easts, easts[1:])), 21)
        self.assertAlmostEqual(max(north for north, _ in offsets), 222, delta=2)

    def test_refusals(self):
        for words, problems in (
            ([("fly",)], ["'fly' is not an item of missions"]),
            ([("takeOff",)], ["item 1, takeOff: lacks altitude"]),
            ([("takeOff", "high")], ["item 1, takeOff: altitude is not a number within range"]),
            ([("takeOff", 1, 2)], ["item 1, takeOff: takes altitude, not 2 arguments"]),
            ([("takeOff", Named(height=3))], ["item 1, takeOff: has no argument 'height': it has altitude"]),
            ([("goPos", HERE)], ["item 1, goPos: how high? Give altitude: metres above home, or begin with takeOff"]),
            ([("takeOff", 5), ("goPos", 4)], ["item 2, goPos: position is not a position"]),
            ([("takeOff", 5), ("jumpToItem", 7)], ["jumpToItem 7: there are 2 items"]),
            ([("arm", 1)], ["item 1, arm: arm is true or false"]),
            ([("arm", True)], ["it has no items"]),
            ([("stored", "t")], ["there is no mission 't'"]),
        ):
            self.assertEqual(self.refused(*words), problems)
        self.assertEqual(self.refused(("takeOff", 5), whom=BOAT), ["item 1: a USV neither takes off nor lands"])

    def test_another_language(self):
        with self.assertRaises(plans.Refused) as caught:
            read({"name": "x", "language": "prose", "body": {}})
        self.assertEqual(caught.exception.problems, ["plans in prose are not known here"])


if __name__ == "__main__":
    unittest.main()
