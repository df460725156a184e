"""`check` tells every mistake of a macro file, not only the first one that the run meets."""

from __future__ import annotations

from polycnc.cli.diagnostics import diagnostics_of
from polycnc.session import open_session

TEXT = "%@MACRO\n#1 := 1\nIF #1 EQ 2 THEN\n  #2 := (3;\nEND_IF;\nWHILE 1 DO\nM30;\n"


def test_all_mistakes_and_missing_semicolons_are_told_once() -> None:
    result = open_session(TEXT, control="syntec-mill").run()
    found = [(d.place.line, d.code, d.severity) for d in diagnostics_of(result, "x.nc")]
    assert found == [
        (3, "COM-003", "error"),
        (4, "COM-003", "error"),
        (6, "COM-018", "error"),
        (2, "unclosed", "warning"),
    ]


def test_a_sound_macro_file_gives_no_finding() -> None:
    result = open_session(
        "%@MACRO\nFOR #1 := 1 TO 2 DO\n  G00 X#1;\nEND_FOR;\nM30;\n", control="syntec-mill"
    ).run()
    assert diagnostics_of(result, "x.nc") == []
