"""Files of missions as other programs, people and accidents leave them: the mission, or the reason of a refusal."""

import copy
import json
import math
import random
import unittest

from dolphin_mavlink import mission, mission_files, plans
from dolphin_mavlink.mission import Unreadable
from dolphin_mavlink.wire import Wire
from seeds import seeds


def simple(command, params, frame=3, **more):
    return {"type": "SimpleItem", "command": command, "frame": frame, "params": params, "autoContinue": True, **more}


PLAN = {
    "fileType": "Plan",
    "mission": {
        "items": [
            simple(22, [0, 0, 0, None, 41.185, -8.706, 30], doJumpId=1),
            {
                "type": "ComplexItem",
                "complexItemType": "survey",
                "TransectStyleComplexItem": {
                    "Items": [
                        simple(16, [0, 0, 0, None, 41.186, -8.706, 30], doJumpId=4),
                        simple(206, [25, 0, 1, 0, 0, 0, 0], 2, doJumpId=5),
                        simple(16, [0, 0, 0, None, 41.187, -8.706, 30], doJumpId=6),
                    ]
                },
            },
            simple(195, [0, 0, 0, 0, 41.19, -8.7, 0], doJumpId=8),
            simple(177, [4, 2, 0, 0, 0, 0, 0], 2, doJumpId=9),
            simple(20, [0, 0, 0, 0, 0, 0, 0], 2, doJumpId=10),
        ]
    },
    "geoFence": {"polygons": [], "circles": []},
    "rallyPoints": {"points": []},
}
ROWS = [
    "0\t1\t0\t16\t0\t0\t0\t0\t41.185\t-8.706\t12\t1",
    "1\t0\t3\t22\t0\t0\t0\t0\t0\t0\t30\t1",
    "2\t0\t3\t16\t0\t0\t0\t0\t41.186\t-8.706\t30\t1",
    "3\t0\t3\t201\t0\t0\t0\t0\t41.19\t-8.7\t0\t1",
    "4\t0\t3\t177\t2\t3\t0\t0\t0\t0\t0\t1",
    "5\t0\t3\t16\t0\t0\t0\t0\t41.187\t-8.706\t30\t1",
    "6\t0\t3\t20\t0\t0\t0\t0\t0\t0\t0\t1",
]
HEAD = "QGC WPL 110"
STRANGE = [None, True, False, -1, 0, 1.5, 2**31, 2**70, 1e39, -1e39, "", "16", [], [1], {}, {"a": 1}]


def rows(lines):
    return "\n".join([HEAD, *lines]) + "\n"


def paths(value, at=()):
    """The paths to all values inside of a JSON value."""
    inner = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, x in inner:
        yield (*at, key)
        yield from paths(x, (*at, key))


