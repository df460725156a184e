"""Rules of the FANUC machining centre, as rows: its own, and those of all machining centres of its kind."""

from __future__ import annotations

from polycnc.control.word_address import rules
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.coordinates.tip import TIP_CODES
from polycnc.control.word_address.machining_centre import MillingControl
from polycnc.control.word_address.macro_b import interruption
from polycnc.control.word_address.tools.radius import BY_VECTOR, SIDES
from polycnc.deferred.functions import loaded_when_called

with loaded_when_called():
    from polycnc.control.fanuc.milling import five_axes, leading_edge, leaning, standing_system, table_system

RULES = (
    Rule(
        "radius compensation in space",
        modes={"compensation": SIDES},
        check=five_axes.check_block,
        after=five_axes.relax_behind,
    ),
    Rule(
        "points of the table",
        modes={"point_system": ("table",)},
        before=table_system.refuse_apart,
        motion=table_system.plan_direction,
    ),
    Rule("block in which points of the table begin", codes=tuple(SIDES), after=table_system.name_behind),
    Rule(
        "tool direction by a vector in radius compensation in space",
        modes={"compensation": BY_VECTOR},
        motion=five_axes.plan_direction,
    ),
    Rule("leading edge offset", modes={"compensation": ("G41.3",)}, check=leading_edge.check_block),
    # One kind of length compensation in another.
    Rule(
        "kinds of length compensation",
        codes=("G43", "G44", *TIP_CODES),
        check=standing_system.check_lengths,
    ),
    Rule("block in which tip control begins", codes=TIP_CODES, motion=standing_system.plan_start),
    Rule("arcs under tip control", modes={"length": TIP_CODES}, motion=standing_system.refuse_standing_arc),
    # Words while they name the tip in a system that does not turn.
    Rule(
        "tip in a system that stands",
        modes={"tip_system": ("work",)},
        check=standing_system.check_block,
        motion=standing_system.plan_arc,
        wrap=standing_system.keep_plane,
    ),
    # Straight blocks while the tool leans.
    Rule("tool that leans towards its way", modes={"tip_lean": ("Q",)}, motion=leaning.plan_leaning),
    *MillingControl.rules,
    rules.NO_WAY,
    interruption.RULE,
)
