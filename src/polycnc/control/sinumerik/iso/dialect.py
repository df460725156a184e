"""A block of the ISO dialect: functions here, the rest told in the control's own language."""

from __future__ import annotations

from polycnc.control.sinumerik.iso import frames, holes, offsets, reference, subprograms, systems, turning
from polycnc.control.sinumerik.iso.running import IsoRun
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.errors import NcSyntaxError
from polycnc.language.sinumerik.iso_dialect import MOTIONS

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.iso_dialect import IsoBlock, IsoWord

#: Functions of the dialect that the control's own language has no word for.
FUNCTIONS: dict[str, Callable[[IsoRun, IsoWord], None]] = {
    "G10": frames.set_offset,
    "G28": reference.return_to,
    "G30": reference.return_to,
    "G31": reference.to_probe,
    "G43": offsets.select,
    "G44": offsets.select,
    "G49": offsets.cancel,
    "G50": frames.unscale,
    "G51": frames.scale,
    "G50.1": frames.unmirror,
    "G51.1": frames.mirror,
    "G52": frames.shift,
    "G53": reference.to_machine,
    "G54": offsets.select_zero,
    "G54.1": offsets.select_zero,
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

#: Those of a lathe, in the names of code system B.
TURNING_FUNCTIONS = {
    **{
        name: FUNCTIONS[name]
        for name in ("G28", "G30", "G31", "G54", "G54.1", "G65", "G66", "G67", "M98", "M99")
    },
    "G33": turning.thread,
    **dict.fromkeys(turning.CYCLES, turning.choose),
    "G92": turning.limit_speed,
}

#: Functions of which a block may hold one; the words told in the control's own language have its groups.
GROUPS = (
    frozenset(("G43", "G44", "G49")),
    frozenset(("G50", "G51")),
    frozenset(("G50.1", "G51.1")),
    frozenset(("G68", "G69")),
    frozenset(("G80", *holes.KINDS)),
    frozenset(("G98", "G99")),
    frozenset(("G65", "G66", "G67")),
    frozenset(("G54", "G54.1", "G55", "G56", "G57", "G58", "G59")),
    # They read the axis words.
    frozenset(
        (
            "G10",
            "G28",
            "G30",
            "G31",
            "G50.1",
            "G51",
            "G51.1",
            "G52",
            "G53",
            "G65",
            "G66",
            "G68",
            "G92",
            *turning.CYCLES,
        )
    ),
)
#: Letters that a block may hold several times.
_REPEATED = "GM"


def check(block: IsoBlock) -> None:
    """Each function and each word has one meaning in a block.

    Raises:
        AlarmError: 12060 for two functions of a group, 12010 for a letter that is there twice. Words that a macro
            reads are the macro's own affair.
    """
    for group in GROUPS:
        members = [word for word in block.words if word.code in group]
        if len(members) > 1:
            raise NcSyntaxError("12060", members[1].column, members[1].code)
    if not subprograms.MACROS.isdisjoint(block.codes):
        return
    seen: set[str] = set()
    for word in block.words:
        if word.letter in seen and word.letter not in _REPEATED:
            raise NcSyntaxError("12010", word.column, word.letter)
        seen.add(word.letter)


def run(channel: SinumerikChannel, block: IsoBlock, perform: Callable[[str], None]) -> None:
    """Run a block.

    Args:
        channel: The channel.
        block: Its words.
        perform: Runs a block of the control's own language.

    Raises:
        AlarmError: PC0001 for a word of the dialect that is not executed; what `check`, the functions and the told
            words raise.
    """
    is_lathe = channel.memory.transverse >= 0
    if is_lathe:
        block = systems.of_system(block, channel.memory.data.integer("$MN_EXTERN_GCODE_SYSTEM"))
    check(block)
    running = IsoRun(channel, block)
    functions = TURNING_FUNCTIONS if is_lathe else FUNCTIONS
    for word in block.words:
        function = functions.get(word.name)
        if function is not None:
            running.taken.append(word)
            function(running, word)
    if any(code in MOTIONS for code in block.codes):
        holes.end(running)
    if is_lathe:
        turning.act(running)
    holes.drill(running)
    offsets.check(running)
    motion = channel.mode["motion"]
    for act in running.before:
        act()
    perform(" ".join([block.told(motion, running.taken), *running.extra]))
    for act in running.after:
        act()
