# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of the forms in the panel: the body of each."""
