"""The state of a vehicle, from its messages. Pure: `hear` takes a message and the time."""

import collections
import dataclasses
import math
import re

from . import modes
from .wire import mavlink, version_of

CONFUSED = 60.0  # seconds for which a link is remembered to double or to reorder messages
LINK_SILENCE = 5.0  # seconds without a heartbeat, after which the link counts as lost
MOVE_SILENCE = 10.0  # seconds after which a vehicle may be heard from another address
DEAF = 10.0  # seconds in which a vehicle answers the first requests, over slow links too
UNSIGNED = "signs its messages: --key-file gives the pass phrase by which ours are signed"
HEIGHTS = 10.0  # seconds for which reports of its height are kept
FALL = 3.0  # metres a second: no copter lands as fast
MOVES = 1.5  # metres a second: a vehicle at rest does not sink as fast
CURRENT = 3.0  # seconds for which a position counts as the vehicle's current one: it is asked for once a second
_CLOCK_WRAPS = 2**32 / 1000  # seconds
_DEVICES = {mavlink.MAV_TYPE_CAMERA: "camera", mavlink.MAV_TYPE_GIMBAL: "gimbal", mavlink.MAV_TYPE_WINCH: "winch"}
_DISTRESS = re.compile(
    r"failsafe|battery .*(low|critical)|(low|critical) battery|crash|thrust loss|leak detected|lost manual control"
    r"|heartbeat lost|parachute|dead ?reckon",
    re.IGNORECASE,
)
_FENCE = re.compile(r"fence.*breach|breach.*fence", re.IGNORECASE)
_NO_DISTRESS = re.compile(r"cleared|continuing|restored|resolved|recovered|disabled|\boff$", re.IGNORECASE)
_BREACHES = {
    mavlink.FENCE_BREACH_MINALT: " (minimum altitude)",
    mavlink.FENCE_BREACH_MAXALT: " (maximum altitude)",
    mavlink.FENCE_BREACH_BOUNDARY: " (boundary)",
}
SHOWN = mavlink.MAV_SEVERITY_CRITICAL  # texts as grave as this are shown to people
_UNABLE = {
    mavlink.MAV_STATE_BOOT: "is starting",
    mavlink.MAV_STATE_CALIBRATING: "is calibrating",
    mavlink.MAV_STATE_CRITICAL: "is in failsafe",
    mavlink.MAV_STATE_EMERGENCY: "is in an emergency",
    mavlink.MAV_STATE_POWEROFF: "is switching itself off",
    mavlink.MAV_STATE_FLIGHT_TERMINATION: "terminates its flight",
}


def is_autopilot(heartbeat):
    """Whether a heartbeat is one of a vehicle that plans can be given to."""
    return heartbeat.autopilot in (modes.ARDUPILOT, modes.PX4) and modes.frame_of(heartbeat.type) is not None


class Order:
    """The order in which a component sent its messages, by the numbers in their frames."""

    def __init__(self):
        self._last, self._at = None, -math.inf
        self.confused_at = -math.inf  # when a copy, or an overtaken message, came last

    def is_new(self, now, seq):
        """Whether the message is later than all before it: neither a copy nor one that was overtaken."""
        ahead = 1 if self._last is None or now - self._at > 3 else (seq - self._last) & 0xFF
        if 0 < ahead < 192:
            self._last, self._at = seq, now
            return True
        self.confused_at = now
        return False


@dataclasses.dataclass
class Text:
    at: float
    severity: int
    words: str


@dataclasses.dataclass(frozen=True)
class Height:
    """A report of its height, in metres above home, by its clock."""

    at: float
    height: float
    sinks: float  # metres a second
    armed: bool  # as the last heartbeat before it had it


