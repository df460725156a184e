"""Which axes follow which: the couplings of a channel, and what they make of its coordinates (job planning 9).

They act in the basic coordinate system, behind the frames and the tool; those of a gantry and of masters between axes
of the machine, behind a transformation. While one acts words name the way that a following axis goes by itself, and
what its leading axes add comes on top. When a coupling ends, the axes stay where they are, and words mean their places
again. A coupling takes a seat of its own, or a side of that of the transformation (`Seated.led`, `Seated.driven`).
"""

from __future__ import annotations

from enum import IntEnum

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.curve_tables.memory import CurveTables
from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.control.sinumerik.errors import not_supported
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY
from polycnc.geometry.tolerances import NO_WAY
from polycnc.transformation.couplings.laws import Ratio
from polycnc.transformation.kinematic.parallel import ParallelAxes
from polycnc.transformation.seated import Seated

with loaded_when_called():
    from polycnc.transformation.couplings.coupled import Coupled, Shown

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.frames import Frame
    from polycnc.transformation.couplings.laws import Law


class Kind(IntEnum):
    """What a coupling is, as `$AA_COUP_ACT` tells it."""

    SLAVE = 0
    """Of a master (MASLON), which it does not tell."""
    GANTRY = -1
    """Of a gantry, which it does not tell either."""
    TRAIL = 8
    LEAD = 16
    GEAR = 32


#: Couplings of axes of the machine, which a transformation has in front of it.
OF_MACHINE = frozenset((Kind.SLAVE, Kind.GANTRY))
#: Bits of MD20110 that keep couplings over a reset, where its bit 0 is set; gears (9.4.2) and slaves stay in any case.
KEPT_BY_MASK = {Kind.TRAIL: 8, Kind.LEAD: 13}


@dataclass(frozen=True, slots=True)
class Link:
    """One leading axis of a following one.

    Attributes:
        kind: What has made it.
        law: What the leading axis does.
        table: Number of the curve table that it uses, 0 for none.
        waits: The following axis is not yet where the table has it: the law does not act.
    """

    kind: Kind
    law: Law
    table: int = 0
    waits: bool = False


@dataclass(slots=True)
class Couplings(State, lifetime=Lifetime.POWER):
    """The couplings of a channel.

    Attributes:
        links: Those that are switched on, by the column of the following axis.
        seated: They all in their seat; None where none acts.
        shown_by: What displays make of the rows then.
    """

    links: dict[int, list[Link]] = field(default_factory=dict)
    seated: Seated | None = None
    shown_by: Shown | None = None

    def laws(self, kinds: frozenset[Kind] = frozenset(Kind)) -> dict[int, list[Law]]:
        """The laws of some kinds that act, by the column of the following axis."""
        acting = {
            column: [link.law for link in links if not link.waits and link.kind in kinds]
            for column, links in self.links.items()
        }
        return {column: laws for column, laws in acting.items() if laws}

    def of_kind(self, column: int, kind: Kind) -> list[Link]:
        """The links of a following axis that something of a kind has made."""
        return [link for link in self.links.get(column, ()) if link.kind is kind]

    def end(self, channel: Channel, lifetime: Lifetime) -> None:
        """A reset ends couplings, but for gears, slaves and those that MD20110 keeps; power-on ends all."""
        if lifetime < Lifetime.RESET:
            return
        mask = MachineData.of(channel).integer("$MC_RESET_MODE_MASK")
        kept = {kind for kind, bit in KEPT_BY_MASK.items() if mask & 1 and mask >> bit & 1} | {
            Kind.GEAR,
            Kind.SLAVE,
            Kind.GANTRY,
        }
        for column in list(self.links):
            stay = [link for link in self.links[column] if link.kind in kept and lifetime < Lifetime.POWER]
            put(channel, column, stay)


def put(channel: Channel, column: int, links: list[Link]) -> None:
    """These lead an axis from now on; tables that are used are locked meanwhile."""
    state, tables = Couplings.of(channel), CurveTables.of(channel)
    before = state.links.pop(column, [])
    for link in links:
        if link.table:
            tables.use(link.table)
    for link in before:
        if link.table:
            tables.leave(link.table)
    if links:
        state.links[column] = links


