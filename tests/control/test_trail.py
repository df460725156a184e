"""From a code to what it does: every handler of a G table says in its docstring which codes it is for."""

from __future__ import annotations

import inspect
import re
from functools import partial
from typing import TYPE_CHECKING

import pytest

from polycnc.control.fanuc.lathe.codes import g_table
from polycnc.control.registry import control

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.control.word_address.block.codes import GCode

_CODE = r"G(\d+(?:\.\d+)?)"


def table(control_id: str) -> Mapping[str, GCode]:
    if control_id == "fanuc-0i-tf":
        return g_table("A", circular_thread=True, grinding=True, series_15=True, balance=True)
    codes: Mapping[str, GCode] = vars(type(control(control_id)))["g_codes"]
    return codes


def names(told: str, code: str) -> bool:
    number = float(
        code[1:].split(maxsplit=1)[0]
    )  # the lathe tells two meanings of a code apart by a word behind it
    spans = re.findall(rf"{_CODE}(?: to |, …, | … ){_CODE}", told)
    return any(float(one) == number for one in re.findall(_CODE, told)) or any(
        float(first) <= number <= float(last) for first, last in spans
    )


@pytest.mark.parametrize("control_id", ["fanuc-m", "meldas-m", "syntec-mill", "fanuc-0i-tf"])
def test_every_handler_names_its_code(control_id: str) -> None:
    silent = []
    for row in table(control_id).values():
        act = row.handler or row.planner
        while isinstance(act, partial):
            act = act.func
        if act is None or row.not_yet:
            continue
        if not names(inspect.getdoc(act) or "", row.code):
            silent.append(f"{row.code} {act.__module__}.{act.__qualname__}")
    assert silent == []
