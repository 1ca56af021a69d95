# SPDX-License-Identifier: GPL-3.0-or-later
import importlib.util

import pytest

from solver.backends.engine_choice import TAICHI, engine

PACKAGE = engine().package
CPU = f"{PACKAGE}-cpu"
"""the name of the device"""
_HAS_ENGINE = importlib.util.find_spec(PACKAGE) is not None

needs_engine = pytest.mark.skipif(not _HAS_ENGINE, reason="neither Taichi nor Quadrants")
needs_taichi = pytest.mark.skipif(
    not _HAS_ENGINE or engine() is not TAICHI, reason="about what only Taichi does"
)
