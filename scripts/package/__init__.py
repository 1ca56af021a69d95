# SPDX-License-Identifier: GPL-3.0-or-later
"""Packages of the extension that hold the wheels it needs, one for each platform and Python."""
