# SPDX-License-Identifier: GPL-3.0-or-later
import pytest
from taichi_marks import needs_taichi


@pytest.fixture(params=["numpy", pytest.param("cpu", marks=needs_taichi)])
def device(request):
    """Run a test with either backend."""
    return request.param
