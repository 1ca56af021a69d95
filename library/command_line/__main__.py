# SPDX-License-Identifier: GPL-3.0-or-later
"""Run the command as ``python -m cubic_craft.command_line``."""

import sys

from .program import main

sys.exit(main())
