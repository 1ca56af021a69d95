# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures of the paper, made with our tool."""
