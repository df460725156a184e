"""Which counter counts at which M function."""

from __future__ import annotations

import pytest

from tests.control.sinumerik.support import run

NAMES = ("$AC_TOTAL_PARTS", "$AC_ACTUAL_PARTS", "$AC_SPECIAL_PARTS")


@pytest.mark.parametrize(
    ("mode", "counts"),
    [
        (0, (0, 0, 0)),
        (1 << 4, (1, 0, 0)),
        (1 << 8 | 1 << 12, (0, 1, 1)),
        (3 << 4 | 1 << 8, (2, 1, 0)),
    ],
)
def test_counters_go_by_the_bits_of_the_datum(mode: int, counts: tuple[int, int, int]) -> None:
    result = run("M55", "M55", parameters={"$MC_PART_COUNTER": mode, "$MC_PART_COUNTER_MCODE[0]": 55})
    channel = result.channel
    assert tuple(channel.control.read_variable(channel, name) for name in NAMES) == counts


def test_the_end_of_a_subprogram_is_no_part() -> None:
    result = run("%_N_MAIN_MPF", "SUB", "M30", "%_N_SUB_SPF", "M17", parameters={"$MC_PART_COUNTER": 1 << 4})
    channel = result.channel
    assert channel.control.read_variable(channel, NAMES[0]) == 1
