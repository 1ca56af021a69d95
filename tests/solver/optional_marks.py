# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of tests that need a package which the solver can do without."""

import pytest

from solver.optional_packages import optional_package


def needs(name):
    """Skip a test where a package is missing."""
    return pytest.mark.skipif(optional_package(name) is None, reason=f"no {name}")
