"""Calls and returns of custom macro B told as data, for the scanner: `M98 P L`, `G65 P L arguments`, `M99`."""

from __future__ import annotations

from polycnc.control.word_address.block.words_as_data import word_as_data
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk import Call, Return, Target, Word

if TYPE_CHECKING:
    from collections.abc import Collection

    from polycnc.control.word_address.block.plan import Arguments, Plan

#: How a whole number is written: without a point, or as a formula.
_WHOLE = ("", "#")


def subprogram(plan: Plan) -> Call | None:
    """M98 with P and L alone."""
    return _call(plan, "M98", "PL", None)


def subprogram_end(plan: Plan) -> Return | None:
    """M99 alone."""
    return Return() if plan.order == ["M99"] else None


def macro(plan: Plan, arguments: Arguments) -> Call | None:
    """G65 with P, L and numbers as arguments."""
    targets = []
    for variable, slot, convert in arguments.typed:
        told = word_as_data(slot, convert)
        if told is None:
            return None
        targets.append(Target(told.slot, told.conversion, variable))
    return None if arguments.fixed else _call(plan, "G65", plan.slots, tuple(targets))


def _call(
    plan: Plan, code: str, addresses: Collection[str], arguments: tuple[Target, ...] | None
) -> Call | None:
    if plan.program_name or "P" not in plan.slots or not set(plan.order) <= {code, *addresses}:
        return None
    if any(plan.slots[address][1] not in _WHOLE for address in "PL" if address in plan.slots):
        return None
    repeats = plan.slots.get("L")
    return Call(Word(plan.slots["P"][0]), None if repeats is None else Word(repeats[0]), arguments)
