"""Which axes follow which: the couplings of a channel, and what they make of its coordinates (job planning 9).

They act in the basic coordinate system, behind the frames and the tool. While one acts it takes the seat of a
transformation: words name the way that a following axis goes by itself, and what its leading axes add comes on top.
When a coupling ends, the axes stay where they are, and words mean their places again.
"""

from __future__ import annotations

from dataclasses import field, replace
from enum import IntEnum
from typing import TYPE_CHECKING

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.curve_tables.memory import CurveTables
from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.deferred.records import dataclass
from polycnc.geometry.frames import IDENTITY
from polycnc.transformation.couplings.coupled import Coupled, Shown
from polycnc.transformation.seated import Seated

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

    def laws(self) -> dict[int, list[Law]]:
        """The laws that act, by the column of the following axis."""
        acting = {
            column: [link.law for link in links if not link.waits] for column, links in self.links.items()
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
    laws = Couplings.of(channel).laws()
    if not laws:
        return None
    coupled = Coupled.of(laws, channel.coordinates.geometry)
    return Seated(coupled, IDENTITY if frame.is_identity else frame, tuple(shifts) if any(shifts) else ())


def take_seat(channel: SinumerikChannel, made: Seated | None) -> Seated | None:
    """The couplings that act from now on; gives the same object as before where nothing has changed."""
    state = Couplings.of(channel)
    if made != state.seated:
        state.seated, state.shown_by = made, None
        if made is not None:
            state.shown_by = Shown(made, replace(made, inner=Coupled((), made.geometry)))
    return state.seated


def shown(channel: SinumerikChannel, position: Iterable[float]) -> list[float]:
    """A position of the path as displays show it."""
    by = Couplings.of(channel).shown_by
    return list(position) if by is None else by.to_work(list(position))


def without_couplings(channel: SinumerikChannel, position: list[float]) -> list[float]:
    """Where the axes would be at a position of the path if none led another."""
    by = Couplings.of(channel).shown_by
    return channel.coordinates.to_machine(position) if by is None else by.bare.to_machine(position)


def coupled(channel: SinumerikChannel) -> frozenset[int]:
    """Columns of the axes that lead or follow."""
    links = Couplings.of(channel).links
    return frozenset((*links, *(link.law.leading for of in links.values() for link in of)))
