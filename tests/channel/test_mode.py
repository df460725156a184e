from __future__ import annotations

from polycnc.channel.mode import ModeTable

START = {"motion": "G0", "plane": "G17"}


def test_equal_modal_states_are_one_object() -> None:
    table = ModeTable()
    mode = table.mode(START)
    there_and_back = mode.with_code("motion", "G1").with_code("motion", "G0")
    assert there_and_back is mode


def test_a_change_of_one_group_leaves_the_others() -> None:
    mode = ModeTable().mode(START).with_codes([("motion", "G2"), ("plane", "G18")])
    assert (mode["motion"], mode["plane"]) == ("G2", "G18")


def test_the_order_of_groups_does_not_make_another_state() -> None:
    table = ModeTable()
    assert table.mode(START) is table.mode(dict(reversed(START.items())))


def test_forgetting_plans_reaches_every_state() -> None:
    table = ModeTable()
    mode = table.mode(START)
    other = mode.with_code("motion", "G1")
    mode.plans["shape"] = other.plans["shape"] = 1
    table.forget_plans()
    assert not mode.plans
    assert not other.plans
