"""The pilot, station or emergency that took a vehicle out of its mission, in words. Pure."""

from .wire import mavlink

RECENT = 10.0  # seconds for which an emergency is the reason of a mode
_RETURNS = {"RTL", "SMART_RTL", "QRTL", "AUTO_RTL"}
_LANDS = {"LAND", "QLAND", "PRECLAND"}


def restarted(vehicle):
    """Why a task failed whose vehicle's autopilot has started again."""
    flew = vehicle.flew_at >= vehicle.armed_at - RECENT
    return "its autopilot restarted in flight" if flew else "its autopilot restarted"


def is_emergency(now, vehicle):
    """Whether it has reported one just now."""
    said_at, text = vehicle.distress
    return vehicle.breach(now, RECENT) is not None or (bool(text) and now - said_at <= RECENT)


def emergency(now, vehicle):
    """Its last report of one, if it came just now, to be added to a reason."""
    said_at, text = vehicle.distress
    return f": {text}" if text and now - said_at <= RECENT else ""


def named(now, vehicle, mode):
    """Why the task failed when the vehicle went into `mode`, and why it cannot take the next one, as a predicate."""
    fence = vehicle.breach(now, RECENT)
    if fence is not None:
        return f"{fence}, in mode {mode}", f"is in mode {mode} after a fence breach"
    said_at, text = vehicle.distress
    if text and now - said_at <= RECENT:
        return f"failsafe: {text}, in mode {mode}", f"is in failsafe: {text}"
    if vehicle.status in (mavlink.MAV_STATE_CRITICAL, mavlink.MAV_STATE_EMERGENCY):
        return f"failsafe, in mode {mode}", "is in failsafe"
    for modes, does in ((_RETURNS, "returns home"), (_LANDS, "lands")):
        if mode in modes:
            return f"{does} in mode {mode}, set by its pilot or another station", f"{does} in mode {mode}"
    return f"taken over by its pilot in mode {mode}", f"is flown by its pilot in mode {mode}"
