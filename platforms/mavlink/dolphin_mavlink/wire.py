"""MAVLink's frames as messages, and back. Pure: the time is an argument.

The messages are pymavlink's, of its dialect `ardupilotmega`, which contains `common`; here it is called `mavlink`.
"""

import hashlib

from pymavlink.dialects.v20 import ardupilotmega as mavlink

SIGNATURE = 13
SIGNED = 0x01
# Signatures count units of 10 microseconds since 2015-01-01, in seconds since 1970.
SIGNING_EPOCH = 1420070400


_AUTOPILOTS = (mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA, mavlink.MAV_AUTOPILOT_PX4)


class _Codec(mavlink.MAVLink):
    """pymavlink's codec. It would take the timestamp of a forged signature for the stream's latest, and refuse the true
    ones after it; here only a signature that is right moves the stream on. `doubt`: why the last frame with a right
    checksum was not believed; None if it was, or is a copy."""

    doubt = None

    def check_signature(self, msgbuf, srcSystem, srcComponent):
        right = hashlib.sha256(self.signing.secret_key + bytes(msgbuf[:-6])).digest()[:6]
        if right != bytes(msgbuf[-6:]):
            self.doubt = "signed with another key"
            return False
        is_known = (msgbuf[-13], srcSystem, srcComponent) in self.signing.stream_timestamps
        believed = super().check_signature(msgbuf, srcSystem, srcComponent)
        self.doubt = None if believed or is_known else "signed by a clock that is more than a minute behind ours"
        return believed

    def unsigned(self, number):
        """Whether a message may come without a right signature."""
        return False


class Wire:
    """One end of MAVLink links: our numbers, our counter of frames, and the key if one is given."""

    def __init__(self, system, component, key=None):
        self._codec = _Codec(None, srcSystem=system, srcComponent=component)
        self._has_key, self._doubts = key is not None, {}
        if key is not None:
            self._codec.signing.allow_unsigned_callback = _Codec.unsigned
            self._codec.signing.secret_key = hashlib.sha256(key.encode()).digest()
            self._codec.signing.sign_outgoing = True

    def set_date(self, date):
        """Signatures are stamped with `date`, in seconds since 1970, unless one had a later stamp."""
        signing = self._codec.signing
        signing.timestamp = max(signing.timestamp, int((date - SIGNING_EPOCH) * 1e5))

    def encode(self, message, version=2):
        """The frame of `message`, as MAVLink 1 or 2."""
        frame = message.pack(self._codec, force_mavlink1=version == 1)
        self._codec.seq = (self._codec.seq + 1) % 256
        return frame

    def decode(self, data):
        """The messages in `data`, a datagram or a piece of a stream, and the bytes after the last whole frame. What is
        no frame, has a wrong checksum or signature, or is no message of the dialect, is passed over."""
        messages, at = [], 0
        while at < len(data):
            if data[at] not in (mavlink.PROTOCOL_MARKER_V1, mavlink.PROTOCOL_MARKER_V2):
                at += 1
                continue
            size = frame_size(data, at)
            if size is None or at + size > len(data):
                # Perhaps the rest is still to come, perhaps a stray byte looks like a frame's first.
                break
            message = self._message(data[at : at + size])
            if message is None:
                at += 1
            else:
                messages.append(message)
                at += size
        return messages, bytes(data[at:])

    def decode_datagram(self, data):
        """The messages in `data`, of which nothing is still to come."""
        messages = []
        while data:
            found, rest = self.decode(data)
            messages += found
            data = rest[1:]
        return messages

    def take_doubts(self):
        """By systems that seem to be vehicles: why their messages are not believed, since this was asked last."""
        doubts, self._doubts = self._doubts, {}
        return doubts

    def _message(self, frame):
        if frame[0] == mavlink.PROTOCOL_MARKER_V2 and frame[2] & ~SIGNED:
            return None
        rejected = self._codec.signing.reject_count
        self._codec.doubt = "not signed"
        try:
            message = self._codec.decode(bytearray(frame))
        except (mavlink.MAVError, ValueError, TypeError):
            if self._codec.signing.reject_count > rejected:
                self._doubt(frame)
            return None
        if message.get_msgId() < 0 or message.get_type().startswith("UNKNOWN"):
            return None
        message.needs_key = not self._has_key and frame[0] == mavlink.PROTOCOL_MARKER_V2 and bool(frame[2] & SIGNED)
        return message

    def _doubt(self, frame):
        is_2 = frame[0] == mavlink.PROTOCOL_MARKER_V2
        system, number, payload = (frame[5], frame[7:10], frame[10:]) if is_2 else (frame[3], frame[5:6], frame[6:])
        is_vehicle = not any(number) and len(payload) > 5 and payload[5] in _AUTOPILOTS
        if is_vehicle and self._codec.doubt is not None:
            self._doubts[system] = self._codec.doubt


def frame_size(data, at):
    """How long the frame at `at` is, or None if its header is not there yet."""
    if at + 3 > len(data):
        return None
    if data[at] == mavlink.PROTOCOL_MARKER_V1:
        return data[at + 1] + 8
    return data[at + 1] + 12 + (SIGNATURE if data[at + 2] & SIGNED else 0)


def version_of(message):
    """1 or 2: the version of MAVLink that `message` came in."""
    buffer = message.get_msgbuf()
    return 1 if buffer and buffer[0] == mavlink.PROTOCOL_MARKER_V1 else 2
