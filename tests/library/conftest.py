# SPDX-License-Identifier: GPL-3.0-or-later
"""These tests are about the installed wheel: `make test-wheel` makes the environments for them."""

from importlib.util import find_spec

import pytest

if find_spec("cubic_craft") is None:
    raise pytest.UsageError("cubic_craft is not installed; run make test-wheel")
