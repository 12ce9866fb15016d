"""Why an autopilot refuses to arm or to go into a mode. Pure.

ArduPilot acknowledges first, and sends the reason in a text within a second after it."""

import re

from .wire import mavlink

REASON = 1.2  # seconds after the acknowledgement in which the reason may come
BEFORE = 3.0  # seconds before it in which it may have come
MOST = 3  # texts that are quoted
_ABOUT_IT = re.compile(r"\b(pre)?arm|\bmode\b|denied|\bauto\b|\bmission\b|reject", re.IGNORECASE)
RESULTS = {
    mavlink.MAV_RESULT_TEMPORARILY_REJECTED: "not now",
    mavlink.MAV_RESULT_DENIED: "denied",
    mavlink.MAV_RESULT_UNSUPPORTED: "not supported",
    mavlink.MAV_RESULT_FAILED: "failed",
}


class Refusal:
    """`what` was refused, with `result`; it was asked for at `asked`."""

    def __init__(self, now, vehicle, what, result, asked):
        self._vehicle, self._what, self._since, self._asked = vehicle, what, now, asked
        self._result = RESULTS.get(result, f"result {result}")

    def is_ripe(self, now):
        """Whether no reason is to be waited for any more."""
        return now - self._since >= REASON

    @property
    def why(self):
        reasons = self._texts(self._asked, mavlink.MAV_SEVERITY_NOTICE)
        reasons = reasons or self._texts(self._since - BEFORE, mavlink.MAV_SEVERITY_WARNING)[-1:]
        return f"{self._what}: {'; '.join(reasons[:MOST]) or self._result}"

    def _texts(self, since, severity):
        found = []
        for text in self._vehicle.texts:
            if text.at >= since and text.severity <= severity and text.words not in found:
                found.append(text.words)
        return [words for words in found if _ABOUT_IT.search(words)] or found
