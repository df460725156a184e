"""A following axis waits for its place on a curve while the leading axis moves (job planning 9.3).

The move on which its place comes to where it is gets a coupling from there on; behind it the coupling acts everywhere.
"""

from __future__ import annotations

from itertools import pairwise

from polycnc.channel.moves.move_path import PIECES, MovePath
from polycnc.channel.moves.path import Rank, Stage
from polycnc.control.sinumerik.couplings.links import Couplings, Link, places, put
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.frames import active
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.transformation.couplings.laws import ByCurve

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.moves.path import Move
    from polycnc.control.sinumerik.family import SinumerikChannel

_HALVINGS = 60


class SynchronisationStage(Stage):
    """Looks for the places at which waiting axes are led on.

    Args:
        channel: The channel whose moves come by.
    """

    rank = Rank.COUPLINGS
    lasts = True

    def __init__(self, channel: SinumerikChannel) -> None:
        self._channel = channel

    @property
    def active(self) -> bool:
        """Whether an axis waits."""
        return any(link.waits for links in Couplings.of(self._channel).links.values() for link in links)

    def move(self, move: Move) -> None:
        """Pass a move on, with the coupling that begins in it."""
        waiting = [
            (column, link)
            for column, links in Couplings.of(self._channel).links.items()
            for link in links
            if link.waits
        ]
        met = [(column, link, self._meeting(move, column, link)) for column, link in waiting]
        beginning = [(column, link, law) for column, link, law in met if law is not None]
        within = [begins for begins in beginning if begins[2].from_place is not None]
        for column, link, law in within:
            self._lead(column, link, law)
        if within:
            coordinates, state = self._channel.coordinates, Couplings.of(self._channel)
            context = replace(
                self._channel.toolpath.contexts[move.context],
                transformation=state.seated,
                shown_by=state.shown_by,
                frame=coordinates.zero,
                offsets=tuple(coordinates.offsets),
            )
            move.context = self._channel.toolpath.context_number(context)
        self.after.move(move)
        for column, link, law in beginning:
            self._lead(column, link, replace(law, from_place=None))

    def _lead(self, column: int, link: Link, law: ByCurve) -> None:
        """A law acts from now on; what has been programmed by now stays as it is."""
        channel = self._channel
        links = [
            Link(each.kind, law, each.table) if each.table == link.table and each.kind is link.kind else each
            for each in Couplings.of(channel).links[column]
        ]
        put(channel, column, links)
        position = channel.coordinates.position
        active.apply(channel)
        channel.coordinates.arrive(position)
        channel.context_changed()

    def _meeting(self, move: Move, column: int, link: Link) -> ByCurve | None:
        """The law from where the place of the axis comes to where it is; None where it does not on this move.

        Without a place to begin from: it is near enough at the end.

        Raises:
            AlarmError: PC0001 for a leading axis that turns round behind that place.
        """
        law = link.law
        assert isinstance(law, ByCurve)
        coordinates = self._channel.coordinates
        path = MovePath(move, coordinates.geometry)

        def at(part: float) -> tuple[float, float]:
            stands = places(self._channel, path.at(part))
            return stands[law.leading], stands[column]

        def gap(part: float) -> float:
            leading, here = at(part)
            return law.curve.followed(leading)[0] - here

        part = _crossing(gap)
        if part is None:
            name = self._channel.axes[column]
            tolerance = self._channel.memory.data.number("$MA_COUPLE_POS_TOL_COARSE", name)
            if abs(gap(1.0)) > tolerance:
                return None
            return ByCurve(law.leading, law.curve, at(1.0)[1])
        leading, here = at(part)
        last = at(1.0)[0]
        way = (last - leading) or (leading - at(0.0)[0])
        steps = [at(part + (1.0 - part) * k / PIECES)[0] for k in range(PIECES + 1)]
        if any((b - a) * way < -NO_WAY for a, b in pairwise(steps)):
            raise not_supported(f"LEADON({self._channel.axes[column]}): G2, G3")
        return ByCurve(law.leading, law.curve, here, leading, way > 0.0)


def _crossing(gap: Callable[[float], float]) -> float | None:
    """The first part of a way at which a gap is closed."""
    before = gap(0.0)
    for k in range(1, PIECES + 1):
        after = gap(k / PIECES)
        if before * after <= 0.0 and before != after:
            low, high = (k - 1) / PIECES, k / PIECES
            for _ in range(_HALVINGS):
                middle = 0.5 * (low + high)
                if gap(middle) * before > 0.0:
                    low = middle
                else:
                    high = middle
            return high
        before = after
    return None
