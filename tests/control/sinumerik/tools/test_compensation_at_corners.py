"""Radius compensation that changes between the two moves of a chamfer or rounding."""

from __future__ import annotations

import pytest

import polycnc

SETUP = {"tools": {1: {"radius": 3}, 2: {"radius": 4}}}
HEAD = "T1 D1 G17 G1 F500\n"


def run(*blocks: str) -> polycnc.Result:
    return polycnc.run(HEAD + "\n".join((*blocks, "M30", "")), control="sinumerik-840d", setup=SETUP)


def places(result: polycnc.Result) -> list[tuple[float, float]]:
    moves = [row for row in result.rows if "to" in row]
    return [(row["to"]["X"], row["to"]["Y"]) for row in moves]


@pytest.mark.parametrize("shape", ["RND=8", "CHR=8", "CHF=8"])
@pytest.mark.parametrize("code", ["G40", "G42", "T2", "OFFN=2", "TOFFR=1"])
def test_a_change_of_its_own_block_is_as_one_in_the_second_block(shape: str, code: str) -> None:
    together = run("G41 X20 Y0", f"X40 {shape}", f"{code} Y30", "X60", "G40 X80")
    apart = run("G41 X20 Y0", f"X40 {shape}", code, "Y30", "X60", "G40 X80")
    assert together.alarms == apart.alarms == []
    assert places(together) == places(apart)
    unchanged = places(run("G41 X20 Y0", f"X40 {shape}", "Y30", "X60", "G40 X80"))
    assert places(together)[:2] == unchanged[:2]
    assert places(together) != unchanged


def test_compensation_that_begins_and_changes_before_the_second_move_counts_whole() -> None:
    begun = run("X20 Y0 RND=4", "G41 T2 D1", "Y20", "X0", "G40 Y40")
    alone = run("X20 Y0 RND=4", "T2 D1", "G41 Y20", "X0", "G40 Y40")
    assert begun.alarms == alone.alarms == []
    assert places(begun) == places(alone)
    assert (20, 16) in places(begun)


def test_what_begins_and_ends_before_the_second_move_was_nothing() -> None:
    result = run("X20 Y0 RND=4", "G41", "G40 Y20", "X0")
    assert result.alarms == []
    assert places(result) == places(run("X20 Y0 RND=4", "Y20", "X0"))


def test_without_a_second_move_compensation_ends_all_the_same() -> None:
    result = run("G41 X20 Y0", "X40 RND=8", "G40")
    assert result.alarms == []
    assert places(result)[:2] == [(20, 3), (40, 3)]


@pytest.mark.parametrize("block", ["G18 Y30", "G148 DISR=5 X80 Y30", "STOPRE"])
def test_what_needs_to_know_the_compensation_at_once_is_refused(block: str) -> None:
    result = run("X40 RND=8", "G41", block)
    assert [(alarm.code, alarm.line) for alarm in result.alarms] == [("PC0001", 4)]


def test_cutconon_between_holds_behind_the_shape() -> None:
    result = run("G41 X20 Y0", "X40 RND=8", "CUTCONON Y30", "CUTCONOF X60", "G40 X80")
    assert result.alarms == []
    assert places(result)[:3] == [(20, 3), (32, 3), (37, 8)]
