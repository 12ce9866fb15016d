"""A mission on its way aboard: uploaded, downloaded, and compared. Pure."""

from . import mission as missions
from .transfer import Download, Upload, numbered

UPLOADS = 5  # transfers tried
SILENCES = 20  # further transfers tried if the vehicle fell silent in the middle of one


class Boarding:
    """`stage` is "upload" or "verify"; the transfer began at `since`. `result` is None during the transfer, "aboard"
    after it, or the reason why the mission is not on board."""

    def __init__(self, vehicle, mission, round_trip):
        self._vehicle, self._mission, self._round_trip = vehicle, mission, round_trip
        self._items = ()  # as they are numbered on board
        self._transfer, self._uploads, self._only_compares = None, 0, False
        self._silences = 0
        self._upload_at = None  # when the next upload begins
        self.stage, self.since, self.result = None, 0.0, None
        self.same_commands = False  # whether the mission on board has the commands of ours

    def upload(self, now):
        v = self._vehicle
        self.stage, self.since, self._uploads, self._upload_at = "upload", now, self._uploads + 1, None
        self._number()
        self._transfer = Upload(v.target, self._items, self._round_trip)
        return self._transfer.begin(now)

    def compare(self, now):
        """Compares the mission on board with ours, without another upload."""
        self._only_compares = True
        self._number()
        return self._verify(now)

    def hear(self, now, message):
        if self._upload_at is not None:
            return []  # an answer to an abandoned upload
        return self._transfer.hear(now, message) + self._transferred(now)

    def tick(self, now):
        if self._upload_at is not None:
            return self.upload(now) if now >= self._upload_at else []
        return self._transfer.tick(now) + self._transferred(now)

    def cancel(self):
        return self._transfer.cancel() if isinstance(self._transfer, Upload) else []

    def _number(self):
        v = self._vehicle
        home = (v.home or v.place or (0.0, 0.0)) if v.home_is_item_0 else None
        self._items = numbered(self._mission.items, home)

    def _verify(self, now):
        self.stage, self.since = "verify", now
        window = 8 if self._vehicle.home_is_item_0 else 1
        self._transfer = Download(self._vehicle.target, self._round_trip, window, most=len(self._items))
        return self._transfer.begin(now)

    def _transferred(self, now):
        if isinstance(self._transfer, Upload):
            return self._uploaded(now)
        if self._transfer.items is not None or self._transfer.refused:
            return self._downloaded(now)
        return []

    def _uploaded(self, now):
        result = self._transfer.result
        if result is None:
            return []
        if isinstance(result, tuple):
            self.result = f"its autopilot refuses the mission: {result[1]}"
            return []
        if result == "silent" and self._silences < SILENCES:
            self._silences, self._uploads = self._silences + 1, self._uploads - 1
        if result in ("again", "silent"):
            return self._again(now, "its autopilot gave up each of the uploads")
        return self._verify(now)

    def _downloaded(self, now):
        kept = self._transfer.items
        self.same_commands = kept is not None and [i.command for i in kept] == [i.command for i in self._items]
        why = self._transfer.refused or self._difference(self._transfer.items)
        if why is None:
            self.result = "aboard"
        elif self._only_compares:
            self.result = f"the mission on board is another one: {why}"
        else:
            return self._again(now, f"the mission is not on board as it was sent: {why}")
        return []

    def _again(self, now, why):
        if self._uploads >= UPLOADS:
            self.result = why
            return []
        self.stage, self._upload_at = "upload", now + self._round_trip.settled
        return []

    def _difference(self, items):
        if len(items) != len(self._items):
            return f"{len(items)} items instead of {len(self._items)}"
        pairs = list(enumerate(zip(self._items, items)))
        for n, (sent, kept) in pairs[1:] if self._vehicle.home_is_item_0 else pairs:
            different = missions.difference(sent, kept)
            if different is not None:
                return f"item {n} has {different}"
        return None
