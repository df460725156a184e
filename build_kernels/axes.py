"""Kernels whose loops go over axes are made twice: for any number of them, and for the usual one.

Where LLVM knows how many axes there are, it writes such loops out. The results are the same bit for bit.
"""

from __future__ import annotations

from inspect import signature
from typing import TYPE_CHECKING

from build_kernels.arguments import Argument, Kind, arguments, flat

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from llvmlite.binding import ModuleRef

#: So many axes most machines have. How many there are says an argument of a kernel that has one of these names: a
#: number, or an array by its length.
_USUAL_AXES, _AXES = 3, ("n", "position", "rotary", "jerk")

#: What machine code takes for an argument, in the words of LLVM.
_TAKES = {
    Kind.ARRAY: ("ptr", "i64"), Kind.RECORD: ("ptr",), Kind.INTEGER: ("i64",), Kind.NUMBER: ("double",),
}  # fmt: skip


def give_usual_axes(whole: ModuleRef, kernels: Sequence[Callable[..., object]]) -> None:
    """Give kernels of a module that are told a number of axes a copy of all code for the usual one."""
    from llvmlite import binding

    counts = {kernel: found for kernel in kernels if (found := counts_of_axes(kernel))}
    if not counts:
        return
    usual = binding.parse_bitcode(whole.as_bitcode())
    for value in (*usual.functions, *usual.global_variables):
        if not value.is_declaration:
            value.linkage = "internal"
    for kernel in counts:
        for module, name in ((usual, _usual(kernel)), (whole, _any(kernel))):
            function = module.get_function(kernel.__name__)
            function.name, function.linkage = name, "external"
    whole.link_in(usual)
    for kernel, found in counts.items():
        whole.link_in(binding.parse_assembly(_choice(kernel, found)))


def _usual(kernel: Callable[..., object]) -> str:
    return f"{kernel.__name__}.usual"


def _any(kernel: Callable[..., object]) -> str:
    return f"{kernel.__name__}.any"


def counts_of_axes(kernel: Callable[..., object]) -> list[int]:
    """Places, among what the machine code of a kernel takes, of what says how many axes there are."""
    found: list[int] = []
    place = 0
    for name, argument in _named(signature(kernel).parameters, arguments(kernel)):
        place += len(_TAKES[argument.kind])
        if name in _AXES and _TAKES[argument.kind][-1] == "i64":
            found.append(place - 1)
    return found


def taken_by(kernel: Callable[..., object]) -> list[str]:
    """What the machine code of a kernel takes, in the words of LLVM."""
    return [type_ for argument in flat(arguments(kernel)) for type_ in _TAKES[argument.kind]]


def _named(names: Iterable[str], taken: Sequence[Argument]) -> Iterator[tuple[str, Argument]]:
    """Arguments with their names, those in groups too."""
    for name, argument in zip(names, taken, strict=True):
        if argument.kind is Kind.GROUP:
            assert argument.type is not None
            yield from _named(argument.type.__annotations__, argument.parts)
        else:
            yield name, argument


def _choice(kernel: Callable[..., object], counts: Sequence[int]) -> str:
    """A function, in the words of LLVM, that calls the copy of a kernel for the usual axes where there are so many."""
    types = taken_by(kernel)
    given = [f"{type_} %a{k}" for k, type_ in enumerate(types)]
    usual = [f"i64 {_USUAL_AXES}" if k in counts else each for k, each in enumerate(given)]
    asked = "".join(
        f"%is{k} = icmp eq i64 %a{k}, {_USUAL_AXES}\nbr i1 %is{k}, label %next{k}, label %any\nnext{k}:\n"
        for k in counts
    )
    return f"""
        declare i64 @{_usual(kernel)}({", ".join(types)})
        declare i64 @{_any(kernel)}({", ".join(types)})
        define i64 @{kernel.__name__}({", ".join(given)}) {{
        {asked}
        %with_usual = call i64 @{_usual(kernel)}({", ".join(usual)})
        ret i64 %with_usual
        any:
        %with_any = call i64 @{_any(kernel)}({", ".join(given)})
        ret i64 %with_any
        }}
    """
