"""Pages of the documentation whose first example is run."""

from __future__ import annotations

import re
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

DOCS = Path(__file__).parents[1] / "docs"


def page(name: str) -> str:
    """The text of a page."""
    return (DOCS / name).read_text(encoding="utf-8")


def example(name: str) -> tuple[str, str]:
    """What the first code block of a page prints, and what the page shows in its second one."""
    code, shown = re.findall(r"```(?:python)?\n(.*?)```", page(name), re.DOTALL)[:2]
    printed = StringIO()
    with redirect_stdout(printed):
        exec(compile(code, name, "exec"), {})
    return printed.getvalue(), shown
