"""Words that are whole numbers: codes, tools, offsets, programs, counts, times of P (Hartford manual 2.4.1).

Which addresses these are is told by the control, and by a code's row where the code takes a length or a factor in such
an address (`reals`). The words of a macro call are arguments and may be any numbers. A value from an expression is
rounded to a whole number, halves away from zero (FANUC macro B reference 2.1).
"""

from __future__ import annotations

from enum import Enum

from polycnc.control.word_address.block.rules import Rule
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk import Idle, declare
from polycnc.language.word_address.functions import round_half_away
from polycnc.language.word_address.words import FORMS, code_key, is_fixed_code

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.family import WordAddressChannel

#: Whole numbers on every control of the FANUC kind, beside M and N.
ADDRESSES = frozenset("DHLOPST")


class DecimalPoint(Enum):
    """What a decimal point in a whole number does."""

    REFUSED = "an alarm"
    CUT = "the fraction is dropped"
    READ_OVER = "nothing, where nothing but zeros follows; else an alarm"


def plan_whole_numbers(builder: Builder, _plan: Plan) -> Step | None:
    """Where words are not written as whole numbers: the step that runs the block with the whole numbers instead."""
    if _calls_macro(builder):
        return None
    control, addresses = builder.control, _whole(builder)
    signature: list[str] = []
    #: Place in the signature, index of the value, whether it is an M code.
    changed: list[tuple[int, int, bool]] = []
    slot = 0
    for key in builder.signature:
        if is_fixed_code(key):
            if key[0] == "M" and "." in key:
                key = _code_without_point(builder, key)
            signature.append(key)
            continue
        address = key.rstrip(FORMS)
        if address in addresses and key != address and '"' not in key:
            if key[-1] != "#" and control.POINT_IN_WHOLE_NUMBERS is not DecimalPoint.CUT:
                raise control.fail("point", address=address)
            changed.append((len(signature), slot, address == "M"))
            key = address
        signature.append(key)
        slot += 1
    shape = tuple(signature)
    if shape == builder.signature:
        return None

    def run(channel: WordAddressChannel, values: list[float]) -> None:
        keys, whole = list(shape), list(values)
        for place, index, is_code in reversed(changed):
            typed = builder.signature[place][-1] != "#"
            whole[index] = float(int(values[index])) if typed else round_half_away(values[index])
            if is_code:
                if whole[index] < 0.0:
                    raise control.fail("minus", address="M")
                keys[place] = code_key("M", f"{whole.pop(index):g}")
        following = tuple(keys)
        plan = channel.mode.plans.get(following)
        (plan or control.plan(channel, following)).run(channel, whole)

    return run


def _calls_macro(builder: Builder) -> bool:
    return any("*" in row.addresses for row in builder.codes)


def _whole(builder: Builder) -> frozenset[str]:
    """The addresses that are whole numbers in a block; none that names an axis."""
    control, channel = builder.control, builder.channel
    reals = {address for row in builder.codes for address in row.reals}
    addresses = control.whole_numbers(channel) - reals
    return frozenset("M").union(
        address for address in addresses if control.axis_of_address(channel, address, builder) is None
    )


def _code_without_point(builder: Builder, key: str) -> str:
    """An M code that was written with a point."""
    whole, _, fraction = key.partition(".")
    point = builder.control.POINT_IN_WHOLE_NUMBERS
    if point is DecimalPoint.REFUSED or (point is DecimalPoint.READ_OVER and fraction.strip("0")):
        raise builder.control.fail("point", address="M")
    return whole


def plan_signs(builder: Builder, _plan: Plan) -> Step | None:
    """A whole number has no sign."""
    if _calls_macro(builder):
        return None
    control = builder.control
    addresses = _whole(builder)
    slots = tuple(
        (slot, address) for address, slot, form in builder.typed if address in addresses and not form
    )
    if not slots:
        return None

    def check(_channel: WordAddressChannel, values: list[float]) -> None:
        for slot, address in slots:
            if values[slot] < 0.0:
                raise control.fail("minus", address=address)

    # Of these words plain blocks have S, P and L, whose own steps leave negative numbers to the interpreter.
    return declare(check, Idle())


#: Behind the rules by which a block calls a macro: those of its words are arguments.
RULE = Rule(
    "whole numbers", words=ADDRESSES | {"M"}, m_codes=True, replace=plan_whole_numbers, before=plan_signs
)
