"""The lathe: the offset files of its manual (0i-TF Plus III.1.1), variables and parameters as on machining centres."""

from __future__ import annotations

from polycnc.control.fanuc.lathe.tools import files
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.interchange.controls import mills, parameters
from polycnc.interchange.controls.kinds import TAPE, Kind, Texts

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.control.fanuc.lathe.family import LatheChannel


def _writer(kind: str) -> Callable[[LatheChannel], str]:
    return lambda channel: files.write(channel, kind)


def _read(channel: Channel, content: str) -> list[str] | None:
    """Offset files have a form of their own: second geometry is no G10 of programs."""
    first = next((line for line in content.splitlines()[1:] if line.strip()), "")
    if not first.replace(" ", "").startswith(("G10P", "G10L2P", "G10L20P")):
        return None
    files.read(channel, content)
    return []


TEXTS = Texts(
    {
        "parameters": Kind("CNC-PARA.TXT", parameters.write),
        "offsets": Kind("TOOLOFST.TXT", _writer("offsets")),
        "second-geometry": Kind("SEC_GEOM.TXT", _writer("second-geometry")),
        "work-shift": Kind("WORKSHFT.TXT", _writer("work-shift")),
        "work": Kind("EXT_WKZ.TXT", _writer("work")),
        "variables": Kind("MACRO.TXT", mills.variables),
    },
    TAPE,
    "ALL-PROG.TXT",
    readers=(parameters.read, _read),
)
