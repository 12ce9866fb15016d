"""Waits of tests, which fail after a time that only a fault takes; and ports of loopback: `unittests`, beside this, has
this folder on the path."""

import asyncio
import socket
import time
from typing import Any, Callable

SECONDS = 60.0


def until(condition: Callable[[], Any], what: Callable[[], object] = lambda: "a condition") -> Any:
    """Waits for a condition, and gives its value. `what` is shown if it does not become true."""
    end = time.monotonic() + SECONDS
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.02)
    raise AssertionError(f"in {SECONDS:g} s: {what()}")


async def eventually(condition: Callable[[], Any]) -> None:
    """Waits for a condition while the event loop goes on."""
    end = time.monotonic() + SECONDS
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"a condition did not become true in {SECONDS:g} s")
        await asyncio.sleep(0.005)


def free_port() -> int:
    """A port of loopback that is free now, for TCP."""
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return int(listener.getsockname()[1])
