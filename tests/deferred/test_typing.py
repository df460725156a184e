"""Names of `typing` that cost nothing: those of the library for a type checker, and never the library at a start."""

from __future__ import annotations

import ast
import subprocess
import sys
import typing
from pathlib import Path
from typing import Any

import pytest

from polycnc.deferred import typing as ours

SRC = Path(ours.__file__).parents[1]
#: Modules whose annotations others evaluate, or which stand for the library here.
OF_LIBRARY = {
    "cases/format.py",
    "deferred/named_tuples.py",
    "deferred/records.py",
    "deferred/regexes.py",
    "deferred/typing.py",
    "machine/schema.py",
    "machine/tables.py",
}


def test_every_name_is_one_of_the_library() -> None:
    names: Any = ours
    for name in set(ours.__all__) - {"is_class_variable"}:
        assert hasattr(typing, name)
        assert hasattr(ours, name)
    assert ours.TypedDict is typing.TypedDict
    with pytest.raises(AttributeError):
        names.Nothing  # noqa: B018


def test_types_with_something_said_of_them() -> None:
    hint: Any = ours.Annotated
    hint = hint[int, "said", 3]
    assert (hint.__origin__, hint.__metadata__) == (int, ("said", 3))


def test_heads_of_classes() -> None:
    names: Any = ours
    kind = names.TypeVar("kind", bound=int)

    class Box(names.Generic[kind]):  # type: ignore[misc]
        """Something with a parameter."""

        __slots__ = ("content",)

    base: Any = Box

    class Full(base[int]):  # type: ignore[misc]
        """It is given."""

        __slots__ = ()

    class Named(names.Protocol):  # type: ignore[misc]
        """It has a name."""

        name: str

    assert Full.__mro__[1:3] == (Box, names.Generic)
    assert not hasattr(Full(), "__dict__")
    assert Named.__mro__[1] is names.Protocol
    assert names.cast("int", "text") == "text"
    assert names.Literal["text"] | int | None is names.Literal
    assert int | names.Literal["text"] is names.Literal


def test_only_what_is_evaluated_imports_the_library() -> None:
    importing = {
        path.relative_to(SRC).as_posix()
        for path in SRC.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_bytes()))
        if (isinstance(node, ast.ImportFrom) and node.module == "typing")
        or (isinstance(node, ast.Import) and any(each.name == "typing" for each in node.names))
    }
    assert importing == OF_LIBRARY


def test_a_run_does_without_the_library(tmp_path: Path) -> None:
    program = tmp_path / "part.nc"
    program.write_text(
        "O1\nG90 G54 G0 X10. Y5.\nG1 Z-1. F100.\nG81 X1. Y2. Z-3. R1. F50.\nG80\nM30\n", "ascii"
    )
    code = (
        "import sys, atexit\n"
        f"sys.argv = ['polycnc', 'run', {str(program)!r}, '--control', 'fanuc-m']\n"
        "from polycnc.cli import main\n"
        "try:\n    main()\nexcept SystemExit:\n    print('typing' in sys.modules)\n"
    )
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert said.stdout.splitlines()[-1] == "False"
