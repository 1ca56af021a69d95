# SPDX-License-Identifier: GPL-3.0-or-later
"""Which way the form lies: found from the shape, for any form."""
