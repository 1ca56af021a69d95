# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of a session that was cancelled: the next one of the same objects starts there."""

from typing import Any

_Values = dict[str, Any]
_last: tuple[frozenset[int], _Values, _Values] | None = None


def remember(object_uids: list[int], own: _Values, values: _Values) -> None:
    """Remember the settings of a session, and the objects' own with which it began."""
    global _last
    _last = frozenset(object_uids), own, values


def recall(object_uids: list[int], own: _Values) -> _Values | None:
    """Return the remembered settings, None if it was about others or their own have changed."""
    if _last is None or _last[:2] != (frozenset(object_uids), own):
        return None
    return _last[2]
