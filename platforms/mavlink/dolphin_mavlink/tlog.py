"""Telemetry logs of ground stations (`.tlog`): 8 bytes of microseconds since 1970 before each frame. Pure."""

from .wire import frame_size, mavlink

STAMP = 8
# Time stamps lie between 2000 and 2100.
_EARLIEST, _LATEST = 946684800 * 10**6, 4102444800 * 10**6
_MARKERS = (mavlink.PROTOCOL_MARKER_V1, mavlink.PROTOCOL_MARKER_V2)


class Unreadable(Exception):
    """Why it is not such a log; a text for people."""


def _record(data, at):
    """The seconds since 1970 and the frame of the record at `at`; None if it is not one."""
    stamp = int.from_bytes(data[at : at + STAMP], "big")
    frame = at + STAMP
    if not _EARLIEST <= stamp <= _LATEST or frame >= len(data) or data[frame] not in _MARKERS:
        return None
    size = frame_size(data, frame)
    if size is None or frame + size > len(data):
        return None
    return stamp / 1e6, data[frame : frame + size]


def read(data):
    """The records of a log, each (seconds since 1970, frame), and the number of bytes outside of them."""
    records, at, left_out = [], 0, 0
    while at < len(data):
        record = _record(data, at)
        if record is None:
            at, left_out = at + 1, left_out + 1
        else:
            records.append(record)
            at += STAMP + len(record[1])
    if not records:
        raise Unreadable(
            "not a telemetry log: no time stamp before a MAVLink frame was found"
            if data
            else "not a telemetry log: the file is empty"
        )
    return records, left_out
