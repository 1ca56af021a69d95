# SPDX-License-Identifier: GPL-3.0-or-later
"""Read what ``--handles`` names: a JSON list of handles, checked without Blender."""

import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .errors import InputError

__all__ = ("GivenHandle", "read_handles")

KINDS = ("group", "vertices", "box")
"""what says which vertices belong to a handle; exactly one of them"""

Point = tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class GivenHandle:
    """A handle as the file has it; lengths and coordinates are those of the object."""

    where: str
    """file and number of the handle, for messages"""
    group: str | None = None
    vertices: tuple[int, ...] | None = None
    box: tuple[Point, Point] | None = None
    """lowest and highest corner"""
    threshold: float = 0.5
    """least weight in the group"""
    translate: Point = (0.0, 0.0, 0.0)
    rotate: Point = (0.0, 0.0, 0.0)
    """degrees about x, then y, then z"""
    scale: Point = (1.0, 1.0, 1.0)
    pivot: Point | None = None
    """where it is turned and scaled about; None is the middle of its bounding box"""
    cubic: bool = False
    """whether its surface becomes cubic, and only its place and rotation are held"""


def read_handles(path: Path) -> list[GivenHandle]:
    """Read and check the file.

    Raises
    ------
    InputError
        Naming the file, the handle by its number from 1, and what is wrong.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise InputError(f"--handles {path}: there is no such file; check the path") from None
    except OSError as error:
        raise InputError(f"--handles {path}: cannot be read ({error.strerror})") from None
    except (ValueError, RecursionError) as error:
        raise InputError(f"--handles {path}: is not JSON ({error})") from None
    if not isinstance(content, list):
        raise InputError(f"--handles {path}: must be a list of handles, [{{...}}, ...]")
    return [
        _handle(entry, f"--handles {path}: handle {number}")
        for number, entry in enumerate(content, start=1)
    ]


def _handle(entry: Any, where: str) -> GivenHandle:
    if not isinstance(entry, dict):
        raise InputError(f'{where}: must be an object such as {{"group": "ear"}}')
    for key in entry:
        if key not in _READERS:
            raise InputError(f"{where}: unknown key {key!r}; known are {', '.join(_READERS)}")
    if sum(kind in entry for kind in KINDS) != 1:
        raise InputError(f"{where}: give one of {', '.join(KINDS)}")
    if "threshold" in entry and "group" not in entry:
        raise InputError(f"{where}: a threshold goes with a group only")
    values = {key: _READERS[key](value, f"{where}: {key}") for key, value in entry.items()}
    return GivenHandle(where=where, **values)


def _name(value: Any, what: str) -> str:
    if not isinstance(value, str) or not value:
        raise InputError(f"{what} must be the name of a vertex group")
    return value


def _indices(value: Any, what: str) -> tuple[int, ...]:
    is_list = isinstance(value, list) and value
    if not is_list or any(type(number) is not int or number < 0 for number in value):
        raise InputError(f"{what} must be a list of whole numbers, the first vertex is 0")
    return tuple(value)


def _number(value: Any, what: str) -> float:
    if type(value) not in (int, float) or not math.isfinite(value):
        raise InputError(f"{what} must be a finite number, not {_shown(value)}")
    return float(value)


def _point(value: Any, what: str) -> Point:
    if not isinstance(value, list) or len(value) != 3:
        raise InputError(f"{what} must be three numbers, not {_shown(value)}")
    x, y, z = (_number(number, what) for number in value)
    return x, y, z


def _flag(value: Any, what: str) -> bool:
    if not isinstance(value, bool):
        raise InputError(f"{what} must be true or false, not {_shown(value)}")
    return value


def _scale(value: Any, what: str) -> Point:
    scale = _point(value if isinstance(value, list) else [_number(value, what)] * 3, what)
    if not all(scale):
        raise InputError(f"{what} must not be zero")
    return scale


def _box(value: Any, what: str) -> tuple[Point, Point]:
    if not isinstance(value, list) or len(value) != 2:
        raise InputError(f"{what} must be two corners, [[x, y, z], [x, y, z]]")
    low, high = (_point(corner, what) for corner in value)
    if any(a > b for a, b in zip(low, high, strict=True)):
        raise InputError(f"{what} must have its lowest corner first")
    return low, high


def _threshold(value: Any, what: str) -> float:
    number = _number(value, what)
    if not 0.0 <= number <= 1.0:
        raise InputError(f"{what} must lie between 0 and 1, not {number:g}")
    return number


def _shown(value: Any) -> str:
    text = json.dumps(value)
    return text if len(text) <= 40 else f"{text[:37]}..."


_READERS: dict[str, Callable[[Any, str], Any]] = {
    "group": _name,
    "vertices": _indices,
    "box": _box,
    "threshold": _threshold,
    "translate": _point,
    "rotate": _point,
    "scale": _scale,
    "pivot": _point,
    "cubic": _flag,
}
