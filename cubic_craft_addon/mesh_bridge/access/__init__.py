# SPDX-License-Identifier: GPL-3.0-or-later
"""The data of a mesh as arrays and back, whatever its purpose."""
