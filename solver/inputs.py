# SPDX-License-Identifier: GPL-3.0-or-later
"""What a caller gives, as the solver uses it, or one sentence that names it and says what it is.

NumPy would take much of what is meant otherwise: the real parts of complex numbers, numbers in
quotes, and any text as true.
"""

from collections.abc import Sequence
from contextlib import suppress
from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .aliases import BoolArray, FloatArray, IntArray
from .errors import CubicCraftError

T = TypeVar("T")

_REAL = "biuf"  # NumPy's kinds: boolean, integers and floating point


def real_numbers(values: ArrayLike, name: str) -> FloatArray:
    """Return an array of float64, of any shape."""
    found = array_of(values, name)
    # such as fractions; NumPy takes None for NaN
    if found.dtype.kind == "O" and None not in found.ravel().tolist():
        with suppress(TypeError, ValueError):
            found = found.astype(np.float64)
    if found.dtype.kind not in _REAL:
        raise CubicCraftError(f"{name} must be real numbers, not {_kind(values)}")
    return np.asarray(found, dtype=np.float64)


def vectors(values: ArrayLike, name: str) -> FloatArray:
    """Return vectors (k,3); none, or a single one, will do as well."""
    found = real_numbers(values, name)
    if found.size and found.shape[-1:] != (3,):
        raise CubicCraftError(f"{name} must have the shape (k, 3), not {found.shape}")
    return found.reshape(-1, 3)


def matrix_of(values: ArrayLike, name: str) -> FloatArray:
    """Return an affine map as a matrix (4,4) of finite numbers."""
    found = real_numbers(values, name)
    if found.shape not in ((4, 4), (16,)) or not np.isfinite(found).all():
        raise CubicCraftError(f"{name} must be 4x4 finite numbers, row by row")
    return found.reshape(4, 4)


def real_number(value: ArrayLike, name: str) -> float:
    """Return a single number."""
    found = real_numbers(value, name)
    if found.ndim:
        raise CubicCraftError(f"{name} must be one number, not {found.shape}")
    return float(found)


def whole_number(value: Any, name: str, least: int) -> int:
    """Return a single integer of at least so much."""
    number: Any = value
    is_whole = isinstance(value, int | np.integer) and not isinstance(value, bool)
    if not (is_whole and number >= least):
        raise CubicCraftError(
            f"{name} must be a whole number of at least {least}, not {_short(value)}"
        )
    return int(number)


def whole_numbers(values: ArrayLike, name: str) -> IntArray:
    """Return an array of integers, of any shape; one that is empty may be of any type."""
    found = array_of(values, name)
    if found.dtype.kind not in "iu" and found.size:
        raise CubicCraftError(f"{name} must be integers, not {_kind(values)}")
    return found.astype(np.int64, copy=False)


def vertex_numbers(values: ArrayLike, name: str, count: int) -> IntArray:
    """Return the vertices (k,) that are listed by number or by a mask (count,), ascending."""
    found = array_of(values, name)
    if found.dtype.kind == "b":
        return np.flatnonzero(vertex_mask(found, name, count))
    if found.size and found.dtype.kind not in "iu":
        raise CubicCraftError(
            f"{name} must list vertices by number, or be a mask of {count} truth values,"
            f" not be {_kind(values)}"
        )
    numbers = np.unique(found.astype(np.int64))
    if len(numbers) and (numbers[0] < 0 or numbers[-1] >= count):
        raise CubicCraftError(f"{name} vertices must lie between 0 and {count - 1}")
    return numbers


def vertex_mask(values: ArrayLike, name: str, count: int) -> BoolArray:
    """Return a mask (count,) of the vertices."""
    found = array_of(values, name)
    if found.dtype.kind != "b":
        raise CubicCraftError(f"{name} must be a mask of truth values, not {_kind(values)}")
    if found.shape != (count,):
        raise CubicCraftError(
            f"{name} must have one truth value for each of the {count} vertices, not {found.shape}"
        )
    return found


def choices_per_vertex(values: ArrayLike, name: str, count: int, most: int) -> IntArray:
    """Return which of several each vertex has (count,), from 0 to most - 1."""
    found = whole_numbers(values, name)
    if found.shape != (count,):
        raise CubicCraftError(f"{name} must have the shape ({count},), not {found.shape}")
    if found.size and (found.min() < 0 or found.max() >= most):
        raise CubicCraftError(f"{name} must lie between 0 and {most - 1}")
    return found


def switch(value: Any, name: str) -> bool:
    """Return a truth value, and not what Python would take for one."""
    if not isinstance(value, bool | np.bool_):
        raise CubicCraftError(f"{name} must be True or False, not {value!r}")
    return bool(value)  # pyright: ignore[reportUnknownArgumentType]


def instance(value: Any, name: str, kind: type[T]) -> T:
    """Return a value of a class of ours."""
    if not isinstance(value, kind):
        raise CubicCraftError(f"{name} must be of the type {kind.__name__}, not {_kind(value)}")
    return value


def instances(values: Any, name: str, kind: type[T]) -> list[T]:
    """Return one or several values of a class of ours as a list."""
    if isinstance(values, kind):
        return [values]
    several = cast("Sequence[Any]", values)
    if not isinstance(values, Sequence) or isinstance(values, str):
        raise CubicCraftError(f"{name} must be of the type {kind.__name__}, not {_kind(values)}")
    if not len(several):
        raise CubicCraftError(f"{name} must have at least one {kind.__name__}")
    return [instance(value, name, kind) for value in several]


def array_of(values: Any, name: str) -> NDArray[Any]:
    """Return any array, as NumPy makes it."""
    refuse_mask(values, name)
    try:
        return np.asarray(values)
    except ValueError:
        raise CubicCraftError(f"{name} must be an array, whose rows are of one length") from None


def refuse_mask(values: Any, name: str) -> None:
    """Refuse an array of which some values are masked: NumPy would take what lies below."""
    if isinstance(values, np.ma.MaskedArray) and bool(np.any(cast("Any", values).mask)):
        raise CubicCraftError(f"{name} must have no masked values; fill them, as filled() does")


def _short(value: Any) -> str:
    is_number = isinstance(value, bool | int | float | np.generic)
    return f"{value}" if is_number else _kind(value)


def _kind(value: Any) -> str:
    if value is None:
        return "None"
    is_array = isinstance(value, np.ndarray | np.generic | list | tuple)
    kind = np.asarray(cast("Any", value)).dtype if is_array else None
    if isinstance(value, str | bytes) or (kind is not None and kind.kind in "SU"):
        return "text"
    return str(kind) if is_array else type(value).__name__
