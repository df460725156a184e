"""What a control may ask of the main run in an interpolation cycle, and what may look in each: synchronised actions.

A program that needs the clock asks for it by `Channel.on_clock`. Actions are the control's; the main run offers this
one object of each channel and knows nothing of their language.
"""

from __future__ import annotations

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Final, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from polycnc.messages import AlarmError
    from polycnc.toolpath import Event
    from polycnc.transformation.couplings.laws import Law

#: The shift of an axis by the handwheel, among those that lie over it.
HANDWHEEL_OFFSET: Final = "DRF"


class OnPath(NamedTuple):
    """Where the block in execution is.

    Attributes:
        seconds: Since it began.
        done: Way along its path, mm.
        left: Way to its end, mm.
        speed: Path speed, mm/s.
    """

    seconds: float
    done: float
    left: float
    speed: float


class BlockKind(NamedTuple):
    """What has made the block in execution.

    Attributes:
        origin: As `Context` says.
        rounding: The control rounds the corner between two blocks: the codes that are active there; else None.
    """

    origin: int = 0
    rounding: Mapping[str, str] | None = None


@dataclass(slots=True)
class Influence:
    """What actions have made of the speeds in one interpolation cycle; it holds until they look again.

    Attributes:
        factor: Path override, 1 for 100 %.
        addend: What is added to the path feed, mm/s.
        of_axes: Override of single axes by column, 1 for 100 %.
        holds_next: The next block does not begin (RDISABLE).
    """

    factor: float = 1.0
    addend: float = 0.0
    of_axes: dict[int, float] = field(default_factory=dict)
    holds_next: bool = False

    @property
    def is_none(self) -> bool:
        """Whether the path runs as it would without actions."""
        return self.factor == 1.0 and self.addend == 0.0 and not self.of_axes


class Watcher(Protocol):
    """Who looks in every interpolation cycle."""

    def look(self) -> None:
        """An interpolation cycle has come, and the axes are where they are in it."""

    def block_begins(self) -> None:
        """A block begins that does something on the machine; the one before is over."""

    def block_ends(self) -> None:
        """The block in execution is over."""

    @property
    def lingers(self) -> bool:
        """Whether the end of the program has to wait."""

    @property
    def goes_home(self) -> bool:
        """Whether a reset has to wait for an axis that it leads to its place of rest."""

    @property
    def is_quiet(self) -> bool:
        """Whether another look would find everything as it is, until a block begins or an axis comes to rest."""

    def abandon(self, *, reset: bool) -> None:
        """The program has ended, or was given up by a reset."""


class PassiveWatcher:
    """A watcher to which blocks mean nothing, and that neither the end of a program nor a reset waits for.

    Whoever differs in one of these says so.
    """

    __slots__ = ()

    def block_begins(self) -> None:
        """It looks in interpolation cycles."""

    def block_ends(self) -> None:
        """It looks in interpolation cycles."""

    @property
    def lingers(self) -> bool:
        """The end of the program does not wait."""
        return False

    @property
    def goes_home(self) -> bool:
        """A reset does not wait."""
        return False


class Commanded(Protocol):
    """An axis that is moved beside the path; positions are of the machine, mm (radius) or degrees."""

    @property
    def moves(self) -> bool:
        """Whether it is under way, or waits at an override of 0."""

    @property
    def is_turning(self) -> bool:
        """Whether it moves by itself now, beside what leads it."""

    @property
    def left(self) -> float:
        """Way to its target, signed; 0 where it has none."""

    def move_to(self, target: float, speed: float) -> None:
        """Go to a target, out of whatever it does."""

    def run_on(self, direction: int, speed: float, end: float | None = None) -> None:
        """Go on, 1 or -1, without end or to this one; 0 brakes."""

    def preset(self, place: float) -> None:
        """It is called another position where it is, and goes on with the way that is left."""

    def change_speed(self, speed: float) -> None:
        """Another speed, where it is under way."""

    def stop(self) -> None:
        """Brake, and drop the way that is left."""


