"""States that features ask of each other: what is on, apart from the modules that turn it on and off.

So a block that only asks whether a plane is tilted loads nothing of tilted planes.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.geometry.frames import Frame, Vector
    from polycnc.program import Program
    from polycnc.transformation.kinematic.cylinder import Cylinder
    from polycnc.transformation.kinematic.parallel import ParallelAxes
    from polycnc.transformation.kinematic.polar import PolarPlane

#: The direction of a tool that nothing turns.
UPRIGHT: Vector = (0.0, 0.0, 1.0)


@dataclass(slots=True)
class PolarState(State, lifetime=Lifetime.RESET):
    """The plane of polar coordinate interpolation, and what its end brings back.

    Attributes:
        plane: None while it is off.
        diameter: The machine display shows diameters of its linear axis.
        plane_before: Code of the plane that holds again then; `geometry_before` its axes.
    """

    plane: PolarPlane | None = None
    diameter: bool = False
    plane_before: str = "G17"
    geometry_before: tuple[int, int, int] = (-1, -1, -1)


@dataclass(slots=True)
class CylinderState(State, lifetime=Lifetime.RESET):
    """Cylindrical interpolation.

    Attributes:
        active: The unrolled surface; None while it is off.
        geometry_before: The columns of X, Y and Z that hold again at its end.
    """

    active: Cylinder | None = None
    geometry_before: tuple[int, int, int] = (-1, -1, -1)


@dataclass(slots=True)
class TiltState(State, lifetime=Lifetime.RESET):
    """The tilted plane inside the work system, and what blocks have told of the next one (P2, P3).

    `way` is their P; `placed` is where the origin lies in the plane through three points, and how that turns (P2 Q0).
    """

    plane: Frame | None = None
    told: list[tuple[Vector, Vector]] = field(default_factory=list)
    way: int = 0
    placed: Frame = IDENTITY


@dataclass(slots=True)
class PlaneAxes(State, lifetime=Lifetime.POWER):
    """The parallel axes that a plane has chosen; None where its axes are X, Y and Z."""

    parallel: ParallelAxes | None = None


@dataclass(slots=True)
class LengthState(State, lifetime=Lifetime.RESET):
    """The active length offset.

    Attributes:
        number: Its number (H).
        direction: The direction in which it counts where that is not Z.
        along: The tool as the head turns it, which is that direction under G43.1.
        lost: Axes in which it does not count until the next G43, G44 or H.
        left_at: Machine positions to which axes were sent without regard to it.
    """

    number: int = 0
    direction: Vector | None = None
    along: Vector = UPRIGHT
    lost: tuple[int, ...] = ()
    left_at: dict[int, float] = field(default_factory=dict)


@dataclass(slots=True)
class ModalCall:
    """G66 or G66.1: the macro that follows every block."""

    program: Program
    repeats: int
    arguments: list[float | None]
    each_block: bool


@dataclass(slots=True)
class ModalCallState(State, lifetime=Lifetime.RESET):
    """The modal calls that are active, the last one called first; `due` follows the block that runs."""

    calls: list[ModalCall] = field(default_factory=list)
    due: ModalCall | None = None


@dataclass(slots=True)
class Curve:
    """A curve that blocks are still telling."""

    order: int
    knots: list[float] = field(default_factory=list)
    poles: list[tuple[float, ...]] = field(default_factory=list)
    weights: list[float] = field(default_factory=list)

    @property
    def is_complete(self) -> bool:
        """Whether every knot is there."""
        return len(self.knots) == len(self.poles) + self.order


@dataclass(slots=True)
class CurveState(State, lifetime=Lifetime.RESET):
    """The curve that blocks of G06.2 are telling; None for none."""

    curve: Curve | None = None


@dataclass(slots=True)
class LastSkip(State, lifetime=Lifetime.POWER):
    """Where the last skip move has ended (absolute display); None where there was none."""

    position: list[float] | None = None

    @classmethod
    def here(cls, channel: Channel) -> list[float]:
        """That position, else where the channel is."""
        return cls.of(channel).position or channel.coordinates.position
