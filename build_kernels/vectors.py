"""Kernels whose loops become vectors are made twice: for every processor, and for those with vectors of four numbers.

Those are processors of Intel and AMD with AVX2. Which code runs the object asks the processor, once: in a virtual
machine the answer takes as long as a short kernel. The results are the same bit for bit: four numbers at once are
counted as two are, and FMA, which fuses products with sums, is not asked for.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from build_kernels.axes import taken_by

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from llvmlite.binding import ModuleRef

    from polycnc.kernels.library import Library

#: The libraries whose time is that of such loops. Of the others a second copy would be size alone.
LIBRARIES = {"jerk_laws"}
#: The processors that there is a copy for, by how LLVM's names of platforms begin.
_KIND = "x86_64"
#: What the functions of the copy may use besides, and for what they are tuned.
_WIDE = '"target-features"="+avx2" "tune-cpu"="x86-64-v3"'
#: Where the attributes of a function stand, in the words of LLVM: behind what it takes.
_HEAD = re.compile(r"^(define .*\)(?: (?:local_)?unnamed_addr)?)", re.MULTILINE)
#: What the object knows of the processor: it has not asked yet (0, as nobody writes it), or one of these.
NARROW, WIDE = 1, 2


def give_wide_vectors(whole: ModuleRef, library: Library, triple: str) -> None:
    """Give the kernels of a module a copy of all code for processors with wide vectors, if the library is one of those.

    Args:
        whole: The module.
        library: Its library.
        triple: The platform, as LLVM names it.
    """
    from llvmlite import binding

    if library.name not in LIBRARIES or not triple.startswith(_KIND):
        return
    wide = binding.parse_assembly(_HEAD.sub(rf"\1 {_WIDE}", str(whole)))
    for value in (*wide.functions, *wide.global_variables):
        if not value.is_declaration:
            value.linkage = "internal"
    for name in library.names:
        for module, other in ((wide, f"{name}.wide"), (whole, f"{name}.narrow")):
            function = module.get_function(name)
            function.name, function.linkage = other, "external"
    whole.link_in(wide)
    known = known_by(library)
    choices = [_choice(library.plain(name), known) for name in library.names]
    whole.link_in(
        binding.parse_assembly("\n".join([_ASKED.format(known=known, WIDE=WIDE, NARROW=NARROW), *choices]))
    )


def known_by(library: Library) -> str:
    """The number of the object in which a library keeps what it knows of the processor."""
    return f"vectors_{library.name}"


#: What the processor says. Leaf 1: the system keeps the state of registers (bit 27 of ecx), which `xgetbv` tells of
#: those of 16 and 32 bytes (bits 1 and 2). Leaf 7: AVX2 (bit 5 of ebx).
_ASKED = """
@{known} = global i32 0
define internal i32 @asked() noinline {{
begin:
  %first = call {{i32, i32, i32, i32}} asm sideeffect "cpuid",
    "={{ax}},={{bx}},={{cx}},={{dx}},{{ax}},{{cx}},~{{dirflag}},~{{fpsr}},~{{flags}}"(i32 0, i32 0)
  %leaves = extractvalue {{i32, i32, i32, i32}} %first, 0
  %second = call {{i32, i32, i32, i32}} asm sideeffect "cpuid",
    "={{ax}},={{bx}},={{cx}},={{dx}},{{ax}},{{cx}},~{{dirflag}},~{{fpsr}},~{{flags}}"(i32 1, i32 0)
  %features = extractvalue {{i32, i32, i32, i32}} %second, 2
  %keeps = and i32 %features, 134217728
  %is_kept = icmp ne i32 %keeps, 0
  %is_told = icmp uge i32 %leaves, 7
  %is_new = and i1 %is_kept, %is_told
  br i1 %is_new, label %new, label %narrow
new:
  %kept = call {{i32, i32}} asm sideeffect "xgetbv",
    "={{ax}},={{dx}},{{cx}},~{{dirflag}},~{{fpsr}},~{{flags}}"(i32 0)
  %registers = extractvalue {{i32, i32}} %kept, 0
  %both = and i32 %registers, 6
  %are_both = icmp eq i32 %both, 6
  %third = call {{i32, i32, i32, i32}} asm sideeffect "cpuid",
    "={{ax}},={{bx}},={{cx}},={{dx}},{{ax}},{{cx}},~{{dirflag}},~{{fpsr}},~{{flags}}"(i32 7, i32 0)
  %extended = extractvalue {{i32, i32, i32, i32}} %third, 1
  %avx2 = and i32 %extended, 32
  %has_avx2 = icmp ne i32 %avx2, 0
  %is_wide = and i1 %are_both, %has_avx2
  br i1 %is_wide, label %wide, label %narrow
wide:
  br label %end
narrow:
  br label %end
end:
  %found = phi i32 [{WIDE}, %wide], [{NARROW}, %narrow]
  store atomic i32 %found, ptr @{known} monotonic, align 4
  ret i32 %found
}}
"""


def _choice(kernel: Callable[..., object], known: str) -> str:
    """A function, in the words of LLVM, that calls the copy of a kernel for this processor."""
    name, types = kernel.__name__, taken_by(kernel)
    taken, given = ", ".join(types), ", ".join(_numbered(types))
    return f"""
        declare i64 @{name}.wide({taken})
        declare i64 @{name}.narrow({taken})
        define i64 @{name}({given}) {{
        begin:
          %noted = load atomic i32, ptr @{known} monotonic, align 4
          %is_noted = icmp ne i32 %noted, 0
          br i1 %is_noted, label %known, label %ask
        ask:
          %told = call i32 @asked()
          br label %known
        known:
          %processor = phi i32 [%noted, %begin], [%told, %ask]
          %is_wide = icmp eq i32 %processor, {WIDE}
          br i1 %is_wide, label %wide, label %narrow
        wide:
          %by_wide = call i64 @{name}.wide({given})
          ret i64 %by_wide
        narrow:
          %by_narrow = call i64 @{name}.narrow({given})
          ret i64 %by_narrow
        }}
    """


def _numbered(types: Sequence[str]) -> list[str]:
    return [f"{type_} %a{k}" for k, type_ in enumerate(types)]
