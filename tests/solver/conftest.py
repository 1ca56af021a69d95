# SPDX-License-Identifier: GPL-3.0-or-later
import pytest
from devices import DEVICES
from engine_marks import needs_engine


@pytest.fixture(
    params=[pytest.param(name, marks=() if name == "numpy" else needs_engine) for name in DEVICES]
)
def device(request):
    """Run a test on each device; on a GPU only by `make test-gpu`."""
    return request.param
