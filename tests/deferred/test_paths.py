"""Of a path as a text the functions say what `pathlib.Path` says of it."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import polycnc
from polycnc.deferred import paths

if TYPE_CHECKING:
    from collections.abc import Callable

TEXTS = st.lists(
    st.sampled_from(["/", "\\", ".", "..", "a", "B.nc", "é\udcff", ":", "\n", "~", " "]), max_size=7
).map("".join)


@given(TEXTS)
@example("")
@example(".")
@example("//srv/a")
@example("C:a.nc")
def test_a_text_says_what_a_path_says(text: str) -> None:
    path = Path(text)
    assert paths.text_of(text) == paths.text_of(path) == str(path)
    assert paths.parent_of(text) == str(path.parent)
    assert paths.name_of(text) == path.name
    assert paths.stem_of(text) == path.stem
    assert paths.suffix_of(text) == path.suffix


@given(TEXTS, TEXTS)
@example(".", "./a.nc")
@example("..", "a.nc")
def test_a_name_in_a_folder_is_that_of_the_path(folder: str, name: str) -> None:
    assert paths.joined(folder, name) == str(Path(folder) / name)


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a file, a folder, links and a pipe, in which one is."""
    (tmp_path / "file").write_text("é\n", encoding="utf-8")
    (tmp_path / "folder").mkdir()
    if sys.platform != "win32":
        for name, target in (
            ("link", "file"),
            ("dead", "nothing"),
            ("loop", "loop"),
            ("to folder", "folder"),
        ):
            (tmp_path / name).symlink_to(target)
        os.mkfifo(tmp_path / "pipe")
    monkeypatch.chdir(tmp_path)
    return tmp_path


NAMES = [
    "file",
    "folder",
    "link",
    "dead",
    "loop",
    "loop/x",
    "to folder",
    "pipe",
    "none",
    "file/x",
    "file/",
    "folder/.",
    "",
]


@pytest.mark.parametrize("name", [*NAMES, "a\0b", "\udcff"])
@pytest.mark.usefixtures("tree")
def test_what_lies_at_a_path_is_asked_as_the_library_asks(name: str) -> None:
    assert paths.exists(name) is Path(name).exists()
    assert paths.is_file(name) is Path(name).is_file()
    assert paths.is_dir(name) is Path(name).is_dir()


@pytest.mark.parametrize("ask", [paths.exists, paths.is_file, paths.is_dir])
def test_who_may_not_look_hears_of_it(ask: Callable[[str], bool], monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_path: str) -> None:
        raise PermissionError(13, "Permission denied")

    with pytest.raises(OSError, match="long"):
        ask("x" * 5000)
    monkeypatch.setattr(os, "stat", refuse)
    with pytest.raises(PermissionError):
        ask("file")


def test_links_are_followed_to_the_file(tree: Path) -> None:
    for name in ("file", "link", "to folder/../file", "none", ""):
        assert paths.resolved(name) == str(Path(name).resolve())
    assert paths.is_same("file", str(tree / "link"))
    assert not paths.is_same("file", "folder")
    with pytest.raises(FileNotFoundError):
        paths.is_same("file", "none")


@pytest.mark.usefixtures("tree")
def test_a_folder_names_what_lies_in_it() -> None:
    assert paths.names_in("") == sorted(each.name for each in Path().iterdir())
    assert paths.names_in("none") == paths.names_in("file") == []
    assert paths.read_text("file") == "é\n"


def test_what_comes_with_polycnc_lies_beside_its_modules() -> None:
    assert (
        Path(paths.package_path("machine", "builtin"))
        == Path(polycnc.__file__).parent / "machine" / "builtin"
    )
