# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel, with a file for each part of it, the overlays, and the preferences."""
