"""Runs the commands of a page of documentation: run.py DOLPHIN PAGE prints PAGE with what its commands print now.

A fenced block "groovy NAME" is the file NAME from there on. In a block "console" a line "$ COMMAND" is run by one shell
for the whole page, and the lines after it are what it prints. A line "..." stands for any lines, and at the end of a
line for the rest of it; figures of time and memory may differ. If what is printed fits, the page's own lines stay.
"""

import os
import re
import subprocess
import sys
import tempfile

END = "-- end of the command --"

# Vehicles and consoles of the page meet on ports of their own, so that nothing else on this machine takes part.
WRAPPER = """#!/bin/sh
case " $* " in
  *" sim "*" --imc "*) exec {dolphin} "$@" --discovery-ports 21340-21344 --port 21350 --announce 0.5 --contact 0.2 ;;
  *" --imc-loopback "*) exec {dolphin} "$@" --imc-discovery-ports 21340-21344 ;;
  *) exec {dolphin} "$@" ;;
esac
"""


class Shell:
    def __init__(self, folder, environment):
        self.process = subprocess.Popen(
            ["/bin/sh"], cwd=folder, env=environment, text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )

    def run(self, command):
        self.process.stdin.write("%s\necho '%s'\n" % (command, END))
        self.process.stdin.flush()
        lines = []
        for line in self.process.stdout:
            if line.endswith(END + "\n"):
                rest = line[: -len(END) - 1]
                return lines + [rest] if rest else lines
            lines.append(line.rstrip("\n"))
        raise SystemExit("the shell ended amid: " + command)

    def end(self):
        self.process.stdin.close()
        self.process.wait(timeout=60)


def pattern(line):
    if line == "...":
        return r"(?:.*\n)*?"
    text = re.escape(line)
    text = re.sub(r"\d+\\\.\d\d\\ s,\\ \d+\\ MiB", r"[0-9.]+ s, [0-9]+ MiB", text)
    if line.endswith("..."):
        text = text[: -len(re.escape("..."))] + ".*"
    return text + r"\n"


def fits(expected, printed):
    return re.fullmatch("".join(map(pattern, expected)), "".join(line + "\n" for line in printed)) is not None


def console(shell, block):
    out = []
    at = 0
    while at < len(block):
        command = block[at]
        at += 1
        expected = []
        while at < len(block) and not block[at].startswith("$ "):
            expected.append(block[at])
            at += 1
        printed = shell.run(command[2:])
        out += [command] + (expected if fits(expected, printed) else printed)
    return out


def page(shell, folder, lines):
    out = []
    at = 0
    while at < len(lines):
        line = lines[at]
        out.append(line)
        at += 1
        if line.startswith("```") and line != "```":
            stop = lines.index("```", at)
            block = lines[at:stop]
            words = line[3:].split()
            if words[0] == "console":
                block = console(shell, block)
            elif len(words) == 2:
                with open(os.path.join(folder, words[1]), "w", encoding="utf-8") as file:
                    file.write("\n".join(block) + "\n")
            out += block + ["```"]
            at = stop + 1
    return out


def main(dolphin, path):
    with open(path, encoding="utf-8") as file:
        lines = file.read().split("\n")
    with tempfile.TemporaryDirectory() as folder:
        tools = os.path.join(folder, ".tools")
        work = os.path.join(folder, "work")
        os.mkdir(tools)
        os.mkdir(work)
        wrapper = os.path.join(tools, "dolphin")
        with open(wrapper, "w", encoding="utf-8") as file:
            file.write(WRAPPER.format(dolphin=os.path.abspath(dolphin)))
        os.chmod(wrapper, 0o755)
        environment = dict(os.environ, PATH=tools + ":" + os.environ["PATH"], HOME=folder, NO_COLOR="1", TERM="dumb")
        environment.pop("XDG_STATE_HOME", None)
        shell = Shell(work, environment)
        made = page(shell, work, lines)
        shell.end()
    sys.stdout.write("\n".join(made))


main(sys.argv[1], sys.argv[2])
