# SPDX-License-Identifier: GPL-3.0-or-later
import pytest
from devices import DEVICES
from taichi_marks import needs_taichi


@pytest.fixture(
    params=[pytest.param(name, marks=() if name == "numpy" else needs_taichi) for name in DEVICES]
)
def device(request):
    """Run a test on each device; on a GPU only by `make test-gpu`."""
    return request.param
