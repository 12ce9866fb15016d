"""A person: the instruction that is open, and the rules from its offer to its end.

Each decision of a person is kept as a note on Dolphin's disk before the page gets its reply, so that a decision which
the page knows to be received outlives this process."""

from __future__ import annotations

import asyncio
import collections
import time
from dataclasses import dataclass, field
from typing import Any, Callable, Deque, Dict, List, Mapping, Optional, Protocol, Sequence, Set

import dolphin
from dolphin.document import near
from dolphin.waiting import within

from .configuration import LONGEST_TEXT, Configuration, Entry, Rule, position_of, problem_of

OFFERED, ACCEPTED, STOPPING = "offered", "accepted", "stopping"
DONE, FAILED, STOPPED, CLOSED = "done", "failed", "stopped", "closed"
POSTING, POSTED = "posting", "posted"
"""Of notes alone: the answer of an instruction that is done is about to be posted, and was posted."""
OPEN = (OFFERED, ACCEPTED, STOPPING)
"""The states in which a page shows the instruction. After DONE and FAILED its end is being reported."""
POLL = 10.0
"""Seconds after which a page gets a reply though nothing has changed."""
LONGEST_WHY = 300
"""Characters of a reason at most."""
NOTICES = 10


class Refused(Exception):
    """A decision that a person can mend: a value or a reason that is not right."""


class Gone(Exception):
    """A decision on an instruction that is over, or is not this one."""


class Answers(Protocol):
    """`answers.Answers`, or that of a test."""

    turn: asyncio.Lock
    """Held while an answer is posted."""

    async def undeclared(self, key: str) -> Optional[str]: ...

    async def post(self, request: str, key: str, value: Any, is_repeated: bool) -> None: ...


@dataclass
class Instruction:
    """An instruction to a person, from its offer on."""

    plan: dolphin.Plan
    rule: Rule
    text: str
    state: str
    until: Optional[float] = None
    """When the state ends by itself, by the clock of the person."""
    value: Any = None
    why: str = ""
    kept: Mapping[str, Any] = field(default_factory=lambda: {"state": OFFERED})
    """The latest note."""
    photos: List[str] = field(default_factory=list)


