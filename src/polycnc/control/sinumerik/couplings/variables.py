"""What a program reads of its couplings (job planning 9.1, 9.3, 9.4)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.couplings.links import Couplings
from polycnc.language.sinumerik.names.values import Type

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, RowWithStop


def _acts(channel: SinumerikChannel, indices: Indices) -> int:
    """`$AA_COUP_ACT[following]`: 8 coupled motion, 16 master value coupling, 32 electronic gear; 0 none."""
    column = arguments.column(channel, indices[0] if indices else None)
    return sum({link.kind for link in Couplings.of(channel).links.get(column, ())})


COUPLING_VARIABLES: dict[str, RowWithStop] = {"$AA_COUP_ACT": (Type.INT, _acts, None, True)}
