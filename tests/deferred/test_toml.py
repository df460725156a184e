"""Plain TOML is read without the library, and never otherwise than by it."""

from __future__ import annotations

import random
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import polycnc
from polycnc.deferred.toml import loads, plain
from polycnc.machine import documents

SOURCE = Path(polycnc.__file__).parent
SHIPPED = sorted(SOURCE.rglob("*.toml"))
MACHINES = [path.read_text(encoding="utf-8") for path in SHIPPED if path.parent.name == "builtin"]
DOCUMENT = """\
# A comment with "a text" in it
whole = 12
signed = -3
real = -0.5  # mm
"quoted key" = "with, comma = and # sign"
empty = ""
flags = [true, false]
nested = [[1.0], [2.0]]
none = []
name = { en = "Table, turned", zh-TW = "工作台" }

[spindle.1]
rpm = +100

[spindle]
kind = "mill"

[[rule]]
when = "M8 | M9"

[[rule]]
when = "M30"

["hint.not-supported"]
en = "{code}"
"""


def outcome(text: str) -> dict[str, object] | None:
    """What the library reads; None where it refuses."""
    try:
        return tomllib.loads(text)
    except ValueError:  # with those of numbers that `int` refuses
        return None


def test_a_plain_document_is_read() -> None:
    assert plain(DOCUMENT) == tomllib.loads(DOCUMENT)


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.relative_to(SOURCE).as_posix())
def test_files_mean_what_the_library_reads(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert repr(loads(text)) == repr(tomllib.loads(text))


@pytest.mark.parametrize("name", ["family/mill", "family/lathe", "mill3", "lathe2"])
def test_machines_that_come_with_polycnc_are_plain(name: str) -> None:
    assert plain((SOURCE / "machine" / "builtin" / f"{name}.toml").read_text(encoding="utf-8")) is not None


@pytest.mark.parametrize(
    "text",
    [
        "a = 1\na = 2", "[a]\n[a]", "a = 1\n[a]", "[a]\nb = 1\n[a.b]", "[[a]]\n[a]", "[a]\n[[a]]",
        "[[a]]\n[a.b]\nc = 1", "[a.b]\n[[a]]", "a = { b = 1 }\n[a.b]", "a = { b = 1 }\n[a]", "a = { b = 1, b = 2 }",
        "a.b = 1", "a = 01", "a = 1_0", "a = 1e3", "a = .5", "a = 5.", "a = inf", "a = 0x1F", "a = 1979-05-27",
        "a = 'b'", 'a = "b\\n"', 'a = """b"""', 'a = "b" c', 'a = "b', "a =", "= 1", "a", "a = [1,, 2]", "a = [1, 2",
        "a = [1, 2,]", "a = [[1, 2], [3]]", "a = [1], [2]", "a = {}", "a = { b = 1, }", "a = [{ b = 1 }, { c = 2 }]",
        "a = [\n1]", "[a] b = 1", "[a", "[a]]", "[[a]", "[]", "[a.]", "[ a . b ]\nc = 1", "a = 1 # x", 'a = 1 # "x',
        "# a\u0001", 'a = "\u3000"', 'a = "\t"', "a\u00a0= 1", "a = \u0661", "é = 1", "a = 1\r\nb = 2\r\n", "a = 1\r",
        "a = 99999999999999999999", "a = " + "[" * 3000 + "]" * 3000, "- = 1", "a = -", "a = true false", "a = -0.0",
        "a = { b = { c = 1 } }", "a = { b = [1, 2] }", 'a = "b""c"', '"" = 1', "[\"a\".'b']", "a = '\"' # \"",
    ],
)  # fmt: skip
def test_what_is_not_plain_is_the_librarys(text: str) -> None:
    found = plain(text)
    try:
        assert found is None or repr(found) == repr(outcome(text))
    except RecursionError:
        assert found is None


def test_documents_with_mistakes_are_never_plain() -> None:
    """Changed anywhere, a document means what the library reads, or is left to it."""
    chosen = random.Random(7)
    signs = "[]{}\"'#=,.\\\n -+0a_é\t"
    for _ in range(4000):
        text = DOCUMENT
        for _ in range(chosen.randint(1, 3)):
            at = chosen.randrange(len(text))
            text = text[:at] + chosen.choice(("", chosen.choice(signs))) + text[at + chosen.randint(0, 2) :]
        found = plain(text)
        assert found is None or repr(found) == repr(outcome(text)), text


KEYS = st.sampled_from(
    ["a", "b", "1", "-", '"a"', '"b.c"', "'a'", "a.b", '"#"', "é", '""', "a b", '"a=b"', "a . b", '"a".b']
)  # fmt: skip
ATOMS = st.sampled_from(
    [
        "1", "-1", "+1", "01", "-0", "1.5", "-0.0", "1.", ".5", "1e3", "1_0", "999999999999999", "9999999999999999",
        "0.1234567890123", "12345678901.5", "1" * 5000, "inf", "-nan", "true", "false", "True", "1979-05-27",
        "1979-05-27T07:32:00Z", "07:32:00", '"x"', '"x # y"', '"x, y"', '"[x]"', "'x'", "'\"'", '"\\n"', '""',
        '"""x"""', '"""\nx"""', "'''x'''", '"é\u3000"', '"\t"', '"\x7f"', '"\x01"', "\u0661", "²", '"a" "b"',
        '"\U0001f600"', "0x1F", "0b1", "+", "", "1 1", "[", "}", '"', "{}", "[]", "\ufeff1", '"\xa0"', "1\xa0",
    ]
)  # fmt: skip
VALUES = st.recursive(
    ATOMS,
    lambda inner: st.one_of(
        st.tuples(st.lists(inner, max_size=3), st.sampled_from(["[{}]", "[ {} ]", "[{},]", "[\n{}]"])).map(
            lambda made: made[1].format(", ".join(made[0]))
        ),
        st.tuples(
            st.lists(st.tuples(KEYS, inner), max_size=3), st.sampled_from(["{{ {} }}", "{{{}}}", "{{{},}}"])
        ).map(lambda made: made[1].format(", ".join(f"{key} = {value}" for key, value in made[0]))),
    ),
    max_leaves=4,
)
HEADS = st.tuples(
    st.lists(KEYS, min_size=1, max_size=3).map(".".join),
    st.sampled_from(["[{}]", "[[{}]]", "[ {} ]", "[[ {} ]]", "[{}", "[{}]]", "[[{}] ]", "[{}] x"]),
).map(lambda made: made[1].format(made[0]))
LINES = st.tuples(
    st.one_of(HEADS, st.tuples(KEYS, VALUES).map(" = ".join), st.sampled_from(["", "a", "= 1", "\ufeff"])),
    st.sampled_from(["", "", " # x", '# "x', ' # "x"', "# it's", '# "a" = #', " #\t", "#\x01"]),
    st.sampled_from(["\n", "\n", "\n", "\r\n", "\r", " \n", "\t\n", "\n ", "\x0b", "\x85"]),
)


@settings(max_examples=500, deadline=None)
@given(st.lists(LINES.map("".join), max_size=6).map("".join))
def test_documents_of_all_that_toml_has_mean_what_the_library_reads(text: str) -> None:
    found = plain(text)
    assert found is None or repr(found) == repr(outcome(text))


@settings(max_examples=200, deadline=None)
@given(st.data())
def test_mistakes_in_machines_are_told_as_by_the_library(data: st.DataObject) -> None:
    text = data.draw(st.sampled_from(MACHINES))
    lines = text.split("\n")
    at = data.draw(st.integers(0, len(lines) - 1))
    changed = data.draw(
        st.sampled_from([lines[data.draw(st.integers(0, len(lines) - 1))], lines[at] + '"', "[a"])
    )
    text = "\n".join([*lines[:at], changed, *lines[at + data.draw(st.integers(0, 1)) :]])

    def told() -> object:
        try:
            return repr(documents.toml_values(text))
        except documents.DocumentError as error:
            return error.line, error.column, error.message, error.args_by_name

    ours = told()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(documents, "plain", lambda _text: None)
        assert ours == told()


def test_a_plain_run_loads_no_library(tmp_path: Path) -> None:
    file = tmp_path / "O1.nc"
    file.write_text("O1\nG0 X1.\nM30\n", encoding="utf-8")
    asked = (
        "import sys, polycnc\n"
        f"polycnc.run({str(file)!r}, control='fanuc-m', machine='mill3')\n"
        "print([name for name in ('tomllib', 'datetime') if name in sys.modules])"
    )
    told = subprocess.run([sys.executable, "-c", asked], capture_output=True, text=True, check=True)
    assert told.stdout.split() == ["[]"]
