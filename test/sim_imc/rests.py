#!/usr/bin/env python3
"""Plans that are stopped at random moments and go on by `rest`, on a simulated vehicle in another process, over IMC.
Consoles are killed and resumed meanwhile. rests.py DOLPHIN [--moments N] [--seed N] [--short] [--keep FOLDER]"""

import argparse
import concurrent.futures
import os
import random
import subprocess
import sys
import tempfile

sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "scripts"))
import flown  # noqa: E402

# A console that dies in the moment between its request to start a rest and the answer cannot know whether it ran.
DIED_ASKING = "it is unknown whether it has run again"
FLEET = "vehicle 'auv', { type 'UUV'; at 41.1855, -8.7068 }\n"
LONG = "move(120, 0); goTo(); skeeping duration: 8; move(40, 20); rows width: 40, length: 80, hstep: 20"
SHORT = "move(50, 0); goTo(); skeeping duration: 2; move(0, 25); goTo()"
PLANS = """v = pick { id 'auv'; timeout 20.seconds }
way = imcPlan { planName 'way'; speed 8, Speed.Units.METERS_PS; locate 41.185, -8.707; goTo(); %s }
away = imcPlan { planName 'away'; speed 8, Speed.Units.METERS_PS; locate 41.1856, -8.7075; goTo() }
"""


def program(maneuvers, stops):
    lines = [PLANS % maneuvers]
    for seconds, goes_away in stops:
        lines.append(f"execute way.rest(v)[v] during {seconds}.seconds\n")
        if goes_away:
            lines.append("execute away[v]\n")
    return "".join(lines) + "execute way.rest(v)[v]\n"


def run(dolphin, folder, first, text, kills):
    """The parts of the way that the vehicle went; consoles are killed after [kills] seconds, as by [flown.fly]."""
    source, fleet = (os.path.join(folder, name) for name in ("mission.dol", "auv.fleet"))
    for path, content in ((source, text), (fleet, FLEET)):
        with open(path, "w", encoding="utf-8") as file:
            file.write(content)
    ports = f"{first}-{first + 4}"
    options = ["--announce", "0.5", "--contact", "0.2", "--discovery-ports", ports, "--port", str(first + 10)]
    vehicles = subprocess.Popen(
        [dolphin, "sim", fleet, "--imc", *options, "--for", "900"], stdout=subprocess.PIPE, text=True)
    try:
        vehicles.stdout.readline()
        console = [dolphin, "exec", source, "--imc-loopback", "--imc-discovery-ports", ports]
        journal = flown.fly(console, folder, kills, 400)
    finally:
        vehicles.kill()
        vehicles.wait()
        vehicles.stdout.close()
    return flown.parts(journal, "auv", "way")


def drawn(seed, short):
    """Seconds of each part and whether the vehicle goes elsewhere after it, and of the consoles."""
    draw = random.Random(seed)
    longest = 8 if short else 40
    stops = [(draw.randint(1, longest), draw.random() < 0.6) for _ in range(1 if short else draw.randint(1, 3))]
    kills = [draw.uniform(2, longest) for _ in range(1 if short else draw.randint(0, 2))]
    return stops, kills


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("dolphin")
    parser.add_argument("--moments", type=int, default=1)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--first-port", type=int, default=21500)
    parser.add_argument("--jobs", type=int, default=5)
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--keep")
    given = parser.parse_args()
    maneuvers = SHORT if given.short else LONG
    top = given.keep or tempfile.mkdtemp()

    def one(number):
        folder = os.path.join(top, str(number))
        os.makedirs(folder, exist_ok=True)
        for name in os.listdir(folder):
            os.remove(os.path.join(folder, name))
        stops, kills = ([], []) if number == 0 else drawn(given.seed + number - 1, given.short)
        port = given.first_port + 20 * (number % (4 * given.jobs))
        try:
            return stops, kills, run(given.dolphin, folder, port, program(maneuvers, stops), kills), None
        except (flown.Flown, OSError, ValueError) as why:
            return stops, kills, [], str(why)

    worst_off, worst_twice, failed, asking, moments = 0.0, 0.0, 0, 0, 0
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        results = list(pool.map(one, range(given.moments + 1)))
    whole = results[0][2]
    for number, (stops, kills, broken, why) in enumerate(results[1:]):
        moments += 1
        if why and kills and DIED_ASKING in why:
            asking += 1
            continue
        try:
            if why:
                raise flown.Flown(why)
            off, more = flown.compare(whole, broken, len(stops) + len(kills))
            worst_off, worst_twice = max(worst_off, off), max(worst_twice, abs(more) / (len(stops) + len(kills)))
        except flown.Flown as why:
            failed += 1
            print(f"seed {given.seed + number}, stops {stops}, kills {kills}: {why}")
    if not given.short:
        print(f"at most {worst_off:g} m off the way, {worst_twice:.0f} m twice for each stop")
    if asking:
        print(f"{asking} failed since the console died just as it asked for a rest")
    print(f"{moments - failed - asking} of {moments} rests over IMC went well")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
