# SPDX-License-Identifier: GPL-3.0-or-later
import importlib.util

import pytest

HAS_TAICHI = importlib.util.find_spec("taichi") is not None

needs_taichi = pytest.mark.skipif(not HAS_TAICHI, reason="no Taichi wheel for this Python")
