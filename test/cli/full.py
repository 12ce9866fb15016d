"""Every output of every command on a full disk: the status is 3, the message names what could not be written, and no
other file is blamed or left in part. Programs are drawn."""

import glob
import os
import random
import resource
import shutil
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


def limited(program):
    """Files that are longer than a process may write: OUT is the file."""
    run = "full.run"
    return [
        ["lts", program, "-o", "OUT"], ["trace", "draw", run, "-o", "OUT.svg"],
        ["trace", "draw", run, "-o", "OUT.html"], ["time", program, "--draw", "OUT.svg"],
        ["explore", program, "--junit", "OUT"], ["explore", program, "--sarif", "OUT"],
        ["trace", "export", run, "--to", "csv", "-o", "OUT"],
        ["trace", "export", run, "--to", "gpx", "-o", "OUT"], ["trace", "export", run, "--to", "kml", "-o", "OUT"],
        ["trace", "export", run, "--to", "geojson", "-o", "OUT"], ["trace", "export", run, "--to", "mcap", "-o", "OUT"],
    ]


def too_long(arguments):
    """A file that cannot be written whole is as it was before, or is not there."""
    name = next(argument for argument in arguments if argument.startswith("OUT"))
    for old in (None, "as it was"):
        if old:
            with open(name, "w") as file:
                file.write(old)
        run = subprocess.run(
            ["dolphin", *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            text=True, timeout=60, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))
        )
        complain(arguments, run, name)
        found = None
        if os.path.exists(name):
            with open(name) as file:
                found = file.read()
            os.remove(name)
        if found != old:
            print(f"dolphin {' '.join(arguments)}: the file has {found!r}")


def tree(folder):
    """Its files with their texts, and its folders."""
    found = {}
    for path, folders, names in os.walk(folder):
        found.update({os.path.join(path, name): None for name in folders})
        for name in names:
            with open(os.path.join(path, name)) as file:
                found[os.path.join(path, name)] = file.read()
    return found


def folders(program):
    """A folder that cannot be written whole is as it was before, or is not there, whichever of its files is too long."""
    fleet = ["--fleet", f"{EXAMPLES}/abort.fleet"]
    for arguments in (["new", "OUT/deep"], ["tla", program, *fleet, "-o", "OUT/deep"]):
        dolphin(arguments, "/dev/null")
        whole = tree("OUT")
        sizes = sorted(len(text) for text in whole.values() if text)
        for old in (None, "as it was"):
            for size in sizes:
                shutil.rmtree("OUT", ignore_errors=True)
                if old and arguments[0] == "tla":
                    for path, text in whole.items():
                        os.makedirs(os.path.dirname(path), exist_ok=True)
                        if text:
                            with open(path, "w") as file:
                                file.write(old)
                before = tree("OUT")
                run = subprocess.run(
                    ["dolphin", *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                    text=True, timeout=60,
                    preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size - 1, size - 1))
                )
                complain(arguments, run, ": File too large")
                if "OUT/deep/" not in run.stderr:
                    print(f"dolphin {' '.join(arguments)}: no file is named: {run.stderr}")
                if tree("OUT") != before or os.path.exists("OUT") != bool(before):
                    print(f"dolphin {' '.join(arguments)}, at most {size - 1} bytes: the folder has {sorted(tree('OUT'))}")
        shutil.rmtree("OUT", ignore_errors=True)


def cache(program):
    """Verdicts that cannot be kept are printed, and leave no file."""
    run = subprocess.run(
        ["dolphin", "explore", program, "--cache"], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
        stderr=subprocess.PIPE, text=True, timeout=60, env={**os.environ, "XDG_CACHE_HOME": os.path.abspath("OUT")},
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))
    )
    if run.returncode != 0 or "OUT/dolphin/explore/" not in run.stderr or ": File too large" not in run.stderr:
        print(f"dolphin explore {program} --cache: status {run.returncode}: {run.stderr[:200]}")
    left = [text for text in tree("OUT").values() if text is not None]
    if left:
        print(f"dolphin explore {program} --cache: {len(left)} files")
    shutil.rmtree("OUT", ignore_errors=True)


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
    for arguments in limited(program):
        too_long(arguments)
    folders(f"{EXAMPLES}/abort.dol")
    cache(f"{EXAMPLES}/abort.dol")
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
