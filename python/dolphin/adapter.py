"""The adapter: the platform protocol (docs/platform.md) for vehicles that Python commands.

It has the rules of the protocol that hold for every adapter: one end for each request, repeated when asked; starts that
come twice; stops at any moment; refusals; a note before each command, so that a death of this process is harmless; the
pace of telemetry. `dolphin.vehicle.Vehicle` has the rest: how the plans of a vehicle start, finish and stop."""

from __future__ import annotations

import asyncio
import os
import sys
import threading
import traceback
from typing import Any, Awaitable, Callable, Dict, Iterable, List, Mapping, Optional, Sequence, Set

from .channel import Channel, StandardStreams
from .requests import COMMANDED, Request, plan_of, was_commanded
from .vehicle import Absent, Done, Failed, Plan, Stopped, Unknown, Vehicle, finite
from .waiting import within

PROTOCOL = 1
TELEMETRY_ON, TELEMETRY_OFF = 1.0, 10.0
"""Seconds between two reports of positions and batteries."""
STOP_AGAIN = 1.0
"""Seconds until a vehicle that could not be stopped is stopped again."""
CLOSING = 4.5
"""Seconds that vehicles get to stop when the run ends; the protocol gives 5."""
ENDING = 0.3
"""Seconds that `Vehicle.run` and `Adapter.run` get to end when the run is over; the protocol gives 0.5."""


