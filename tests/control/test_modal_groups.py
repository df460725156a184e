"""Every modal group of a control has its name in one list."""

from __future__ import annotations

import pytest

from polycnc.control import registry
from polycnc.control.modal_groups import MODAL_GROUPS
from polycnc.control.sinumerik import gcodes
from polycnc.control.word_address.control import WordAddressControl


def groups_of(control_id: str) -> set[str]:
    control = registry.control(control_id)
    if isinstance(control, WordAddressControl):
        return {row.group for row in control.g_codes.values() if row.group} | set(control.power_on)
    return {group.name for group in gcodes.GROUPS} | set(gcodes.INTERNAL_CODES)


@pytest.mark.parametrize("control_id", registry.ids())
def test_a_control_names_its_modal_groups_as_the_list_does(control_id: str) -> None:
    assert groups_of(control_id) - set(MODAL_GROUPS) == set()


def test_no_group_of_the_list_is_left_over() -> None:
    assert set(MODAL_GROUPS) == set().union(*map(groups_of, registry.ids()))


def test_what_all_families_decide_has_one_name() -> None:
    shared = set.intersection(*map(groups_of, registry.ids()))
    assert {"motion", "plane", "distance", "unit", "feed", "compensation", "wcs", "path"} <= shared
