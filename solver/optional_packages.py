# SPDX-License-Identifier: GPL-3.0-or-later
"""Optional packages of the solver, imported when they are needed."""

from functools import cache
from importlib import import_module
from typing import Any


@cache
def optional_package(name: str) -> Any:
    """Return the package, or None if it is not there or cannot be imported."""
    try:
        package = import_module(name)
    except Exception:  # a broken installation can raise anything
        return None
    has_code = getattr(package, "__file__", None) is not None  # else a folder that was left behind
    return package if has_code else None
