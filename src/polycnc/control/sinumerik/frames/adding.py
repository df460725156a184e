"""ADDFRAME: chain a frame, such as a measured one, into a frame variable (job planning 5.6)."""

from __future__ import annotations

from polycnc.control.sinumerik.frames.memory import (
    AFTER_PROGRAMMABLE,
    AFTER_SETTABLE,
    BEFORE_BASE,
    SYSTEM_FRAMES,
    chain,
)
from polycnc.control.sinumerik.frames.variables import FRAME_VARIABLES
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.memory import Memory
    from polycnc.language.sinumerik.names.frame import NcFrame

OK, WRONG_TARGET, NOT_CONFIGURED, NO_ROTATION = range(4)
_TARGET = regex(r"(\$P_[A-Z0-9]+)(?:\[(\d+)\])?")
#: Errors of writing a frame and what ADDFRAME returns for them.
_ERRORS = {"18310": NO_ROTATION, "17020": NOT_CONFIGURED, "18311": NOT_CONFIGURED}
#: The link of the chain to which a target belongs, and whether the number in brackets counts in it.
_LINKS = {
    "$P_NCBFR": "global base",
    "$P_NCBFRAME": "global base",
    "$P_CHBFR": "base",
    "$P_CHBFRAME": "base",
    "$P_UBFR": "base",
    "$P_BFRAME": "base",
    "$P_UIFR": "settable",
    "$P_IFRAME": "settable",
    "$P_PFRAME": "programmable",
    **{name: name for name in SYSTEM_FRAMES},
}


def add(channel: SinumerikChannel, args: tuple[Any, ...]) -> int:
    """ADDFRAME(frame, target): the target changes so that the total frame becomes the old one chained with the frame.

    Returns:
        0, 1 for a target that is no frame, 2 for one that is not configured, 3 where it takes no rotation.
    """
    frame, text = args
    found = _TARGET.fullmatch(text.strip().upper())
    if found is None or found[1] not in _LINKS or FRAME_VARIABLES[found[1]][2] is None:
        return WRONG_TARGET
    name, indices = found[1], () if found[2] is None else (int(found[2]),)
    _, read, write = FRAME_VARIABLES[name]
    assert write is not None
    try:
        inner = _inside(channel.memory, _LINKS[name], indices[0] if indices else 0)
        write(channel, indices, read(channel, indices) @ inner @ frame @ inner.inverse())
    except AlarmError as alarm:
        if alarm.code not in _ERRORS:
            raise
        return _ERRORS[alarm.code]
    return OK


def _inside(memory: Memory, link: str, number: int) -> NcFrame:
    """The part of the chain between a link of it and the work coordinates."""
    state = memory.frames
    masks = {"global base": state.global_base_mask, "base": state.base_mask}
    bases = {"global base": state.active_global_base, "base": state.active_base}
    links: list[tuple[str, int, NcFrame]] = [(name, 0, state.system[name]) for name in BEFORE_BASE]
    for kind, active in bases.items():
        links += [
            (kind, i, each)
            for i, each in enumerate(active)
            if masks[kind] >> i & 1 or (kind, i) == (link, number)
        ]
    links.append(("settable", 0, state.active_settable))
    links += [(name, 0, state.system[name]) for name in AFTER_SETTABLE]
    links.append(("programmable", 0, state.programmable))
    links += [(name, 0, state.system[name]) for name in AFTER_PROGRAMMABLE]
    place = next(
        (i for i, (kind, n, _) in enumerate(links) if kind == link and (kind not in bases or n == number)), -1
    )
    return chain([each for _, _, each in links[place + 1 :]])
