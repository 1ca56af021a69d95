# SPDX-License-Identifier: GPL-3.0-or-later
"""What consists of arrays compares as a whole, and prints in a line.

By themselves, dataclasses would compare arrays element by element, ask for the truth of many
values, and print thousands of numbers.
"""

from collections.abc import Iterable
from dataclasses import fields
from typing import Any, ClassVar, Self

import numpy as np

LONGEST = 8
"""elements of an array that is printed as it is"""


class Value:
    """A base of dataclasses whose fields may be arrays; they have to say ``eq=False, repr=False``.

    Two are equal if they are of the same class and all fields that are compared are, bit for bit.
    """

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return is_same(_compared(self), _compared(other))

    __hash__ = None  # pyright: ignore[reportAssignmentType] - as of all that has arrays

    def __repr__(self) -> str:
        shown = [(each.name, getattr(self, each.name)) for each in fields(self) if each.repr]  # pyright: ignore[reportArgumentType]
        return described(type(self), shown)


class Stored:
    """A base of what leaves out of its stored state what is made anew where that is read.

    A copy shares all of it instead. Two are equal if their stored states are.
    """

    _made_anew: ClassVar[tuple[str, ...]]
    """names of what is left out"""

    def __copy__(self) -> Self:
        other = object.__new__(type(self))
        other.__dict__.update(self.__dict__)
        return other

    def __getstate__(self) -> dict[str, Any]:
        return {name: x for name, x in self.__dict__.items() if name not in self._made_anew}

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, type(self)):
            return NotImplemented
        return is_same(*(sorted(x.__getstate__().items()) for x in (self, other)))

    __hash__ = object.__hash__  # it may change, and is one of many uses of the same arrays


def is_same(one: Any, other: Any) -> bool:
    """Return whether two values are equal: arrays bit for bit, and so for what consists of them."""
    if hasattr(one, "nnz") and hasattr(other, "nnz") and one.shape == other.shape:
        parts = ("data", "indices", "indptr")
        return all(is_same(getattr(one, name), getattr(other, name)) for name in parts)
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        one, other = np.asarray(one), np.asarray(other)
        if one.dtype != other.dtype:
            return False
        return np.array_equal(one, other, equal_nan=one.dtype.kind == "f")
    if isinstance(one, tuple | list) and type(one) is type(other):
        return len(one) == len(other) and all(map(is_same, one, other))
    return bool(one == other)


def described(kind: type, values: Iterable[tuple[str, Any]]) -> str:
    """Return a line that describes an object by the names of its values, and these."""
    return f"{kind.__name__}({', '.join(f'{name}={_short(value)}' for name, value in values)})"


def _compared(value: Any) -> list[Any]:
    return [getattr(value, each.name) for each in fields(value) if each.compare]


def _short(value: Any) -> str:
    if hasattr(value, "nnz") or (isinstance(value, np.ndarray) and value.size > LONGEST):
        return f"<{value.shape} {value.dtype}>"
    if isinstance(value, np.ndarray):
        return repr(value.tolist())
    if isinstance(value, Value):
        return type(value).__name__ + "(...)"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_short, value))}]"
    return repr(value)
