"""Options of the command line that several commands have."""

from . import modes


class Trouble(Exception):
    """Why a command cannot begin; a text for people."""


def pairs(values, what, numbers=False):
    found = {}
    for value in values:
        name, equals, rest = value.partition("=")
        if not equals or not name or not rest or (numbers and not name.isdigit()):
            raise Trouble(f"{what} {value}: it is {'NUMBER' if numbers else 'VEHICLE'}=...")
        found[int(name) if numbers else name] = rest
    return found


def _kind(number, text):
    frame, _, autopilot = text.partition(":")
    autopilots = {"px4": modes.PX4, "ardupilot": modes.ARDUPILOT}
    if frame not in modes.TYPES or autopilot not in autopilots:
        frames = ", ".join(modes.TYPES)
        raise Trouble(f"--kind {number}={text}: it is one of {frames}, and :px4 or :ardupilot")
    return autopilots[autopilot], frame


def names_of(values):
    """The names of systems, by their numbers."""
    return pairs(values, "--name", numbers=True)


def kinds_of(values):
    """The autopilots and frames of systems, by their numbers."""
    return {n: _kind(n, text) for n, text in pairs(values, "--kind", numbers=True).items()}
