"""Local frames: metres from an origin in WGS 84."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Tuple

_RADIUS, _FLATTENING = 6378137.0, 1 / 298.257223563
_SQUARE = _FLATTENING * (2 - _FLATTENING)


@dataclass(frozen=True)
class Origin:
    """The origin of a map: its place, and the heading of its x axis in degrees from north, clockwise. ROS has x to the
    east, which is heading 90."""

    latitude: float
    longitude: float
    height: float = 0.0
    heading: float = 90.0

    def locate(self, x: float, y: float) -> Tuple[float, float]:
        """Latitude and longitude of a point of the map; y is 90 degrees to the left of x. Flat: a kilometre away the
        error is below a metre.

        >>> north, east = Origin(41.0, -8.0).locate(0.0, 111.0)
        >>> round(north, 5), round(east, 5)
        (41.001, -8.0)
        """
        heading = math.radians(self.heading)
        north = x * math.cos(heading) + y * math.sin(heading)
        east = x * math.sin(heading) - y * math.cos(heading)
        sine = math.sin(math.radians(self.latitude))
        under = 1 - _SQUARE * sine * sine
        meridian, normal = _RADIUS * (1 - _SQUARE) / under**1.5, _RADIUS / math.sqrt(under)
        latitude = self.latitude + math.degrees(north / meridian)
        longitude = self.longitude + math.degrees(east / (normal * math.cos(math.radians(self.latitude))))
        return latitude, (longitude + 540.0) % 360.0 - 180.0
