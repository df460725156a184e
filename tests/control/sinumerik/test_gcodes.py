"""The table of G groups: numbers, order, start values."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc.control.sinumerik import gcodes
from polycnc.control.sinumerik.block.plan import BLOCK_MOTIONS, MOTIONS
from polycnc.control.sinumerik.frames.codes import FRAME_CODES
from polycnc.session import open_session

if TYPE_CHECKING:
    from pathlib import Path


def test_every_function_belongs_to_one_group() -> None:
    words = [word for group in gcodes.GROUPS for word in group.words if word != "-"]
    assert len(words) == len(set(words))


def test_groups_have_their_published_numbers() -> None:
    numbers = [group.number for group in gcodes.GROUPS]
    assert numbers == sorted(set(range(1, 62)) - {5, 58})


@pytest.mark.parametrize(
    ("code", "group", "number"),
    [
        ("G1", 1, 2),
        ("CT", 1, 15),
        ("G35", 1, 17),
        ("G19", 6, 3),
        ("G505", 8, 6),
        ("G599", 8, 100),
        ("G645", 10, 7),
        ("G710", 13, 4),
        ("G973", 15, 13),
        ("DRIVE", 21, 3),
        ("WALCS10", 60, 11),
    ],
)
def test_a_function_has_its_number_in_its_group(code: str, group: int, number: int) -> None:
    assert gcodes.GROUP_OF[code].number == group
    assert gcodes.number_of(code) == number


def test_start_values_are_members_of_their_groups() -> None:
    assert all(group.start in group.words for group in gcodes.GROUPS if group.is_modal)


def test_every_motion_and_frame_function_is_executed_or_says_that_it_is_not() -> None:
    for name, executed in (("motion", MOTIONS), ("block_motion", BLOCK_MOTIONS), ("frame", FRAME_CODES)):
        for code in gcodes.BY_NAME[name].words:
            assert code == "-" or (code in executed) != (code in gcodes.NOT_EXECUTED), code


def test_what_is_not_executed_exists() -> None:
    assert set(gcodes.GROUP_OF) >= gcodes.NOT_EXECUTED
    assert not gcodes.NOT_EXECUTED & set(gcodes.START_CODES.values())


def test_the_codes_of_an_exact_stop_say_which_window_it_waits_for(tmp_path: Path) -> None:
    machine = tmp_path / "settling.toml"
    machine.write_text('base = "mill3"\nsettle_fine_s = 10\nsettle_coarse_s = 1\n', encoding="utf-8")
    program = "G1 G60 X10 F5000\nG602 X20\nG603 X30\nG64 X40\nG601 G9 X50\nM30\n"

    def seconds(machine: str | Path) -> float:
        return open_session(program, control="sinumerik-840d", machine=machine).run().plan.total_s

    assert seconds(machine) - seconds("mill3") == pytest.approx(10 + 1 + 0 + 0 + 10)
