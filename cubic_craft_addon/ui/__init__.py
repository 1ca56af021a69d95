# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn: the panel, a file for each part of it, the overlay, and the preferences."""
