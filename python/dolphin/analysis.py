"""Analyses of a program that do not run it: `check`, and `explore`, which follows every run."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple

from . import command, diagnostics
from .command import Faults, Output, PathLike
from .diagnostics import Diagnostic


@dataclass(frozen=True)
class Check:
    """The faults of a program and of its fleet that show without running it."""

    diagnostics: Tuple[Diagnostic, ...]
    text: str
    """The command's own text."""

    @property
    def ok(self) -> bool:
        """No errors; there may be warnings."""
        return not self.errors

    @property
    def errors(self) -> Tuple[Diagnostic, ...]:
        return tuple(d for d in self.diagnostics if d.is_error)

    @property
    def warnings(self) -> Tuple[Diagnostic, ...]:
        return tuple(d for d in self.diagnostics if not d.is_error)


def check(
    program: PathLike, *, fleet: Optional[PathLike] = None, set: Optional[Mapping[str, Any]] = None,
    platform: Sequence[str] = (),
) -> Check:
    """`dolphin check PROG`. With `platform`, commands of adapters, these report the problems of plans too."""
    arguments = ["check", *command.of_world(program, fleet=fleet, set=set)]
    output = command.call(arguments + [f"--platform={adapter}" for adapter in platform])
    text = output.stdout + output.stderr
    found = diagnostics.parse(text)
    if output.status == 0 or (output.status == 2 and any(d.is_error for d in found)):
        return Check(tuple(found), text)
    raise output.error()


@dataclass(frozen=True)
class Verdict:
    """The verdict on a property: `holds`, `violated`, `inconclusive`, or, of termination, `by design not`."""

    name: str
    verdict: str
    run: Tuple[str, ...] = ()
    """Labels of a run that violates it, as the semantics writes them."""
    cycle: Tuple[str, ...] = ()
    """The steps that are repeated without end after `run`."""
    shortest: bool = False
    faults: Optional[int] = None
    """How many faults that run has."""
    bound: Optional[str] = None
    """Why it is inconclusive."""
    unreached: Tuple[str, ...] = ()
    """The pieces of the program that no run reaches, with their places."""
    raw: Mapping[str, Any] = field(default_factory=dict, repr=False, compare=False)
    """All members of the command's JSON."""

    @property
    def holds(self) -> bool:
        return self.verdict == "holds"

    @property
    def violated(self) -> bool:
        return self.verdict == "violated"

    def __str__(self) -> str:
        lines = [f"{self.name}: {self.verdict}" + (f", {self.bound}" if self.bound else "")]
        lines += [f"  {label}" for label in self.run]
        if self.cycle:
            lines += ["  and without end:"] + [f"  {label}" for label in self.cycle]
        return "\n".join(lines + [f"  {piece}" for piece in self.unreached])


@dataclass(frozen=True)
class Exploration:
    """The result of `dolphin explore`."""

    verdicts: Tuple[Verdict, ...]
    states: int
    transitions: int
    depth: int
    seconds: float
    reductions: Tuple[str, ...]
    status: int
    """The command's: 0, every property holds; 1, one is violated; 3, inconclusive, and none is violated."""
    raw: Mapping[str, Any] = field(default_factory=dict, repr=False, compare=False)

    @property
    def holds(self) -> bool:
        """Every property holds. Properties that are only noted (`no halt`, leftover tuples, unreachable code) count
        if `strict` was given."""
        return self.status == 0

    @property
    def violated(self) -> Tuple[Verdict, ...]:
        """The violated properties, with those that are only noted."""
        return tuple(verdict for verdict in self.verdicts if verdict.violated)

    @property
    def is_conclusive(self) -> bool:
        return self.status != 3

    def __getitem__(self, name: str) -> Verdict:
        for verdict in self.verdicts:
            if verdict.name == name:
                return verdict
        raise KeyError(name)

    def __str__(self) -> str:
        return "\n".join([*map(str, self.verdicts), f"{self.states} states, {self.transitions} transitions"])


def explore(
    program: PathLike, *, fleet: Optional[PathLike] = None, faults: Optional[Faults] = None,
    set: Optional[Mapping[str, Any]] = None, answers: Sequence[str] = (), invariants: Sequence[str] = (),
    ltl: Sequence[str] = (), strict: bool = False, reduction: Optional[str] = None, max_states: Optional[int] = None,
    max_depth: Optional[int] = None, max_memory: Optional[str] = None, timeout: Optional[float] = None,
    workers: Optional[int] = None, options: Sequence[str] = (),
) -> Exploration:
    """`dolphin explore PROG`: every run of the program. `faults` are `"all"`, several of `fail`, `loss`, `join`,
    `interrupt`, or `{"fail": 1}` for at most one in a run. `options` are further ones of the command. Raises
    `CommandError` if there is no verdict, as for a program with faults. A violated property is a result."""
    arguments = ["explore", "--json", *command.of_world(program, fleet=fleet, set=set, answers=answers, faults=faults)]
    arguments += [f"--invariant={text}" for text in invariants] + [f"--ltl={text}" for text in ltl]
    arguments += limits(
        {"reduction": reduction, "max-states": max_states, "max-depth": max_depth, "max-memory": max_memory,
         "timeout": timeout, "workers": workers}
    )
    if strict:
        arguments.append("--strict")
    output = command.call([*arguments, *options])
    result = answer(output, "verdicts")
    return Exploration(
        verdicts=tuple(_verdict(verdict) for verdict in result["verdicts"]), states=result["states"],
        transitions=result["transitions"], depth=result["depth"], seconds=result["seconds"],
        reductions=tuple(result["reductions"]), status=output.status, raw=result,
    )


def limits(options: Mapping[str, Any]) -> List[str]:
    """Options of the command; those that are `None` are left out."""
    return [f"--{name}={value}" for name, value in options.items() if value is not None]


def answer(output: Output, member: str) -> Dict[str, Any]:
    """The JSON that the command printed, which has this member; otherwise its error is raised."""
    try:
        result = json.loads(output.stdout)
    except ValueError:
        raise output.error() from None
    if not isinstance(result, dict) or member not in result:
        raise ValueError(f"the answer has no {member!r}: a range in `set` gives a table, which this function lacks")
    return result


def _verdict(json: Mapping[str, Any]) -> Verdict:
    return Verdict(
        name=json["property"], verdict=json["verdict"], run=tuple(json.get("run", ())),
        cycle=tuple(json.get("cycle", ())), shortest=json.get("shortest", False), faults=json.get("faults"),
        bound=json.get("bound"), raw=json,
        unreached=tuple(f"{piece['at']}: {piece['what']}" for piece in json.get("unreached", ())),
    )
