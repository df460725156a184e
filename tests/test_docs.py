"""Files and folders that the documentation names are there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").rglob("*.md")])
#: A path in a code span, with a suffix of our files or as a folder; the target of a link.
NAMED = re.compile(r"`([\w./-]+(?:\.(?:py|toml|md|yaml)|/))`|\]\(([^)#:]+)\)")
#: Files of users, as examples.
OF_USERS = {"setup.yaml"}


@pytest.fixture(scope="module")
def ours() -> list[str]:
    """Every file and folder of the project."""
    tops = "src", "tests", "build_kernels", "docs", "examples", "benchmarks"
    inner = [path for top in tops for path in [ROOT / top, *(ROOT / top).rglob("*")]]
    return [f"/{path.relative_to(ROOT).as_posix()}" for path in [*ROOT.iterdir(), *inner]]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_path_that_a_page_names_is_there(page: Path, ours: list[str]) -> None:
    named = {code or link for code, link in NAMED.findall(page.read_text(encoding="utf-8"))} - OF_USERS
    beside = {each for each in named if (page.parent / each).exists()}
    lacking = {
        each for each in named - beside if not any(path.endswith(f"/{each.strip('/')}") for path in ours)
    }
    assert not lacking
