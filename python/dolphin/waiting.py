"""Waits with an end."""

from __future__ import annotations

import asyncio
from typing import Awaitable, Optional, TypeVar

T = TypeVar("T")


async def within(work: Awaitable[T], seconds: Optional[float]) -> Optional[T]:
    """The result of the work, or `None` if it takes longer than these seconds; then it is cancelled. `None` of them is
    without a limit. Before Python 3.12 `asyncio.wait_for` loses a cancellation that comes as the work ends."""
    task = asyncio.ensure_future(work)
    try:
        await asyncio.wait({task}, timeout=seconds)
        return task.result() if task.done() else None
    finally:
        task.cancel()
