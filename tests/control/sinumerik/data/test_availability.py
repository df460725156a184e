"""Words that variants of the control do without."""

from __future__ import annotations

import tomllib
from typing import get_args, get_type_hints

import pytest

from polycnc.control.sinumerik.data.availability import TABLE, refused
from polycnc.deferred.paths import read_text
from polycnc.machine import schema

GROUPS = tomllib.loads(read_text(TABLE))


def _literals(field: str) -> set[str]:
    """What a machine file may hold there."""
    found, todo = set(), [get_type_hints(schema.MachineTable)[field]]
    while todo:
        hint = todo.pop()
        if isinstance(hint, str):
            found.add(hint)
        todo.extend(get_args(hint))
    return found


def test_machine_files_name_the_variants_and_options_of_the_table() -> None:
    assert _literals("control_variant") == set(GROUPS["variants"])
    assert _literals("control_options") == {each["option"] for each in GROUPS["group"] if "option" in each}


def test_every_option_word_has_an_option() -> None:
    assert all("option" in each for each in GROUPS["group"] if "o" in each["marks"])
    assert all(len(each["marks"]) == len(GROUPS["variants"]) for each in GROUPS["group"])


@pytest.mark.parametrize(
    ("variant", "options", "there", "gone"),
    [
        ("", (), ("CTABDEF", "TRAORI"), ()),
        ("828D PPU280 milling", (), ("TRAORI",), ("CTABDEF", "CSPLINE", "TRANSMIT", "COUPON", "TRAANG")),
        ("828D PPU280 milling", ("splines", "transmit"), ("CSPLINE", "TRANSMIT"), ("COMPCAD", "TRAANG")),
        ("828D PPU280 turning", ("inclined axis",), ("TRAANG",), ("TRAORI", "COUPON", "WAITC")),
        ("828D PPU260 turning", ("inclined axis", "synchronous spindles"), ("COUPON",), ("TRAANG", "WAITC")),
    ],
)
def test_what_a_variant_does_without(
    variant: str, options: tuple[str, ...], there: tuple[str, ...], gone: tuple[str, ...]
) -> None:
    found = refused(variant, options)
    assert not found.intersection(there)
    assert found.issuperset(gone)
