"""Dolphin from Python: adapters for vehicles, suppliers, runs, analyses, journals, and missions as tests.

The documentation is docs/python.md of Dolphin. The command `dolphin` is called: it is on the path, or named by the
environment variable `DOLPHIN`."""

from .adapter import Adapter, serve
from .analysis import Check, Exploration, Verdict, check, explore
from .console import Console, ConsoleEvent
from .diagnostics import Diagnostic
from .errors import (
    CommandError,
    CommandFault,
    CommandNotFound,
    ConsoleRefused,
    DolphinError,
    JournalError,
    PlatformError,
    ProgramError,
    RequestRefused,
    RunEnded,
    RunFailed,
    RunGone,
)
from .fakes import Fake, Fakes, never
from .journal import End, Event, Header, Journal, Other, Record, Resumed, Sighting, TaskRun, Transition, read
from .missions import assert_holds, assert_in_time, mission
from .runs import Run, StartedRun, attach, execute, run
from .supplier import Supplier, SupplierError
from .timing import Battery, TaskTimes, Timing, Window, Within, time
from .values import Area, Circle, Position, Reference, Task, Vehicles
from .version import VERSION as __version__
from .vehicle import Absent, Done, Failed, Plan, Stopped, Unknown, Vehicle

__all__ = [
    "Absent", "Adapter", "Area", "Battery", "Check", "Circle", "CommandError", "CommandFault", "CommandNotFound",
    "Console", "ConsoleEvent", "ConsoleRefused", "Diagnostic", "DolphinError", "Done", "End", "Event",
    "Exploration", "Failed", "Fake", "Fakes", "Header", "Journal", "JournalError", "Other", "Plan", "PlatformError",
    "Position", "ProgramError", "Record", "Reference", "RequestRefused", "Resumed", "Run", "RunEnded", "RunFailed",
    "RunGone", "Sighting", "StartedRun", "Stopped", "Supplier", "SupplierError", "Task", "TaskRun", "TaskTimes",
    "Timing", "Transition", "Unknown", "Vehicle", "Vehicles", "Verdict", "Window", "Within", "assert_holds",
    "assert_in_time", "attach", "check", "execute", "explore", "mission", "never", "read", "run", "serve", "time",
]
