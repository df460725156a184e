"""Object code of kernels, made by Numba.

Every kernel that Python calls gets an entry of its own name that takes a block of addresses and lengths: arrays are
views of the caller's memory, records are pointers. The code needs neither Numba nor Python when it runs, only a few
functions of the C library's mathematics, which are those that Python calls.
"""

from __future__ import annotations

import os
import platform
import re
from contextlib import contextmanager
from types import FunctionType, ModuleType
from typing import TYPE_CHECKING, cast, get_type_hints

from build_kernels.arguments import Argument, Kind, arguments, flat, signature
from build_kernels.axes import give_usual_axes
from build_kernels.blocks import take_blocks
from build_kernels.sources import contents
from build_kernels.vectors import give_wide_vectors, known_by
from polycnc.deferred.named_tuples import written
from polycnc.kernels.description import TEXT, description
from polycnc.kernels.layout import Places

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from llvmlite.binding import ModuleRef, TargetMachine
    from numba.types import Signature, Type

    from polycnc.kernels.library import Library

#: What code is made for, by the names that Python has for processors: every one of the last fifteen years, for an
#: installation may move to another machine. Neither fuses products with sums, so that results stay those of Python.
_PROCESSORS = {"x86_64": "x86-64-v2", "amd64": "x86-64-v2"}

#: Helpers of the wrappers that Numba lays round a function. None is called here: nothing raises, no array is owned.
_HELPERS = re.compile(
    r"^declare void @(numba_gil_ensure|numba_gil_release|NRT_MemInfo_call_dtor)(\(.*?\)).*$", re.MULTILINE
)

#: How functions of Python and Numba begin.
_PYTHON = ("Py", "numba_", "NRT_")


def described(library: Library) -> bytes:
    """What the object says of a library.

    Raises:
        TypeError: A kernel takes what machine code cannot have.
    """
    signatures = {name: signature(arguments(library.plain(name))) for name in library.names}
    return description(signatures, contents(library))


def object_code(library: Library, about: bytes) -> bytes:
    """Compile the kernels of a library, for every processor of this machine's kind.

    Args:
        library: The library.
        about: Its description.

    Raises:
        ImportError: Numba is not installed.
        TypeError: A kernel can raise.
    """
    # Read when Numba is imported: it would make use of what only this processor has.
    os.environ["NUMBA_CPU_NAME"], os.environ["NUMBA_CPU_FEATURES"] = _processor(), ""
    from llvmlite import binding
    from numba import cfunc, config

    # Loops over axes are too short for vectors; those over characters, in libraries of one piece, are not.
    config.LOOP_VECTORIZE = 1 if library.inline else 0
    functions = _compiled(library.modules, inline=library.inline)
    whole = binding.parse_assembly(_data(library.symbol, about))
    for name in library.names:
        kernel = library.plain(name)
        with _indices_from_the_start():
            made = cfunc(_signature(kernel), error_model="numpy")(_entry(functions[name], kernel))
        source = _HELPERS.sub(r"define internal void @\1\2 { ret void }", made.inspect_llvm())
        part = binding.parse_assembly(source)
        part.get_function(made.native_name).name = name
        whole.link_in(part)
    if not library.inline:
        give_usual_axes(whole, [library.plain(name) for name in library.names])
    give_wide_vectors(whole, library, _machine().triple)
    take_blocks(whole, [library.plain(name) for name in library.names])
    return _optimised(whole, {library.symbol, known_by(library), *library.names})


@contextmanager
def _indices_from_the_start() -> Iterator[None]:
    """While this lasts, Numba takes it that no index counts from the end of its array: tests hold that of all kernels.

    To look whether one does is a third of the work of the planner's.
    """
    from numba.cpython import slicing

    kept = slicing.fix_index
    slicing.fix_index = lambda _builder, index, _size: index
    try:
        yield
    finally:
        slicing.fix_index = kept


def _data(symbol: str, content: bytes) -> str:
    """Data of the object, in the words of LLVM."""
    text = "".join(f"\\{byte:02x}" for byte in content)
    return f'@{symbol} = constant [{len(content)} x i8] c"{text}"\n'


def _processor() -> str:
    return _PROCESSORS.get(platform.machine().lower(), "generic")


