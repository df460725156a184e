"""Rules of SYNTEC, as rows: its own, and those of all word-address controls."""

from __future__ import annotations

from polycnc.control.syntec import cycles
from polycnc.control.syntec.axis_groups import borrowing, names
from polycnc.control.syntec.macros import calls, interrupts
from polycnc.control.syntec.motion import arcs, moves, rotary_ways
from polycnc.control.word_address import rules
from polycnc.control.word_address.auxiliary.interlocks import MOVES_RULE
from polycnc.control.word_address.block import whole_numbers
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.coordinates import frames
from polycnc.control.word_address.coordinates.tip import TIP_CODES
from polycnc.control.word_address.cycles import drilling
from polycnc.control.word_address.tools.radius import SIDES
from polycnc.deferred.functions import loaded_when_called

with loaded_when_called():
    from polycnc.control.syntec.five_axes import posture, spatial, tip_control
    from polycnc.control.syntec.motion import oscillation, polar
    from polycnc.control.word_address.transformations import polar_interpolation

RULES = (
    rotary_ways.RULE,
    Rule(
        "polar interpolation",
        unless={"polar_interpolation": "G13.1"},
        check=polar.check_block,
        convert=polar_interpolation.length_word,
    ),
    frames.ROTATION_RULE,
    rules.NORMAL_LINE,
    Rule("oscillation", unless={"oscillation": "G80.2"}, check=oscillation.check_block),
    Rule("spatial radius compensation", modes={"compensation": SIDES}, check=spatial.check_block),
    calls.RULE,
    names.RULE,
    moves.LEAD_RULE,
    whole_numbers.RULE,
    rules.CORNERS,
    rules.LINES_BY_ANGLE,
    Rule("company of tool tip control", modes={"length": TIP_CODES}, check=tip_control.check_company),
    Rule(
        "tool direction in a turned work system",
        modes={"posture": ("work",)},
        motion=posture.plan_posture,
        wrap=posture.wrap_posture,
    ),
    Rule("tool direction by a vector", modes={"length": ("G43.5",)}, motion=tip_control.plan_with_direction),
    drilling.RULE,
    cycles.OVERLAP_RULE,
    cycles.RULE,
    borrowing.RULE,
    moves.INVERSE_TIME_RULE,
    interrupts.RULE,
    arcs.RULE,
    calls.MODAL_RULE,
    MOVES_RULE,
)
