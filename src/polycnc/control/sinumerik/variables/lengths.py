"""Which values of system variables are lengths: under G700 a program reads and writes them in inches.

Under G70 they stay in the basic system, which is metric: words alone are in inches there. Source: Fundamentals (G700,
G710: feeds and variables too); which data are meant is general knowledge (Function Manual G2, table of the measuring
systems): settable and base frames, tool offsets, machine and setting data and variables that are lengths. Positions of
axes have their own unit (`block/positions.py`).
"""

from __future__ import annotations

from collections.abc import Callable

from polycnc.control.sinumerik.data.delivered import LENGTHS as DATA
from polycnc.control.sinumerik.frames.variables import FRAME_VARIABLES
from polycnc.control.sinumerik.tables import data_factor
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, Any, TypeAlias
from polycnc.language.sinumerik.names.values import Axis

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices

#: The mm, or mm/min, that one unit of the program is.
Unit: TypeAlias = Callable[["SinumerikChannel", "Indices"], float]

#: Numbers of what is a length in the data of tools, by the beginning of their names.
_OF_TOOLS = {
    "TC_DP": frozenset((*range(3, 10), *range(12, 19), 21, 22, 23)),
    "TC_CARR": frozenset((*range(1, 7), *range(15, 21), *range(38, 47), *range(55, 61))),
    "TC_TPG": frozenset((3, 4, 5)),
    "TC_ADPT": frozenset((1, 2, 3)),
}
#: Lengths and radii of additive offsets (`$TC_SCPxy`): y.
_OF_OFFSETS = frozenset(range(3, 10))
_NUMBERED = regex(r"^\$(TC_DP|TC_CARR|TC_TPG|TC_ADPT)(\d+)$")
_ADDITIVE = regex(r"^\$TC_[SE]CP\d(\d)$")
#: What is a length, or a feed, of the path or of the tool.
_PLAIN = frozenset(
    (
        *("$P_TOOLL", "$P_TOOLR", "$P_OFFN", "$P_F"),
        *("$AC_DTEB", "$AC_DTEW", "$AC_DTBB", "$AC_DTBW", "$AC_PLTBB", "$AC_PLTEB", "$AC_DELT"),
        *("$AC_VACTB", "$AC_VACTW", "$AC_VC"),
    )
)
#: What is a length of a linear axis.
_AXIAL = frozenset(("$AA_OFF", "$AA_DELT", "$AA_TOFF", "$AA_TOFF_VAL", "$AA_ETRANS"))
#: Parts of frames that are lengths.
_SHIFTS = ("TR", "FI")


def unit_of(name: str) -> Unit | None:
    """In which unit a program reads and writes a variable; None for one that is no length."""
    data = f"${name.lstrip('$')}"
    if name in FRAME_VARIABLES:
        return _of_frame
    if data in DATA and not data.startswith("$MN_"):
        return _of_datum
    if name in _AXIAL:
        return _of_datum
    numbered, additive = _NUMBERED.match(name), _ADDITIVE.match(name)
    is_tool = numbered is not None and int(numbered[2]) in _OF_TOOLS[numbered[1]]
    if is_tool or (additive is not None and int(additive[1]) in _OF_OFFSETS) or name in _PLAIN:
        return _inch
    return _of_edge if name == "$P_AD" else None


def of_axis(channel: SinumerikChannel, axis: str) -> float:
    """The unit of positions of an axis; rotary axes and spindles count degrees."""
    memory = channel.memory
    name = memory.data.axes.get(axis, axis)  # machine axes by their own names too
    if name not in memory.columns or memory.axes[memory.column(name)].rotary:
        return 1.0
    return _inch(channel, ())


def _inch(channel: SinumerikChannel, _indices: Indices) -> float:
    return data_factor(channel.mode)


def _of_datum(channel: SinumerikChannel, indices: Indices) -> float:
    """Of a datum: that of the axis which is named, where one is."""
    axes: list[Any] = [index for index in indices if isinstance(index, Axis)]
    return of_axis(channel, axes[0].name) if axes else _inch(channel, indices)


def _of_frame(channel: SinumerikChannel, indices: Indices) -> float:
    """Of a frame: whole frames have none, nor have other parts than shifts."""
    return _of_datum(channel, indices) if indices and indices[-1] in _SHIFTS else 1.0


def _of_edge(channel: SinumerikChannel, indices: Indices) -> float:
    """Of `$P_AD[n]`: parameters of the active edge have the numbers of `$TC_DPn`."""
    return _inch(channel, indices) if indices and indices[0] in _OF_TOOLS["TC_DP"] else 1.0
