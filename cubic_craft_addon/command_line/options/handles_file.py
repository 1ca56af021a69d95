# SPDX-License-Identifier: GPL-3.0-or-later
"""Read what ``--handles`` names: a JSON list of handles, checked without Blender."""

import itertools
import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ....solver.console.output import InputError

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

    Raises InputError: naming the file, the handle by its number from 1, and what is wrong.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise InputError(f"--handles {path}: there is no such file; check the path") from None
    except OSError as error:
        raise InputError(f"--handles {path}: cannot be read ({error.strerror})") from None
    except (ValueError, RecursionError) as error:
        raise InputError(f"--handles {path}: is not JSON ({error})") from None
    _check(
        isinstance(content, list), f"--handles {path}: must be a list of handles, [{{...}}, ...]"
    )
    wheres = (f"--handles {path}: handle {number}" for number in itertools.count(1))
    return list(map(_handle, content, wheres))


def _handle(entry: Any, where: str) -> GivenHandle:
    _check(isinstance(entry, dict), f'{where}: must be an object such as {{"group": "ear"}}')
    known = ", ".join(_READERS)
    for key in entry:
        _check(key in _READERS, f"{where}: unknown key {key!r}; known are {known}")
    is_one = sum(kind in entry for kind in KINDS) == 1
    _check(is_one, f"{where}: give one of {', '.join(KINDS)}")
    has_group = "group" in entry or "threshold" not in entry
    _check(has_group, f"{where}: a threshold goes with a group only")
    values = {key: _READERS[key](value, f"{where}: {key}") for key, value in entry.items()}
    return GivenHandle(where=where, **values)


def _check(is_right: object, message: str) -> None:
    if not is_right:
        raise InputError(message)


def _name(value: Any, what: str) -> str:
    _check(isinstance(value, str) and value, f"{what} must be the name of a vertex group")
    return value


def _indices(value: Any, what: str) -> tuple[int, ...]:
    is_right = isinstance(value, list) and value and all(type(n) is int and n >= 0 for n in value)
    _check(is_right, f"{what} must be a list of whole numbers, the first vertex is 0")
    return tuple(value)


def _number(value: Any, what: str) -> float:
    is_right = type(value) in (int, float) and math.isfinite(value)
    _check(is_right, f"{what} must be a finite number, not {_shown(value)}")
    return float(value)


def _point(value: Any, what: str) -> Point:
    is_right = isinstance(value, list) and len(value) == 3
    _check(is_right, f"{what} must be three numbers, not {_shown(value)}")
    x, y, z = (_number(number, what) for number in value)
    return x, y, z


def _flag(value: Any, what: str) -> bool:
    _check(isinstance(value, bool), f"{what} must be true or false, not {_shown(value)}")
    return value


def _scale(value: Any, what: str) -> Point:
    scale = _point(value if isinstance(value, list) else [_number(value, what)] * 3, what)
    _check(all(scale), f"{what} must not be zero")
    return scale


def _box(value: Any, what: str) -> tuple[Point, Point]:
    is_right = isinstance(value, list) and len(value) == 2
    _check(is_right, f"{what} must be two corners, [[x, y, z], [x, y, z]]")
    low, high = (_point(corner, what) for corner in value)
    is_right = all(a <= b for a, b in zip(low, high, strict=True))
    _check(is_right, f"{what} must have its lowest corner first")
    return low, high


def _threshold(value: Any, what: str) -> float:
    number = _number(value, what)
    _check(0.0 <= number <= 1.0, f"{what} must lie between 0 and 1, not {number:g}")
    return number


def _shown(value: Any) -> str:
    text = json.dumps(value)
    return text if len(text) <= 40 else f"{text[:37]}..."


_READERS: dict[str, Callable[[Any, str], Any]] = {
    **{"group": _name, "vertices": _indices, "box": _box, "threshold": _threshold},
    **{"translate": _point, "rotate": _point, "scale": _scale, "pivot": _point, "cubic": _flag},
}
