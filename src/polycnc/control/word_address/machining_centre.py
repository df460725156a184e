"""What FANUC and MELDAS machining centres share beyond the word-address base."""

from __future__ import annotations

from functools import cache
from math import inf

from polycnc.control.word_address import rules
from polycnc.control.word_address.auxiliary.interlocks import MOVES_RULE
from polycnc.control.word_address.block import repeated_codes, whole_numbers
from polycnc.control.word_address.block.codes import MCode
from polycnc.control.word_address.coordinates import frames
from polycnc.control.word_address.coordinates.frames import ROTATION_RULE
from polycnc.control.word_address.cycles import drilling
from polycnc.control.word_address.macro_b import code_calls
from polycnc.control.word_address.macro_b.custom_macro import CustomMacroControl
from polycnc.control.word_address.motion import path
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, ClassVar

with loaded_when_called():
    from polycnc.control.word_address.tools import length

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel
    from polycnc.compensation.corner import CornerPolicy
    from polycnc.compensation.policy import Policy
    from polycnc.control.word_address.block.codes import Handler, MRow
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.rules import Rule
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import MillingChannel
    from polycnc.language.bulk import Condition


@cache
def hartford() -> Policy:
    """Radius compensation of Hartford machining centres, FANUC and MELDAS (training manual 3.3.1 D).

    Two blocks are read ahead, and a start-up that does not see the next plane motion makes no offset.
    """
    from polycnc.compensation.policy import Policy

    return Policy(recommand_is_square=True, blind_start_is_square=False)


def only_the_last(builder: Builder, number: int) -> MCode | None:
    """Of several M codes in a block only the last acts, unless the control takes several."""
    channel: MillingChannel = builder.channel
    if number != builder.m_codes[-1] and not channel.control.several_m_codes(channel):
        return MCode(number, silent=True)
    return None


class MillingControl(CustomMacroControl):
    """A machining centre of the FANUC kind."""

    m_rows: ClassVar[tuple[MRow, ...]] = (only_the_last, *CustomMacroControl.m_rows)
    acts: ClassVar[Mapping[str, Handler]] = {
        **CustomMacroControl.acts,
        "mirror_first_axis": frames.mirror_first_axis,
        "mirror_second_axis": frames.mirror_second_axis,
        "mirror_off": frames.end_mirror_by_m,
    }
    repeated_codes: ClassVar[Mapping[str, Condition]] = repeated_codes.MILLING
    #: G20 and G21 are what they were before the power went off (manual, list of G codes, note 4).
    KEPT_AT_RESET: ClassVar[frozenset[str]] = frozenset({"unit", "stroke"})
    CURVE_BEGINS_AT_TOOL: ClassVar[bool] = True
    rules: ClassVar[tuple[Rule, ...]] = (
        rules.NORMAL_LINE,
        rules.PARAMETER_INPUT,
        ROTATION_RULE,
        rules.polar("G90", "G91", "G94", "G95"),
        rules.unrolled("G51", "G51.1", "G68.2", "G43.4", "G43.5"),
        code_calls.RULE,
        rules.MODAL_CALLS,
        whole_numbers.RULE,
        rules.CORNERS,
        path.INVERSE_TIME_RULE,
        rules.LINES_BY_ANGLE,
        rules.ZERO_ON_TABLE,
        rules.COMPANY_OF_TIP,
        rules.DIRECTION_BY_VECTOR,
        rules.STOPS,
        drilling.RULE,
        rules.CURVES,
        MOVES_RULE,
    )

    # ---- motion --------------------------------------------------------------------------------------

    def spiral_tolerance(self, channel: MillingChannel) -> float:
        """What an arc takes up on its way; beyond it, where a parameter allows that, the rest is straight."""
        limit, delivered = self.arc_tolerance(channel), self.parameter_class.arc_tolerance.delivered
        return min(limit, delivered) if limit > 0.0 else delivered

    def scale_factors(self, channel: MillingChannel, words: Words) -> tuple[float, float, float]:
        """Factors of G51: P for all axes, or I J K; without a point in units of 5400#7 SCR."""
        unit = 0.001 if channel.memory.parameters.SCR else 0.00001
        if "P" in words:
            own = next((letter for letter in "IJK" if letter in words), "")
            if own:
                raise self.fail("address", address=own)
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

    def several_m_codes(self, _channel: Channel) -> bool:
        """Whether a block may hold several M codes (Hartford manual 2.3.3: the last one counts)."""
        return False

    def travel_by_parameters(self, channel: MillingChannel) -> Mapping[int, tuple[float, float]]:
        """Stroke limits by parameter (FANUC 1320, 1321, MELDAS 2013, 2014); none where plus is not above minus."""
        found: dict[int, tuple[float, float]] = {}
        for i, of in enumerate(map(channel.memory.parameters.of, channel.axes)):
            low = -inf if of.travel_lower is None else of.travel_lower
            high = inf if of.travel_upper is None else of.travel_upper
            if -inf < low < high or low < high < inf:
                found[i] = (low, high)
        return found

    # ---- offsets -------------------------------------------------------------------------------------

    def compensation_policy(self, _channel: Channel) -> Policy:
        """Rules of radius compensation."""
        return hartford()

    def corner_policy(self) -> CornerPolicy:
        """A dwell may stand between the two moves of a chamfer or rounding."""
        return replace(super().corner_policy(), dwell_between=True)

    def goes_with_fixture(self, _channel: Channel) -> bool:
        """Whether the tool goes along when the fixture offset of a rotary table changes (G54.2)."""
        return True

    def turns_tool_with_work(self, _channel: Channel) -> bool:
        """Whether a workpiece error turns the tool without tip control as well (G54.4)."""
        return False

    def overrun(self, channel: MillingChannel, axis: int) -> float:
        """How far and on which side G60 positions past the target of an axis, mm (sign: last direction)."""
        return channel.memory.parameters.of(channel.axes[axis]).overrun

    def measuring(self, channel: MillingChannel, words: Words) -> tuple[float, float, float]:
        """G37: way before the target at feed, allowed difference (both mm), feed (mm/s)."""
        raise NotImplementedError

    def note_length(self, channel: Channel, number: int, change: float) -> None:
        """Add a measured difference to a length offset."""
        channel.memory.offset_number(number).length += change
        length.renew_length(channel)
