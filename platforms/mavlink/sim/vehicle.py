"""A vehicle that speaks MAVLink, for tests: the mission protocol and the modes as ArduPilot or PX4 have them, on a
straight way at constant speed. Pure: messages and the time go in, messages come out. Faults are ordered by its
attributes and by `pilot`, `failsafe`, `disarm`, `kill`, `restart`.

The order of its messages is the one seen of ArduCopter 4.6: an acknowledgement before the heartbeat with the new mode,
the reason of a refusal half a second after it, and at a landing, within a quarter of a second: a text, the heartbeat
that is disarmed, the mission at its first item again, and only then the ground.

It shares pymavlink's messages and the tables of modes with the adapter, nothing else.
"""

import math

from dolphin_mavlink import geo, modes
from dolphin_mavlink.wire import mavlink

KINDS = {
    "copter": mavlink.MAV_TYPE_QUADROTOR,
    "plane": mavlink.MAV_TYPE_FIXED_WING,
    "vtol": mavlink.MAV_TYPE_VTOL_TILTROTOR,
    "rover": mavlink.MAV_TYPE_GROUND_ROVER,
    "boat": mavlink.MAV_TYPE_SURFACE_BOAT,
    "sub": mavlink.MAV_TYPE_SUBMARINE,
}
# Seconds that an item takes, by its command: which parameter has them. Others above 95 are done at once.
_SECONDS = {16: "param1", 19: "param1", 93: "param1", 213: None, 42702: "param2", 42703: "param1"}


