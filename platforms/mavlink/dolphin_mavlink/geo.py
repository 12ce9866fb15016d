"""Small distances on the WGS 84 ellipsoid. Positions are (latitude, longitude) in degrees, distances in metres."""

import math

_A, _E2 = 6378137.0, 6.69437999014e-3


def _radii(latitude):
    """Of curvature, along the meridian and across it."""
    w = 1 - _E2 * math.sin(math.radians(latitude)) ** 2
    return _A * (1 - _E2) / w**1.5, _A / math.sqrt(w)


def displace(place, north, east):
    latitude, longitude = place
    meridian, across = _radii(latitude)
    latitude_to = latitude + math.degrees(north / meridian)
    longitude_to = longitude + math.degrees(east / (across * math.cos(math.radians(latitude))))
    return latitude_to, (longitude_to + 540) % 360 - 180


def offset(place, other):
    """(north, east) from `place` to `other`."""
    meridian, across = _radii(place[0])
    north = math.radians(other[0] - place[0]) * meridian
    around = (other[1] - place[1] + 540) % 360 - 180
    return north, math.radians(around) * across * math.cos(math.radians(place[0]))


def distance(place, other):
    return math.hypot(*offset(place, other))
