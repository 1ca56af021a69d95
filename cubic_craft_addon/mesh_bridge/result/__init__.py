# SPDX-License-Identifier: GPL-3.0-or-later
"""Results: written, all or nothing, and restored."""
