"""Rules of features that concern few blocks, as rows: what a feature then does is loaded when a block concerns it.

As a G table does, a row names functions of the feature's module. Rules of what every program uses stand in the
feature's module.
"""

from __future__ import annotations

from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.coordinates.tip import TIP_CODES
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.word_address.block.plan import Builder

with loaded_when_called():
    from polycnc.control.word_address.macro_b import macro_calls, parameter_input
    from polycnc.control.word_address.motion import corners, line_by_angle, nurbs
    from polycnc.control.word_address.tools import look_ahead
    from polycnc.control.word_address.transformations import (
        cylinder,
        normal_line,
        polar_interpolation,
        tool_center_point,
        workpiece,
    )

#: What must not stand in blocks while the axis follows the path.
NORMAL_LINE = Rule("normal line control", unless={"normal_line": "G40.1"}, check=normal_line.check_block)
#: Between G10 L50 and G11 blocks are parameters.
PARAMETER_INPUT = Rule(
    "input of parameters", unless={"data_input": "G11"}, replace=parameter_input.plan_parameter_block
)
#: Blocks that G66.1 takes as arguments, and the macro behind blocks that move.
MODAL_CALLS = Rule(
    "modal macro calls",
    modes={"macro": ("G66", "G66.1")},
    replace=macro_calls.plan_argument_block,
    after=macro_calls.plan_modal_call,
    last=macro_calls.plan_following,
)
#: Chamfers and roundings.
CORNERS = Rule("corners", words=(",C", ",R"), corner=corners.plan_corner_words)
#: Straight blocks that tell their end by an angle.
LINES_BY_ANGLE = Rule(
    "lines by angle", words=(",A",), in_cycles=False, motion=line_by_angle.plan_line_by_angle
)
#: What turns of the table do to the work zero.
ZERO_ON_TABLE = Rule(
    "work zero on a rotary table",
    modes={"fixture": ("G54.2",), "workpiece_error": ("G54.4",)},
    before=workpiece.refuse_one_shot,
    motion=workpiece.plan_turning,
    wrap=workpiece.wrap_turning,
    after=workpiece.follow_behind,
)
#: What must not come while words name the tip.
COMPANY_OF_TIP = Rule(
    "company of tool centre point control", modes={"length": TIP_CODES}, check=tool_center_point.check_company
)
#: Straight blocks that name the direction of the tool.
DIRECTION_BY_VECTOR = Rule(
    "tool direction by a vector",
    modes={"length": ("G43.5",)},
    in_cycles=False,
    motion=tool_center_point.plan_with_tip,
)
#: M codes behind which nothing is read.
STOPS = Rule("codes that stop reading", unless={"compensation": "G40"}, after=look_ahead.plan_stop)
#: Moves without a way.
NO_WAY = Rule(
    "moves without a way", unless={"compensation": "G40"}, in_cycles=False, wrap=look_ahead.plan_travel
)
#: A curve is complete when another motion code comes.
CURVES = Rule("NURBS curves", modes={"motion": ("G6.2",)}, wrap=nurbs.close_curve)


def polar(*further: str) -> Rule:
    """What blocks may hold and how they are read in polar coordinate interpolation.

    Args:
        further: G codes that a control allows beside `polar_interpolation.ALLOWED`.
    """

    def check(builder: Builder) -> None:
        polar_interpolation.check_block(builder, further)

    return Rule(
        "polar coordinate interpolation",
        unless={"polar_interpolation": "G13.1"},
        check=check,
        convert=polar_interpolation.length_word,
    )


def unrolled(*further: str) -> Rule:
    """What blocks may hold and how they are read in cylindrical interpolation.

    Args:
        further: G codes that a control refuses beside `cylinder.REFUSED`.
    """

    def check(builder: Builder) -> None:
        cylinder.check_block(builder, further)

    return Rule(
        "cylindrical interpolation", unless={"cylinder": ""}, check=check, convert=cylinder.surface_word
    )