class Damaged(unittest.TestCase):
    def taken(self, name, text):
        """Its items, which can be sent; None if it is refused with a reason."""
        try:
            items = mission_files.of_file(name, text)
        except Unreadable as why:
            self.assertTrue(str(why))
            return None
        mission.problems(items)
        mission_files.left_out(name, text)
        wire = Wire(255, 190)
        for n, item in enumerate(items):
            wire.encode(item.message((1, 1), n))
            self.assertTrue(all(math.isfinite(c) for c in (*item.params[:3], item.z)))
        return items

    def test_plans_with_strange_values(self):
        """Anything anywhere: it is refused in words, or makes items that can be sent."""
        places = list(paths(PLAN))
        for seed in seeds(20):
            draw = random.Random(seed)
            for _ in range(100):
                damaged = copy.deepcopy(PLAN)
                for _ in range(draw.choice((1, 1, 2))):
                    *way, last = draw.choice(places)
                    inner = damaged
                    try:
                        for key in way:
                            inner = inner[key]
                        if draw.random() < 0.2:
                            del inner[last]
                        else:
                            inner[last] = copy.deepcopy(draw.choice(STRANGE))
                    except (KeyError, TypeError, IndexError):
                        continue
                text = json.dumps(damaged)
                with self.subTest(seed=seed, text=text):
                    self.taken("a.plan", text)

    def test_rows_with_strange_columns(self):
        words = ["nan", "NaN", "-nan", "inf", "1e39", "-1", "1e400", "0x10", "1_0", "", "41,1", "４", "2147483648", "x"]
        for seed in seeds(20):
            draw = random.Random(seed)
            for _ in range(100):
                lines = [line.split("\t") for line in ROWS]
                draw.choice(lines)[draw.randrange(12)] = draw.choice(words)
                text = rows("\t".join(line) for line in lines)
                with self.subTest(seed=seed, text=text):
                    self.taken("a.waypoints", text)

    def test_files_that_are_cut_short(self):
        """A plan has an end. Rows are refused if one is cut in a column or before its last one."""
        whole = json.dumps(PLAN)
        for n in range(len(whole)):
            self.assertIsNone(self.taken("a.plan", whole[:n]), n)
        text = rows(ROWS)
        ends = {text.index(row) + len(row) for row in ROWS[1:]}
        for n in range(len(text) - 1):
            found = self.taken("a.waypoints", text[:n])
            if n not in ends and n - 1 not in ends:
                self.assertIsNone(found, text[:n])

    def test_no_height(self):
        """It would be 0 m above home."""
        for command in sorted(mission.DESTINATIONS):
            for name, text in (
                ("a.plan", json.dumps({"mission": {"items": [simple(command, [0, 0, 0, 0, 41, -8, None])]}})),
                ("a.waypoints", rows([ROWS[0], f"1\t0\t3\t{command}\t0\t0\t0\t0\t41\t-8\tnan\t1"])),
            ):
                with self.subTest(command=command, name=name):
                    if command in (mission.LAND, mission.VTOL_LAND, 94):
                        self.assertEqual(mission_files.of_file(name, text)[0].z, 0.0)
                    else:
                        with self.assertRaisesRegex(Unreadable, "^item 1 has no height$"):
                            mission_files.of_file(name, text)
        home = rows([ROWS[0].replace("\t12\t", "\tnan\t"), *ROWS[1:]])
        self.assertEqual(mission_files.of_file("a.waypoints", home), mission_files.of_file("a.waypoints", rows(ROWS)))


class Written(unittest.TestCase):
    """The same mission, written otherwise."""

    def test_rows(self):
        plain = rows(ROWS)
        found = mission_files.of_file("a.waypoints", plain)
        self.assertEqual([item.command for item in found], [22, 16, 201, 177, 16, 20])
        comments = "\n# by hand\n\n".join(["# first", HEAD, *ROWS, ""])
        for text in (
            plain.replace("\n", "\r\n"),
            plain.replace("\n", "\r"),
            "\ufeff" + plain,
            plain + "\x1a",
            plain.replace("\n", "\r\n") + "\x1a",
            plain.replace("\t", " "),
            plain.replace("\t", "  \t"),
            plain.rstrip("\n"),
            plain + "\n \n\t\n",
            plain.replace("0\t1\t0\t16\t", "0\t1\t0\t0\t"),  # a home position as Mission Planner may write it
            comments,
            "\ufeff" + comments.replace("\n", "\r\n"),
        ):
            with self.subTest(text=text):
                self.assertEqual(mission_files.of_file("a.waypoints", text), found)

    def test_plans(self):
        found = repr(mission_files.of_file("a.plan", json.dumps(PLAN)))
        for text in (
            json.dumps(PLAN, indent=4).replace("\n", "\r\n"),
            "\ufeff" + json.dumps(PLAN),
            json.dumps(PLAN, sort_keys=True) + "\n\x1a",
        ):
            self.assertEqual(repr(mission_files.of_file("a.plan", text)), found)

    def test_jumps_by_ids_lead_to_the_same_item_however_ids_are_given(self):
        for seed in seeds(20):
            draw = random.Random(seed)
            count, target = 8, draw.randrange(8)
            ids = draw.sample(range(1, 1000), count + 1)
            items = [
                simple(16, [0, 0, 0, None, 41 + n / 100, -8, 30], doJumpId=ids[n]) for n in range(count)
            ]
            items.append(simple(177, [ids[target], 2, 0, 0, 0, 0, 0], 2, doJumpId=ids[count]))
            if draw.random() < 0.5:
                items[2:5] = [{"type": "ComplexItem", "complexItemType": "survey", "Items": items[2:5]}]
            found = mission_files.of_file("a.plan", json.dumps({"mission": {"items": items}}))
            self.assertEqual(found[int(found[-1].params[0]) - 1].place[0], 41 + target / 100)


    def test_jumps_by_rows_lead_to_the_same_item_however_rows_are_counted(self):
        """Rows that lack a number, as after one was deleted by hand: ground stations count them again. A jump over
        the gap is refused, for it means one item or the next one; others lead where they led."""
        for seed in seeds(20):
            draw = random.Random(seed)
            count = draw.randrange(4, 9)
            numbers = list(range(1, count + 1))
            gap = draw.choice((None, draw.randrange(count)))
            if gap is not None:
                numbers = [n + (n > gap) for n in numbers]
            target = draw.randrange(count)
            lines = [f"{n}\t0\t3\t16\t0\t0\t0\t0\t{41 + k / 100}\t-8\t30\t1" for k, n in enumerate(numbers)]
            lines.append(f"{numbers[-1] + 1}\t0\t3\t177\t{numbers[target]}\t2\t0\t0\t0\t0\t0\t1")
            text = rows([ROWS[0], *lines])
            with self.subTest(seed=seed, text=text):
                if numbers[target] == target + 1:
                    found = mission_files.of_file("a.waypoints", text)
                    self.assertEqual(found[-1].params[:2], (target + 1.0, 2.0))
                else:
                    with self.assertRaisesRegex(Unreadable, f"jumps to number {target + 2}, and that row is number"):
                        mission_files.of_file("a.waypoints", text)


