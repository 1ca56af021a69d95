# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures and the table of the paper, made with our tool."""
