# SPDX-License-Identifier: GPL-3.0-or-later
"""Values of a setting that are worth trying; new settings have theirs from their declaration."""


def values(setting):
    """Return the choices or the ends of a `Setting`, and what is usual, which is the first."""
    usual = setting.default
    if setting.choices:
        return [usual, *(each[0] for each in setting.choices if each[0] != usual)]
    if not isinstance(usual, tuple):
        return [usual, *(each for each in _numbers(setting, usual) if each != usual)]
    others = [each for each in _numbers(setting, usual[0]) if each != usual[0]]
    return [usual, *((each, *usual[1:]) for each in others), *((each,) * 3 for each in others)]


def _numbers(setting, usual):
    if isinstance(usual, bool):
        return (False, True)
    return (
        () if isinstance(usual, str) else sorted({*(setting.limits or ()), *(setting.soft or ())})
    )
