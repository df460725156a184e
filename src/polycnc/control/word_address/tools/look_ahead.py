"""Blocks behind which nothing is read before they have run: what radius compensation holds back ends square there.

A control that compensates reads ahead to find where two paths meet. Codes that stop reading (FANUC: M00, M01, M02,
M30 and those of 3411 to 3432; "suppressed buffering", 0i-TF Plus II.5.4.3) leave the last move, that of their own block
or the one in front, without the next one, however many blocks are read otherwise (19625). A move without a way does so
too (II.5.2.5, example 5).
"""

from __future__ import annotations

from polycnc.control.word_address.tools.radius import active_compensation
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk import declare, declared

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.family import WordAddressChannel

LINES = frozenset({"G0", "G1"})


def end_square(channel: WordAddressChannel, _values: list[float] | None = None) -> None:
    """What is compensated so far ends square on itself."""
    stage = active_compensation(channel)
    if stage is not None:
        stage.end_square()


def plan_stop(builder: Builder, _plan: Plan) -> Step | None:
    """A block that stops reading: what moves in it, or else the block in front, ends square."""
    stops = any(builder.control.stops_reading(builder.channel, code) for code in builder.m_codes)
    return end_square if stops else None


def plan_travel(builder: Builder, plan: Plan, step: Step | None) -> Step | None:
    """A straight block whose axis words give no way: the block in front ends square on itself."""
    if step is None or not plan.axis_words or builder.mode["motion"] not in LINES:
        return step
    if builder.mode["compensation"] == "G40":
        return step

    def run(channel: WordAddressChannel, values: list[float]) -> None:
        before = channel.coordinates.position[:]
        step(channel, values)
        if channel.coordinates.position == before:
            end_square(channel)

    # A block without a way is none that the scanner hands to compensation, so a run of blocks does as `step` says.
    return declare(run, declared(step))