class Person(dolphin.Vehicle):
    """A person of the configuration, as a vehicle of type Human whose devices are the skills."""

    type = "Human"

    def __init__(self, entry: Entry, configured: Configuration, answers: Answers, program: Optional[str] = None,
                 clock: Callable[[], float] = time.monotonic) -> None:
        place = entry.position
        members = {} if place is None else {
            "latitude": place.latitude, "longitude": place.longitude, "height": place.height}
        super().__init__(entry.name, link=False, payload=entry.skills, **members)
        self.entry, self._configured, self._answers, self._clock = entry, configured, answers, clock
        self._program = program
        self._open: Optional[Instruction] = None
        self._over: Dict[str, Set[str]] = {}
        """The decisions that were taken, by request: a page repeats one whose reply it did not get."""
        self._notices: Deque[Mapping[str, Any]] = collections.deque(maxlen=NOTICES)
        self._noticed = 0
        self._duty = True
        self._resting_until: Optional[float] = None
        self._seen: Optional[float] = None
        self._boot = f"{time.time_ns():x}"
        self._number = 0
        self._changed = asyncio.Event()
        self._deciding = asyncio.Lock()

    # A vehicle of the platform protocol.

    async def problems(self, plan: dolphin.Plan) -> Sequence[str]:
        found = self._configured.rule(plan.name)
        if found is None:
            known = [rule.name for rule in self._configured.rules]
            return [f"undefined instruction '{plan.name}'{near(plan.name, known)}"]
        rule, text = found
        if len(text) > LONGEST_TEXT:
            return [f"the instruction has {len(text)} characters: at most {LONGEST_TEXT}"]
        if rule.answer is not None:
            undeclared = await self._answers.undeclared(rule.answer.input)
            return [] if undeclared is None else [undeclared]
        return []

    async def start(self, plan: dolphin.Plan) -> None:
        await self._offer(self._put(plan, OFFERED))

    async def _offer(self, open_: Instruction) -> None:
        """Returns once the person has accepted; the person may be done by then."""
        accept = self._configured.accept
        open_.until = self._clock() + accept
        self._touch()
        if not await self._once(lambda: open_.state != OFFERED, accept) and open_.state == OFFERED:
            self._close(open_, "No longer needed")
            raise dolphin.Failed(f"has not accepted in {accept:g} s")
        if open_.state == FAILED:
            self._close(open_)
            raise dolphin.Failed(open_.why)

    async def finish(self, plan: dolphin.Plan) -> None:
        open_ = self._of(plan)
        rule = open_.rule
        if open_.state == ACCEPTED and rule.within is not None:
            open_.until = self._clock() + rule.within
            self._touch()
        if not await self._once(lambda: open_.state != ACCEPTED, rule.within) and open_.state == ACCEPTED:
            await self._have_stopped(open_)
            raise dolphin.Failed(f"is not done after {rule.within:g} s")
        if open_.state == FAILED:
            self._close(open_)
            raise dolphin.Failed(open_.why)
        await self._post(open_, open_.kept)
        self._close(open_)

    async def _post(self, open_: Instruction, kept: Mapping[str, Any]) -> None:
        """Posts the answer, if there is one. Notes before and after it, and one post at a time: so if this process dies
        meanwhile, the input of the answer stands behind its note in the journal, or was not posted. `kept` is the
        latest note of before such a death."""
        answer = open_.rule.answer
        if answer is None or kept["state"] == POSTED:
            return
        value = position_of(open_.value) if answer.kind == "position" else open_.value
        async with self._answers.turn:
            is_repeated = kept["state"] == POSTING
            if not is_repeated:
                await open_.plan.note({**kept, "state": POSTING})
            await self._answers.post(open_.plan.request, answer.input, value, is_repeated)
            await open_.plan.note({**kept, "state": POSTED})

    async def stop(self, plan: dolphin.Plan) -> None:
        open_ = self._open
        if open_ is None or open_.plan.request != plan.request:
            return
        if open_.state == FAILED:
            self._close(open_)
            raise dolphin.Failed(open_.why)
        await self._have_stopped(open_)

    async def _have_stopped(self, open_: Instruction) -> None:
        """Returns once the person has stopped, or need not."""
        if open_.state in (ACCEPTED, STOPPING) and open_.rule.acknowledge:
            open_.state, open_.until = STOPPING, None
            self._touch()
            await self._once(lambda: open_.state != STOPPING)
        self._close(open_, None if open_.state in (STOPPED, DONE) else "No longer needed")

    async def resume(self, plan: dolphin.Plan) -> None:
        """This process was started again. The latest note is the last decision of the person."""
        kept = next((dict(note) for note in plan.notes if "state" in note), {"state": OFFERED})
        if self._configured.rule(plan.name) is None:
            raise dolphin.Unknown(f"the instruction '{plan.name}' is no longer in the configuration")
        state = str(kept["state"])
        self._over.setdefault(plan.request, set()).update(kept.get("acts", ()))
        if state == STOPPED:
            raise dolphin.Stopped()
        if state == FAILED:
            raise dolphin.Failed(str(kept.get("why", "")))
        open_ = self._put(plan, state)
        open_.value = kept.get("value")
        if state in (DONE, POSTING, POSTED):
            await self._post(open_, kept)
            self._close(open_)
            raise dolphin.Done()
        if state == OFFERED:
            await self._offer(open_)

    async def run(self) -> None:
        while True:
            await asyncio.sleep(0.5)
            self.look_at_the_clock()

    def look_at_the_clock(self) -> None:
        """Reports a page that was not seen for too long, and the end of the pause after a refusal."""
        now = self._clock()
        if self._resting_until is not None and now >= self._resting_until:
            self._resting_until = None
        is_seen = self._seen is not None and now - self._seen < self._configured.seen
        self.report(link=is_seen, unready=self._reason())

    def _reason(self) -> Optional[str]:
        if not self._duty:
            return "has a break"
        return None if self._resting_until is None else "has just declined"

    def hold(self, held: bool) -> None:
        self._touch()

    # For the pages.

    def was_seen(self) -> None:
        """A page of this person has just sent a request."""
        self._seen = self._clock()
        if not self.known["link"]:
            self.look_at_the_clock()

    async def state(self, after: Optional[str]) -> Mapping[str, Any]:
        """The state for a page, once it is another one than that of the version `after`, or after `POLL` seconds."""
        if after == self._version():
            await within(self._changed.wait(), POLL)
        open_ = self._open if self._open is not None and self._open.state in OPEN else None
        return {
            "version": self._version(), "person": self.name, "skills": list(self.entry.skills), "duty": self._duty,
            "held": self.held, "program": self._program, "locate": self.entry.locate,
            "instruction": None if open_ is None else self._shown(open_), "notices": list(self._notices),
        }

    def _shown(self, open_: Instruction) -> Mapping[str, Any]:
        answer = open_.rule.answer
        members: Dict[str, Any] = {}
        if answer is not None:
            members = {"kind": answer.kind}
            if answer.kind == "number":
                members.update(unit=answer.unit, least=answer.least, most=answer.most)
            elif answer.kind == "choice":
                members.update(choices=list(answer.choices))
        remaining = None if open_.until is None else max(0.0, round(open_.until - self._clock(), 1))
        return {"request": open_.plan.request, "state": open_.state, "text": open_.text, "remaining": remaining,
                "answer": members or None}

    async def decide(self, request: str, act: str, value: Any = None, why: str = "") -> None:
        """A decision on the instruction of this request, which may be repeated. It is kept when this returns. Raises
        `Refused` or `Gone`."""
        async with self._deciding:
            if act in self._over.get(request, ()):
                return
            open_ = self._open
            if open_ is None or open_.plan.request != request:
                raise Gone("this instruction is over")
            await self._decide(open_, act, value, " ".join(why.split()).rstrip("."))

    async def _decide(self, open_: Instruction, act: str, value: Any, why: str) -> None:
        ways = {"accept": ((OFFERED,), ACCEPTED), "decline": ((OFFERED,), FAILED), "done": ((OFFERED, ACCEPTED), DONE),
                "cannot": ((OFFERED, ACCEPTED), FAILED), "stopped": ((STOPPING,), STOPPED)}
        if act not in ways:
            raise Refused(f"the decision '{act}' does not exist")
        from_, to = ways[act]
        if open_.state not in from_:
            raise Gone("this is no longer wanted: report that you have stopped" if open_.state == STOPPING else
                       "this instruction is over" if open_.state not in OPEN else f"this is {open_.state} already")
        if len(why) > LONGEST_WHY:
            raise Refused(f"give a reason of at most {LONGEST_WHY} characters")
        if act == "done":
            problem = problem_of(open_.rule.answer, value, open_.photos)
            if problem is not None:
                raise Refused(problem)
        if act == "cannot" and not why:
            raise Refused("give a reason")
        note: Dict[str, Any] = {"state": to, "acts": sorted({*self._over.get(open_.plan.request, ()), act})}
        if to == FAILED:
            open_.why = ("has declined" if act == "decline" else "cannot") + (f": {why}" if why else "")
            note["why"] = open_.why
        if act == "done" and value is not None:
            note["value"] = value
        await open_.plan.note(note)
        open_.kept = note
        self._over.setdefault(open_.plan.request, set()).add(act)
        if open_.state not in from_:  # it was withdrawn while the note was written
            if to in (DONE, FAILED) and open_.state == STOPPING:
                open_.state = STOPPED
                self._touch()
                return
            raise Gone("this is no longer wanted")
        open_.state, open_.until, open_.value = to, None, value
        if act == "decline" and self._configured.declined > 0:
            self._resting_until = self._clock() + self._configured.declined
            self.report(unready=self._reason())
        self._touch()

    def set_duty(self, duty: bool) -> None:
        """The person takes a break, or is back from it, also from the pause after a refusal."""
        self._duty = duty
        if duty:
            self._resting_until = None
        self.report(unready=self._reason())
        self._touch()

    def place(self, position: dolphin.Position) -> None:
        """The position of the person's phone."""
        self.report(latitude=position.latitude, longitude=position.longitude, height=position.height)

    @property
    def wants_photo(self) -> Optional[Instruction]:
        """The open instruction if its answer is a photo."""
        open_ = self._open
        if open_ is None or open_.state not in (OFFERED, ACCEPTED) or open_.rule.answer is None:
            return None
        return open_ if open_.rule.answer.kind == "photo" else None

    # Instructions.

    def _put(self, plan: dolphin.Plan, state: str) -> Instruction:
        """The instruction of a plan is the open one from now on."""
        found = self._configured.rule(plan.name)
        if found is None:
            raise dolphin.Failed(f"undefined instruction '{plan.name}'")
        before = self._open
        if before is not None and before.state in OPEN:
            self._close(before, "Stop this at once, another instruction follows")
        self._open = Instruction(plan, *found, state=state)
        self._touch()
        return self._open

    def _of(self, plan: dolphin.Plan) -> Instruction:
        if self._open is None or self._open.plan.request != plan.request:
            raise dolphin.Failed("has another instruction")
        return self._open

    def _close(self, open_: Instruction, notice: Optional[str] = None) -> None:
        open_.state = CLOSED
        if self._open is open_:
            self._open = None
        if notice is not None:
            self._noticed += 1
            self._notices.append({"number": self._noticed, "text": f"{notice}: {open_.text}"})
        self._touch()

    def _version(self) -> str:
        return f"{self._boot}-{self._number}"

    def _touch(self) -> None:
        """Waits for a change go on."""
        self._number += 1
        self._changed.set()
        self._changed = asyncio.Event()

    async def _once(self, condition: Callable[[], bool], seconds: Optional[float] = None) -> bool:
        """Waits until a change makes the condition true; false if that takes more than `seconds`."""
        end = None if seconds is None else self._clock() + seconds
        while not condition():
            left = None if end is None else end - self._clock()
            if left is not None and left <= 0:
                return False
            changed = self._changed.wait()
            await (changed if left is None else within(changed, left))
        return True
