# SPDX-License-Identifier: GPL-3.0-or-later
"""The data that we keep on a mesh: its original and our result, recognized after changes."""
