"""CYCLE832: tolerance, dynamics, smoothing and compressor for free-form surfaces in one call."""

from __future__ import annotations

from polycnc.control.sinumerik import gcodes
from polycnc.control.sinumerik.block import procedures
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.feed import tolerances
from polycnc.control.sinumerik.reset import start_code
from polycnc.control.sinumerik.transformations import smoothing
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Kind of machining (units of S_TOLM): dynamics, and the tolerance where S_TOL is 0, mm.
KINDS = {1: ("DYNFINISH", 0.01), 2: ("DYNSEMIFIN", 0.05), 3: ("DYNROUGH", 0.1)}
#: What the cycle switches on, by group.
ON = {
    "acceleration": "SOFT",
    "feedforward": "FFWON",
    "path": "G645",
    "compressor": "COMPCAD",
    "path_reference": "UPATH",
}
#: Groups that go back to what the machine data say when the cycle is switched off.
SET = ("dynamics", *ON)
#: A second argument above this is the code of the older cycle.
LARGEST_KIND = 99
#: Millions of the second argument: the option Top Surface, without smoothing from track to track and with it.
TOP_SURFACE, MOST_OF_TOP_SURFACE = 1_000_000, 2
#: Digits of that code: path mode, feedforward and acceleration, compressor.
OLD_PATH_MODES = {0: "G64", 1: "G641", 2: "G642"}
OLD_DYNAMICS = {0: ("FFWOF", "SOFT"), 1: ("FFWON", "SOFT"), 2: ("FFWOF", "BRISK")}
OLD_COMPRESSORS = {0: "COMPOF", 1: "COMPCAD", 2: "COMPCURV", 3: "COMPON"}


def high_speed(moves: Moves, a: Arguments) -> None:
    """CYCLE832(S_TOL, S_TOLM, S_OTOL); S_TOLM 0 or no argument: off."""
    moves.act(_set, moves.channel, a)
    moves.end_block()


def _set(channel: SinumerikChannel, a: Arguments) -> None:
    top_surface, kind = divmod(abs(a.integer("S_TOLM")), TOP_SURFACE)
    if top_surface > MOST_OF_TOP_SURFACE:
        raise AlarmError("61002")
    if kind > LARGEST_KIND:
        _older(channel, a)
    elif kind % 10 == 0:
        _switch(channel, _start_codes(channel), tolerances.NO_TOLERANCE, tolerances.NO_TOLERANCE)
    elif kind % 10 in KINDS:
        dynamics, delivered = KINDS[kind % 10]
        orientation = a["S_OTOL"] if kind // 10 == 1 else tolerances.NO_TOLERANCE
        _switch(channel, {"dynamics": dynamics, **ON}, a["S_TOL"] or delivered, orientation)
    elif kind % 10 == 4:
        raise not_supported("CYCLE832 _PRECISION")
    else:
        raise AlarmError("61002")


def _switch(channel: SinumerikChannel, codes: dict[str, str], tolerance: float, orientation: float) -> None:
    if tolerance < 0.0 and tolerance != tolerances.NO_TOLERANCE:
        raise AlarmError("12560", text="S_TOL")
    channel.mode = channel.mode.with_codes(list(codes.items()))
    tolerances.Smoothing.of(channel).tolerance.update(CTOL=tolerance, OTOL=orientation)
    smoothing.follow(channel)
    channel.context_changed()


def _start_codes(channel: SinumerikChannel) -> dict[str, str]:
    """The functions of the cycle's groups as machine data 20150 and the delivered state have them."""
    memory = channel.memory
    return {name: start_code(gcodes.BY_NAME[name], memory.data) for name in SET}


def _older(channel: SinumerikChannel, a: Arguments) -> None:
    """The code of six digits: kind, -, transformation, path mode, feedforward and acceleration, compressor."""
    digit = [a.digit("S_TOLM", place) for place in range(6)]
    if digit[0] == 0:
        _switch(channel, _start_codes(channel), tolerances.NO_TOLERANCE, tolerances.NO_TOLERANCE)
        return
    if (
        digit[0] not in KINDS
        or digit[2] > 2
        or digit[3] not in OLD_PATH_MODES
        or digit[4] not in OLD_DYNAMICS
        or digit[5] not in OLD_COMPRESSORS
    ):
        raise AlarmError("61002")
    dynamics, delivered = KINDS[digit[0]]
    feedforward, acceleration = OLD_DYNAMICS[digit[4]]
    codes = {
        "dynamics": dynamics,
        "path": OLD_PATH_MODES[digit[3]],
        "feedforward": feedforward,
        "acceleration": acceleration,
        "compressor": OLD_COMPRESSORS[digit[5]],
    }
    _switch(channel, codes, a["S_TOL"] or delivered, tolerances.NO_TOLERANCE)
    name, values = ("TRAORI", (digit[2],)) if digit[2] else ("TRAFOOF", ())
    procedures.run(channel, name, values)
