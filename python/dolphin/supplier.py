"""A supplier: the object behind `getSupplier()` of programs, made of decorated functions.

    tasks = ["photograph_pier", "follow_coast"]
    supplier = dolphin.Supplier()

    @supplier.method
    def active():
        return len(tasks) > 0

    @supplier.method
    def next(vehicle, minutes=5):
        return dolphin.Task(tasks.pop(0))

    supplier.serve()
"""

from __future__ import annotations

import asyncio
import inspect
import sys
import traceback
from typing import Any, Callable, Dict, Mapping, Optional, TypeVar, overload

from .channel import Channel, StandardStreams
from .values import Reference, from_json, to_json

Function = TypeVar("Function", bound=Callable[..., Any])


class SupplierError(Exception):
    """A call that fails: its text is the error that the program gets. Any other exception is one, too."""


class Supplier:
    """The supplier's object, and further ones that it offers."""

    def __init__(self, name: str = "supplier") -> None:
        self.name = name
        self._methods: Dict[str, Callable[..., Any]] = {}
        self._values: Dict[str, Callable[[], Any]] = {}
        self._offered: Dict[str, Any] = {}

    @overload
    def method(self, function: Function) -> Function: ...

    @overload
    def method(self, *, name: str) -> Callable[[Function], Function]: ...

    def method(self, function: Optional[Function] = None, *, name: Optional[str] = None) -> Any:
        """Decorates a function, or a coroutine, which programs call as `supplier.NAME(...)`. `name` is needed if it is
        a word that Python keeps for itself, such as `await`."""
        return self._decorator(self._methods, function, name)

    @overload
    def value(self, function: Function) -> Function: ...

    @overload
    def value(self, *, name: str) -> Callable[[Function], Function]: ...

    def value(self, function: Optional[Function] = None, *, name: Optional[str] = None) -> Any:
        """Decorates a function without parameters, which programs read as `supplier.NAME`."""
        return self._decorator(self._values, function, name)

    def offer(self, name: str, thing: Any) -> Reference:
        """Makes an object known to programs: its public methods can be called, its public attributes read. A name
        that ends in `_` is that without it. A function that returns the object, or this reference, gives it to the
        program. A run that is resumed may still name it: offer it again at the start."""
        self._offered[name] = thing
        return Reference(name)

    def serve(self) -> None:
        """Answers on the standard streams until their end."""
        asyncio.run(self._serve())

    async def _serve(self) -> None:
        await self.converse(StandardStreams())

    async def converse(self, channel: Channel) -> None:
        """Answers each request on a channel, one after the other, until its end."""
        while True:
            request = await channel.receive()
            if request is None:
                return
            channel.send(await self._reply(request))
            await channel.drain()

    async def _reply(self, request: Mapping[str, Any]) -> Dict[str, Any]:
        try:
            value = self._find(request)
            if inspect.isawaitable(value):
                value = await value
            return {"id": request.get("id"), "value": self._encode(value)}
        except SupplierError as error:
            return {"id": request.get("id"), "error": str(error)}
        except Exception as error:
            traceback.print_exc(file=sys.stderr)
            return {"id": request.get("id"), "error": f"{type(error).__name__}: {error}"}

    def _find(self, request: Mapping[str, Any]) -> Any:
        thing, call, get = request.get("object"), request.get("call"), request.get("get")
        if thing is None and call == "getSupplier":
            return Reference(self.name)
        arguments = [self._decode(argument) for argument in request.get("arguments") or ()]
        if thing == self.name:
            known: Mapping[str, Callable[..., Any]] = self._values if call is None else self._methods
            name = str(get if call is None else call)
            if name not in known:
                raise SupplierError(f"{self.name} has no {'value' if call is None else 'method'} '{name}'")
            return known[name](*arguments)
        if thing not in self._offered:
            raise SupplierError(f"there is no object '{thing}'")
        found = _public(self._offered[thing], thing, str(get if call is None else call))
        return found if call is None else found(*arguments)

    def _encode(self, value: Any) -> Any:
        for name, thing in self._offered.items():
            if thing is value:
                return to_json(Reference(name))
        return to_json(value)

    def _decode(self, json: Any) -> Any:
        value = from_json(json)
        return self._offered.get(value.name, value) if isinstance(value, Reference) else value

    @staticmethod
    def _decorator(known: Dict[str, Callable[..., Any]], function: Optional[Function], name: Optional[str]) -> Any:
        def register(function: Function) -> Function:
            known[name or function.__name__.rstrip("_")] = function
            return function

        return register if function is None else register(function)


def _public(thing: Any, name: str, member: str) -> Any:
    if not member.startswith("_"):
        for spelling in (member, member + "_"):
            if hasattr(thing, spelling):
                return getattr(thing, spelling)
    raise SupplierError(f"{name} has no member '{member}'")
