# SPDX-License-Identifier: GPL-3.0-or-later
"""A hook of MkDocs: formulas become MathML when the site is built.

Browsers show MathML by themselves, so that the site needs no script for it and no network.
"""

import html
import re

from latex2mathml.converter import convert  # pyright: ignore[reportMissingImports]

_MARKED = re.compile(r'<(span|div) class="arithmatex">\\[(\[](.*?)\\[)\]]</\1>', re.DOTALL)


def on_page_content(content, **_):
    """Turn what Arithmatex has marked as LaTeX into MathML."""
    return _MARKED.sub(_mathml, content)


def _mathml(match):
    tag, latex = match.groups()
    is_block = tag == "div"
    formula = convert(html.unescape(latex).strip(), display="block" if is_block else "inline")
    return f'<div class="formula">{formula}</div>' if is_block else formula
