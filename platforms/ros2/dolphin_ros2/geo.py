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

    def _scales(self) -> Tuple[float, float]:
        """Metres of a degree of latitude and of longitude."""
        sine = math.sin(math.radians(self.latitude))
        under = 1 - _SQUARE * sine * sine
        meridian, normal = _RADIUS * (1 - _SQUARE) / under**1.5, _RADIUS / math.sqrt(under)
        return math.radians(meridian), math.radians(normal * math.cos(math.radians(self.latitude)))

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
        northward, eastward = self._scales()
        latitude, longitude = self.latitude + north / northward, self.longitude + east / eastward
        return latitude, (longitude + 540.0) % 360.0 - 180.0

    def metres(self, latitude: float, longitude: float) -> Tuple[float, float]:
        """The point of the map at a latitude and longitude: the inverse of `locate`.

        >>> x, y = Origin(41.0, -8.0).metres(41.001, -8.0)
        >>> round(x), round(y)
        (0, 111)
        """
        northward, eastward = self._scales()
        north = (latitude - self.latitude) * northward
        east = ((longitude - self.longitude + 540.0) % 360.0 - 180.0) * eastward
        heading = math.radians(self.heading)
        return (north * math.cos(heading) + east * math.sin(heading),
                north * math.sin(heading) - east * math.cos(heading))
