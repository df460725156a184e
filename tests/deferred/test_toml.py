"""Plain TOML is read without the library, and never otherwise than by it."""

from __future__ import annotations

import random
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import polycnc
from polycnc.deferred.toml import loads, plain

SOURCE = Path(polycnc.__file__).parent
SHIPPED = sorted(SOURCE.rglob("*.toml"))
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
    except tomllib.TOMLDecodeError:
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
