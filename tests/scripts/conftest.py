# SPDX-License-Identifier: GPL-3.0-or-later
"""Inputs of our own making, written once per session."""

import subprocess
import sys
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def inputs(tmp_path_factory):
    """Folder with ``awkward.*``: one mesh in every format that can be read."""
    folder = tmp_path_factory.mktemp("inputs")
    script = Path(__file__).with_name("make_inputs.py")
    subprocess.run([sys.executable, script, folder], check=True, capture_output=True)
    return folder
