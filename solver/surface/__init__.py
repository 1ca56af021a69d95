# SPDX-License-Identifier: GPL-3.0-or-later
"""What is known of a mesh once, whatever it is turned toward."""
