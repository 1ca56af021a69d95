# SPDX-License-Identifier: GPL-3.0-or-later
"""Small helpers of all that is drawn; they import nothing of our code."""