class SimVehicle:
    def __init__(self, system, kind="copter", px4=False, place=(41.185, -8.706), speed=15.0, armed=False, battery=90):
        self.system, self.component = system, 1
        self.autopilot = modes.PX4 if px4 else modes.ARDUPILOT
        self.type, self.frame = KINDS[kind], kind
        self.modes = modes.modes_of(self.autopilot, kind)
        self.mode = "GUIDED" if armed and not px4 else self._first_mode()
        self.place, self.home, self.altitude, self.speed = place, place, 0.0, speed
        self.armed, self.battery, self.status = armed, battery, mavlink.MAV_STATE_STANDBY
        self.items, self.current, self.state = [], 0, mavlink.MISSION_STATE_NO_MISSION
        self.began = []  # when each mission was begun, and how many items it had
        self.reached = []  # the items that were reached
        self.commands = []  # all that were carried out, with their first parameters
        # Faults
        self.refuses_upload = None  # a MAV_MISSION_RESULT for the first item
        self.results = {}  # of commands, by their numbers
        self.deaf_to = set()  # types of messages and numbers of commands that it ignores
        self.silent = False
        self.tells_state = True  # of its mission, as newer autopilots do
        self.tells_reached = True
        self.grants_rates = True  # whether it sends its position as often as it is asked to
        self.keeps = lambda items: items  # what it keeps of an upload
        self.reasons = {}  # of refused commands, by their numbers: a severity and a text, after the acknowledgement
        self.lands_at = 1.5  # metres a second
        self.transition = 8.0  # seconds that a VTOL transition takes, for which only PX4 waits
        self.lag = 0.1  # seconds between an acknowledgement and its heartbeat
        self.pace = 1.0  # how many times as fast its clock goes
        self._out, self._at = [], None
        self._soon = []  # messages to come, each with its time
        self._streams, self._booted, self._silent_until = True, 0.0, -1.0
        self._place_interval, self._placed_at = 1.0, 0.0  # of its positions, in seconds
        self._on_ground, self._falls = True, None  # its report; the time and height at which it began to fall
        self._upload = None
        self._waits_until, self._jumps = None, {}
        self._beat_at = -1.0

    def _first_mode(self):
        if self.autopilot == modes.PX4:
            return "HOLD"
        return {"copter": "STABILIZE", "sub": "STABILIZE"}.get(self.frame, "MANUAL")

    # From the ground station

    def hear(self, now, message):
        kind = message.get_type()
        if (
            self.silent
            or kind in self.deaf_to
            or getattr(message, "target_system", self.system) not in (0, self.system)
        ):
            return []
        self._advance(now)
        hear = getattr(self, "_hear_" + kind.lower(), None)
        if hear is not None:
            hear(now, message)
        return self._take()

    def _take(self):
        out, self._out = self._out, []
        return out

    def _later(self, at, say, *arguments):
        """Calls `say` at the time `at`."""
        self._soon.append((at, say, arguments))

    def _say_due(self, now):
        due, self._soon = [x for x in self._soon if x[0] <= now], [x for x in self._soon if x[0] > now]
        for _, say, arguments in sorted(due, key=lambda x: x[0]):
            say(*arguments)

    def _hear_mission_count(self, now, message):
        self._upload = {
            "from": (message.get_srcSystem(), message.get_srcComponent()),
            "count": message.count,
            "items": [],
            "asked": now,
            "begun": now,
            "heard": now,
        }
        self._request(now)

    def _request(self, now):
        upload = self._upload
        upload["asked"] = now
        self._out.append(mavlink.MAVLink_mission_request_int_message(*upload["from"], len(upload["items"])))

    def _hear_mission_item_int(self, now, message):
        upload, sender = self._upload, (message.get_srcSystem(), message.get_srcComponent())
        if upload is None:
            self._acknowledge(sender, mavlink.MAV_MISSION_ERROR)
        elif message.seq != len(upload["items"]):
            self._acknowledge(sender, mavlink.MAV_MISSION_INVALID_SEQUENCE)
        elif self.refuses_upload is not None:
            self._upload = None
            self._acknowledge(sender, self.refuses_upload)
        else:
            upload["items"].append(message)
            upload["heard"] = now
            if len(upload["items"]) < upload["count"]:
                self._request(now)
            else:
                self._upload = None
                self.items = self.keeps(upload["items"])
                self._rewind()
                self._acknowledge(sender, mavlink.MAV_MISSION_ACCEPTED)

    def _hear_mission_ack(self, now, message):
        if message.type == mavlink.MAV_MISSION_OPERATION_CANCELLED:
            self._upload = None

    def _acknowledge(self, to, result):
        self._out.append(mavlink.MAVLink_mission_ack_message(*to, result))

    def _hear_mission_request_list(self, now, message):
        self._out.append(
            mavlink.MAVLink_mission_count_message(
                message.get_srcSystem(), message.get_srcComponent(), len(self.items)
            )
        )

    def _hear_mission_request_int(self, now, message):
        to = message.get_srcSystem(), message.get_srcComponent()
        if message.seq >= len(self.items):
            self._acknowledge(to, mavlink.MAV_MISSION_INVALID_SEQUENCE)
            return
        i = self.items[message.seq]
        self._out.append(
            mavlink.MAVLink_mission_item_int_message(
                *to,
                i.seq,
                i.frame,
                i.command,
                0,
                i.autocontinue,
                i.param1,
                i.param2,
                i.param3,
                i.param4,
                i.x,
                i.y,
                i.z
            )
        )

    def _hear_mission_set_current(self, now, message):
        self._rewind(is_new=False)

    def _hear_command_long(self, now, message):
        command = message.command
        if command in self.deaf_to:
            return
        result = self.results.get(command)
        if result is None:
            result = self._carry_out(now, command, message)
            if result == mavlink.MAV_RESULT_ACCEPTED:
                self.commands.append((command, message.param1, message.param2))
        self._out.append(
            mavlink.MAVLink_command_ack_message(
                command, result, 0, 0, message.get_srcSystem(), message.get_srcComponent()
            )
        )
        if result != mavlink.MAV_RESULT_ACCEPTED and command in self.reasons:
            self._later(now + 0.5, self._text, *self.reasons[command])

    def _carry_out(self, now, command, message):
        if command == mavlink.MAV_CMD_DO_SET_MODE:
            px4 = self.autopilot == modes.PX4
            number = int(message.param2) << 16 | int(message.param3) << 24 if px4 else int(message.param2)
            self._enter(now, modes.name_of(self.autopilot, self.frame, number))
        elif command == mavlink.MAV_CMD_COMPONENT_ARM_DISARM:
            if message.param1 == 1:
                self.armed, self._on_ground = True, self.altitude <= 0
                self._begin(now)
            else:
                self._disarm(now)
            self._later(now + self.lag, self._beat, now + self.lag)
        elif command == mavlink.MAV_CMD_DO_SET_MISSION_CURRENT:
            self._rewind(is_new=False)
        elif command == mavlink.MAV_CMD_SET_MESSAGE_INTERVAL:
            self._streams = True
            if message.param1 == mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT and self.grants_rates:
                self._place_interval = message.param2 / 1e6
        elif command not in (mavlink.MAV_CMD_REQUEST_MESSAGE, mavlink.MAV_CMD_MISSION_START):
            return mavlink.MAV_RESULT_UNSUPPORTED
        return mavlink.MAV_RESULT_ACCEPTED

    # Actions of others

    def pilot(self, now, mode):
        self._advance(now)
        self._enter(now, mode)
        return self._take()

    def failsafe(self, now, text, mode):
        self._advance(now)
        self.status = mavlink.MAV_STATE_CRITICAL
        self._text(mavlink.MAV_SEVERITY_CRITICAL, text)
        self._enter(now, mode)
        return self._take()

    def breach(self, now, mode, kind=mavlink.FENCE_BREACH_BOUNDARY, text=None):
        """Its fence, as ArduPilot reports it: by a message, and copters by a text too."""
        self._advance(now)
        self._out.append(mavlink.MAVLink_fence_status_message(1, 1, kind, 0))
        if text is not None:
            self._text(mavlink.MAV_SEVERITY_NOTICE, text)
        self._enter(now, mode)
        return self._take()

    def disarm(self, now):
        self._advance(now)
        self._disarm(now)
        self._beat(now)
        return self._take()

    def kill(self, now):
        """Its motors are stopped: it falls, and claims the ground at once, as ArduCopter does."""
        self._advance(now)
        self._falls = now, self.altitude
        self._disarm(now)
        self._beat(now)
        return self._take()

    def restart(self, now, away=2.0):
        """Its autopilot restarts, and is heard again `away` seconds later. It sends what it is asked for."""
        self._advance(now)
        self._falls = now, self.altitude
        self.armed, self._on_ground, self._soon = False, True, []
        self.mode, self.state, self.current = self._first_mode(), mavlink.MISSION_STATE_NOT_STARTED, 0
        self._booted, self._silent_until, self._streams = now, now + away, False
        self._place_interval = 1.0

    def _text(self, severity, text):
        self._out.append(mavlink.MAVLink_statustext_message(severity, text.encode()))

    def _disarm(self, now):
        self.armed = False
        if self.autopilot == modes.ARDUPILOT and self.frame == "copter":
            # Its mission goes back to the first item, and is called active; it claims the ground, at any height.
            self._on_ground = True
            if self.state == mavlink.MISSION_STATE_ACTIVE:
                self.current, self._waits_until, self._jumps = self._first, None, {}
                self._later(now + 0.1, self._news)
            self._later(now + 0.2, self._tell_ground)

    # Its mission

    @property
    def _first(self):
        return 0 if self.autopilot == modes.PX4 else 1

    def _rewind(self, is_new=True):
        self.current, self._waits_until, self._jumps = self._first, None, {}
        if is_new or self.state != mavlink.MISSION_STATE_ACTIVE:
            there = len(self.items) > self._first
            self.state = mavlink.MISSION_STATE_NOT_STARTED if there else mavlink.MISSION_STATE_NO_MISSION
        self._news()

    def _enter(self, now, mode):
        self.mode = mode
        if mode == self.modes.mission:
            self._begin(now)
        elif self.state == mavlink.MISSION_STATE_ACTIVE:
            self.state = mavlink.MISSION_STATE_PAUSED
        self._later(now + self.lag, self._beat, now + self.lag)

    def _begin(self, now):
        runs = self.armed and self.mode == self.modes.mission and len(self.items) > self._first
        if runs and self.state in (mavlink.MISSION_STATE_NOT_STARTED, mavlink.MISSION_STATE_PAUSED):
            if self.state == mavlink.MISSION_STATE_NOT_STARTED:
                self.began.append((now, len(self.items) - self._first))
            self.state, self._at = mavlink.MISSION_STATE_ACTIVE, now
            self._news()

    def _news(self):
        total = max(0, len(self.items) - self._first)
        state = self.state if self.tells_state else 0
        self._out.append(
            mavlink.MAVLink_mission_current_message(self.current, total if self.tells_state else 0, state)
        )

    def _advance(self, now):
        """Flies on until `now`."""
        if self._at is None:
            self._at = now
        guard = 0
        while self.state == mavlink.MISSION_STATE_ACTIVE and self.armed and guard < 10000:
            guard += 1
            if not self._step(now):
                break
        self._at = now

    def _seconds(self, item):
        """How long an item takes at its place."""
        if item.command == mavlink.MAV_CMD_DO_VTOL_TRANSITION:
            return self.transition if self.autopilot == modes.PX4 else 0.0
        parameter = _SECONDS.get(item.command)
        seconds = getattr(item, parameter) if parameter is not None else 0.0
        return seconds if math.isfinite(seconds) else 0.0

    def _step(self, now):
        """Whether the current item was fulfilled before `now`."""
        item = self.items[self.current]
        if item.command == mavlink.MAV_CMD_DO_JUMP:
            return self._jump(item)
        goal = (item.x / 1e7, item.y / 1e7) if item.command < 80 and (item.x, item.y) != (0, 0) else None
        if item.command == mavlink.MAV_CMD_NAV_RETURN_TO_LAUNCH:
            goal = self.home
        if goal is not None and self._waits_until is None:
            far = geo.distance(self.place, goal)
            takes = far / self.speed
            if self._at + takes > now:
                north, east = geo.offset(self.place, goal)
                share = (now - self._at) * self.speed / far
                self.place = geo.displace(self.place, north * share, east * share)
                return False
            self._at, self.place = self._at + takes, goal
            if not self._descends(item):
                self.altitude, self._on_ground = item.z, item.z <= 0
        if item.command == mavlink.MAV_CMD_NAV_LOITER_UNLIM:
            return False
        seconds = self._seconds(item)
        if self._descends(item):
            seconds = self.altitude / self._sink + 1 if self._waits_until is None else 0
        if self._waits_until is None:
            self._waits_until = self._at + seconds
        if self._waits_until > now:
            if self._descends(item):
                self.altitude = min(self.altitude, max(0.0, (self._waits_until - 1 - now) * self._sink))
            return False
        self._at, self._waits_until = max(self._at, self._waits_until), None
        self._fulfilled(item)
        return True

    @property
    def _sink(self):
        return self.lands_at * self.pace

    def _descends(self, item):
        lands = item.command in (mavlink.MAV_CMD_NAV_LAND, mavlink.MAV_CMD_NAV_RETURN_TO_LAUNCH)
        return lands and self.frame == "copter"

    def _jump(self, item):
        done = self._jumps.get(self.current, 0)
        if 0 <= item.param2 <= done:
            self._next()
        else:
            self._jumps[self.current] = done + 1
            self.current = int(item.param1)
            self._news()
        return True

    def _fulfilled(self, item):
        if self._descends(item) and self.autopilot == modes.ARDUPILOT:
            # It is disarmed by touching the ground, and never calls the item reached.
            self.altitude = 0.0
            self._text(mavlink.MAV_SEVERITY_INFO, "Disarming motors")
            self._disarm(self._at)
            self._beat(self._at)
            return
        self.reached.append(self.current)
        is_told = item.command <= 95 or item.command in _SECONDS or self.autopilot == modes.PX4
        if self.tells_reached and is_told:
            self._out.append(mavlink.MAVLink_mission_item_reached_message(self.current))
        if self._descends(item):
            self.altitude, self._on_ground, self.armed = 0.0, True, False
        self._next()

    def _next(self):
        if self.current + 1 < len(self.items):
            self.current += 1
        else:
            self.state = mavlink.MISSION_STATE_COMPLETE
            if self.modes.after and self.armed:
                self.mode = self.modes.after[0]
            self._beat(self._at)
        self._news()

    # Reports

    def _beat(self, now):
        main, sub = modes.parameters_of(self.autopilot, self.frame, self.mode)
        custom = main << 16 | sub << 24 if self.autopilot == modes.PX4 else main
        base = mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED | (mavlink.MAV_MODE_FLAG_SAFETY_ARMED if self.armed else 0)
        status = self.status
        if status == mavlink.MAV_STATE_STANDBY and self.armed:
            status = mavlink.MAV_STATE_ACTIVE
        self._out.append(mavlink.MAVLink_heartbeat_message(self.type, self.autopilot, base, custom, status, 3))

    def tick(self, now):
        self._advance(now)
        if self._falls is not None:
            since, height = self._falls
            self.altitude = max(0.0, height - 4.9 * ((now - since) * self.pace) ** 2)
        self._say_due(now)
        if self.silent or now < self._silent_until:
            self._out = []
            return []
        if now - self._beat_at >= 1:
            self._beat_at = now
            self._beat(now)
            if self._streams:
                self._news()
                self._say_place(now)
                self._sense()
        elif self._streams and now - self._placed_at > self._place_interval - 0.001:
            self._say_place(now)
        upload = self._upload
        if upload is not None:
            px4 = self.autopilot == modes.PX4
            if now - upload["heard"] > (5 if px4 else 8):
                self._upload = None
                self._acknowledge(upload["from"], mavlink.MAV_MISSION_OPERATION_CANCELLED)
            elif now - upload["asked"] > (0.25 if px4 else 1.0):
                self._request(now)
        return self._take()

    def _say_place(self, now):
        self._placed_at = now
        latitude, longitude = round(self.place[0] * 1e7), round(self.place[1] * 1e7)
        millimetres = round(self.altitude * 1000)
        moves = self.state == mavlink.MISSION_STATE_ACTIVE and self.armed
        speed = round(self.speed * 100) if moves else 0
        self._out.append(
            mavlink.MAVLink_global_position_int_message(
                round((now - self._booted) * self.pace * 1000) & 0xFFFFFFFF,
                latitude,
                longitude,
                millimetres,
                millimetres,
                speed,
                0,
                self._sinks(now),
                65535,
            )
        )

    def _sense(self):
        self._out += [
            mavlink.MAVLink_sys_status_message(0, 0, 0, 0, 12000, -1, self.battery, 0, 0, 0, 0, 0, 0),
            mavlink.MAVLink_home_position_message(
                round(self.home[0] * 1e7), round(self.home[1] * 1e7), 0, 0, 0, 0, [1, 0, 0, 0], 0, 0, 0
            ),
        ]
        self._tell_ground()

    def _sinks(self, now):
        """Centimetres a second, by its clock."""
        if self.altitude <= 0:
            return 0
        if self._falls is None:
            lands = self.armed and self._waits_until is not None and self._descends(self.items[self.current])
            return round(100 * self._sink / self.pace) if lands else 0
        return round(min(9.8 * (now - self._falls[0]) * self.pace, 300) * 100)

    def _tell_ground(self):
        state = mavlink.MAV_LANDED_STATE_ON_GROUND if self._on_ground else mavlink.MAV_LANDED_STATE_IN_AIR
        self._out.append(mavlink.MAVLink_extended_sys_state_message(0, state))
