"""Rules of the lathe, as rows: its own, and those of all word-address controls."""

from __future__ import annotations

from polycnc.control.fanuc.lathe.cycles import drilling, speed_arrival, tapping
from polycnc.control.fanuc.lathe.cycles.modal import CYCLES, FINISHING, GRINDING, READING
from polycnc.control.fanuc.lathe.motion import threads
from polycnc.control.fanuc.lathe.states import BesideState, RetractState
from polycnc.control.fanuc.lathe.tools import offsets
from polycnc.control.word_address import rules
from polycnc.control.word_address.auxiliary.interlocks import MOVES_RULE
from polycnc.control.word_address.block import whole_numbers
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.coordinates.frames import ROTATION_RULE
from polycnc.control.word_address.macro_b import code_calls, interruption
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING

with loaded_when_called():
    from polycnc.control.fanuc.lathe import balance
    from polycnc.control.fanuc.lathe.cycles import intervention, repetitive, shape, single
    from polycnc.control.fanuc.lathe.motion import beside, drawing, retract
    from polycnc.control.fanuc.lathe.tools import data_input, nose_radius

if TYPE_CHECKING:
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder

#: Straight motion.
LINES = frozenset({"G0", "G1"})
#: What this control refuses on an unrolled cylinder beside `cylinder.REFUSED`: threads, measuring, rotation and cycles.
NOT_ON_CYLINDERS = frozenset({
    "G31.8", "G32", "G34", "G35", "G36", "G50", "G50.3", "G53.2", "G68.1",
    "G70", "G71", "G72", "G73", "G74", "G75", "G76", "G90", "G94",
})  # fmt: skip


def _none_moves_beside(channel: LatheChannel) -> bool:
    return not BesideState.of(channel).columns


def _none_retracts(channel: LatheChannel) -> bool:
    return not RetractState.of(channel).ends or "TRESC" not in channel.setup.switches.signals_at


def _none_draws(channel: LatheChannel) -> bool:
    return not channel.memory.parameters.CRD


def _line_words(builder: Builder) -> Step | None:
    """Corners and vectors are words of straight blocks; I, J, K and R of others are an arc's."""
    return nose_radius.plan_line_words(builder) if builder.mode["motion"] in LINES else None


RULES = (
    # A turning cycle begins where the tool was before it was moved by hand.
    Rule(
        "manual intervention and turning cycles",
        modes={"motion": CYCLES},
        codes=frozenset({"G70", "G71", "G72", "G73", "G74", "G75", "G76"}),
        before=intervention.plan_return,
        takes_back=intervention.takes_back,
    ),
    # Axes that move beside the program belong to none of its blocks.
    Rule("axes beside the program", rests=_none_moves_beside, check=beside.check_block),
    # G80 ends them beside the drilling cycle: a rule, so that it does nothing where none moves.
    Rule(
        "end of axes beside the program",
        codes=("G80",),
        rests=_none_moves_beside,
        before=beside.end_by_drilling_code,
    ),
    ROTATION_RULE,
    rules.NORMAL_LINE,
    Rule("input of parameters", unless={"data_input": "G11"}, replace=data_input.plan_parameter_block),
    rules.polar("G98", "G99"),
    rules.unrolled(*NOT_ON_CYLINDERS),
    Rule(
        "company of repetitive cycles",
        codes=frozenset({"G70", "G71", "G72", "G73", "G76"}),
        after=repetitive.check_block,
    ),
    code_calls.RULE,
    rules.MODAL_CALLS,
    whole_numbers.RULE,
    # Corner words, and vectors of the compensation.
    Rule("corners and vectors", words=("C", *"IJKR"), corner=_line_words),
    tapping.WAITING_RULE,
    offsets.WAITING_RULE,
    speed_arrival.RULE,
    drilling.RULE,
    # Single cycles are not rotated.
    Rule("single cycles without rotation", modes={"motion": CYCLES}, in_cycles=False, wrap=single.unrotated),
    # What nose radius compensation makes of straight blocks.
    Rule(
        "nose radius compensation",
        unless={"compensation": "G40"},
        codes=("G39",),
        in_cycles=False,
        wrap=nose_radius.plan_travel,
    ),
    rules.STOPS,
    threads.RULE,
    Rule("tool retract", rests=_none_retracts, in_cycles=False, wrap=retract.with_retract),
    replace(interruption.RULE, wrap=shape.interruptible),
    Rule("balanced cutting", modes={"turret_mirror": ("G68",)}, wrap=balance.together),
    Rule("shapes", modes={"shape": (READING, FINISHING)}, after=shape.plan_note),
    # What makes the control forget the words of a single cycle or of a grinding cycle.
    Rule("words of single cycles", modes={"motion": CYCLES | GRINDING}, after=single.plan_clearing),
    tapping.LEAVING_RULE,
    Rule("drawing dimensions", rests=_none_draws, motion=drawing.plan_line, after=drawing.plan_check),
    MOVES_RULE,
)
