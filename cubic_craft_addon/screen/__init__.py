# SPDX-License-Identifier: GPL-3.0-or-later
"""Small drawing helpers that import none of our other code."""
