"""CYCLE83 and CYCLE830: what is drilled, and that no rapid meets what is not."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.control.sinumerik.cycles.table import CYCLES
from tests.control.sinumerik.support import codes, run

TOOLS = {1: {"radius": 3.0, "length": 0.0}}
NAMES = [name.partition(":")[0] for name in CYCLES["CYCLE830"].signature.split()]


def drilled(**values: Any) -> Any:
    """A hole 40 deep from Z0 with CYCLE830."""
    told = {"RTP": 50, "RFP": 0, "SDIS": 2, "DP": -40, "FDEP": -12, "VARI": 1, **values}
    written = ",".join(str(told.get(name, '""' if name in ("S_CON", "S_COFF") else 0)) for name in NAMES)
    return run("G17 G90 G94 T1 D1 M6", "S1000 M3 F100", "G0 X0 Y0 Z50", f"CYCLE830({written})", tools=TOOLS)


def rows(result: Any) -> list[Any]:
    return [row for row in result.rows if row["type"] in ("rapid", "feed") and "to" in row]


LENGTHS = st.floats(0.5, 9.0)


@settings(max_examples=40)
@given(
    st.tuples(*(st.integers(0, most) for most in (3, 1, 1, 1, 2, 1))),
    st.tuples(LENGTHS, LENGTHS, LENGTHS, LENGTHS, LENGTHS),
    st.floats(-30.0, -1.0),
    st.integers(0, 3),
)
def test_no_rapid_goes_where_nothing_is_drilled(
    digits: tuple[int, ...], lengths: tuple[float, ...], first: float, breaks: int
) -> None:
    spot, pilot, even, more, rest = lengths
    result = drilled(
        VARI=sum(digit * 10**place for place, digit in enumerate(digits)),
        FDEP=first, _DAM=-0.8, _MDEP=1, S_FP=300, S_F=120, S_ZA=spot, S_FA=50, S_ZP=pilot, S_FS=40, S_ZS1=even,
        S_ZS2=more, S_N=breaks, S_ZD=rest, S_FD=30, S_FR=400, S_ZPV=0.4,
    )  # fmt: skip
    assert codes(result) == []
    way = rows(result)
    deepest = -pilot if digits[4] == 2 else 0.0
    for row in way:
        z = row["to"]["Z"]
        if row["type"] == "rapid":
            assert z >= deepest - 1e-6
        deepest = min(deepest, z)
    assert deepest == pytest.approx(-40.0)
    assert way[-1]["to"]["Z"] == pytest.approx(50.0)
    through = [row for row in way if row["type"] == "feed" and row["to"]["Z"] == pytest.approx(-40.0)]
    assert through[-1]["feed"] == pytest.approx(36.0 if digits[3] else 120.0)
