"""Kernels take all that they are given as one block of numbers of eight bytes (`polycnc/kernels/call.py` says why)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from build_kernels.axes import taken_by

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from llvmlite.binding import ModuleRef


def take_blocks(whole: ModuleRef, kernels: Iterable[Callable[..., object]]) -> None:
    """Have the kernels of a module take addresses, lengths and numbers out of a block, in place of one by one."""
    from llvmlite import binding

    entries = []
    for kernel in kernels:
        whole.get_function(kernel.__name__).name = _apart(kernel)
        entries.append(_entry(kernel))
    whole.link_in(binding.parse_assembly("\n".join(entries)))


def _apart(kernel: Callable[..., object]) -> str:
    return f"{kernel.__name__}.apart"


def _entry(kernel: Callable[..., object]) -> str:
    """A function, in the words of LLVM, that takes the block apart. Bytes of Python may lie anywhere (`align 1`)."""
    types = taken_by(kernel)
    read = "".join(
        f"%p{k} = getelementptr i64, ptr %block, i64 {k}\n%a{k} = load {type_}, ptr %p{k}, align 1\n"
        for k, type_ in enumerate(types)
    )
    given = ", ".join(f"{type_} %a{k}" for k, type_ in enumerate(types))
    return f"""
        declare i64 @{_apart(kernel)}({", ".join(types)})
        define i64 @{kernel.__name__}(ptr %block) {{
        {read}
        %found = call i64 @{_apart(kernel)}({given})
        ret i64 %found
        }}
    """
