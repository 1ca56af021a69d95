# SPDX-License-Identifier: GPL-3.0-or-later
"""What is given on the command line, read and checked before Blender is started."""
