"""A block of the ISO dialect: functions here, the rest told in the control's own language."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.sinumerik.iso import frames, holes, offsets, reference, subprograms
from polycnc.control.sinumerik.iso.running import IsoRun
from polycnc.language.sinumerik.iso_dialect import MOTIONS

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.iso_dialect import IsoBlock, IsoWord

#: Functions of the dialect that the control's own language has no word for.
FUNCTIONS: dict[str, Callable[[IsoRun, IsoWord], None]] = {
    "G28": reference.return_to,
    "G30": reference.return_to,
    "G43": offsets.select,
    "G49": offsets.cancel,
    "G50": frames.unscale,
    "G51": frames.scale,
    "G50.1": frames.unmirror,
    "G51.1": frames.mirror,
    "G52": frames.shift,
    "G68": frames.rotate,
    "G69": frames.unrotate,
    "G92": frames.set_position,
    **dict.fromkeys(holes.KINDS, holes.choose),
    "G80": holes.cancel,
    "G98": holes.to_initial,
    "G99": holes.to_r,
    "G65": subprograms.call_macro,
    "G66": subprograms.call_modally,
    "G67": subprograms.end_modal,
    "M98": subprograms.call,
    "M99": subprograms.return_,
}


def run(channel: SinumerikChannel, block: IsoBlock, perform: Callable[[str], None]) -> None:
    """Run a block.

    Args:
        channel: The channel.
        block: Its words.
        perform: Runs a block of the control's own language.

    Raises:
        AlarmError: PC0001 for a word of the dialect that is not executed; what the functions and the told words raise.
    """
    running = IsoRun(channel, block)
    for word in block.words:
        function = FUNCTIONS.get(word.name)
        if function is not None:
            running.taken.append(word)
            function(running, word)
    if any(code in MOTIONS for code in block.codes):
        holes.end(running)
    holes.drill(running)
    offsets.check(running)
    motion = channel.mode["motion"]
    for act in running.before:
        act()
    perform(" ".join([block.told(motion, running.taken), *running.extra]))
    for act in running.after:
        act()
