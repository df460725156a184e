"""What FANUC and MELDAS machining centres share beyond the word-address base."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from polycnc.compensation.policy import Policy
from polycnc.control.word_address.auxiliary.interlocks import BRAKE_RULE, guarded, unlisted
from polycnc.control.word_address.block import repeated_codes
from polycnc.control.word_address.block.codes import MCode
from polycnc.control.word_address.cycles import drilling
from polycnc.control.word_address.macro_b import code_calls, macro_calls, parameter_input
from polycnc.control.word_address.macro_b.custom_macro import CustomMacroControl
from polycnc.control.word_address.motion import corners, line_by_angle, nurbs, path
from polycnc.control.word_address.tools.length import renew_length
from polycnc.control.word_address.transformations import (
    cylinder,
    normal_line,
    polar_interpolation,
    tool_center_point,
)

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.rules import Rule
    from polycnc.control.word_address.block.words import Words
    from polycnc.language.bulk import Condition


#: Two blocks are read ahead, and a start-up that does not see the next plane motion makes no offset (training manual
#: 3.3.1 D of Hartford machining centres, FANUC and MELDAS).
HARTFORD = Policy(recommand_is_square=True, blind_start_is_square=False)


class MillingControl(CustomMacroControl):
    """A machining centre of the FANUC kind.

    Attributes:
        OVERRUN_PARAMETER: Parameter of each axis with the overrun of G60.
    """

    OVERRUN_PARAMETER: ClassVar[int] = 5440
    repeated_codes: ClassVar[Mapping[str, Condition]] = repeated_codes.MILLING
    CURVE_BEGINS_AT_TOOL: ClassVar[bool] = True
    rules: ClassVar[tuple[Rule, ...]] = (
        normal_line.RULE,
        parameter_input.RULE,
        polar_interpolation.rule("G90", "G91", "G94", "G95"),
        cylinder.rule("G51", "G51.1", "G68", "G68.2", "G43.4", "G43.5"),
        code_calls.RULE,
        macro_calls.RULE,
        corners.RULE,
        path.INVERSE_TIME_RULE,
        line_by_angle.RULE,
        tool_center_point.RULE,
        drilling.RULE,
        nurbs.RULE,
        BRAKE_RULE,
    )

    # ---- motion --------------------------------------------------------------------------------------

    def spiral_tolerance(self, channel: Channel) -> float:
        """What an arc takes up on its way; beyond it, where a parameter allows that, the rest is straight."""
        limit, delivered = self.arc_tolerance(channel), self.ARC_TOLERANCE_PARAMETER[1]
        return min(limit, delivered) if limit > 0.0 else delivered

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
