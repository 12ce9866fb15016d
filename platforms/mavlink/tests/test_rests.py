"""Missions that are stopped at random moments and go on by `rest`, with the command itself: the environment variable
DOLPHIN. Consoles are killed and resumed meanwhile. DOLPHIN_RESTS is the number of moments, by seeds from DOLPHIN_SEED
on."""

import concurrent.futures
import os
import random
import subprocess
import sys
import tempfile
import threading
import unittest

import flown
from tests.test_process import FOLDER, free_port

DOLPHIN = os.environ.get("DOLPHIN")
MOMENTS = int(os.environ.get("DOLPHIN_RESTS", "0"))
PORTS = threading.Lock()
# A mission that ends by landing while its console is dead fails: the vehicle may have flown it.
LANDED_UNHEARD = "may have flown it"
# Metres a second of the simulator's vehicles, and where their missions lead.
KINDS = {"copter": 8, "plane": 18}
LONG = """arm: true; takeOff 30; goPos 41.1860, -8.7065; goPos 41.1868, -8.7065, altitude: 40
    loiterTime 6.seconds; surveyArea(location(41.1875, -8.7055) ^ 100.m, 30); goPos 41.1860, -8.7050"""
SHORT = "arm: true; takeOff 30; goPos 41.1853, -8.7060; loiterTime 2.seconds; goPos 41.1856, -8.7060"
PLANS = """v = pick { type 'UAV'; timeout 20.seconds }
way = mission { name 'way'; %s }
away = mission { name 'away'; arm: true; takeOff 30; goPos 41.1854, -8.7066%s }
"""


def program(items, stops):
    """[stops] are seconds, and whether the vehicle goes elsewhere afterwards, and whether it lands there."""
    lines = [PLANS % (items, "; returnHomeAndLand()" if any(lands for _, _, lands in stops) else "")]
    for seconds, goes_away, _ in stops:
        lines.append(f"execute way.rest(v)[v] during {seconds}.seconds\n")
        if goes_away:
            lines.append("execute away[v]\n")
    return "".join(lines) + "execute way.rest(v)[v]\n"


def spawn_vehicle(kind, port):
    options = ["--to", f"127.0.0.1:{port}", "--place=41.1850,-8.7062"]
    return subprocess.Popen([sys.executable, "-B", "-m", "sim", *options, kind], cwd=FOLDER, stdin=subprocess.PIPE)


def run(folder, spawn, adapter_options, text, kills, vehicle="mav-1"):
    """The parts of the way that the vehicle flew; consoles are killed after [kills] seconds, as by [flown.fly]."""
    with PORTS:
        port = free_port()
    source = os.path.join(folder, "mission.dol")
    with open(source, "w", encoding="utf-8") as file:
        file.write(text)
    adapter = f"{os.path.join(FOLDER, 'dolphin-mavlink')} --udp {port} {adapter_options}"
    environment = dict(os.environ, DOLPHIN_MAVLINK=sys.executable)
    sky = spawn(port)
    try:
        command = [DOLPHIN, "exec", source, "--platform", adapter]
        journal = flown.fly(command, folder, kills, 900, env=environment)
    finally:
        sky.kill()
        sky.wait()
        sky.stdin.close()
    return flown.parts(journal, vehicle, "way")


def drawn(seed, longest, most, may_land):
    draw = random.Random(seed)
    lands = draw.random() < 0.2 and may_land
    stops = [(draw.randint(2, longest), draw.random() < 0.6, lands) for _ in range(draw.randint(1, most))]
    kills = [draw.uniform(4, longest) for _ in range(draw.randint(0, most - 1))]
    return stops, kills


@unittest.skipUnless(DOLPHIN, "DOLPHIN is not set")
class Rests(unittest.TestCase):
    def flies_once(self, spawn, options, items, cases, vehicle="mav-1", twice=flown.TWICE):
        """The worst metres off the way, and flown twice for each stop; and the number of runs whose vehicle landed
        while the console was dead."""
        with tempfile.TemporaryDirectory() as top:
            top = os.environ.get("DOLPHIN_KEPT", top)

            def one(case):
                number, stops, kills = case
                folder = tempfile.mkdtemp(prefix=f"rests-{number}-", dir=top)
                try:
                    return run(folder, spawn, options, program(items, stops), kills, vehicle), None
                except (flown.Flown, OSError) as why:
                    return [], str(why)

            with concurrent.futures.ThreadPoolExecutor(6) as pool:
                (whole, why), *broken = pool.map(one, [("whole", [], []), *cases])
            self.assertIsNone(why)
            off, most, unheard = 0.0, 0.0, 0
            for (number, stops, kills), (parts, why) in zip(cases, broken):
                with self.subTest(seed=number, stops=stops, kills=kills):
                    if why and LANDED_UNHEARD in why and kills and any(lands for _, _, lands in stops):
                        unheard += 1
                        continue
                    self.assertIsNone(why)
                    try:
                        here, more = flown.compare(whole, parts, len(stops) + len(kills), twice)
                    except flown.Flown as why:
                        self.fail(str(why))
                    off, most = max(off, here), max(most, abs(more) / (len(stops) + len(kills)))
            return off, most, unheard

    def test_a_mission_that_is_stopped_and_whose_console_is_killed(self):
        cases = [(0, [(5, True, False)], []), (1, [(6, False, False)], [4.5]), (2, [(4, True, False)], [6.0])]
        self.flies_once(lambda port: spawn_vehicle("copter", port), "", SHORT, cases)

    # The flights take too long for each change: `make nightly` sets DOLPHIN_RESTS.
    if MOMENTS:

        def test_random_moments(self):
            seed = int(os.environ.get("DOLPHIN_SEED", "0"))
            for kind, speed in KINDS.items():
                seeds = range(seed, seed + (MOMENTS + 1) // 2)
                cases = [(n, *drawn(n, 900 // speed, 3, kind == "copter")) for n in seeds]
                # The time between two reports, that of the order to stop, and the turn back
                bound = max(flown.TWICE, 3.5 * speed)
                off, again, unheard = self.flies_once(
                    lambda port, kind=kind: spawn_vehicle(kind, port), "", LONG, cases, twice=bound)
                rests = f"{len(cases)} rests, of which {unheard} landed unheard" if unheard else f"{len(cases)} rests"
                print(f"{kind}: at most {off:g} m off the way, {again:.0f} m twice for each stop, {rests}")


if __name__ == "__main__":
    unittest.main()
