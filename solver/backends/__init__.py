# SPDX-License-Identifier: GPL-3.0-or-later
"""The local step on different machinery, behind one interface: see `NumpyLocalStep`."""

from .devices import DEVICES, local_step_class, problem_with_engine
from .engine_choice import engine_name
from .taichi_runtime import set_cache_folder

__all__ = ["DEVICES", "engine_name", "local_step_class", "problem_with_engine", "set_cache_folder"]
