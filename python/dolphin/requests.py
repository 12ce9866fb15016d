"""The requests of Dolphin that an adapter knows: the last report on each, and the reports that may follow."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from typing import Any, Dict, Mapping, Optional

from .vehicle import Plan, Vehicle

ENDS = frozenset({"done", "failed", "stopped", "absent"})

COMMANDED: Mapping[str, Any] = {"commanded": True}
"""The note that precedes every command: a request without it never reached its vehicle."""


@dataclass
class Request:
    """A request, from its `start` or `resume` to its end."""

    id: str
    vehicle_name: str
    plan: Plan
    vehicle: Optional[Vehicle] = None
    last: Optional[Dict[str, Any]] = None
    """The last report on it: `kind` and `why`; estimates do not count."""
    commanded: bool = False
    """Whether the vehicle may have heard of it."""
    replaces: "Optional[Request]" = None
    """The request that was still being stopped when this one was started."""
    work: "Optional[asyncio.Task[None]]" = None
    stopping: "Optional[asyncio.Task[None]]" = None

    @property
    def has_ended(self) -> bool:
        return self.last is not None and self.last["kind"] in ENDS

    @property
    def is_absent(self) -> bool:
        return self.last is not None and self.last["kind"] == "absent"

    def takes(self, kind: str) -> bool:
        """Whether a report of this kind may follow. The first end counts, and `unknown` is reported once."""
        if self.has_ended:
            return False
        return not (kind in ("unknown", "taken") and self.last is not None and self.last["kind"] == "unknown")


def plan_of(json: Mapping[str, Any], order: Mapping[str, Any]) -> Plan:
    """The plan of an order. Of the notes those of the vehicle's own are left."""
    own = [note["note"] for note in order.get("notes") or () if isinstance(note, dict) and "note" in note]
    timeout = order.get("timeout")
    return Plan(
        name=json.get("name") or "", language=json.get("language"), body=json.get("body") or {},
        request=order.get("request") or "", timeout=60.0 if timeout is None else timeout, notes=own,
        doubt=order.get("doubt"),
    )


def was_commanded(order: Mapping[str, Any]) -> bool:
    """Whether the vehicle may have been commanded before a `resume`: there are notes, or Dolphin's journal may have
    lost some."""
    return bool(order.get("notes")) or order.get("doubt") is not None
