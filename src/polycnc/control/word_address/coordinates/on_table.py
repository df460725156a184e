"""Work zeros that go with the table: fixture offsets (G54.2) and errors of the workpiece (G54.4).

Both hold for one position of the rotary axes of the table. They are worked out anew when these turn: in front of the
move of a block, for where they stand at its end (`follow`).
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State, retained
from polycnc.control.word_address.coordinates.systems import ZeroState, refresh_zero
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import Frame, translation
from polycnc.memory.retained import WORKPIECE_ERRORS

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.machine.kinematics import Angles

#: Fixture offsets by number from 1; workpiece errors by number from 0, which is added to all others.
FIXTURES, ERRORS = 8, 7
COMMON_ERROR = 0
#: Values of an error: along X, Y, Z (mm), about X, Y, Z, and where the rotary axes of the table stood (degrees).
ERROR_VALUES, LINEAR, TURNS, TABLE = 8, slice(0, 3), slice(3, 6), slice(6, 8)
ROUND_X_Y_Z = (0, 1, 2)
#: An axis that is as near (degrees) to where it was has not moved.
NOT_MOVED_DEG = 1e-6
#: The variables of error 0, and how many numbers lie between those of two errors.
FIRST_VARIABLE, VARIABLES = 26000, 10


@dataclass(slots=True)
class OnTable(State, lifetime=Lifetime.RESET):
    """Which fixture offset (G54.2 P) and which workpiece error (G54.4 P) act; 0 for none.

    Attributes:
        posture: How the tool stands on the work as it should lie: machine positions of the rotary axes by name,
            degrees, as words under G43.4 have told them; where none have, where the axes stood when that began.
        stood: Positions that the rotary axes were led to by that, so that it stands on the work as it lies.
        turns_tool: The error turns the tool without tip control as well.
    """

    fixture: int = 0
    error: int = 0
    turns_tool: bool = False
    posture: dict[str, float] = field(default_factory=dict)
    stood: dict[str, float] = field(default_factory=dict)

    @property
    def acts(self) -> bool:
        """Whether the work zero depends on the table."""
        return bool(self.fixture or self.error)


@dataclass(slots=True)
class WorkpieceErrors(State, lifetime=Lifetime.RETAINED):
    """The errors of workpieces by number; `ERROR_VALUES` values each."""

    by_number: dict[int, list[float]] = retained(WORKPIECE_ERRORS)


def values_of(channel: Channel, number: int) -> list[float]:
    """The values of an error; zeros until they are set."""
    return WorkpieceErrors.of(channel).by_number.setdefault(number, [0.0] * ERROR_VALUES)


def fixture_name(number: int) -> str:
    """The name of a fixture offset among the work offsets; of rotary axes it holds the reference angles."""
    return f"G54.2 P{number}"


def table_axes(channel: WordAddressChannel) -> tuple[str, ...]:
    """Rotary axes of the table, the one nearest to the base first."""
    return tuple(joint.axis for joint in channel.control.kinematics(channel).work)


def follow(channel: WordAddressChannel, angles: Angles | None = None) -> None:
    """The work zero as these positions of the rotary axes (degrees by name), else the present ones, turn it.

    The machine stays.
    """
    from polycnc.transformation.planes.misplaced import Misplaced

    state, zero = OnTable.of(channel), ZeroState.of(channel)
    here = dict(zip(channel.axes, channel.coordinates.machine, strict=True)) if angles is None else angles
    kinematics = channel.control.kinematics(channel)
    turn = kinematics.work_turn(here)
    zero.fixture, zero.misplaced = (0.0, 0.0, 0.0), None
    if state.fixture:
        values = channel.memory.work_offset(fixture_name(state.fixture))
        x, y, z = (values[axis] if axis >= 0 else 0.0 for axis in channel.coordinates.geometry)
        reference = kinematics.work_turn(dict(zip(channel.axes, values, strict=True)))
        zero.fixture = turn.direct(*reference.inverse().direct(x, y, z))
    if state.error:
        errors = tuple(
            (error, kinematics.work_turn(dict(zip(table_axes(channel), places, strict=False))))
            for error, places in _errors(channel, state.error)
        )
        if errors:
            told = (
                kinematics.work_turn(state.posture) if state.turns_tool and _is_led(channel, here) else None
            )
            zero.misplaced = Misplaced(errors, turn, told)
    refresh_zero(channel)


def begin_posture(channel: WordAddressChannel, *, told: bool = False) -> None:
    """Tip control begins: the tool stands as its rotary axes do, unless those are where words had led them before.

    `told`: words of the block in which it begins have led them, as they do without tip control.
    """
    state, here = OnTable.of(channel), dict(zip(channel.axes, channel.coordinates.machine, strict=True))
    if told or not (state.error and _is_led(channel, here)):
        axes = channel.control.kinematics(channel).axes
        state.posture, state.stood = {name: here[name] for name in axes}, {}


def _is_led(channel: WordAddressChannel, here: Angles) -> bool:
    """Whether the rotary axes stand where words have led them."""
    stood = OnTable.of(channel).stood
    axes = channel.control.kinematics(channel).axes
    return bool(stood) and all(abs(stood[name] - here[name]) < NOT_MOVED_DEG for name in axes)


def _errors(channel: WordAddressChannel, number: int) -> list[tuple[Frame, list[float]]]:
    """The error of a number and the common one: shifts, turns about X, Y, Z in this order; where the table stood.

    Their values are added where the table stood alike.
    """
    from polycnc.transformation.planes.tilted import by_fixed_axes

    told = [values_of(channel, each) for each in (COMMON_ERROR, number)]
    found = [values for values in told if any(values[LINEAR]) or any(values[TURNS])]
    if len(found) > 1 and found[0][TABLE] == found[1][TABLE]:
        common, own = found
        found = [[a + b for a, b in zip(common[:6], own[:6], strict=True)] + own[TABLE]]
    return [
        (translation(*values[LINEAR]) @ by_fixed_axes(ROUND_X_Y_Z, values[TURNS]), values[TABLE])
        for values in found
    ]