def _optimised(module: ModuleRef, entries: set[str]) -> bytes:
    """Object code of a whole module. Seen as a whole, no function raises: what would tell Python of it goes."""
    from llvmlite import binding

    for value in (*module.functions, *module.global_variables):
        if not value.is_declaration and value.name not in entries:
            value.linkage = "internal"
    target = _machine()
    module.triple, module.data_layout = target.triple, str(target.target_data)
    builder = binding.create_pass_builder(target, binding.create_pipeline_tuning_options(speed_level=3))
    builder.getModulePassManager().run(module, builder)
    raising = [f.name for f in module.functions if f.is_declaration and f.name.startswith(_PYTHON)]
    if raising:
        msg = f"a kernel can raise: its code needs {', '.join(raising)}"
        raise TypeError(msg)
    return target.emit_object(module)


def _machine() -> TargetMachine:
    """What LLVM makes code for: a shared object of this platform."""
    from llvmlite import binding

    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    binding.initialize_native_asmparser()  # type: ignore[attr-defined]  # for what asks the processor
    target = binding.Target.from_triple(_platform(binding.get_default_triple()))
    return target.create_target_machine(cpu=_processor(), opt=3, reloc="pic", codemodel="default")


def _platform(triple: str) -> str:
    """A platform as LLVM names it, without what Microsoft's linker asks of objects: a mark where they have numbers.

    That of MinGW, which asks for none, has LLVM call a `sincos` that the system does not have.
    """
    return triple.replace("-windows-msvc", "-windows-itanium")


def _compiled(modules: Sequence[ModuleType], *, inline: bool) -> dict[str, Callable[..., object]]:
    """Copies of the functions of modules, for Numba. They see each other, not the plain ones."""
    from numba import njit

    scopes: list[dict[str, object]] = [dict(vars(module)) for module in modules]
    functions: dict[str, Callable[..., object]] = {}
    for scope in scopes:
        for name, value in scope.items():
            if isinstance(value, FunctionType) and value.__module__ == scope["__name__"]:
                copy = FunctionType(value.__code__, scope, name, value.__defaults__)
                functions[name] = njit(error_model="numpy", forceinline=inline)(copy)
    # Numba compiles at the first call: what a scope holds then is what counts.
    for scope in scopes:
        scope.update((name, function) for name, function in functions.items() if name in scope)
        for name, value in scope.items():
            if isinstance(value, type) and issubclass(value, Places):
                scope[name] = _constants(value)
    return functions


def _constants(places: type[Places]) -> ModuleType:
    """Places as Numba takes them: it knows the constants of a module, not those of a class."""
    module = ModuleType(places.__name__)
    vars(module).update((name, getattr(places, name)) for name in dir(places) if name.isupper())
    return module


def _signature(kernel: Callable[..., object]) -> Signature:
    from numba import from_dtype, types
    from numpy import dtype

    items = {
        "B": types.uint8, "H": types.uint16, "i": types.int32, "I": types.uint32, "q": types.int64,
        "d": types.float64, TEXT: types.uint8,
    }  # fmt: skip
    taken: list[Type] = []
    for argument in flat(arguments(kernel)):
        if argument.kind is Kind.ARRAY:
            taken += [types.CPointer(items[argument.code]), types.int64]
        elif argument.kind is Kind.RECORD:
            taken.append(types.CPointer(from_dtype(dtype(argument.type))))
        else:
            taken.append(types.int64 if argument.kind is Kind.INTEGER else types.float64)
    return types.int64(*taken)


def _entry(compiled: Callable[..., object], kernel: Callable[..., object]) -> Callable[..., int]:
    """The function that takes addresses and lengths, and gives a whole number: 0 where the kernel gives nothing."""
    from numba import carray

    scope: dict[str, object] = {"carray": carray, "kernel": compiled}
    names: list[str] = []
    given = ", ".join(_given(argument, names, scope) for argument in arguments(kernel))
    call = (
        f"kernel({given})\n    return 0"
        if get_type_hints(kernel)["return"] is type(None)
        else f"return kernel({given})"
    )
    source = f"def entry({', '.join(names)}):\n    {call}\n"
    exec(source, scope)  # Numba compiles functions with a fixed number of arguments only
    return cast("Callable[..., int]", scope["entry"])


def _given(argument: Argument, names: list[str], scope: dict[str, object]) -> str:
    """An expression for an argument of a kernel; adds the names of what it is made of."""
    if argument.kind is Kind.GROUP:
        assert argument.type is not None
        scope[argument.type.__name__] = written(argument.type)
        parts = ", ".join(_given(part, names, scope) for part in argument.parts)
        return f"{argument.type.__name__}({parts})"
    name = f"a{len(names)}"
    names.append(name)
    if argument.kind is Kind.ARRAY:
        names.append(f"{name}_count")
        return f"carray({name}, {name}_count)"
    return f"carray({name}, 1)[0]" if argument.kind is Kind.RECORD else name
