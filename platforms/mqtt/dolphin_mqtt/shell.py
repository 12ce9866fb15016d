"""The process: options, the run, the broker, and the end."""

from __future__ import annotations

import argparse
import asyncio
import os
import signal
import sys
import time
from typing import Any, Callable, Dict, List, Mapping, Optional, Protocol, Sequence

import dolphin
from dolphin.document import Faulty
from dolphin.posting import AGAIN, Poster, Remarks
from dolphin.waiting import within

from . import configuration, version
from .configuration import Configuration
from .sensor import News, Pair, Sensor

DESCRIPTION = """Posts messages of an MQTT broker to a running mission, as inputs that its program declares:
dolphin-mqtt --config sensors.yaml --run mission.run
beside dolphin exec mission.dol --journal mission.run. docs/mqtt.md describes the configuration.
It ends with the run. The exit status is 0 if the run has ended, 2 if the configuration or the command line
is not right, 3 if the run cannot be reached, and 130 or 143 after an interruption."""
WAIT = 30.0
"""Seconds to wait for a run that does not listen."""

ENDED, WRONG, UNREACHABLE = 0, 2, 3


class Link(Protocol):
    """A connection to a broker: `broker.Broker`, or one of a test."""

    def open(self) -> None: ...

    def close(self) -> None: ...


Connect = Callable[[configuration.Broker, Mapping[str, int], Callable[[str, bytes, bool], None], Remarks], Link]


class Bridge:
    """From the topics of a configuration to the run beside a journal."""

    def __init__(self, found: Configuration, journal: str, wait: float, connect: Connect, remarks: Remarks,
                 clock: Callable[[], float] = time.monotonic) -> None:
        self._configuration, self._journal, self._wait = found, journal, wait
        self._connect, self._remarks, self._clock = connect, remarks, clock
        self._run = dolphin.attach(journal)
        self._sensors: Dict[str, List[Sensor]] = {}

    async def serve(self) -> int:
        """Works until the run has ended; the exit status."""
        status = await self._reach()
        if status is None:
            return UNREACHABLE
        wrong = undeclared(self._configuration, status["inputs"])
        if wrong:
            self._remarks.now("\n".join(wrong))
            return WRONG
        now = self._clock()
        for rule in self._configuration.inputs:
            self._sensors.setdefault(rule.topic, []).append(Sensor(rule, now))
        self._poster, self._changed = Poster(self._run, self._remarks), asyncio.Event()
        link = self._connect(
            self._configuration.broker, self._configuration.topics(), self._hear, self._remarks)
        link.open()
        end = asyncio.ensure_future(self._end())
        work: "List[asyncio.Future[Any]]" = [
            end, asyncio.ensure_future(self._poster.run()), asyncio.ensure_future(self._tick())]
        try:
            done, _ = await asyncio.wait(work, return_when=asyncio.FIRST_COMPLETED)
            for each in done:
                each.result()  # raises if it is a fault of the bridge itself
            return await end
        finally:
            for each in work:
                each.cancel()
            link.close()

    def _hear(self, topic: str, payload: bytes, retained: bool) -> None:
        for sensor in self._sensors.get(topic, ()):
            self._spread(sensor.hear(payload, retained, self._clock()))
        self._changed.set()

    async def _tick(self) -> None:
        sensors = [sensor for each in self._sensors.values() for sensor in each]
        while True:
            for sensor in sensors:
                self._spread(sensor.tick(self._clock()))
            self._changed.clear()
            # Some days at most: clocks of operating systems take no infinite wait.
            await within(self._changed.wait(), min(max(0.0, min(s.due() for s in sensors) - self._clock()), 1e5))

    def _spread(self, news: News) -> None:
        for each in news:
            if isinstance(each, Pair):
                self._poster.put(each.key, each.value)
            elif each.kind is None:
                self._remarks.now(each.text)
            else:
                self._remarks.once(each.text, each.kind)

    async def _end(self) -> int:
        """Follows the run to its end. A console that died may be started again, and resume the run."""
        while True:
            try:
                async for record in self._run:
                    if isinstance(record, dolphin.End):
                        return ENDED
            except dolphin.RunEnded:
                return ENDED
            except dolphin.RunGone:
                if has_ended(self._journal):
                    return ENDED
            except dolphin.RequestRefused as refused:
                self._remarks.now(f"the run cannot be followed: {refused}")
                return UNREACHABLE
            if await self._reach() is None:
                return ENDED if has_ended(self._journal) else UNREACHABLE

    async def _reach(self) -> Optional[Mapping[str, Any]]:
        """The status of the run, once it listens; `None` if it does not for too long."""
        until = self._clock() + self._wait
        while True:
            try:
                return await self._run.status()
            except (dolphin.RunGone, dolphin.RequestRefused) as error:
                why = error
            if self._clock() >= until:
                self._remarks.now(f"the run cannot be reached: {why}")
                return None
            self._remarks.once(f"{why}; waits {self._wait:g} s for the run at most", "reach")
            await asyncio.sleep(min(AGAIN, max(0.01, until - self._clock())))


def undeclared(found: Configuration, declared: Sequence[str]) -> List[str]:
    """The faults of keys that the program does not declare."""
    known = ", ".join(f"'{key}'" for key in declared)
    has = f"its inputs are {known}" if declared else "it declares no inputs"
    return [
        f"the program declares no input '{key}': {has}"
        for key in found.keys() if key not in declared
    ]


def has_ended(journal: str) -> bool:
    """Whether the journal has the end of its run."""
    try:
        return dolphin.read(journal).end is not None
    except (OSError, dolphin.DolphinError):
        return False


def main(arguments: Optional[Sequence[str]] = None) -> int:
    parser = argparse.ArgumentParser(
        prog="dolphin-mqtt", description=DESCRIPTION, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--config", required=True, metavar="FILE", help="the broker and the topics, in YAML")
    parser.add_argument(
        "--run", metavar="JOURNAL", help="the journal of the run, as dolphin exec --journal has it")
    parser.add_argument(
        "--wait", type=seconds, default=WAIT, metavar="SECONDS",
        help="seconds to wait for a run that does not listen: not yet, or since its console died (%(default)g)")
    parser.add_argument(
        "--check", action="store_true", help="only check the configuration, print all its faults, and end")
    parser.add_argument("--version", action="version", version=f"dolphin-mqtt {version}")
    options = parser.parse_args(arguments)
    if options.run is None and not options.check:
        parser.error("--run JOURNAL is needed")
    try:
        found = configuration.read(options.config)
    except Faulty as faulty:
        print("\n".join(faulty.lines), file=sys.stderr)
        return WRONG
    if options.check:
        inputs, topics = len(found.inputs), len(found.topics())
        print(f"{options.config}: {counted(inputs, 'input')} from {counted(topics, 'topic')} of {found.broker}")
        return 0
    from .broker import Broker

    return asyncio.run(until_signal(Bridge(found, os.path.abspath(options.run), options.wait, Broker, Remarks())))


async def until_signal(bridge: Bridge) -> int:
    """The exit status of the bridge, or of the signal that ends it."""
    work = asyncio.ensure_future(bridge.serve())
    caught: List[int] = []

    def catch(number: int) -> None:
        caught.append(number)
        work.cancel()

    for number in (signal.SIGINT, signal.SIGTERM):
        asyncio.get_running_loop().add_signal_handler(number, catch, number)
    try:
        return await work
    except asyncio.CancelledError:
        return 128 + caught[0] if caught else 130


def seconds(text: str) -> float:
    """Seconds of an option."""
    number = float(text)
    if not 0 <= number <= 1e6:
        raise ValueError(text)
    return number


def counted(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"
