"""What the build makes: every kernel, in a wheel that says for which platform it is."""

from __future__ import annotations

import ast
import platform
import re
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from build_kernels import compiler, linker, shared_object

from polycnc.kernels import native

if TYPE_CHECKING:
    from build_kernels.hook import KernelHook

    from polycnc.kernels.library import Library

ROOT = Path(__file__).resolve().parents[2]


def test_every_library_of_polycnc_is_compiled() -> None:
    modules = [
        ".".join(file.relative_to(ROOT / "src").with_suffix("").parts)
        for file in sorted((ROOT / "src").rglob("*.py"))
        if re.search(r"^LIBRARY = Library\(", file.read_text(encoding="utf-8"), re.MULTILINE)
    ]
    assert modules == sorted(shared_object.MODULES)


def test_no_two_kernels_have_one_name() -> None:
    names = [name for library in shared_object.libraries() for name in library.names]
    assert len(names) == len(set(names))


def test_no_kernel_raises_to_a_whole_power() -> None:
    """Machine code makes products of it, Python asks `pow`, which rounds otherwise now and then."""
    files = {
        Path(module.__file__ or "") for library in shared_object.libraries() for module in library.modules
    }
    found = [
        f"{file.name}: {ast.unparse(node)}"
        for file in sorted(files)
        for function in ast.parse(file.read_text(encoding="utf-8")).body
        if isinstance(function, ast.FunctionDef)
        for node in ast.walk(function)
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow)
        if isinstance(node.right, ast.Constant) and isinstance(node.right.value, int)
    ]
    assert found == []


def test_only_libraries_whose_sources_have_changed_are_compiled_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    compiled: list[str] = []
    linked: list[list[bytes]] = []

    def code(library: Library, about: bytes) -> bytes:
        compiled.append(library.name)
        return about

    about = {library.name: library.name.encode() for library in shared_object.libraries()}
    monkeypatch.setattr(shared_object, "KEPT", tmp_path / "kept")
    monkeypatch.setattr(shared_object, "described", lambda library: about[library.name])
    monkeypatch.setattr(shared_object, "object_code", code)
    monkeypatch.setattr(
        shared_object, "link", lambda files, _: linked.append([file.read_bytes() for file in files])
    )
    shared_object.make()
    one, *others = compiled
    about[one] = b"changed"
    shared_object.make()
    shared_object.make()
    assert compiled == [one, *others, one]
    assert linked[1:] == [list(about.values())] * 2
    assert len(list((tmp_path / "kept").iterdir())) == len(about)


@pytest.mark.parametrize(("linker_there", "needed"), [("/usr/bin/cc", 1), (None, 2)])
def test_a_linker_is_asked_for_where_there_is_none(
    linker_there: str | None, needed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    hook = made_hook(monkeypatch, linker_there)
    assert len(hook.dependencies()) == needed


def test_a_pure_wheel_can_be_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("POLYCNC_PURE", "1")
    hook = made_hook(monkeypatch, "/usr/bin/cc")
    data: dict[str, object] = {"artifacts": []}
    hook.initialize("standard", data)
    assert hook.dependencies() == []
    assert data == {"artifacts": []}


@pytest.mark.parametrize("error", [OSError("no place"), AttributeError("no place in this Numba")])
def test_a_build_that_fails_gives_a_pure_wheel_and_says_why(
    error: Exception, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails() -> None:
        raise error

    warnings: list[str] = []
    hook = made_hook(monkeypatch, "/usr/bin/cc")
    monkeypatch.setattr(shared_object, "is_current", bool)
    monkeypatch.setattr(shared_object, "make", fails)
    monkeypatch.setattr(hook.app, "display_warning", warnings.append)
    data: dict[str, object] = {"artifacts": []}
    hook.initialize("standard", data)
    assert data == {"artifacts": []}
    assert "no place" in warnings[0]


def test_the_wheel_has_the_object_and_the_tag_of_its_platform(monkeypatch: pytest.MonkeyPatch) -> None:
    hook = made_hook(monkeypatch, "/usr/bin/cc")
    monkeypatch.setattr(shared_object, "is_current", lambda: True)
    data: dict[str, object] = {"artifacts": []}
    hook.initialize("standard", data)
    assert data["artifacts"] == [f"/src/polycnc/kernels/{Path(native.FILE).name}"]
    assert data["pure_python"] is False
    assert re.fullmatch(r"py3-none-\w+", str(data["tag"]))
    assert data["tag"] != "py3-none-any"


def test_without_a_c_compiler_that_of_pypi_links(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(linker, "system_linker", lambda: None)
    assert linker._command() == [sys.executable, "-m", "ziglang", "cc", "-mcpu=baseline"]


def test_windows_gives_the_kernels_the_mathematics_that_python_calls(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The linker for Windows would take other functions, which round otherwise."""
    declared, commands = [], []

    def run(command: list[str | Path], **_: object) -> None:
        commands.append([str(each) for each in command])
        if "dlltool" in command:
            declared.extend(Path(command[command.index("-d") + 1]).read_text(encoding="ascii").split())
        else:
            Path(command[command.index("-o") + 1]).touch()

    monkeypatch.setattr(platform, "system", lambda: "Windows")
    monkeypatch.setattr(subprocess, "run", run)
    linker.link([tmp_path / "0.o"], tmp_path / "compiled.dll")
    assert [command[3] for command in commands] == ["dlltool", "cc"]
    assert commands[1][-1] == commands[0][-1]  # no `-lm`
    assert declared[:2] == ["LIBRARY", "api-ms-win-crt-math-l1-1-0.dll"]
    assert {"sin", "cos", "tan", "pow", "fmod", "atan2", "acos", "asin"} <= {*declared}


@pytest.mark.parametrize(
    ("triple", "wanted"),
    [
        ("x86_64-pc-windows-msvc", "x86_64-pc-windows-itanium"),
        ("x86_64-unknown-linux-gnu", "x86_64-unknown-linux-gnu"),
        ("arm64-apple-darwin23.6.0", "arm64-apple-darwin23.6.0"),
    ],
)
def test_no_object_needs_what_only_the_linker_of_microsoft_has(triple: str, wanted: str) -> None:
    assert compiler._platform(triple) == wanted


def made_hook(monkeypatch: pytest.MonkeyPatch, found: str | None) -> KernelHook:
    """The hook, on a machine with some linker, of a platform that has Numba."""
    pytest.importorskip("hatchling")
    from build_kernels import hook
    from hatchling.bridge.app import Application
    from hatchling.builders.wheel import WheelBuilder

    monkeypatch.setattr(hook, "system_linker", lambda: found)
    monkeypatch.setattr(hook, "_NUMBA_FOR", {(platform.system(), platform.machine())})
    monkeypatch.setattr(platform, "libc_ver", lambda: ("glibc", "2.36"))
    builder = WheelBuilder(str(ROOT))
    return hook.KernelHook(str(ROOT), {}, builder.config, builder.metadata, "", "wheel", Application())
