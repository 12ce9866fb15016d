"""What Dolphin was told of each vehicle, and what has changed since. Pure."""

from . import modes


_PLACE = ("latitude", "longitude")


class Sightings:
    """`telemetry`: whether positions and batteries are wanted every second."""

    def __init__(self):
        self._told, self._told_at = {}, {}  # by names
        self.telemetry = False

    def forget(self):
        """A report was refused, and it is not known which: the next one of each vehicle has all members."""
        self._told = {}

    def news(self, now, name, vehicle, payload, has_plan, at_once):
        """What is to be told of a vehicle: links and readiness at once, the rest about once a second. None: nothing."""
        report = {
            "type": modes.TYPES[vehicle.frame],
            "payload": list(payload),
            "link": vehicle.link(now),
            "unready": vehicle.unready(now, has_plan),
        }
        before = self._told.get(name, {})
        due = now - self._told_at.get(name, -60) >= (1 if self.telemetry else 5)
        first = (vehicle.place is not None and "latitude" not in before) or (
            vehicle.battery is not None and before.get("battery") is None
        )
        if not (due or at_once or first or any(before.get(k) != x for k, x in report.items())):
            return None
        self._told_at[name] = now
        if vehicle.place is not None:
            height = (vehicle.altitude or 0.0) + (vehicle.geoid or 0.0)
            report.update(latitude=vehicle.place[0], longitude=vehicle.place[1], height=round(height, 2))
            above = round(vehicle.relative, 2)
            report.update({"depth": 0.0 - above} if vehicle.frame == "sub" else {"altitude": above})
        report.update(battery=vehicle.battery, speed=vehicle.speed)
        changed = {k: x for k, x in report.items() if k not in before or before[k] != x}
        if not changed.keys().isdisjoint(_PLACE):
            changed.update((k, report[k]) for k in _PLACE)  # Dolphin refuses one without the other
        if not changed:
            return None
        self._told[name] = report
        return {"kind": "vehicle", "vehicle": name, **changed}
