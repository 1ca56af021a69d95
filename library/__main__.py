# SPDX-License-Identifier: GPL-3.0-or-later
"""Run the command as ``python -m cubic_craft``, where the folder of scripts is not on the path."""

import sys

from .command_line import main

sys.exit(main())
