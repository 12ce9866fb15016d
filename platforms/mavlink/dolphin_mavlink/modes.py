"""Types of vehicles and their flight modes, for ArduPilot and PX4. Numbers of modes are pymavlink's tables."""

from pymavlink import mavutil

from .wire import mavlink

ARDUPILOT, PX4 = mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA, mavlink.MAV_AUTOPILOT_PX4

_ROTARY = {2, 3, 4, 13, 14, 15, 29, 35, 43}
_VTOL = {19, 20, 21, 22, 23, 24, 25}
_WINGED = {1, 7, 16, 28}


def frame_of(mav_type):
    """The kind of such a vehicle: "copter", "plane", "vtol", "rover", "boat", "sub"; None: not a vehicle."""
    if mav_type in _ROTARY:
        return "copter"
    if mav_type in _VTOL:
        return "vtol"
    if mav_type in _WINGED:
        return "plane"
    return {10: "rover", 11: "boat", 12: "sub"}.get(mav_type)


TYPES = {"copter": "UAV", "vtol": "UAV", "plane": "UAV", "rover": "UGV", "boat": "USV", "sub": "UUV"}

_ARDUPILOT_MODES = {
    "copter": mavutil.mode_mapping_acm,
    "plane": mavutil.mode_mapping_apm,
    "vtol": mavutil.mode_mapping_apm,
    "rover": mavutil.mode_mapping_rover,
    "boat": mavutil.mode_mapping_rover,
    "sub": mavutil.mode_mapping_sub,
}

_PX4_MAIN = {1: "MANUAL", 2: "ALTCTL", 3: "POSCTL", 5: "ACRO", 6: "OFFBOARD", 7: "STABILIZED", 8: "RATTITUDE"}
_PX4_AUTO = {1: "READY", 2: "TAKEOFF", 3: "HOLD", 4: "MISSION", 5: "RTL", 6: "LAND", 8: "FOLLOW", 9: "PRECLAND"}


def name_of(autopilot, frame, custom_mode):
    """The name of the mode in a heartbeat, as pilots call it."""
    if autopilot == PX4:
        main, sub = (custom_mode >> 16) & 0xFF, (custom_mode >> 24) & 0xFF
        return _PX4_AUTO.get(sub, f"AUTO {sub}") if main == 4 else _PX4_MAIN.get(main, f"mode {main}")
    return _ARDUPILOT_MODES[frame].get(custom_mode, f"mode {custom_mode}")


def parameters_of(autopilot, frame, name):
    """The second and third parameter of MAV_CMD_DO_SET_MODE for the mode `name`; None if there is none."""
    if autopilot == PX4:
        for sub, known in _PX4_AUTO.items():
            if known == name:
                return 4, sub
        for main, known in _PX4_MAIN.items():
            if known == name:
                return main, 0
        return None
    for number, known in _ARDUPILOT_MODES[frame].items():
        if known == name:
            return number, 0
    return None


class Modes:
    """The modes that matter of one kind of vehicle."""

    def __init__(self, mission, hold, home, before_arming, hands_off, given_back, after):
        self.mission = mission  # carries out the mission
        self.hold = hold  # stays where it is, without a pilot
        self.home = home  # returns home
        self.before_arming = before_arming  # where it is armed; None: in `mission`
        self.hands_off = hands_off  # those in which no pilot has the sticks
        self.given_back = given_back  # by these a pilot gives the vehicle back
        self.after = after  # where the autopilot itself goes after the last item


_COPTER = Modes(
    "AUTO", "BRAKE", "RTL", "GUIDED", {"AUTO", "GUIDED", "BRAKE", "RTL", "SMART_RTL"}, {"AUTO", "GUIDED"}, ()
)
_PLANE = Modes(
    "AUTO", "LOITER", "RTL", None, {"AUTO", "GUIDED", "LOITER", "RTL", "QRTL"}, {"AUTO", "GUIDED"}, ("RTL", "QRTL")
)
_ROVER = Modes(
    "AUTO",
    "HOLD",
    "RTL",
    "GUIDED",
    {"AUTO", "GUIDED", "HOLD", "LOITER", "RTL", "SMART_RTL"},
    {"AUTO", "GUIDED"},
    ("HOLD", "LOITER"),
)
_SUB = Modes("AUTO", "POSHOLD", "SURFACE", "GUIDED", {"AUTO", "GUIDED", "POSHOLD"}, {"AUTO", "GUIDED"}, ("POSHOLD",))
_PX4 = Modes("MISSION", "HOLD", "RTL", "HOLD", {"MISSION", "HOLD", "RTL", "TAKEOFF"}, {"MISSION", "HOLD"}, ("HOLD",))

_ARDUPILOT = {"copter": _COPTER, "plane": _PLANE, "vtol": _PLANE, "rover": _ROVER, "boat": _ROVER, "sub": _SUB}


def modes_of(autopilot, frame):
    return _PX4 if autopilot == PX4 else _ARDUPILOT[frame]