class Vehicle:
    """`kind` is the autopilot and the frame, for a vehicle whose heartbeats do not have them."""

    def __init__(self, now, address, heartbeat, kind=None):
        self.system, self.component = heartbeat.get_srcSystem(), heartbeat.get_srcComponent()
        self.address = address
        self.version = version_of(heartbeat)
        self.autopilot, self.frame = kind or (heartbeat.autopilot, modes.frame_of(heartbeat.type))
        self._type = heartbeat.type
        self.modes = modes.modes_of(self.autopilot, self.frame)
        self.heard_at = self.first_heard_at = now
        self.mode, self.armed, self.status = None, False, mavlink.MAV_STATE_UNINIT
        self.heartbeats = 0  # how many there were
        self.place = None  # (latitude, longitude)
        self.located_at = -math.inf  # when it was there
        self.armed_from = None  # its place when it was disarmed last: its home, if it does not report another one
        self.altitude = None  # above mean sea level
        self.relative = None  # above home; for submarines above the surface
        self.geoid = None  # height of mean sea level above the ellipsoid, if reported
        self.battery, self.speed, self.home, self.landed = None, None, None, None
        self.heard = {}  # the last time of each kind of message
        self.armed_at = -math.inf  # when a heartbeat last reported it armed
        self.disarmed_at = -math.inf  # when one reported it disarmed for the first time after that
        self.flew_at = -math.inf  # when it last reported that it is in the air
        self.grounded = False  # whether it was on the ground while it was armed
        self.sank_at = -math.inf  # when it last sank faster than a landing, or than a vehicle at rest once disarmed
        self.needs_key = False  # whether it signs its messages, and we have no key
        self.answers = False  # whether it has ever answered us
        self.boot, self.restarted_at = None, -math.inf  # the seconds since its start; when it last started again
        self.current, self.total, self.mission_state = None, None, None
        self.heights = collections.deque()  # reports of its height, of the last HEIGHTS seconds
        self.news = 0  # number of MISSION_CURRENT messages
        self.distress = (-math.inf, "")  # its last text about an emergency, and the time
        self.texts = collections.deque(maxlen=30)  # STATUSTEXT messages, oldest first
        self.to_show = []  # those of them that people are to see
        self._fence, self._breach = (-math.inf, ""), None  # when its fence was breached last, and which one goes on
        self._chunk = None  # where a text in pieces goes on
        self.devices = []
        self.pilot = None  # the mode in which a pilot took it over; until it is given back
        self.hand = None  # what keeps it from the next plan then
        self.idle_mission = False  # its mission has ended, and it is still in that mode
        self._idle_until = -math.inf  # until then the mode of a mission that is over may show for the first time
        self._orders = {}

    @property
    def target(self):
        return self.system, self.component

    @property
    def home_is_item_0(self):
        return self.autopilot == modes.ARDUPILOT

    def finished(self, unseen):
        """Its mission is over. `unseen`: no heartbeat has shown the mode of the mission yet."""
        self.idle_mission = True
        now = max(self.heard.values(), default=self.heard_at)
        self._idle_until = now + LINK_SILENCE if unseen and self.mode != self.modes.mission else -math.inf

    def begins(self, now):
        """Another mission is to begin: of the one before only its mode may be left, now or in the next heartbeat."""
        may_show = self.mode == self.modes.mission or now <= self._idle_until
        self.idle_mission = self.idle_mission and may_show

    def link(self, now):
        return now - self.heard_at <= LINK_SILENCE

    def is_confused(self, now):
        """Whether its link doubles or reorders messages: late copies of orders may then still arrive."""
        order = self._orders.get(self.component)
        return order is not None and now - order.confused_at <= CONFUSED

    def hear(self, now, message):
        """Takes in `message` of this system. Returns whether the autopilot sent it, later than all before it."""
        component = message.get_srcComponent()
        new = self._orders.setdefault(component, Order()).is_new(now, message.get_seq())
        kind = message.get_type()
        if component != self.component:
            if kind == "HEARTBEAT" and message.type in _DEVICES and _DEVICES[message.type] not in self.devices:
                self.devices.append(_DEVICES[message.type])
            return False
        if new:
            self.heard[kind] = now
            self._time(now, message)
            hear = getattr(self, "_" + kind.lower(), None)
            if hear is not None:
                hear(now, message)
        return new

    def _time(self, now, message):
        """Its clock counts from its start."""
        milliseconds = getattr(message, "time_boot_ms", None)
        if milliseconds is None:
            return
        seconds = milliseconds / 1000
        if self.boot is not None and _CLOCK_WRAPS - 3600 > self.boot > seconds + 2:
            self.restarted_at = now
            self.landed, self.grounded = None, False
        self.boot = seconds

    def _heartbeat(self, now, message):
        if message.type != self._type:
            return
        self.heard_at, self.version = now, version_of(message)
        self.heartbeats += 1
        self.needs_key = getattr(message, "needs_key", False)
        mode = modes.name_of(self.autopilot, self.frame, message.custom_mode)
        armed = bool(message.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)
        if not armed or (mode != self.mode and mode in self.modes.given_back and mode != self.pilot):
            self.pilot = None
        if mode != self.mode or not armed:
            still_shows = armed and mode == self.modes.mission and now <= self._idle_until
            self.idle_mission = self.idle_mission and still_shows
        if armed:
            self.armed_at, self.grounded = now, bool(self.landed)
        elif self.disarmed_at <= self.armed_at:
            self.disarmed_at = now
        self.mode, self.armed, self.status = mode, armed, message.system_status

    def _global_position_int(self, now, message):
        self._sink(now, message)
        if (message.lat, message.lon) != (0, 0) and abs(message.lat) <= 900000000 and abs(message.lon) <= 1800000000:
            self.place, self.located_at = (message.lat / 1e7, message.lon / 1e7), now
            if not self.armed:
                self.armed_from = self.place
            self.altitude, self.relative = message.alt / 1000, message.relative_alt / 1000
            self.speed = math.hypot(message.vx, message.vy) / 100

    def _sink(self, now, message):
        report = Height(message.time_boot_ms / 1000, message.relative_alt / 1000, message.vz / 100, self.armed)
        sunk = 0.0
        if self.heights:
            before = self.heights[-1]
            sunk = before.height - report.height - 2 - 2 * abs(report.at - before.at)
        if report.sinks > (FALL if self.armed else MOVES) or sunk > 0:
            self.sank_at = now
        self.heights.append(report)
        while abs(report.at - self.heights[0].at) > HEIGHTS:
            self.heights.popleft()

    def _gps_raw_int(self, now, message):
        if message.alt_ellipsoid != 0 and message.fix_type >= 3:
            geoid = (message.alt_ellipsoid - message.alt) / 1000
            self.geoid = geoid if abs(geoid) < 150 else None

    def _sys_status(self, now, message):
        self._charge(message.battery_remaining)

    def _battery_status(self, now, message):
        if message.id == 0:
            self._charge(message.battery_remaining)

    def _charge(self, percent):
        if 0 <= percent <= 100:
            self.battery = percent / 100

    def _home_position(self, now, message):
        self.home = message.latitude / 1e7, message.longitude / 1e7

    def _extended_sys_state(self, now, message):
        known = message.landed_state != mavlink.MAV_LANDED_STATE_UNDEFINED
        self.landed = message.landed_state == mavlink.MAV_LANDED_STATE_ON_GROUND if known else None
        if self.landed is False:
            self.flew_at, self.grounded = now, False

    def _mission_current(self, now, message):
        self.current, self.news = message.seq, self.news + 1
        self.total = message.total if 0 < message.total < 65535 else None
        self.mission_state = message.mission_state or None

    def _statustext(self, now, message):
        text = message.text if isinstance(message.text, str) else message.text.decode("utf-8", "replace")
        text = re.sub(r"[\x00-\x1f\x7f]+", " ", text)
        before = self._chunk if message.id else None
        if before is not None and before[:2] == (message.id, message.chunk_seq - 1):
            said = before[2]
            said.words = (said.words + text).rstrip()
        else:
            said = Text(now, message.severity, text.strip())
            if not said.words:
                return
            self.texts.append(said)
            if said.severity <= SHOWN:
                self.to_show.append(said)
        self._chunk = (message.id, message.chunk_seq, said) if message.id else None
        if said.severity <= mavlink.MAV_SEVERITY_NOTICE:
            self._judge(now, said.words)

    def _judge(self, now, words):
        """Takes note of an emergency, or of its end, in `words`."""
        if _FENCE.search(words):
            self._fence = (now, self._fence[1] if now - self._fence[0] < 2 else "")
        elif _DISTRESS.search(words):
            if not _NO_DISTRESS.search(words):
                self.distress = (now, words)
            elif self.mode == self.modes.mission:
                self.distress = (-math.inf, "")  # it is over, and the vehicle flies on

    def _fence_status(self, now, message):
        breach = (message.breach_count, message.breach_time, message.breach_type) if message.breach_status else None
        if breach is not None and breach != self._breach:
            self._fence = (now, _BREACHES.get(message.breach_type, ""))
        self._breach = breach  # one that goes on is not a new one

    def breach(self, now, recent):
        """The breach of its fence within the last `recent` seconds, in words, or None."""
        at, kind = self._fence
        return f"fence breach{kind}" if now - at <= recent else None

    def _command_ack(self, now, message):
        self.answers = True

    def is_deaf(self, now):
        """Whether it signs its messages, and has left without an answer all of ours, which are not signed."""
        return self.needs_key and not self.answers and now - self.first_heard_at >= DEAF

    def unlocated(self, now):
        """Why its current position is not known, as a predicate; None if it is."""
        if now - self.located_at < CURRENT:
            return None
        return "has not reported its position" + (" yet" if self.place is None else f" for {CURRENT:g} s")

    def unready(self, now, has_plan):
        """Why the vehicle cannot take a plan although it has a link, as a predicate; None if it can."""
        if has_plan:
            return None
        if self.is_deaf(now):
            return f"does not answer, and {UNSIGNED}"
        if self.status in _UNABLE:
            said_at, text = self.distress
            return _UNABLE[self.status] + (f": {text}" if text and now - said_at < 60 else "")
        if not self.armed:
            return None
        if self.pilot is not None and self.pilot == self.mode and self.hand is not None:
            return self.hand
        if self.pilot is not None or self.mode not in self.modes.hands_off:
            return f"is flown by its pilot in mode {self.mode}"
        if self.mode == self.modes.mission and not self.idle_mission:
            if self.mission_state != mavlink.MISSION_STATE_COMPLETE:
                return f"flies a mission of another station in mode {self.mode}"
        return None
