"""What FANUC and MELDAS machining centres share beyond the word-address base."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from polycnc.compensation.policy import Policy
from polycnc.control.word_address.auxiliary.interlocks import guarded, guarded_motion, unlisted
from polycnc.control.word_address.block import settled
from polycnc.control.word_address.block.codes import MCode
from polycnc.control.word_address.macro_b.custom_macro import CustomMacroControl
from polycnc.control.word_address.macro_b.parameter_input import plan_parameter_block
from polycnc.control.word_address.motion import corners, nurbs
from polycnc.control.word_address.motion.line_by_angle import plan_line_by_angle
from polycnc.control.word_address.tools.length import renew_length
from polycnc.control.word_address.transformations import normal_line
from polycnc.control.word_address.transformations.tool_center_point import plan_with_direction

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.language.bulk import Condition


CUTTING = frozenset({"G1", "G2", "G3"})
#: Two blocks are read ahead, and a start-up that does not see the next plane motion makes no offset (training manual
#: 3.3.1 D of Hartford machining centres, FANUC and MELDAS).
HARTFORD = Policy(recommand_is_square=True, blind_start_is_square=False)


class MillingControl(CustomMacroControl):
    """A machining centre of the FANUC kind.

    Attributes:
        OVERRUN_PARAMETER: Parameter of each axis with the overrun of G60.
    """

    OVERRUN_PARAMETER: ClassVar[int] = 5440
    settled_codes: ClassVar[Mapping[str, Condition]] = settled.MILLING
    CURVE_BEGINS_AT_TOOL: ClassVar[bool] = True
    POLAR_CODES: ClassVar[frozenset[str]] = CustomMacroControl.POLAR_CODES | {"G90", "G91", "G94", "G95"}
    REFUSED_ON_CYLINDER: ClassVar[frozenset[str]] = CustomMacroControl.REFUSED_ON_CYLINDER | {
        "G51", "G51.1", "G68", "G68.2", "G43.4", "G43.5",
    }  # fmt: skip

    # ---- motion --------------------------------------------------------------------------------------

    def call_by_code(self, builder: Builder, plan: Plan) -> Step | None:
        """Parameter blocks of G10 L50; macro calls."""
        normal_line.check_block(builder)
        return plan_parameter_block(builder, plan) or super().call_by_code(builder, plan)

    def plan_motion(self, builder: Builder, plan: Plan) -> Step | None:
        """The step of the active motion or cycle; under G93 every cutting block needs its own F."""
        mode = builder.mode
        if mode["feed"] == "G93" and mode["motion"] in CUTTING and plan.axis_words and not builder.has("F"):
            raise self.fail("inverse_time_feed", address=mode["motion"])
        step = self._straight_words(builder, plan) or super().plan_motion(builder, plan)
        leaves_curve = builder.before["motion"] == "G6.2" != mode["motion"]
        step = nurbs.then(step) if leaves_curve else step
        return step and guarded_motion(step, builder, plan)

    def _straight_words(self, builder: Builder, plan: Plan) -> Step | None:
        """The step of a straight block that tells its end otherwise: by an angle, or by the direction of the tool."""
        if builder.mode["cycle"] != "G80":
            return None
        return plan_line_by_angle(builder, plan) or plan_with_direction(builder, plan)

    def spiral_tolerance(self, channel: Channel) -> float:
        """What an arc takes up on its way; beyond it, where a parameter allows that, the rest is straight."""
        limit, delivered = self.arc_tolerance(channel), self.ARC_TOLERANCE_PARAMETER[1]
        return min(limit, delivered) if limit > 0.0 else delivered

    def plan_corner(self, builder: Builder) -> Step | None:
        """What ,R and ,C ask for."""
        return corners.plan_corner_words(builder)

    def scale_factors(self, channel: Channel, words: Words) -> tuple[float, float, float]:
        """Factors of G51: P for all axes, or I J K; without a point in units of 5400#7."""
        unit = 0.001 if channel.setup.parameters.bit(5400, 7) else 0.00001
        if "P" in words:
            factor = self._factor(words, "P", unit)
            return (factor, factor, factor)
        given = [self._factor(words, letter, unit) if letter in words else 1.0 for letter in "IJK"]
        return (given[0], given[1], given[2])

    def _factor(self, words: Words, letter: str, unit: float) -> float:
        value = words.typed(letter) or 0.0
        factor = value * unit if words.form(letter) == "" else value
        if factor == 0.0 or abs(factor) >= 10_000:
            raise self.fail("scale", address=letter)
        return factor

    # ---- machine -------------------------------------------------------------------------------------

    def m_row(self, builder: Builder, number: int) -> MCode:
        """The row of an M code behind the machine's interlocks; of several in a block only the last acts."""
        if number != builder.m_codes[-1] and not self.several_m_codes(builder.channel):
            return MCode(number, silent=True)
        row = super().m_row(builder, number)
        channel = builder.channel
        named = number in channel.machine.m_functions or number in self.code_calls(channel).m
        if named and number not in self.m_codes:
            return row  # whoever names the code has given it a meaning
        if number in self.m_codes or row.silent or self.plc.knows(f"M{number}"):
            return guarded(row, self.plc)
        return unlisted(row, self.plc)

    def several_m_codes(self, _channel: Channel) -> bool:
        """Whether a block may hold several M codes (Hartford manual 2.3.3: the last one counts)."""
        return False

    # ---- offsets -------------------------------------------------------------------------------------

    def compensation_policy(self, _channel: Channel) -> Policy:
        """Rules of radius compensation."""
        return HARTFORD

    def overrun(self, channel: Channel, axis: int) -> float:
        """How far and on which side G60 positions past the target of an axis, mm (sign: last direction)."""
        return channel.setup.parameters.number(self.OVERRUN_PARAMETER, channel.axes[axis])

    def measuring(self, channel: Channel, _words: Words) -> tuple[float, float, float]:
        """G37: way before the target at feed (6251), allowed difference (6254), feed (6241)."""
        number = channel.setup.parameters.number
        name = channel.axes[channel.coordinates.geometry[2]]
        return number(6251, name), number(6254, name), number(6241, name) / 60.0

    def note_length(self, channel: Channel, number: int, change: float) -> None:
        """Add a measured difference to a length offset."""
        channel.memory.offset_number(number).length += change
        renew_length(channel)