class Adapter:
    """An adapter for `vehicles`; more of them may come and go, by `add` and `remove`. Derive a class to discover
    vehicles (`run`), or to open a link before Dolphin is greeted (`open`)."""

    def __init__(
        self, name: str, vehicles: Iterable[Vehicle] = (), *, version: str = "0.1",
        plans: Optional[Sequence[str]] = None, announce: float = 2.0, patience: float = 30.0,
    ) -> None:
        self.name, self.version, self.announce, self.patience = name, version, announce, patience
        self.vehicles: Dict[str, Vehicle] = {}
        self.purpose = "run"
        """`run`, `look` or `check`: why Dolphin has started the adapter."""
        self.program: Optional[str] = None
        """The name of the program's file, if it has one."""
        self.resumes = False
        self._plans = plans
        self._requests: Dict[str, Request] = {}
        self._current: Dict[Vehicle, Request] = {}
        self._channel: Optional[Channel] = None
        self._loop: Optional[asyncio.AbstractEventLoop] = None
        self._thread: Optional[int] = None
        self._telemetry = TELEMETRY_OFF
        self._telemetry_changed: Optional[asyncio.Event] = None
        self._awaited: Dict[str, "List[asyncio.Future[Vehicle]]"] = {}
        self._kept: Dict[int, "asyncio.Future[None]"] = {}
        self._last_id = 0
        self._background: "Set[asyncio.Task[Any]]" = set()
        for vehicle in vehicles:
            self.add(vehicle)

    # To be defined by derived classes.

    async def open(self) -> None:
        """Opens links to vehicles, within 10 s. An exception is reported to Dolphin, and ends the adapter: `Failed`
        with its reason alone, others also with their traceback on standard error."""

    async def run(self) -> None:
        """Discovers vehicles, with `add` and `remove`, for as long as the adapter lives. Here: nothing."""

    async def problems(self, plan: Plan) -> Sequence[str]:
        """The reasons why no vehicle of this kind can run the plan. Here: of all vehicles the fewest problems."""
        all_ = [await self._problems_of(vehicle, plan) for vehicle in self.vehicles.values()]
        return min(all_, key=len) if all_ else self._foreign(plan, self._languages())

    # For derived classes to call.

    def add(self, vehicle: Vehicle) -> None:
        """The vehicle is there from now on."""
        self.vehicles[vehicle.name] = vehicle
        vehicle._adapter = self
        vehicle._forget_sent()
        if self._channel is not None:
            self.flush(vehicle)
            self._listen_to(vehicle)
        for waiting in self._awaited.pop(vehicle.name, ()):
            if not waiting.done():
                waiting.set_result(vehicle)

    def remove(self, vehicle: Vehicle) -> None:
        """The vehicle has left the fleet. It may be added again."""
        if self.vehicles.get(vehicle.name) is vehicle:
            del self.vehicles[vehicle.name]
            vehicle._adapter = None
            self._send({"kind": "gone", "vehicle": vehicle.name})

    def log(self, text: str, vehicle: Optional[Vehicle] = None) -> None:
        """Shows people an unusual event that is not the end of a task."""
        if self._channel is None:
            print(text, file=sys.stderr)
        about = {} if vehicle is None else {"vehicle": vehicle.name}
        self._send({"kind": "log", **about, "text": text})

    def serve(self) -> None:
        """Speaks to Dolphin on the standard streams until the run ends, and ends this process. If Dolphin dies, the
        process ends at once, with nothing cancelled, so that nothing more is commanded: vehicles go on."""
        asyncio.run(self._serve())

    async def _serve(self) -> None:
        closed = await self.converse(StandardStreams())
        if closed and self._background:
            for task in self._background:
                task.cancel()
            await asyncio.wait(set(self._background), timeout=ENDING)
        sys.stderr.flush()
        os._exit(0)  # threads that wait for a vehicle do not delay the end

    # The conversation.

    async def converse(self, channel: Channel) -> bool:
        """Speaks to Dolphin on a channel until the run ends: `True`, all vehicles having been stopped; or until the
        other side ends without a word: `False`. A later conversation knows the requests of this one."""
        loop = asyncio.get_running_loop()
        first = self._loop is not loop
        self._loop, self._thread = loop, threading.get_ident()
        order = await channel.receive()
        if order is None:
            return False
        refusal = await self._refusal(order)
        if refusal is not None:
            channel.send({"kind": "error", "why": refusal})
            await channel.drain()
            return True
        self._channel = channel
        self._forget_unkept()
        self._telemetry_changed = asyncio.Event()
        self._greet()
        if first:
            self._spawn(self._guarded(self.run(), "discovery", None))
        telemetry = self._spawn(self._send_telemetry())
        for vehicle in list(self.vehicles.values()):
            vehicle._forget_sent()
            self.flush(vehicle)
            if first:
                self._listen_to(vehicle)
        try:
            while True:
                order = await channel.receive()
                if order is None:
                    return False
                if order.get("kind") == "close":
                    await self._close()
                    return True
                self._obey(order)
        finally:
            telemetry.cancel()

    async def _refusal(self, hello: Mapping[str, Any]) -> Optional[str]:
        """Why Dolphin cannot be greeted."""
        if hello.get("kind") != "hello" or hello.get("protocol") != PROTOCOL:
            return f"speaks version {PROTOCOL} of the platform protocol only"
        self.purpose, self.resumes = hello.get("purpose") or "run", bool(hello.get("resumes"))
        self.program = hello.get("program")
        try:
            await self.open()
        except Failed as failed:
            return words_of(failed)
        except Exception as error:
            traceback.print_exc()
            return words_of(error)
        return None

    def _greet(self) -> None:
        self._send(
            {"kind": "hello", "protocol": PROTOCOL, "name": self.name, "version": self.version,
             "plans": self._languages(), "announce": self.announce, "patience": self.patience}
        )

    def _languages(self) -> List[str]:
        if self._plans is not None:
            return list(self._plans)
        languages = {language for vehicle in self.vehicles.values() for language in vehicle.languages}
        return ["name", *sorted(languages)]

    def _obey(self, order: Mapping[str, Any]) -> None:
        """Begins to carry out an order. Unknown orders are ignored."""
        obey = {
            "start": self._start, "stop": self._stop, "resume": self._resume, "check": self._check, "ping": self._ping,
            "kept": self._note_kept, "telemetry": self._pace, "hold": self._hold, "release": self._hold,
            "refused": self._report_again,
        }.get(str(order.get("kind")))
        if obey is None:
            return
        try:
            obey(order)
        except Exception:  # an order that lacks a member, or a fault of a vehicle's code: the next one is obeyed
            traceback.print_exc()

    def _ping(self, order: Mapping[str, Any]) -> None:
        self._send({"kind": "pong", "id": order["id"]})

    def _pace(self, order: Mapping[str, Any]) -> None:
        self._telemetry = TELEMETRY_ON if order["on"] else TELEMETRY_OFF
        if self._telemetry_changed is not None:
            self._telemetry_changed.set()

    def _hold(self, order: Mapping[str, Any]) -> None:
        held = order["kind"] == "hold"
        for name in order["vehicles"]:
            vehicle = self.vehicles.get(name)
            if vehicle is not None:
                vehicle.held = held
                vehicle.hold(held)

    def _report_again(self, order: Mapping[str, Any]) -> None:
        print(f"Dolphin refused a line: it {order.get('why')}", file=sys.stderr)
        for vehicle in self.vehicles.values():
            vehicle._forget_sent()
            self.flush(vehicle)

    def _check(self, order: Mapping[str, Any]) -> None:
        self._spawn(self._answer_check(order))

    async def _answer_check(self, order: Mapping[str, Any]) -> None:
        plan, name = plan_of(order["plan"], order), order.get("vehicle")
        vehicle = self.vehicles.get(name) if name is not None else None
        try:
            if name is None:
                problems = list(await self.problems(plan))
            elif vehicle is None:
                problems = [f"there is no vehicle {name}"]
            else:
                problems = await self._problems_of(vehicle, plan)
        except Exception as error:
            traceback.print_exc()
            problems = [f"the plan cannot be checked: {words_of(error)}"]
        self._send({"kind": "checked", "id": order["id"], "problems": problems})

    async def _problems_of(self, vehicle: Vehicle, plan: Plan) -> List[str]:
        return self._foreign(plan, vehicle.languages) or list(await vehicle.problems(plan))

    @staticmethod
    def _foreign(plan: Plan, languages: Sequence[str]) -> List[str]:
        if plan.language is None or plan.language in languages:
            return []
        return [f"plans in the language {plan.language} are not for this vehicle"]

    # Requests: from an order to an end.

    def _start(self, order: Mapping[str, Any]) -> None:
        known = self._requests.get(order["request"])
        if known is not None and not (known.is_absent and known.stopping is None):
            self._repeat(known)
            return
        request = self._new(order)
        request.vehicle = self.vehicles.get(request.vehicle_name)
        if request.vehicle is None:
            self._say(request, "failed", f"there is no vehicle {request.vehicle_name}")
        else:
            request.work = self._spawn(self._carry_out(request, request.vehicle))

    async def _carry_out(self, request: Request, vehicle: Vehicle) -> None:
        """A start, to its end."""
        try:
            await self._admit(request, vehicle)
            request.replaces = self._give_up(vehicle)
            self._current[vehicle] = request
            request.commanded = True
            await vehicle.start(request.plan)
            self._end_replaced(request, "failed", "was replaced by another plan")
            self._say(request, "taken")
            await vehicle.finish(request.plan)
            self._say(request, "done")
        except asyncio.CancelledError:
            self._cancelled(request)
            raise
        except Exception as error:
            self._conclude(request, error)
            before = request.replaces
            if before is not None and not before.has_ended and request.has_ended:  # it was not replaced
                self._current[vehicle] = before
                before.stopping = self._spawn(self._bring_to_rest(before))

    async def _admit(self, request: Request, vehicle: Vehicle) -> None:
        """Returns once the vehicle may be commanded, and Dolphin's disk has the note on it. Nothing has moved."""
        try:
            problems = await self._problems_of(vehicle, request.plan)
        except Exception as error:
            traceback.print_exc()
            problems = [f"the plan cannot be checked: {words_of(error)}"]
        if problems:
            raise Failed("; ".join(problems))
        await self._keep(request.id, COMMANDED)
        busy = self._current.get(vehicle)
        if busy is not None and not busy.has_ended and busy.stopping is None:
            raise Failed("runs another plan")
        if vehicle.unready is not None:
            raise Failed(vehicle.unready)

    def _give_up(self, vehicle: Vehicle) -> Optional[Request]:
        """The request of the vehicle that is still being stopped, which Dolphin no longer waits for."""
        before = self._current.get(vehicle)
        if before is None or before.has_ended:
            return None
        if before.stopping is not None:
            before.stopping.cancel()
        return before

    def _stop(self, order: Mapping[str, Any]) -> None:
        request = self._requests.get(order["request"])
        if request is None:
            self._say(self._new(order), "stopped")
        elif request.is_absent:
            self._not_absent(request)
        elif request.has_ended:
            self._repeat(request)
        elif request.stopping is None or request.stopping.done():
            request.stopping = self._spawn(self._bring_to_rest(request))

    async def _bring_to_rest(self, request: Request) -> None:
        """A stop, to the end of its request."""
        if request.work is not None and not request.work.done():
            request.work.cancel()
            await asyncio.wait({request.work}, timeout=STOP_AGAIN)
        if request.is_absent:
            self._not_absent(request)
        while not request.has_ended:
            try:
                if request.commanded:
                    vehicle = request.vehicle or await self._heard(request.vehicle_name)
                    await vehicle.stop(request.plan)
                self._end_replaced(request, "stopped")
                self._say(request, "stopped")
            except Failed as failed:
                self._say(request, "failed", failed.why or "is not stopped")
            except Exception as error:
                self._conclude(request, error)
                await asyncio.sleep(STOP_AGAIN)

    def _not_absent(self, request: Request) -> None:
        """Answers the stop of a request that is absent: it will not be ordered again."""
        request.last = None
        self._say(request, "stopped")

    def _resume(self, order: Mapping[str, Any]) -> None:
        known = self._requests.get(order["request"])
        if known is not None:
            self._repeat(known)
            return
        request = self._new(order)
        request.commanded = was_commanded(order)
        request.work = self._spawn(self._find_out(request))

    async def _find_out(self, request: Request) -> None:
        """A request of before this adapter's death, to its end."""
        try:
            if not request.commanded:
                raise Absent()
            vehicle = request.vehicle = await self._heard(request.vehicle_name)
            self._current[vehicle] = request
            await vehicle.resume(request.plan)
            self._say(request, "taken")
            await vehicle.finish(request.plan)
            self._say(request, "done")
        except Absent:
            self._say(request, "absent")
        except Done:
            self._say(request, "done")
        except Stopped:
            self._say(request, "stopped")
        except asyncio.CancelledError:
            self._cancelled(request)
            raise
        except Exception as error:
            self._conclude(request, error)

    def _conclude(self, request: Request, error: Exception) -> None:
        """Reports the outcome that an exception of a vehicle stands for. After a fault the plan is unknown."""
        if isinstance(error, Failed) or not request.commanded:
            self._say(request, "failed", words_of(error))
        else:
            self._say(request, "unknown", words_of(error))
        if not isinstance(error, (Failed, Unknown)):
            traceback.print_exception(type(error), error, error.__traceback__)

    def _cancelled(self, request: Request) -> None:
        """A plan's coroutine was cancelled: by a stop, which reports the end, or by a fault of the vehicle's code."""
        if request.stopping is None:
            self._say(request, "unknown", "was cancelled by the adapter's own code")

    def _end_replaced(self, request: Request, kind: str, why: Optional[str] = None) -> None:
        if request.replaces is not None:
            self._say(request.replaces, kind, why)

    def _new(self, order: Mapping[str, Any]) -> Request:
        plan = plan_of(order.get("plan") or {}, order)
        plan._adapter = self
        request = Request(order["request"], order["vehicle"], plan)
        self._requests[request.id] = request
        return request

    def _say(self, request: Request, kind: str, why: Optional[str] = None) -> None:
        """Reports on a request, unless it has ended. The vehicle's state goes before."""
        if request.takes(kind):
            request.last = {"kind": kind} if why is None else {"kind": kind, "why": why}
            if request.vehicle is not None:
                self.flush(request.vehicle)
            self._repeat(request)

    def _repeat(self, request: Request) -> None:
        if request.last is not None:
            self._send({**request.last, "request": request.id})

    async def _heard(self, name: str) -> Vehicle:
        """The vehicle of this name, once it is there."""
        if name in self.vehicles:
            return self.vehicles[name]
        waiting: "asyncio.Future[Vehicle]" = asyncio.get_running_loop().create_future()
        self._awaited.setdefault(name, []).append(waiting)
        return await waiting

    async def _close(self) -> None:
        """Stops all that runs, and reports that it is quiet, if need be after 5 s."""
        open_ = [request for request in self._requests.values() if not request.has_ended]
        for request in open_:
            if request.stopping is None or request.stopping.done():
                request.stopping = self._spawn(self._bring_to_rest(request))
        stops = {request.stopping for request in open_ if request.stopping is not None}
        if stops:
            await asyncio.wait(stops, timeout=CLOSING)
        self._send({"kind": "quiet"})
        if self._channel is not None:
            await self._channel.drain()

    # Notes and estimates.

    def report_progress(self, plan: Plan, share: Optional[float], remaining: Optional[float]) -> None:
        """`Plan.progress` calls this."""
        request = self._requests.get(plan.request)
        if request is not None and not request.has_ended:
            members = {"share": finite(share), "remaining": finite(remaining)}
            known = {name: max(0.0, x) for name, x in members.items() if x is not None}
            known.update({"share": min(1.0, known["share"])} if "share" in known else {})
            self._send({"kind": "progress", "request": plan.request, **known})

    async def keep_note(self, plan: Plan, note: Mapping[str, Any]) -> None:
        """`Plan.note` calls this."""
        await self._keep(plan.request, {"note": dict(note)})

    async def _keep(self, request: str, note: Mapping[str, Any]) -> None:
        self._last_id += 1
        kept = self._kept[self._last_id] = asyncio.get_running_loop().create_future()
        self._send({"kind": "note", "request": request, "note": dict(note), "id": self._last_id})
        await kept

    def _note_kept(self, order: Mapping[str, Any]) -> None:
        kept = self._kept.pop(order["id"], None)
        if kept is not None and not kept.done():
            kept.set_result(None)

    def _forget_unkept(self) -> None:
        """Notes on which an earlier conversation ended: nothing was commanded that waited for them."""
        for kept in self._kept.values():
            if not kept.done():
                kept.set_exception(Failed("the connection to Dolphin broke before the order was kept"))
        self._kept.clear()

    # Vehicles.

    def flush(self, vehicle: Vehicle) -> None:
        """Sends the news of the vehicle."""
        if self._channel is None or vehicle._adapter is not self:
            return
        news = vehicle._news()
        if news:
            self._send({"kind": "vehicle", "vehicle": vehicle.name, **news})

    async def _send_telemetry(self) -> None:
        changed = self._telemetry_changed
        assert changed is not None
        while True:
            changed.clear()
            await within(changed.wait(), self._telemetry)
            for vehicle in list(self.vehicles.values()):
                self.flush(vehicle)

    def _listen_to(self, vehicle: Vehicle) -> None:
        if self.purpose != "check":
            self._spawn(self._guarded(vehicle.run(), f"listening to {vehicle.name}", vehicle))

    async def _guarded(self, work: Awaitable[None], what: str, vehicle: Optional[Vehicle]) -> None:
        """Work that goes on beside the orders. Its fault is shown, and takes the vehicle's link."""
        try:
            await work
        except Exception as error:
            traceback.print_exc()
            self.log(f"{what} failed: {words_of(error)}", vehicle)
            if vehicle is not None:
                vehicle.report(link=False)

    # The loop.

    def is_of_this_thread(self) -> bool:
        """Whether the adapter's loop runs in this thread, or does not run yet."""
        return self._thread is None or self._thread == threading.get_ident()

    def call_soon(self, call: Callable[[], None]) -> None:
        """Has the adapter's loop call something, from another thread."""
        if self._loop is not None and not self._loop.is_closed():
            self._loop.call_soon_threadsafe(call)

    def _send(self, message: Mapping[str, Any]) -> None:
        if self._channel is not None:
            self._channel.send(message)

    def _spawn(self, work: "Any") -> "asyncio.Task[Any]":
        task: "asyncio.Task[Any]" = asyncio.get_running_loop().create_task(work)
        self._background.add(task)
        task.add_done_callback(self._background.discard)
        return task


def words_of(error: BaseException) -> str:
    """An exception in a few words, for people at the console."""
    why = getattr(error, "why", None)
    text = why if isinstance(why, str) else f"{type(error).__name__}: {error}"
    return " ".join(text.split())[:500] or type(error).__name__


def serve(*vehicles: Vehicle, name: str = "python", **greeting: Any) -> None:
    """The whole of an adapter's main program: serves the vehicles until the run ends.

        dolphin.serve(Boat("boat-1", latitude=41.185, longitude=-8.706), name="boats")
    """
    Adapter(name, vehicles, **greeting).serve()
