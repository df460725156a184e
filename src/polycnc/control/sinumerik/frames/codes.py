"""Functions of group 3: programmable frames, poles, and the limits of G25 and G26.

Source: Fundamentals (TRANS, ROT, ROTS, SCALE, MIRROR and their additive forms, G58, G59, G110 to G112, G25,
G26).
"""

from __future__ import annotations

from math import cos, radians, sin

from polycnc.control.sinumerik.block.positions import AxisTerm, number
from polycnc.control.sinumerik.feed import spindle_speed
from polycnc.control.sinumerik.frames import active as frames
from polycnc.control.sinumerik.limits import working_area
from polycnc.control.sinumerik.motion.polar import Polar
from polycnc.control.sinumerik.tables import length_factor
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import Frame, Vector
from polycnc.geometry.planes import PLANES
from polycnc.geometry.vectors import cross
from polycnc.language.sinumerik.names.frame import (
    GEOMETRY_AXES,
    NcFrame,
    cfine,
    cmirror,
    crot,
    crpl,
    cscale,
    ctrans,
)
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel


def named(draft: Draft) -> list[tuple[str, int, float]]:
    """The axis words of a frame function: frame axis, place, and factor to mm or degrees; 12020 for AC or IC."""
    for position, word in draft.open_words():
        if word.modifier and word.address in draft.memory.columns:
            raise WordAlarm("12020", position, text=word.modifier)
    geometry = draft.channel.coordinates.geometry
    found = []
    for term in draft.take_axes(path=False):
        name = draft.channel.axes[term.column]
        if term.column in geometry:
            name = GEOMETRY_AXES[geometry.index(term.column)]
        found.append((name, term.position, term.factor))
    return found


def _values(words: list[tuple[str, int, float]], values: Values) -> dict[str, float]:
    return {name: number(values, position) * factor for name, position, factor in words}


def _programmable(elementary: Callable[[Values], NcFrame], *, additive: bool) -> Step:
    """A step that replaces the programmable frame, or adds to it."""

    def run(channel: SinumerikChannel, values: Values) -> None:
        state = channel.memory.frames
        frame = elementary(values)
        state.programmable = state.programmable @ frame if additive else frame
        frames.changed(channel)

    return run


def _is_additive(draft: Draft) -> bool:
    return draft.codes["frame"].startswith("A")


def translate(draft: Draft) -> Step:
    """TRANS, ATRANS: shift; TRANS alone deletes the programmable frame.

    With MD24000 a frame keeps the sum of its additive shifts apart, as its fine part: ATRANS adds to that, and TRANS
    leaves that of the axes it names (Fundamentals, G58 and G59).
    """
    words, additive = named(draft), _is_additive(draft)

    def run(channel: SinumerikChannel, values: Values) -> None:
        state, shifts = channel.memory.frames, _values(words, values)
        before, apart = state.programmable, bool(channel.memory.data.number("$MC_FRAME_ADD_COMPONENTS"))
        if additive:
            state.programmable = before @ (cfine(shifts) if apart else ctrans(shifts))
        else:
            state.programmable = before.fine_part(shifts) @ ctrans(shifts) if apart else ctrans(shifts)
        frames.changed(channel)

    return run


def scale(draft: Draft) -> Step:
    """SCALE, ASCALE: factors; alarm 14800 for a factor of zero."""
    words = [(name, position, 1.0) for name, position, _ in named(draft)]

    def elementary(values: Values) -> NcFrame:
        try:
            return cscale(_values(words, values))
        except ValueError:
            raise AlarmError("12160", text="SCALE") from None

    return _programmable(elementary, additive=_is_additive(draft))


def mirror(draft: Draft) -> Step:
    """MIRROR, AMIRROR: the named axes change their sign; values have no meaning."""
    names = [name for name, _, _ in named(draft)]
    return _programmable(lambda _values: cmirror(names), additive=_is_additive(draft))


def _angles(draft: Draft) -> list[tuple[str, int, float]]:
    """The axis words of a rotation, degrees; alarm 16440 for an axis outside the geometry."""
    words = [(name, position, 1.0) for name, position, _ in named(draft)]
    for name, position, _ in words:
        if name not in GEOMETRY_AXES:
            raise WordAlarm("16440", position, axis=name)
    return words


def rotate(draft: Draft) -> Step:
    """ROT, AROT: about axes in RPY order (MD10600 = 1), or by RPL in the plane."""
    in_plane = draft.take("RPL")
    words = _angles(draft)
    if in_plane is not None and words:
        raise WordAlarm("12080", in_plane, text="RPL")
    index = PLANES[draft.mode["plane"]][2]

    def elementary(values: Values) -> NcFrame:
        if in_plane is not None:
            return crpl(index, number(values, in_plane))
        return crot(_values(words, values))

    return _programmable(elementary, additive=_is_additive(draft))


def rotate_solid(draft: Draft) -> Step:
    """ROTS, AROTS: the plane by the angles of its traces in two coordinate planes, or by one."""
    words = _angles(draft)
    return _programmable(lambda values: crots(_values(words, values)), additive=_is_additive(draft))


