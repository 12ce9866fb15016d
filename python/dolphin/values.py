"""Values of programs, and their JSON: that of suppliers, of inputs on the socket, and of events in journals."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, Mapping, Sequence, Tuple


@dataclass(frozen=True)
class Position:
    """A position in WGS 84: degrees, and metres above the ellipsoid."""

    latitude: float
    longitude: float
    height: float = 0.0


@dataclass(frozen=True)
class Circle:
    """An area around a position, with its radius in metres."""

    centre: Position
    radius: float


@dataclass(frozen=True)
class Area:
    """An area with corners. Its rims turn to the left, those of holes to the right."""

    rims: Tuple[Tuple[Position, ...], ...]


@dataclass(frozen=True)
class Task:
    """The plan that vehicles know by this name."""

    name: str


@dataclass(frozen=True)
class Vehicles:
    """A set of vehicles, by their identifiers."""

    names: Tuple[str, ...]


@dataclass(frozen=True)
class Reference:
    """An object of a supplier, by the name that the supplier chose."""

    name: str


def to_json(value: Any) -> Any:
    """The JSON of a value.

    >>> to_json([Position(41.18, -8.7), Task("survey1"), {"depth": 3}])
    [{'latitude': 41.18, 'longitude': -8.7, 'height': 0.0}, {'task': 'survey1'}, {'map': {'depth': 3}}]
    """
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    if isinstance(value, Position):
        return {"latitude": value.latitude, "longitude": value.longitude, "height": value.height}
    if isinstance(value, Circle):
        return {"centre": to_json(value.centre), "radius": value.radius}
    if isinstance(value, Area):
        return {"rims": [[to_json(corner) for corner in rim] for rim in value.rims]}
    if isinstance(value, Task):
        return {"task": value.name}
    if isinstance(value, Vehicles):
        return {"vehicles": list(value.names)}
    if isinstance(value, Reference):
        return {"object": value.name}
    if isinstance(value, Mapping):
        return {"map": {_key(key): to_json(item) for key, item in value.items()}}
    if isinstance(value, Sequence) or isinstance(value, (set, frozenset)):
        return [to_json(item) for item in value]
    raise TypeError(f"a {type(value).__name__} is not a value of programs")


def from_json(json: Any) -> Any:
    """The value that JSON stands for: `from_json(to_json(x)) == x`, but for tuples and sets, which become lists.

    >>> from_json({"latitude": 41.18, "longitude": -8.7})
    Position(latitude=41.18, longitude=-8.7, height=0.0)
    """
    if isinstance(json, list):
        return [from_json(item) for item in json]
    if not isinstance(json, dict):
        return json
    members = set(json)
    if {"latitude", "longitude"} <= members <= {"latitude", "longitude", "height"}:
        return Position(json["latitude"], json["longitude"], json.get("height", 0.0))
    if members == {"centre", "radius"}:
        return Circle(from_json(json["centre"]), json["radius"])
    if members == {"rims"}:
        return Area(tuple(tuple(from_json(corner) for corner in rim) for rim in json["rims"]))
    if members == {"task"}:
        return Task(json["task"])
    if members == {"vehicles"}:
        return Vehicles(tuple(json["vehicles"]))
    if members == {"object"}:
        return Reference(json["object"])
    if members == {"map"} and isinstance(json["map"], dict):
        return _map(json["map"])
    return _map(json)


def _map(json: Dict[str, Any]) -> Dict[str, Any]:
    return {key: from_json(item) for key, item in json.items()}


def _key(key: Any) -> str:
    if not isinstance(key, str):
        raise TypeError(f"keys of maps are texts, and {key!r} is not")
    return key
