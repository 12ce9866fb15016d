"""The fate of a mission that an earlier adapter has begun, or was about to begin. Pure."""

from .wire import mavlink

FLIES = ("taken",)
UNNOTED = "has the mission on board that it was to begin, and may have flown it: the journal has no note of it"
_BEGUN = (mavlink.MISSION_STATE_ACTIVE, mavlink.MISSION_STATE_PAUSED, mavlink.MISSION_STATE_COMPLETE)


class Doubt:
    """A mission without a note: the journal may have lost the note, or with `lost_order` the order, too. The items of a
    mission that `is_relative` depend on the place where it was made: it is recognised by its commands. One that `arms`
    the vehicle can be begun while it is disarmed."""

    def __init__(self, lost_order, is_relative, arms):
        self.lost_order, self.is_relative, self.arms = lost_order, is_relative, arms


def without_note(vehicle, doubt, different, same_commands):
    """The event that follows from the state of `vehicle`: unknown, or absent. `different`: why the mission on board is
    not the one in doubt, if so; `same_commands`: whether it has its commands.

    A vehicle that flies another station's mission does not take the start that follows `absent`."""
    is_on_board = different is None or (doubt.is_relative and same_commands)
    flies = vehicle.mode == vehicle.modes.mission and vehicle.armed
    # The upload, which comes before the note, sets the state back. So does the landing of some autopilots: a vehicle
    # that is disarmed may have flown. A mission that does not arm it is not begun again: the start is refused.
    landed = doubt.arms and not vehicle.armed
    if is_on_board and (doubt.lost_order or flies or landed or vehicle.mission_state in _BEGUN):
        return "unknown", UNNOTED
    return ("absent",)


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
