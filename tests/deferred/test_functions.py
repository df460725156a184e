"""Modules that are loaded when a function of theirs is called, and what may be done with what stands for them."""

from __future__ import annotations

import ast
import builtins
import copy
import inspect
import pickle
import subprocess
import sys
import threading
from functools import wraps
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

import polycnc
from polycnc.channel.states.snapshot import Snapshot
from polycnc.deferred.functions import Deferred, loaded_when_called
from polycnc.geometry import vectors as loaded
from polycnc.geometry.frames import Frame as LoadedFrame

with loaded_when_called():
    from polycnc.geometry import frames, vectors
    from polycnc.geometry.frames import Frame

SOURCE = Path(polycnc.__file__).parent
#: An object that stands for a function, without its type.
dot: Any = vectors.dot


def test_a_function_is_called_as_if_it_were_there() -> None:
    assert isinstance(dot, Deferred)
    assert vectors.dot((1.0, 2.0, 3.0), (4.0, 5.0, 6.0)) == loaded.dot((1.0, 2.0, 3.0), (4.0, 5.0, 6.0))
    assert dot.function is loaded.dot


def test_a_function_has_one_that_stands_for_it() -> None:
    with loaded_when_called():
        from polycnc.geometry import vectors as again
    assert again.dot is vectors.dot


def test_what_is_asked_of_a_function_is_answered_by_it() -> None:
    assert (dot.__name__, dot.__qualname__, dot.__module__) == ("dot", "dot", loaded.dot.__module__)
    assert inspect.getdoc(dot) == inspect.getdoc(loaded.dot)
    assert inspect.signature(dot) == inspect.signature(loaded.dot)
    assert dot == loaded.dot
    assert loaded.dot == dot
    assert dot == Deferred("polycnc.geometry.vectors", "dot")
    assert dot != loaded.cross
    assert {loaded.dot: 1}[dot] == 1
    assert pickle.loads(pickle.dumps(dot)) is loaded.dot
    assert repr(dot) == "<polycnc.geometry.vectors.dot, loaded when called>"


def test_a_function_can_be_wrapped_and_bound() -> None:
    @wraps(dot)
    def act(a: Any, b: Any) -> Any:
        return dot(a, b)

    assert act.__doc__ == loaded.dot.__doc__
    assert act.__name__ == "dot"

    class Point(tuple[float, ...]):
        times = dot

    assert Point((1.0, 2.0, 3.0)).times((1.0, 1.0, 1.0)) == 6.0


def test_a_class_makes_objects_and_has_its_methods() -> None:
    made = Frame(t=(1.0, 2.0, 3.0))
    assert isinstance(made, LoadedFrame)
    assert isinstance(frames.Frame(), LoadedFrame)


def test_objects_are_told_by_their_class() -> None:
    assert isinstance(LoadedFrame(), Frame)
    assert not isinstance(1, Frame)


def test_constants_are_not_to_be_had() -> None:
    with pytest.raises(AttributeError, match="IDENTITY is no function"):
        _ = frames.IDENTITY


def test_what_stands_for_a_module_answers_what_the_library_asks() -> None:
    module: Any = vectors
    for same in (copy.copy(module), pickle.loads(pickle.dumps(module)), inspect.unwrap(module)):
        assert same.dot((1.0, 0.0, 0.0), (1.0, 0.0, 0.0)) == 1.0
    assert not hasattr(module, "__file__")