class Interpolator(Protocol):
    """The main run of one channel, at the moment of a look. Axes are columns of the channel."""

    @property
    def time(self) -> float:
        """Simulated time, s."""

    @property
    def cycle_s(self) -> float:
        """Interpolation cycle, s."""

    @property
    def on_path(self) -> OnPath:
        """Where the block in execution is."""

    @property
    def block_number(self) -> int:
        """How many blocks have begun, intermediate ones too."""

    @property
    def block_kind(self) -> BlockKind:
        """What has made the block in execution."""

    @property
    def block_split(self) -> tuple[bool, bool]:
        """Whether the block in execution is not as the program has it, and whether the one behind it is not."""

    @property
    def operator_override(self) -> float:
        """The feed override that the operator has set, 1 for 100 %."""

    @property
    def runs_programs(self) -> bool:
        """Whether the control is in the mode in which the channel's program was started."""

    @property
    def modal(self) -> Mapping[str, str]:
        """Active codes in the block in execution."""

    def machine(self, column: int) -> float:
        """Commanded position of an axis on the machine."""

    def left(self, column: int) -> float:
        """Way of an axis to where it goes, signed: by what commands it, or in the move in execution."""

    def is_on_path(self, column: int) -> bool:
        """Whether the move in execution moves an axis."""

    def speed(self, column: int) -> float:
        """Speed of an axis, mm/s or degrees/s, signed."""

    def watch(self, watcher: Watcher) -> None:
        """From now on somebody is told of cycles and blocks."""

    def wake(self) -> None:
        """Look in every cycle from the next one on."""

    def sleep(self) -> None:
        """Look in none before something happens: a block begins, a signal changes, an axis comes to rest."""

    @property
    def is_still(self) -> bool:
        """Whether no axis of the channel moves."""

    @property
    def spindle_rpm(self) -> float:
        """Speed of the spindle in the block in execution, signed."""

    @property
    def is_held(self) -> bool:
        """Whether the program is held, is being given up, or has ended in an alarm."""

    @property
    def has_power(self) -> bool:
        """Whether the drives have power: no emergency stop is pressed."""

    def influence(self, influence: Influence) -> None:
        """Let these speeds hold until the next look."""

    def gate(self, *, closed: bool) -> None:
        """Whether every block ends in an exact stop."""

    def stop_behind_next(self) -> None:
        """Preparation waits behind the next block that does something; said while the program is prepared."""

    def release(self) -> None:
        """Preparation need not wait for the end of the block in execution."""

    def drop_rest(self) -> float:
        """Brake on the path and drop what is left of the block in execution; gives the way dropped, mm."""

    def commanded(self, column: int) -> Commanded:
        """An axis that is moved beside the path."""

    def led_by(self, column: int) -> tuple[Law, ...]:
        """What leads an axis beside the path."""

    def follow(
        self,
        column: int,
        laws: Sequence[Law],
        spindles: Mapping[int, float] | None = None,
        speed: Callable[[int, float], float] | None = None,
        *,
        catches_up: bool = True,
    ) -> None:
        """These lead an axis beside the path from now on, none lets it brake.

        Args:
            column: The axis.
            laws: By which other axes lead it.
            spindles: Of a gear: degrees that it turns for one of each leading spindle, by number.
            speed: What a spindle turns with, by its number and at an override, rpm, positive for M3: asked for those
                that are none of the block in execution.
            catches_up: The axis, which accelerates to the speed at which it is led, makes up for the way that it is
                behind meanwhile.

        Raises:
            CircularCouplingError: An axis would lead itself.
        """

    def move_static(self, column: int, *, static: bool) -> None:
        """Whether what moves an axis beside the path goes on while the program is held."""

    def shift_path(self, column: int, place: float) -> None:
        """The path has an axis elsewhere from now on; the axis stays, and nothing moves on the path."""

    def stand_at(self, column: int, place: float) -> None:
        """An axis, which stands, is called another position; nothing moves."""

    def position_beside(self, column: int, target: float, speed: float) -> None:
        """An axis goes to a target beside the path, which has it there from now on; nothing moves on the path."""

    def take_back(self, column: int) -> float:
        """The program has a commanded axis again, which stands: gives its machine position."""

    def overlay(self, name: str, column: int, value: float, speed: float, pull: float = 1.0) -> None:
        """Shift an axis beside everything else, no faster than a speed and with a part of its acceleration.

        `name` says which of its shifts is meant.
        """

    def without_overlay(self, name: str, column: int) -> float:
        """Where a real axis would be now without one of its shifts, machine position."""

    def overlaid(self, name: str, column: int) -> float:
        """How far a shift of an axis has been asked to go, mm or degrees; 0 where there is none."""

    def take_in_overlay(self, name: str, column: int) -> float:
        """A shift of an axis, which stands, becomes a part of the path: gives its machine position."""

    def corner_angle(self) -> float | None:
        """Angle between the end of the move in execution and the next one, degrees; None where none is prepared."""

    def put_out(self, event: Event) -> None:
        """An auxiliary function goes out to the machine."""

    def fail(self, error: AlarmError, *, program: str, line: int) -> None:
        """An action raises an alarm: the program ends behind what is prepared."""