def crots(angles: dict[str, float]) -> NcFrame:
    """Rotation with solid angles (CROTS).

    With angles of X and Y the new X axis lies in the old Z/X plane, turned about Y, and the new plane's trace
    in the Y/Z plane is turned about X; Y and Z, Z and X follow by exchanging the axes in a circle.

    Raises:
        AlarmError: 12080 for three angles, 12160 for two traces along one line.
    """
    if len(angles) < 2:
        return crot(angles)
    if len(angles) > 2:
        raise AlarmError("12080", text="ROTS")
    first = next(i for i in range(3) if {GEOMETRY_AXES[i], GEOMETRY_AXES[(i + 1) % 3]} == set(angles))
    i, j, k = first, (first + 1) % 3, (first + 2) % 3
    about_i, about_j = radians(angles[GEOMETRY_AXES[i]]), radians(angles[GEOMETRY_AXES[j]])
    u, trace = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    u[i], u[k] = cos(about_j), -sin(about_j)
    trace[j], trace[k] = cos(about_i), sin(about_i)
    w = _unit(cross(u, trace))
    columns: list[Sequence[float]] = [(), (), ()]
    columns[i], columns[j], columns[k] = u, cross(w, u), w
    rows: list[Vector] = [(columns[0][r], columns[1][r], columns[2][r]) for r in range(3)]
    return NcFrame(matrix=Frame((rows[0], rows[1], rows[2])).m)


def coarse_offset(draft: Draft) -> Step:
    """G58: the absolute translation of the named axes; the additive part stays."""
    return _offset(draft, "TR")


def fine_offset(draft: Draft) -> Step:
    """G59: the additive translation of the named axes (MD24000); the absolute part stays."""
    return _offset(draft, "FI")


def _offset(draft: Draft, component: str) -> Step:
    words = named(draft)

    def run(channel: SinumerikChannel, values: Values) -> None:
        memory = channel.memory
        if not memory.data.number("$MC_FRAME_ADD_COMPONENTS"):
            raise AlarmError("18312")
        for axis, value in _values(words, values).items():
            memory.frames.programmable = memory.frames.programmable.with_component(axis, component, value)
        frames.changed(channel)

    return run


# ---- poles


def pole(draft: Draft) -> Step:
    """G110 from the last position, G111 from the work zero, G112 from the last pole; by axes or AP and RP."""
    code = draft.codes["frame"]
    angle, radius = draft.take_shape("AP"), draft.take_shape("RP")
    terms = draft.take_axes()
    plane = PLANES[draft.mode["plane"]]

    def run(channel: SinumerikChannel, values: Values) -> None:
        polar = Polar.of(channel)
        geometry = channel.coordinates.geometry
        position = channel.coordinates.position
        if code == "G110":
            origin = [position[i] if i >= 0 else 0.0 for i in geometry]
        else:
            origin = list(polar.pole) if code == "G112" else [0.0, 0.0, 0.0]
        if angle is not None or radius is not None:
            if angle is None or radius is None or terms:
                raise AlarmError("14270")
            length = number(values, radius[0]) * length_factor(draft.mode)
            if length < 0.0:
                raise AlarmError("14250")
            turned = radians(number(values, angle[0]))
            origin[plane[0]] += length * cos(turned)
            origin[plane[1]] += length * sin(turned)
        for term in terms:
            if term.column not in geometry:
                raise AlarmError("14270")
            origin[geometry.index(term.column)] += number(values, term.position) * term.factor
        polar.pole = (origin[0], origin[1], origin[2])

    return run


# ---- limits


def lower_limit(draft: Draft) -> Step:
    """G25: lower working area limits of the axes (SD43430), lowest speed of spindles (SD43210)."""
    return _limit(draft, "MINUS")


def upper_limit(draft: Draft) -> Step:
    """G26: upper working area limits of the axes (SD43420), highest speed of spindles (SD43220)."""
    return _limit(draft, "PLUS")


def _limit(draft: Draft, side: str) -> Step:
    speeds = []
    while (word := draft.take_shape("S")) is not None:
        speeds.append(word)
    terms: list[AxisTerm] = draft.take_axes()

    def run(channel: SinumerikChannel, values: Values) -> None:
        memory = channel.memory
        for position, shape in speeds:
            spindle = memory.spindles.get(shape.index if isinstance(shape.index, int) else None)
            datum = spindle_speed.LOWEST if side == "MINUS" else spindle_speed.HIGHEST
            spindle_speed.set_limit(channel, datum, spindle, number(values, position))
        for term in terms:
            value = number(values, term.position) * term.factor
            memory.data.write(f"$SA_WORKAREA_LIMIT_{side}", (channel.axes[term.column],), value)
        working_area.refresh(channel)

    return run


#: What each function of the group does with its block.
def plan(draft: Draft, code: str) -> Step:
    """The step of a function of group 3."""
    return FRAME_CODES[code](draft)


FRAME_CODES: dict[str, Callable[[Draft], Step]] = {
    "TRANS": translate,
    "ATRANS": translate,
    "ROT": rotate,
    "AROT": rotate,
    "ROTS": rotate_solid,
    "AROTS": rotate_solid,
    "SCALE": scale,
    "ASCALE": scale,
    "MIRROR": mirror,
    "AMIRROR": mirror,
    "G58": coarse_offset,
    "G59": fine_offset,
    "G110": pole,
    "G111": pole,
    "G112": pole,
    "G25": lower_limit,
    "G26": upper_limit,
}


def _unit(a: Vector) -> list[float]:
    length = sum(value * value for value in a) ** 0.5
    if length < 1e-12:
        raise AlarmError("12160", text="ROTS")
    return [value / length for value in a]
