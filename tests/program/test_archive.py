from __future__ import annotations

from polycnc.program import Form, Program, archive_of, split_programs
from polycnc.program.split import Source


def test_an_archive_brings_programs_back_to_their_directories() -> None:
    main = Program("_N_A_MPF", ("G0 X1", "M30"), directory="/_N_WKS_DIR/_N_T_WPD", form=Form.SINUMERIK)
    sub = Program("_N_B_SPF", ("M17",), directory="/_N_SPF_DIR", form=Form.SINUMERIK)
    text = archive_of((main, sub))
    assert text.startswith("%_N_A_MPF\n;$PATH=/_N_WKS_DIR/_N_T_WPD\n")
    found = split_programs(text.splitlines(), Source("ARCHIVE"), Form.SINUMERIK)
    assert [(p.name, p.directory) for p in found] == [(p.name, p.directory) for p in (main, sub)]
    assert [[line for line in p.lines if line[:1] not in "%;"] for p in found] == [list(main.lines), ["M17"]]
