from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, run


@pytest.mark.parametrize(
    "line",
    ["CTABDEL(5,2)", "CTABLOCK(,3)", 'CTABDEL(1,2,"X")', "CTABUNLOCK(1,2,3,4)", 'R1=CTABSEG("SRAM","Q")'],
)
def test_arguments_that_mean_nothing(line: str) -> None:
    assert codes(run(line)) == [("14020", 1)]


@pytest.mark.parametrize("line", ["R1=CTABSEGID(4)", "R1=CTABPOLID(4)"])
def test_a_table_that_is_not_there(line: str) -> None:
    assert codes(run(line)) == [("16776", 1)]


def test_deleting_what_is_not_there_is_no_mistake() -> None:
    assert codes(run("CTABDEL(4)", "CTABLOCK(4)", "CTABUNLOCK()", "CTABDEL()")) == []
