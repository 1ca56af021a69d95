# SPDX-License-Identifier: GPL-3.0-or-later
"""From loaded objects and options to cubic versions."""