def test_an_error_in_a_module_shows_where_it_is_and_is_found_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "wrong_package").mkdir()
    (tmp_path / "wrong_package" / "__init__.py").touch()
    (tmp_path / "wrong_package" / "wrong.py").write_text("def act(): pass\nHALF = 1 / 0\n", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    act: Any = Deferred("wrong_package.wrong", "act")
    for _ in range(2):
        with pytest.raises(ZeroDivisionError) as error:
            act()
        assert (error.traceback[-1].path, error.traceback[-1].lineno) == (
            tmp_path / "wrong_package" / "wrong.py", 1,
        )  # fmt: skip


def test_two_modules_may_defer_each_other_in_any_thread(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = (
        "from polycnc.deferred.functions import loaded_when_called\n"
        "with loaded_when_called():\n    from mutual_package import {other}\n"
        "def act(left):\n    return {other}.act(left - 1) if left else 'done'\n"
    )
    (tmp_path / "mutual_package").mkdir()
    (tmp_path / "mutual_package" / "__init__.py").touch()
    for name, other in (("one", "another"), ("another", "one")):
        (tmp_path / "mutual_package" / f"{name}.py").write_text(text.format(other=other), encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    done: list[str] = []
    start = threading.Barrier(8)

    def act(name: str) -> None:
        start.wait()
        done.append(Deferred(f"mutual_package.{name}", "act")(5))

    threads = [threading.Thread(target=act, args=[name]) for name in ("one", "another") * 4]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=120)
    assert done == ["done"] * 8


def test_only_names_can_be_imported() -> None:
    with pytest.raises(ImportError), loaded_when_called():
        import json  # noqa: F401
    assert builtins.__import__ is __import__


def test_a_missing_function_is_told_when_it_is_called() -> None:
    with pytest.raises(AttributeError, match="no_such_function"):
        vectors.no_such_function()  # type: ignore[attr-defined]
    vars(vectors).pop("no_such_function")  # other tests copy what stands for the module


def test_other_threads_import_as_ever() -> None:
    found: list[object] = []

    def load() -> None:
        names: dict[str, object] = {"__name__": "elsewhere"}
        exec("from polycnc.geometry import vectors", names)
        found.append(names["vectors"])

    with loaded_when_called():
        thread = threading.Thread(target=load)
        thread.start()
        thread.join()
    assert found == [loaded]


def test_two_threads_may_say_it_at_once() -> None:
    before, found = builtins.__import__, []

    def load() -> None:
        names: dict[str, Any] = {"__name__": "elsewhere", "loaded_when_called": loaded_when_called}
        exec("with loaded_when_called():\n    from polycnc.geometry import vectors", names)
        found.append(names["vectors"].dot)

    threads = [threading.Thread(target=load) for _ in range(20)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(each is dot for each in found)
    assert len(found) == 20
    assert builtins.__import__ is before


def test_snapshots_pass_over_what_stands_for_a_function() -> None:
    held = {"handler": Deferred("polycnc.geometry.vectors", "dot")}
    snapshot = Snapshot(held)
    held["handler"]((1.0, 0.0, 0.0), (1.0, 0.0, 0.0))
    snapshot.restore()
    assert held["handler"]((1.0, 0.0, 0.0), (1.0, 0.0, 0.0)) == 1.0


def test_nothing_is_loaded_before_it_is_called() -> None:
    probe = (
        "import sys\n"
        "from polycnc.deferred.functions import loaded_when_called\n"
        "with loaded_when_called():\n"
        "    from polycnc.geometry import vectors\n"
        "dot = vectors.dot\n"
        "assert 'polycnc.geometry' not in sys.modules\n"
        "dot((1, 2, 3), (1, 2, 3))\n"
        "assert 'polycnc.geometry.vectors' in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", probe], check=True, timeout=120)


# ---- how modules use it ---------------------------------------------------------------------------------------------


def deferred_names(tree: ast.Module) -> dict[str, str]:
    """The names that a module defers, with what they stand for."""
    found: dict[str, str] = {}
    for node in tree.body:
        if isinstance(node, ast.With) and "loaded_when_called" in ast.unparse(node.items[0].context_expr):
            for each in node.body:
                assert isinstance(each, ast.ImportFrom), "there stand imports alone"
                found |= {alias.asname or alias.name: f"{each.module}.{alias.name}" for alias in each.names}
    return found


DEFERRING = [
    path
    for path in sorted(SOURCE.rglob("*.py"))
    if path.parent.name != "deferred" and "with loaded_when_called():" in path.read_text(encoding="utf-8")
]


def file_of(module: str) -> Path:
    """Where the text of a module is."""
    return SOURCE.parent.joinpath(*module.split(".")).with_suffix(".py")


@pytest.mark.parametrize("path", DEFERRING, ids=lambda path: path.relative_to(SOURCE).as_posix())
def test_what_is_deferred_is_called_or_handed_on(path: Path) -> None:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    parents = {child: node for node in ast.walk(tree) for child in ast.iter_child_nodes(node)}
    names = deferred_names(tree)
    assert names
    for name, target in names.items():
        is_class = not target.rpartition(".")[2].islower()
        module = target.rpartition(".")[0] if is_class else target
        assert file_of(module).exists(), f"{target} is no module, and no class of one"
        defined = definitions(file_of(module))
        if is_class:
            assert defined.get(target.rpartition(".")[2]) is ast.ClassDef, f"{target} is no class"
        for node in ast.walk(tree):
            if not (isinstance(node, ast.Name) and node.id == name) or is_annotation(node, parents):
                continue
            used: ast.AST = node
            if not is_class:
                used = parents[node]
                assert isinstance(used, ast.Attribute), f"line {node.lineno}: {name} itself is used"
                assert isinstance(used.ctx, ast.Load), f"{name}.{used.attr} is set"
                assert used.attr in defined, f"{target}.{used.attr} is no function or class"
                if defined[used.attr] is ast.FunctionDef:
                    assert not isinstance(parents[used], ast.Compare), f"{used.attr} may stand for itself"
                    continue
            parent = parents[used]
            called = parent.value if isinstance(parent, ast.Attribute) else parent
            call = parents[parent] if isinstance(parent, ast.Attribute) else parent
            assert isinstance(call, ast.Call), f"line {node.lineno}: {ast.unparse(parent)}"
            assert call.func is (parent if isinstance(parent, ast.Attribute) else used), ast.unparse(call)
            assert called is not None


@pytest.mark.parametrize("path", DEFERRING, ids=lambda path: path.relative_to(SOURCE).as_posix())
def test_what_is_deferred_is_there_when_it_is_called(path: Path) -> None:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    names = deferred_names(tree)
    for name, target in names.items():
        place, _, of = target.rpartition(".")
        stands_for = import_module(target) if of.islower() else getattr(import_module(place), of)
        for node in ast.walk(tree):
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == name:
                assert callable(getattr(stands_for, node.attr)), f"{target}.{node.attr}"


def definitions(path: Path) -> dict[str, type[ast.AST]]:
    """Functions and classes at the top of a module; what it imports counts as functions."""
    found: dict[str, type[ast.AST]] = {}
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            found[node.name] = type(node)
    return found


def is_annotation(node: ast.AST, parents: dict[ast.AST, ast.AST]) -> bool:
    """Whether a name stands in an annotation, which nobody evaluates."""
    while node in parents:
        parent = parents[node]
        if isinstance(parent, ast.arg | ast.AnnAssign) and parent.annotation is node:
            return True
        if isinstance(parent, ast.FunctionDef) and parent.returns is node:
            return True
        node = parent
    return False


# ---- retained memory ------------------------------------------------------------------------------------------------

#: Which modules belong to a control, by the beginnings of their names.
FAMILIES = {
    "sinumerik-840d": ("control.sinumerik", "language.sinumerik"),
    "fanuc-0i-tf": ("control.fanuc.lathe", "control.word_address"),
    "fanuc-m": ("control.fanuc.milling", "control.word_address"),
    "meldas-m": ("control.meldas", "control.word_address"),
    "syntec-mill": ("control.syntec", "control.word_address"),
}


@pytest.mark.parametrize("control_id", FAMILIES)
def test_a_control_loads_all_classes_that_files_of_its_memory_name(control_id: str) -> None:
    encoding = {
        ".".join(path.relative_to(SOURCE.parent).with_suffix("").parts)
        for path in SOURCE.rglob("*.py")
        if "import encoded" in path.read_text(encoding="utf-8")
    }
    own = {
        name
        for name in encoding
        if name.startswith(tuple(f"polycnc.{each}" for each in FAMILIES[control_id]))
    }
    probe = f"import sys\nfrom polycnc.control.registry import control\ncontrol({control_id!r})\nprint(*sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", probe], check=True, capture_output=True, text=True, timeout=120
    )
    assert own <= set(done.stdout.split())
