"""Manual intervention and turning cycles: a cycle takes it back, incremental or not (0i-TF Plus II.4.1.6, 4.2.8)."""

from __future__ import annotations

from polycnc.channel.intervention import TakesBack
from polycnc.control.fanuc.lathe.cycles.modal import CYCLES
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan

#: Cycles with a shape, which P and Q name, and others; blocks without those words only give amounts.
_SHAPE_CYCLES, _NAMED_AXES = frozenset({"G70", "G71", "G72", "G73"}), frozenset({"G74", "G75"})
_AXIS_LETTERS = "XYZUVW"


def takes_back(builder: Builder, _plan: Plan) -> TakesBack | None:
    """What the cycle of a block takes back, as soon as it moves; None without a turning cycle."""
    codes = {row.code for row in builder.codes}
    plane = {builder.channel.coordinates.geometry[i] for i in PLANES[builder.mode["plane"]][:2]} - {-1}
    named = {_axis(builder, letter) for letter in _AXIS_LETTERS if builder.has(letter)} & plane
    if codes & _NAMED_AXES:
        return TakesBack(_mask(named)) if named else None
    cuts_shape = codes & _SHAPE_CYCLES and builder.has("P") and builder.has("Q")
    threads = "G76" in codes and named
    single = builder.mode["motion"] in CYCLES and builder.mode["cycle"] == "G80"
    return TakesBack(_mask(plane)) if cuts_shape or threads or single else None


def plan_return(builder: Builder, plan: Plan) -> Step | None:
    """A cycle counts from where the program has left the axes, and its first move leads them there."""
    axes = plan.takes_back.at_once
    if takes_back(builder, plan) is None:
        return None

    def count_from_path(channel: LatheChannel, _values: list[float]) -> None:
        moved, c = channel.moved_by_hand, channel.coordinates
        channel.moved_by_hand = None
        if moved is None or any(abs(a - b) > NO_WAY for a, b in zip(c.machine, moved.machine, strict=True)):
            return
        c.arrive_machine(
            [
                at - way * (axes >> axis & 1)
                for axis, (at, way) in enumerate(zip(c.machine, moved.way, strict=True))
            ]
        )

    return count_from_path


def _axis(builder: Builder, letter: str) -> int:
    found = builder.control.axis_of_address(builder.channel, letter, builder)
    return -1 if found is None else int(found[0])


def _mask(axes: set[int]) -> int:
    return sum(1 << axis for axis in axes)
