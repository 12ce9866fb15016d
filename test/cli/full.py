"""Every output of every command on a full disk: the status is 3, the message names what could not be written, and no
other file is blamed or left in part. Programs are drawn."""

import glob
import os
import random
import subprocess
import sys

EXAMPLES = sys.argv[1]
OUTPUT = "cannot be written: No space left on device"


def dolphin(arguments, stdout):
    with open(stdout, "w") as out:
        return subprocess.run(
            ["dolphin", *arguments], stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.PIPE, text=True, timeout=60
        )


def standard_outputs(program):
    run = "full.run"
    return [
        ["--help"], ["--version"], ["check", program], ["exec", program], ["explore", program],
        ["explore", program, "--json"], ["time", program], ["time", program, "--json"], ["lts", program],
        ["plan", f"{EXAMPLES}/coverage.dol"], ["parse", program], ["doctor"], ["help"], ["help", "exec"],
        ["help", program], ["exec", program, "--runs", "3"], ["trace", "check", program, run],
        ["trace", "show", run], ["trace", "export", run, "--to", "csv"], ["walk", program],
        ["successors", program, "--greeting"], ["conform", "--help"], ["fleet", "--help"], ["runs", "--help"],
        ["explore", program, "--from", "./part.run"], ["time", program, "--from", "./part.run"],
    ]


def files(program):
    run = "full.run"
    return [
        ["exec", program, "--journal", "/dev/full"], ["lts", program, "-o", "/dev/full"],
        ["explore", program, "--junit", "/dev/full"], ["explore", program, "--sarif", "/dev/full"],
        ["trace", "export", run, "--to", "gpx", "-o", "/dev/full"],
    ]


def complain(arguments, run, wanted):
    errors = run.stderr.strip()
    if run.returncode != 3 or wanted not in errors or "full.run:" in errors:
        print(f"dolphin {' '.join(arguments)}: status {run.returncode}: {errors[:200]}")


def check(program):
    for name in ("full.run", "part.run"):
        if os.path.exists(name):
            os.remove(name)
    dolphin(["exec", program, "--journal", "full.run"], "/dev/null")
    with open("full.run") as file:
        lines = file.readlines()
    with open("part.run", "w") as file:
        file.writelines(lines[: len(lines) // 2])
    before = set(os.listdir("."))
    for arguments in standard_outputs(program):
        complain(arguments, dolphin(arguments, "/dev/full"), OUTPUT)
    for arguments in files(program):
        complain(arguments, dolphin(arguments, "/dev/null"), "/dev/full")
    left = set(os.listdir(".")) - before
    if left:
        print(f"{program}: left behind: {sorted(left)}")


def picks_vehicles(program):
    """Journals without vehicles are not exported."""
    with open(program) as file:
        return any("pick" in line for line in file if not line.startswith("//"))


programs = list(filter(picks_vehicles, sorted(glob.glob(f"{EXAMPLES}/*.dol"))))
for seed in [4] + [int(os.environ[name]) for name in ["DOLPHIN_SEED"] if name in os.environ]:
    check(random.Random(seed).choice(programs))
