# SPDX-License-Identifier: GPL-3.0-or-later
"""What takes too long to be found at each redraw: kept for a few objects until they change."""

from collections.abc import Hashable
from typing import Generic, TypeVar

T = TypeVar("T")

MOST = 2
"""objects of which it is kept: windows may show different scenes"""
_OUTDATED = object()  # no key is equal to it


class Kept(Generic[T]):
    """Something about objects or meshes, by their ``session_uid`` (int)."""

    def __init__(self):
        self._known: dict[int, tuple[Hashable, T]] = {}
        """the key and what was found with it"""

    @property
    def is_empty(self) -> bool:
        """Whether nothing is known that could be forgotten."""
        return not self._known

    def get(self, uid: int, key: Hashable = None) -> T | None:
        """Return what is known, if it was found with this key and nothing has changed since."""
        known = self._known.get(uid)
        return known[1] if known is not None and known[0] == key else None

    def before(self, uid: int) -> T | None:
        """Return what was known last, whatever has changed since."""
        known = self._known.get(uid)
        return None if known is None else known[1]

    def keep(self, uid: int, found: T, key: Hashable = None) -> T:
        """Keep and return what was found, and forget what was kept longest if it is too much.

        The key is what it depends on besides what `has_changed` is called for.
        """
        self._known.pop(uid, None)
        while len(self._known) >= MOST:
            del self._known[next(iter(self._known))]
        self._known[uid] = key, found
        return found

    def has_changed(self, uid: int | None = None) -> None:
        """Have it found again for an object, or for all."""
        for each in self._known if uid is None else {uid} & self._known.keys():
            self._known[each] = _OUTDATED, self._known[each][1]

    def forget(self) -> None:
        """Forget everything."""
        self._known.clear()