class Refused(unittest.TestCase):
    """Items that cannot be flown are named."""

    def refused(self, why, *items):
        with self.assertRaises(Unreadable) as caught:
            mission_files.of_file("a.plan", json.dumps({"mission": {"items": items}}))
        self.assertIn(why, str(caught.exception))

    def test_by_name(self):
        for kind in ("fwLandingPattern", "vtolLandingPattern"):
            self.refused(f"its landing pattern ({kind})", {"type": "ComplexItem", "complexItemType": kind})
        self.refused("of type StructureScan", {"type": "ComplexItem", "complexItemType": "StructureScan"})
        self.refused("of type Widget", {"type": "Widget"})
        self.refused("without a type", {"type": "ComplexItem", "complexItemType": ["survey"], "Items": []})
        for command in (5000, 5001, 5002, 5003, 5004):
            self.refused(f"(command {command}) belongs to a fence", simple(command, [0, 0, 0, 0, 41, -8, 0]))
        self.refused("list of rally points", simple(5100, [0, 0, 0, 0, 41, -8, 0]))
        self.refused("parameter 1 of item 1 is out of range", simple(16, [1e39, 0, 0, 0, 41, -8, 30]))
        self.refused("frame [3]", simple(16, [0, 0, 0, 0, 41, -8, 30], [3]))

    def compiled(self, items, whom):
        return plans.compile_plan({"name": "a"}, lambda name: tuple(items), whom)

    def test_jumps(self):
        way = mission.Item(16, 6, x=410000000, y=-80000000, z=30.0)
        for times, why in (
            (-2.0, "item 2 jumps -2 times"),
            (1.5, "item 2 jumps 1.5 times"),
        ):
            with self.assertRaisesRegex(plans.Refused, why):
                self.compiled([way, mission.Item(mission.JUMP, params=(1.0, times, 0.0, 0.0))], plans.For())

    def test_an_item_after_which_px4_does_not_go_on(self):
        way = mission.Item(16, 6, x=410000000, y=-80000000, z=30.0)
        stays = mission.dataclasses.replace(way, autocontinue=0)
        px4, ardupilot = plans.For("a", "copter", True, known=True), plans.For("a", "copter", False, known=True)
        with self.assertRaisesRegex(plans.Refused, "item 2 does not go on to the next one"):
            self.compiled([way, stays, way], px4)
        self.assertEqual(len(self.compiled([way, stays], px4).items), 2)
        self.assertEqual(len(self.compiled([way, stays, way], ardupilot).items), 3)


if __name__ == "__main__":
    unittest.main()
