"""Runs of programs: `dolphin exec`, followed, posted to and stopped from Python.

    async with dolphin.run("mission.dol", speed=10) as run:
        async for record in run:
            if isinstance(record, dolphin.Transition) and record.label.startswith("start"):
                await run.post(abort=True)
"""

from __future__ import annotations

import asyncio
import json
import os
import shutil
import signal
import tempfile
from types import TracebackType
from typing import Any, AsyncIterator, List, Mapping, Optional, Sequence, Type, Union

from . import command
from .adapter import Adapter
from .command import PathLike
from .errors import CommandError, RequestRefused, RunEnded, RunFailed, RunGone
from .hosting import Hosted
from .journal import End, Journal, Record, read, record
from .run_socket import RunSocket
from .supplier import Supplier
from .values import to_json
from .waiting import within

POLL = 0.02
"""Seconds between two looks at a journal, or for a socket, of a process."""
PATIENCE = 30.0
"""Seconds that a run gets to end in good order, before it is interrupted once more."""


class Run:
    """A run. As an asynchronous context manager it starts the run, and waits for its end; if the body raises, and on
    Ctrl-C, it interrupts the run first, so that vehicles are stopped and released. Iterating gives the records of the
    journal. `dolphin.run` and `dolphin.attach` make runs."""

    def __init__(self, journal: str, socket: Optional[str]) -> None:
        self.journal_path = journal
        self.end: Optional[End] = None
        """The end of the run, once an iteration or the context manager has seen it."""
        self._socket_path = socket
        self._socket: Optional[RunSocket] = None

    async def __aenter__(self) -> "Run":
        return self

    async def __aexit__(
        self, kind: Optional[Type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        if self._socket is not None:
            await self._socket.close()

    def __aiter__(self) -> AsyncIterator[Record]:
        return self._records()

    async def _records(self) -> AsyncIterator[Record]:
        async for raw in self._lines():
            each = record(raw)
            if isinstance(each, End):
                self.end = each
            yield each
        if self.end is None:
            raise self._gone()

    async def _lines(self) -> AsyncIterator[Mapping[str, Any]]:
        async for raw in self._requests().follow():
            yield raw

    def _gone(self) -> Exception:
        return RunGone(f"{self._socket_path}: the connection ended before the run did")

    def _requests(self) -> RunSocket:
        if self._socket_path is None:
            raise RunGone("a simulated run that does not wait has no socket: give it a speed")
        if self._socket is None:
            self._socket = RunSocket(self._socket_path)
        return self._socket

    async def post(self, key: Optional[str] = None, value: Any = None, **pairs: Any) -> None:
        """Posts inputs, `run.post(abort=True)` or `run.post("abort", True)`. Returns when the run has taken them, and
        its journal has them."""
        for name, each in {**({} if key is None else {key: value}), **pairs}.items():
            await self._requests().request("post", key=name, value=to_json(each))

    async def answer(self, prompt: str, yes: bool) -> None:
        """Answers the question of a task that has this prompt."""
        await self._requests().request("post", key=prompt, value=yes)

    async def status(self) -> Mapping[str, Any]:
        """The run's `program`, `time`, `inputs` and open `questions`."""
        status: Mapping[str, Any] = await self._requests().request("status")
        return status

    async def stop(self) -> None:
        """Interrupts the run, as Ctrl-C does. It ends, or executes its `onInterrupt`; a second stop then ends it."""
        await self._requests().request("stop")


class StartedRun(Run):
    """A run whose process is a child of this one, in a session of its own: Ctrl-C reaches this process alone."""

    def __init__(
        self, arguments: Sequence[str], *, journal: str, folder: str, has_socket: bool, hosted: Sequence[Hosted],
        check: bool,
    ) -> None:
        super().__init__(journal, journal + ".sock" if has_socket else None)
        self.result: Optional[Journal] = None
        """The journal as a whole, once the run is over."""
        self.output = ""
        """The log for people so far."""
        self._arguments, self._folder, self._hosted, self._check = list(arguments), folder, hosted, check
        self._process: Optional[asyncio.subprocess.Process] = None
        self._readers: "List[asyncio.Task[None]]" = []
        self._errors = ""
        self._is_stopped = False

    async def __aenter__(self) -> "StartedRun":
        try:
            for hosted in self._hosted:
                await hosted.open()
            await self._start()
        except BaseException:
            await self._clean_up()
            raise
        return self

    async def _start(self) -> None:
        process = self._process = await asyncio.create_subprocess_exec(
            command.find(), *self._arguments, stdin=asyncio.subprocess.DEVNULL, stdout=asyncio.subprocess.PIPE,
            stderr=asyncio.subprocess.PIPE, env=dict(command.environment()), start_new_session=True,
        )
        assert process.stdout is not None and process.stderr is not None
        self._readers = [
            asyncio.ensure_future(self._collect(process.stdout, "output")),
            asyncio.ensure_future(self._collect(process.stderr, "_errors")),
        ]
        try:
            while not await self._is_there():
                if process.returncode is not None:
                    await self._wait()
                    if not os.path.exists(self.journal_path):  # it never began
                        raise self._error()
                    return
                await asyncio.sleep(POLL)
        except asyncio.CancelledError:
            await self._interrupt()
            raise

    async def _is_there(self) -> bool:
        """Whether the run can be reached. A socket that a dead run has left refuses."""
        if self._socket_path is None:
            return os.path.exists(self.journal_path)
        try:
            await self._requests().request("status")
            return True
        except (RunGone, RequestRefused):
            return False

    async def _collect(self, stream: asyncio.StreamReader, name: str) -> None:
        while True:
            data = await stream.read(65536)
            if not data:
                return
            setattr(self, name, getattr(self, name) + data.decode(errors="replace"))

    async def __aexit__(
        self, kind: Optional[Type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        try:
            if error is not None:
                await self._interrupt()
            await self._wait()
        except asyncio.CancelledError:  # Ctrl-C while the end was awaited
            await self._interrupt()
            await self._wait()
            raise
        finally:
            await super().__aexit__(kind, error, trace)
            await self._clean_up()
        if error is None:
            self._judge()

    async def wait(self) -> Journal:
        """Waits for the end of the run; its journal."""
        await self._wait()
        self._load()
        if self.result is None:
            raise self._error()
        return self.result

    def _requests(self) -> RunSocket:
        if self.end is not None:
            raise RunEnded("ended", "the run has ended")
        return super()._requests()

    async def stop(self) -> None:
        self._is_stopped = True
        if self._socket_path is None:
            self._signal()
            return
        try:
            await super().stop()
        except RunGone:  # the process is a child of this one, and hears signals without a socket
            self._signal()

    def _signal(self) -> None:
        if self._process is not None and self._process.returncode is None:
            self._process.send_signal(signal.SIGINT)

    async def _interrupt(self) -> None:
        """Interrupts the run, and once more each time that it takes too long to stop its vehicles. Never kills it."""
        self._is_stopped = True
        while self._process is not None and self._process.returncode is None:
            self._signal()
            await within(self._process.wait(), PATIENCE)

    async def _wait(self) -> None:
        if self._process is not None:
            await self._process.wait()
        if self._readers:
            await asyncio.wait(self._readers)

    async def _clean_up(self) -> None:
        for hosted in self._hosted:
            await hosted.close()
        self._load()
        if self._folder:
            shutil.rmtree(self._folder, ignore_errors=True)

    def _load(self) -> None:
        if self.result is None and os.path.exists(self.journal_path) and os.path.getsize(self.journal_path) > 0:
            self.result = read(self.journal_path)
            self.end = self.result.end

    def _judge(self) -> None:
        """Raises if the run died, or ended otherwise than it should have."""
        if self.end is None:
            raise self._error()
        expected = ("completed", "interrupted") if self._is_stopped else ("completed",)
        if self._check and self.end.ending not in expected:
            raise RunFailed(self.end.ending, self.end.message, self._errors)

    def _error(self) -> CommandError:
        status = self._process.returncode if self._process is not None else None
        return command.error_of(["dolphin", *self._arguments], -1 if status is None else status, self._errors)

    def _gone(self) -> Exception:
        if self._process is not None and self._process.returncode is None:
            return super()._gone()
        return self._error()

    async def _lines(self) -> AsyncIterator[Mapping[str, Any]]:
        if self._socket_path is not None and os.path.exists(self._socket_path):
            seen = 0
            async for line in self._requests().follow():
                seen += 1
                yield line
            if seen > 0:
                await self._settle()
                return
        async for raw in self._tail():
            yield raw

    async def _settle(self) -> None:
        """After the last line the process is about to end: so that an error finds its text."""
        if self._process is not None:
            await within(self._process.wait(), 2.0)
        await asyncio.sleep(0)

    async def _tail(self) -> AsyncIterator[Mapping[str, Any]]:
        """The lines of the journal's file, as they are written."""
        rest = b""
        with open(self.journal_path, "rb") as file:
            while True:
                over = self._process is None or self._process.returncode is not None
                rest += file.read()
                *lines, rest = rest.split(b"\n")
                for line in lines:
                    yield json.loads(line)
                if over:
                    await self._wait()
                    return
                await asyncio.sleep(POLL)


def run(
    program: PathLike, *, fleet: Union[PathLike, Adapter, None] = None, speed: Optional[float] = None,
    seed: Optional[int] = None, set: Optional[Mapping[str, Any]] = None, answers: Sequence[str] = (),
    platform: Sequence[str] = (), imc: bool = False, supplier: Union[str, Supplier, None] = None,
    journal: Optional[PathLike] = None, resume: bool = False, check: bool = True, options: Sequence[str] = (),
) -> StartedRun:
    """A run of a program, as an asynchronous context manager.

    - `fleet`: a file of a simulated fleet; or an adapter, such as `dolphin.Fakes`, that this process serves.
    - `platform`: commands of adapters; `imc`: vehicles of the network. Vehicles move. Such runs need a `journal`, by
      which they can be resumed (`resume=True`).
    - `speed`: how much faster than in reality time passes in a simulation; `None`: nothing is waited for. A run
      without a speed on a simulated fleet has no socket: it can be read, not posted to.
    - `check`: raise `RunFailed` if the run does not complete.
    """
    folder = tempfile.mkdtemp(prefix="dolphin-")
    try:
        if journal is None and (platform or imc or resume):
            raise ValueError("a run on vehicles needs a journal, by which it can be resumed: journal='mission.run'")
        path = os.path.join(folder, "run") if journal is None else os.path.abspath(os.fspath(journal))
        hosted: List[Hosted] = []
        is_simulated = not (platform or imc or isinstance(fleet, Adapter))
        file = None if isinstance(fleet, Adapter) else fleet
        arguments = ["exec", *command.of_world(program, fleet=file, set=set, answers=answers)]
        arguments.append(f"--resume={path}" if resume else f"--journal={path}")
        if isinstance(fleet, Adapter):
            hosted.append(Hosted(fleet.converse, os.path.join(folder, "fleet.sock")))
            arguments.append(f"--platform={hosted[-1].command}")
        if isinstance(supplier, Supplier):
            hosted.append(Hosted(supplier.converse, os.path.join(folder, "supplier.sock")))
            arguments.append(f"--supplier={hosted[-1].command}")
        elif supplier is not None:
            arguments.append(f"--supplier={supplier}")
        arguments += [f"--platform={adapter}" for adapter in platform]
        arguments += ["--imc"] if imc else []
        arguments += [] if speed is None else [f"--speed={speed!r}"]
        arguments += [] if seed is None else [f"--seed={seed}"]
        has_socket = (not is_simulated or speed is not None) and "--no-socket" not in options
        return StartedRun(
            [*arguments, *options], journal=path, folder=folder, has_socket=has_socket, hosted=hosted, check=check
        )
    except BaseException:
        shutil.rmtree(folder, ignore_errors=True)
        raise


def attach(journal: PathLike) -> Run:
    """The run of another process, by its journal: followed and posted to on its socket. Leaving it does not stop it."""
    path = os.path.abspath(os.fspath(journal))
    return Run(path, path + ".sock")


def execute(program: PathLike, **options: Any) -> Journal:
    """Runs a program to its end, and returns the journal; the options are those of `run`. For tests and scripts that
    have no event loop.

        journal = dolphin.execute("mission.dol", seed=3)
    """

    async def go() -> Journal:
        async with run(program, **options) as started:
            pass
        assert started.result is not None
        return started.result

    return asyncio.run(go())
