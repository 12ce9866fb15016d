#!/usr/bin/env python3
"""A second runner of the conformance corpus, from conformance/INTERPRETING.md alone.

Usage: runner.py CMD CASES...

CMD is a program that speaks the step protocol, CASES are case files. A line for each case has its result and its
faults; the last line counts.
"""

import json
import subprocess
import sys

WORDED = ("broken", "fault", "cannot-execute", "no-vehicles", "pick")
LONGEST_WALK = 10_000
MOST_PLACES = 20_000


class Trouble(Exception):
    """The implementation violates the protocol."""


class Wrong(Exception):
    """An expectation is not met."""


class Implementation:
    def __init__(self, command):
        self.process = subprocess.Popen(command, shell=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                        encoding="utf-8")
        self.asked = 0

    def ask(self, request, **members):
        self.asked += 1
        line = json.dumps({"id": self.asked, "request": request, **members})
        try:
            self.process.stdin.write(line + "\n")
            self.process.stdin.flush()
            reply = json.loads(self.process.stdout.readline())
        except (OSError, ValueError) as error:
            raise Trouble(str(error))
        if reply.get("id") != self.asked or "error" in reply:
            raise Trouble(f"{request}: {reply.get('error')}")
        return reply

    def steps(self, place, events=None):
        configuration, world, now = place
        chosen = {} if events is None else {"events": events}
        if now:
            chosen["now"] = now
        reply = self.ask("step", configuration=configuration, world=world, **chosen)
        internal = [t for t in reply["transitions"] if "event" not in t]
        caused = [t for t in reply["transitions"] if "event" in t]
        return internal, caused, reply["awaited"]

    def close(self):
        self.process.stdin.close()
        self.process.wait()


# What a transition must be


def same_label(expected, seen):
    return expected == seen or expected in WORDED and seen.startswith(expected + "(")


def same_effect(expected, seen):
    if "look-for" in expected and "look-for" in seen:
        return True
    if "end" in expected and "end" in seen and "message" not in expected["end"]:
        seen = {"end": {k: x for k, x in seen["end"].items() if k != "message"}}
    return expected == seen


def same_ending(expected, seen):
    if seen is None or expected["ending"] != seen["ending"]:
        return False
    return "message" not in expected or expected["message"] == seen.get("message")


def fits(step, t):
    after = t["next"]
    effects = t.get("effects", [])
    return (same_label(step["label"], t["label"])
            and ("rule" not in step or step["rule"] == t["rule"])
            and ("effects" not in step
                 or len(step["effects"]) == len(effects)
                 and all(same_effect(e, s) for e, s in zip(step["effects"], effects)))
            and ("A" not in step or step["A"] == after["A"])
            and ("B" not in step or step["B"] == after["B"])
            and ("N" not in step or sorted(step["N"]) == sorted(after["N"]))
            and ("store" not in step or all(after["store"].get(x) == value for x, value in step["store"].items()))
            and ("end" not in step or same_ending(step["end"], after["end"])))


# Runs


class Walker:
    def __init__(self, implementation, place):
        self.implementation = implementation
        self.start = place
        self.rules = set()

    def take(self, place, t):
        self.rules.update(t["rule"])
        return t["next"], *place[1:]

    def candidates(self, place, step):
        place = (place[0], step.get("world", place[1]), step.get("now", place[2]))
        event = step.get("event")
        internal, caused, _ = self.implementation.steps(place, [] if event is None else [event])
        return place, internal if event is None else caused

    def until(self, place, label):
        for _ in range(LONGEST_WALK):
            internal, _, _ = self.implementation.steps(place, [])
            if not internal:
                break
            place = self.take(place, internal[0])
            if same_label(label, internal[0]["label"]):
                return place
        raise Wrong(f"there is no {label}")

    def trace(self, steps):
        place = self.start
        for step in steps:
            if isinstance(step, dict) and "until" in step:
                place = self.until(place, step["until"])
                continue
            step = {"label": step} if isinstance(step, str) else step
            place, there = self.candidates(place, step)
            if not there or not fits(step, there[0]):
                raise Wrong(f"{step['label']} does not come first")
            place = self.take(place, there[0])
        if self.implementation.steps(place, [])[0]:
            raise Wrong("the run goes on")

    def follow(self, places, step):
        """The places after a step from any of these places."""
        reached = {}
        for place in places:
            place, there = self.candidates(place, step)
            for t in there:
                if fits(step, t):
                    after = self.take(place, t)
                    reached[json.dumps(after[0], sort_keys=True)] = after
        return list(reached.values())

    def along(self, steps):
        places = [self.start]
        for step in steps:
            if isinstance(step, dict) and "until" in step:
                places = [self.until(place, step["until"]) for place in places]
                continue
            step = {"label": step} if isinstance(step, str) else step
            places = self.follow(places, step)
            if not places:
                raise Wrong(f"{step['label']} is not possible")
        return places

    def admits(self, steps):
        self.along(steps)

    def forbids(self, steps):
        places = self.along(steps[:-1])
        before = set(self.rules)
        last = {"label": steps[-1]} if isinstance(steps[-1], str) else steps[-1]
        if self.follow(places, last):
            raise Wrong(f"{last['label']} is possible")
        self.rules = before

    def events(self, configuration, awaited, environment):
        """The environment's further events, besides ends of tasks and expiries of timers, which always come."""
        running, events = configuration["A"], []
        failing = environment.get("fails", []) + environment.get("mayFail", [])
        answers, replies = environment.get("answers", {}), environment.get("replies", [])
        for pattern in awaited:
            kind = pattern["event"]
            if kind == "failed" and running[pattern["vehicle"]] in failing:
                events.append({"event": "failed", "vehicle": pattern["vehicle"], "why": "failure"})
            elif kind == "answer":
                events += [{"event": "answer", "text": text} for text in answers.get(pattern["prompt"], [])]
                if pattern["prompt"] not in answers:
                    events.append({"event": "no-answer", "why": "nobody"})
            elif kind == "confirmation":
                question = pattern["question"]
                events += [{"event": kind, "question": question, "yes": yes} for yes in (True, False)]
            elif kind == "reply":
                events += [{"event": "reply", "value": x} for x in replies]
            elif kind == "no-reply" and not replies:
                events.append({"event": "no-reply", "why": "no host"})
            elif kind == "interruption" and environment.get("interruption"):
                events.append({"event": "interruption"})
        return events

    def outcomes(self, environment):
        """The ends of runs, each with the rest of N."""
        found, queue, known = [], [self.start], {json.dumps(self.start[0], sort_keys=True)}
        while queue:
            place = queue.pop()
            configuration = place[0]
            internal, caused, awaited = self.implementation.steps(place)
            always = environment.get("fails", [])
            caused = [t for t in caused if not (t["event"]["event"] == "done"
                                                and configuration["A"][t["event"]["vehicle"]] in always)]
            events = self.events(configuration, awaited, environment)
            if events:
                caused += self.implementation.steps(place, events)[1]
            if configuration["end"]:
                found.append({**configuration["end"], "N": sorted(configuration["N"])})
            elif not internal and not caused:
                found.append({"ending": "stuck", "N": sorted(configuration["N"])})
            for t in internal + caused:
                after = self.take(place, t)
                key = json.dumps(after[0], sort_keys=True)
                if key not in known:
                    known.add(key)
                    queue.append(after)
            if len(known) > MOST_PLACES:
                raise Wrong("there are too many configurations")
        return found


