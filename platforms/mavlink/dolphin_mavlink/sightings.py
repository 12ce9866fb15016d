"""Reports about vehicles: the last report of each, and its changes since. Pure."""

from . import geo, modes

MOVE = 5.0  # metres: longer moves are reported within a second, for picks
_PLACE = ("latitude", "longitude")


def _moved(before, place):
    return place is not None and "latitude" in before and geo.distance([before[k] for k in _PLACE], place) >= MOVE


class Sightings:
    """`telemetry`: positions and batteries are wanted every second. `picks`: vehicles may be picked, by distance."""

    def __init__(self, picks=True):
        self._picks = picks
        self._told, self._told_at = {}, {}  # by names
        self.telemetry = False

    def forget(self):
        """An unknown report was refused: the next one about each vehicle has all members."""
        self._told = {}

    def news(self, now, name, vehicle, payload, has_plan, at_once):
        """The next report about a vehicle, or None: links and readiness at once, the rest about once a second."""
        report = {
            "type": modes.TYPES[vehicle.frame],
            "payload": list(payload),
            "link": vehicle.link(now),
            "unready": vehicle.unready(now, has_plan),
        }
        may_be_picked = self._picks and not has_plan
        if may_be_picked:
            report["unready"] = report["unready"] or vehicle.unlocated(now)
        before = self._told.get(name, {})
        moved = may_be_picked and _moved(before, vehicle.place)
        due = now - self._told_at.get(name, -60) >= (1 if self.telemetry or moved else 5)
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