def seated(channel: SinumerikChannel, frame: Frame, shifts: Sequence[float]) -> Seated | None:
    """The couplings that act, in their seat behind frames and tool; None where none acts.

    Args:
        channel: The channel.
        frame: From the work to the basic system.
        shifts: What is added to every axis behind it: frames of axes beside the geometry, lengths of the tool.
    """
    if not Couplings.of(channel).laws():
        return None
    geometry = channel.coordinates.geometry
    frame = IDENTITY if frame.is_identity else frame
    return beside(channel, Seated(ParallelAxes(geometry), frame, tuple(shifts) if any(shifts) else ()))


def beside(channel: SinumerikChannel, made: Seated) -> Seated:
    """A seat with the couplings that act."""
    state, geometry = Couplings.of(channel), made.geometry
    if isinstance(made.inner, ParallelAxes):
        laws = state.laws()
        return replace(made, driven=Coupled.of(laws, geometry)) if laws else made
    led, driven = state.laws(frozenset(Kind) - OF_MACHINE), state.laws(OF_MACHINE)
    return replace(
        made,
        led=Coupled.of(led, geometry) if led else None,
        driven=Coupled.of(driven, geometry) if driven else None,
    )


def take_seat(channel: SinumerikChannel, made: Seated | None) -> Seated | None:
    """The couplings that act from now on; gives the same object as before where nothing has changed."""
    state = Couplings.of(channel)
    if made is not None and not made.is_coupled:
        made = None
    if made != state.seated:
        state.seated, state.shown_by = made, None
        if made is not None:
            state.shown_by = Shown(made, bare(made))
    return state.seated


def bare(made: Seated) -> Seated:
    """A seat without its couplings."""
    return replace(made, led=None, driven=None)


def places(channel: SinumerikChannel, position: Sequence[float] | None = None) -> list[float]:
    """Where the axes are as couplings see them: in the basic system under a transformation, on the machine else.

    Args:
        channel: The channel.
        position: A position of the path; None for where it stands.
    """
    coordinates = channel.coordinates
    made = coordinates.transformation
    if isinstance(made, Seated) and not isinstance(made.inner, ParallelAxes):
        return made.basic(coordinates.position if position is None else position)
    return coordinates.machine if position is None else coordinates.to_machine(list(position))


def keep_ways(channel: SinumerikChannel, before: Sequence[float]) -> bool:
    """Axes are called otherwise, though none has moved: following ones go on from there. Whether any law has changed.

    Args:
        channel: The channel.
        before: Their `places` till now.

    Raises:
        AlarmError: PC0001 where the place on a curve would jump.
    """
    ways = [b - a for a, b in zip(before, places(channel), strict=True)]
    changed = False
    for links in Couplings.of(channel).links.values():
        kept = []
        for link in links:
            way = 0.0 if link.kind in OF_MACHINE or link.waits else ways[link.law.leading]
            if abs(way) > NO_WAY:
                if not isinstance(link.law, Ratio):
                    raise not_supported(f"LEADON EGON: {channel.axes[link.law.leading]}")
                changed, link = True, replace(link, law=replace(link.law, origin=link.law.origin + way))
            kept.append(link)
        links[:] = kept
    return changed


def shown(channel: SinumerikChannel, position: Iterable[float]) -> list[float]:
    """A position of the path as displays show it."""
    by = Couplings.of(channel).shown_by
    return list(position) if by is None else by.to_work(list(position))


def without_couplings(channel: SinumerikChannel, position: list[float]) -> list[float]:
    """The `places` of axes at a position of the path if none led another."""
    made, coordinates = channel.coordinates.transformation, channel.coordinates
    if isinstance(made, Seated) and not isinstance(made.inner, ParallelAxes):
        return bare(made).basic(position)
    return (
        coordinates.to_machine(position) if not isinstance(made, Seated) else bare(made).to_machine(position)
    )


def coupled(channel: SinumerikChannel) -> frozenset[int]:
    """Columns of the axes that lead or follow."""
    links = Couplings.of(channel).links
    return frozenset((*links, *(link.law.leading for of in links.values() for link in of)))