def same_outcome(expected, seen):
    return same_ending(expected, seen) and sorted(expected.get("N", [])) == seen["N"]


# Times


def with_faults(environment):
    return {"faults": environment["faults"]} if "faults" in environment else {}


def same_times(expected, seen):
    moments = {(task["task"], task["vehicle"]): task for task in seen.get("tasks", [])}
    return (expected.get("ends", {}) == seen.get("ends", {})
            and expected.get("endless", False) == seen.get("endless", False)
            and sorted(expected.get("missed", [])) == sorted(seen.get("missed", []))
            and all(moments.get((task["task"], task["vehicle"])) == task for task in expected.get("tasks", [])))


def same_findings(expected, seen):
    def key(finding):
        return json.dumps(finding, sort_keys=True)

    return sorted(expected, key=key) == sorted(seen, key=key)


def check(walker, kind, expected, environment):
    if kind == "trace":
        walker.trace(expected)
    elif kind == "admits":
        walker.admits(expected)
    elif kind == "forbids":
        walker.forbids(expected)
    elif kind == "outcomes":
        found = walker.outcomes(environment)
        if not all(any(same_outcome(e, s) for s in found) for e in expected):
            raise Wrong("an outcome is missing")
        if not all(any(same_outcome(e, s) for e in expected) for s in found):
            raise Wrong("there is another outcome")
    elif kind == "deadlock":
        stuck = any(outcome["ending"] == "stuck" for outcome in walker.outcomes(environment))
        if stuck != expected:
            raise Wrong("deadlock")
    elif kind == "times":
        if not same_times(expected, walker.implementation.ask("times", **with_faults(environment))):
            raise Wrong("there are other times")
    elif kind == "dated":
        reply = walker.implementation.ask("dated", run=expected["run"], **with_faults(environment))
        if not same_findings(expected.get("findings", []), reply["findings"]):
            raise Wrong("something else is too early or too late")
    else:
        raise Wrong(f"there is no expectation {kind}")


# Cases


def rejected(expected, seen):
    def code(rejection):
        return (rejection, None) if isinstance(rejection, str) else (rejection["code"], rejection.get("line"))

    expected = sorted((code(rejection) for rejection in expected), key=str)
    codes = [(rejection["code"], rejection.get("line")) for rejection in seen]
    for wanted, line in expected:
        match = next((c for c in codes if c[0] == wanted and line in (None, c[1])), None)
        if match is None:
            return False
        codes.remove(match)
    return not codes


def judge(implementation, case):
    """The kinds of expectation that the case fails."""
    failures, rules = set(), set()
    try:
        reply = implementation.ask("initial", program="\n".join(case["program"]), fleet="\n".join(case["fleet"]))
        for kind, expected in case["expect"].items():
            if kind == "rejected":
                if not rejected(expected, reply.get("rejected", [])):
                    failures.add(kind)
                continue
            if "rejected" in reply:
                failures.add(kind)
                continue
            for one in expected if kind in ("admits", "forbids", "dated") else [expected]:
                walker = Walker(implementation, (reply["configuration"], reply["world"], 0))
                try:
                    check(walker, kind, one, case.get("environment", {}))
                except Wrong:
                    failures.add(kind)
                rules |= walker.rules
        if not failures and not set(case.get("covers", [])) <= rules:
            failures.add("covers")
    except Trouble:
        failures = {"implementation"}
    return failures


def main(command, paths):
    passed = failed = 0
    implementation = Implementation(command)
    for path in paths:
        with open(path, encoding="utf-8") as file:
            case = json.load(file)
        failures = judge(implementation, case)
        fine = failures == set(case.get("fails", []))
        passed, failed = passed + fine, failed + (not fine)
        suffix = ": " + ", ".join(sorted(failures)) if failures else ""
        print(f"{'passed' if fine else 'failed'} {path}{suffix}")
    implementation.close()
    print(f"{passed} passed, {failed} failed")
    return 0 if failed == 0 else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
