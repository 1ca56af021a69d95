# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of the presets that come with the extension: a bear in each look."""
