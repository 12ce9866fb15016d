"""The fate of a mission that an earlier adapter has begun, or was about to begin. Pure."""

from .wire import mavlink

FLIES = ("taken",)


def found(vehicle, progress, different):
    """The event that follows from the state of `vehicle`: FLIES, done, failed or unknown. `different`: why the mission
    on board is not the one that was begun, if so."""
    flies = vehicle.mode == vehicle.modes.mission and vehicle.armed
    where = f"in mode {vehicle.mode}" if vehicle.armed else "not armed"
    if different is not None and flies:
        return "unknown", different
    if different is not None:
        return "failed", f"is {where}, and may have flown the mission that it was to begin: {different}"
    progress.resume()
    if vehicle.mission_state == mavlink.MISSION_STATE_COMPLETE:
        return ("done",)
    if flies or (vehicle.armed and progress.returns_by_itself()):
        return FLIES
    return "failed", f"does not fly the mission that it was to begin, and may have flown it: it is {where}"
