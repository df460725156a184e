"""Program calls and returns: by name, CALL, PCALL, MCALL, EXTCALL, CALLPATH, RET (job planning 1.25)."""

from __future__ import annotations

from polycnc.channel.stack import LevelKind
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.expressions.code import Code, assigned, attribute, constant, quoted, sequence
from polycnc.language.sinumerik import keywords
from polycnc.language.sinumerik.emitter import provide
from polycnc.language.sinumerik.errors import NcSyntaxError, unknown
from polycnc.language.sinumerik.names.places import ElementPlace
from polycnc.language.sinumerik.names.values import Type
from polycnc.language.sinumerik.statements.sections import LANGUAGE, Section, count_levels, leave
from polycnc.messages import AlarmError
from polycnc.program.names import is_too_long, split_stored_path
from polycnc.program.store import EXTERNAL

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.channel.stack import Level
    from polycnc.language.sinumerik.blocks import BlockCompiler
    from polycnc.language.sinumerik.interface import LanguageMemory, NcChannel
    from polycnc.language.sinumerik.lexer import Token
    from polycnc.language.sinumerik.names.variables import Variable
    from polycnc.language.sinumerik.statements.definitions import Header
    from polycnc.program import Program

MAX_PASSES = 9999
_CALL = "call_program(channel, {0}, {1}, {2}, {3})"
#: Characters of a search path.
MAX_PATH = 128
#: Digits of a subprogram number behind L, leading zeros included (1.25.1.2).
MAX_DIGITS = 7


# ---- finding programs --------------------------------------------------------------------------------------


def find_program(channel: Channel, name: str) -> Program | None:
    """The program that a call finds from where the channel stands (search order 1.25.1.4); none has too long a name."""
    if is_too_long(split_stored_path(name)[1]):
        return None
    memory: LanguageMemory = channel.memory.language
    directory = channel.level.code.program.directory
    if directory.startswith(EXTERNAL):  # a program from outside calls as the selected program does
        directory = channel.stack[0].code.program.directory
    return channel.store.find_sinumerik(name, directory, (memory.call_path,) if memory.call_path else ())


def _find_in_place_of_cycle(channel: Channel, cycle: str) -> Program | None:
    """The program that runs instead of a cycle of the control; mostly none has its name, and none is searched for."""
    store = channel.store
    return find_program(channel, cycle) if store.reaches_host or cycle in store.bare_names else None


def named_program(channel: Channel, name: str) -> Program:
    """The program of a call; alarm 14011 if there is none."""
    program = find_program(channel, name)
    if program is None:
        raise AlarmError("14011", text=name)
    return program


def _header(channel: NcChannel, program: Program) -> Header:
    return channel.executable(program).whole.header(channel)


# ---- calls -------------------------------------------------------------------------------------------------


def call_program(
    channel: Channel,
    program: Program,
    args: tuple[Any, ...],
    given: tuple[bool, ...],
    passes: int,
    kind: LevelKind = LevelKind.SUBPROGRAM,
) -> None:
    """Go on with a subprogram. Its level keeps in `data` what belongs to this call.

    `given` which parameters were written ($P_SUBPAR), `single_block` whether single block acts, `display`
    what an alarm shows, `saved` what SAVE brings back.
    """
    if not 1 <= passes <= MAX_PASSES:
        raise AlarmError("12100", text=str(passes))
    count_levels(channel)
    push_program(channel, program, args, given, passes, kind)


def push_program(
    channel: Channel,
    program: Program,
    args: tuple[Any, ...],
    given: tuple[bool, ...],
    passes: int,
    kind: LevelKind = LevelKind.SUBPROGRAM,
) -> None:
    """The level of a subprogram whose call is allowed; see `call_program`."""
    header = _header(channel, program)
    saved = channel.control.save(channel) if "SAVE" in header.attributes else None
    caller = channel.level
    level = channel.push(program, kind=kind, repeats=passes - 1, local=list(args))
    level.data["given"] = given
    _inherit(level, caller, header)
    if saved is not None:
        level.data["saved"] = saved


def _inherit(level: Level, caller: Level, header: Header) -> None:
    """Single block and block display hold for called programs too, unless their PROC says otherwise."""
    level.data["single_block"] = caller.data.get("single_block", True) and "SBLOF" not in header.attributes
    level.data["sblof_in_proc"] = "SBLOF" in header.attributes
    display = caller.data.get("display", "on")
    if "DISPLOF" in header.attributes:
        display = "number" if "ACTBLOCNO" in header.attributes else "off"
    elif "DISPLON" in header.attributes:
        display = "on"
    level.data["display"] = display


def program_call(compiler: BlockCompiler) -> None:
    """A program by its name, with parameters and number of passes: `NAME(1,2) P3`, `L123 P=R1`."""
    token = compiler.take()
    if token.kind == "word" and len(token.text) > 1 + MAX_DIGITS:
        raise compiler.error(token)
    compiler.scope.check_word(token)
    is_cycle = token.text in keywords.CYCLES
    find = _find_in_place_of_cycle if is_cycle else find_program
    program = find(compiler.channel, token.text)
    if program is None:
        if is_cycle:
            compiler.call_procedure(token, compiler.scope.arguments(compiler, token, "*"))
            return
        if token.kind == "word" or token.text in compiler.scope.externals:
            raise NcSyntaxError("14011", token.column, token.text)
        raise unknown(token.column, token.text)
    args, given = _arguments(compiler, token, program)
    passes = _passes(compiler)
    called = compiler.emitter.object(program)
    compiler.emitter.run(quoted(_CALL, called, args, given, passes))


def _passes(compiler: BlockCompiler) -> Code:
    token = compiler.token
    if token.kind == "word" and token.letter == "P":
        compiler.take()
        return constant(token.value)
    if compiler.accept("P"):
        compiler.expect("=")
        return compiler.integer()
    return constant(1)


def _arguments(compiler: BlockCompiler, name: Token, program: Program) -> tuple[Code, Code]:
    """Code of the arguments by the PROC line of the program, and which of them were written (1.25.1.6)."""
    header = _header(compiler.channel, program)
    _check_declaration(compiler, name, header)
    codes: list[Code] = []
    given: list[bool] = []
    if compiler.accept("("):
        while not compiler.at(")"):
            if len(codes) == len(header.parameters):
                raise NcSyntaxError("12340", compiler.token.column, name.text)
            written = not compiler.at(",")
            parameter = header.parameters[len(codes)]
            codes.append(
                _argument(compiler, parameter) if written else _left_out(compiler, header, len(codes), name)
            )
            given.append(written)
            if not compiler.accept(","):
                break
        compiler.expect(")")
    for place in range(len(codes), len(header.parameters)):
        codes.append(_left_out(compiler, header, place, name))
        given.append(False)
    return sequence(codes), sequence(map(constant, given))


def _check_declaration(compiler: BlockCompiler, name: Token, header: Header) -> None:
    """12330: EXTERN has told other parameters than PROC has (1.25.3.2)."""
    declared = compiler.scope.externals.get(name.text)
    if declared is None:
        return
    actual = tuple(
        (parameter.by_reference or bool(parameter.dims), parameter.type) for parameter in header.parameters
    )
    if declared != actual:
        raise NcSyntaxError("12330", name.column, name.text)


def _left_out(compiler: BlockCompiler, header: Header, place: int, name: Token) -> Code:
    value = header.first_values[place]
    if value is None:
        raise NcSyntaxError("14010", name.column, header.parameters[place].name)
    return compiler.emitter.object(value)


def _argument(compiler: BlockCompiler, parameter: Variable) -> Code:
    if not parameter.by_reference and not parameter.dims:
        code = compiler.assigned(parameter.type)
        if parameter.is_plain:
            return code
        return quoted("{0}.checked({1})", compiler.emitter.object(parameter), code)
    token = compiler.take()
    if not compiler.scope.is_place(token):
        raise NcSyntaxError("12320", token.column, token.text)
    place = compiler.scope.place(compiler, token)
    if place.type is not parameter.type:
        raise NcSyntaxError("12330", token.column, token.text)
    dims = place.variable.dims if isinstance(place, ElementPlace) and place.offset is None else ()
    if len(dims) != len(parameter.dims) or not all(map(_sizes_fit, dims, parameter.dims)):
        raise NcSyntaxError("12360", token.column, token.text)
    return place.reference(compiler)


def _sizes_fit(size: int, wanted: int) -> bool:
    """Whether an array's size is that of the parameter; an open one takes any, and one that is open itself any one."""
    return size == wanted or not wanted or not size


def call(compiler: BlockCompiler) -> None:
    """CALL text, CALL [text] BLOCK start TO end (1.25.3.5, 1.25.3.6)."""
    compiler.take()
    name = constant("") if compiler.at("BLOCK") else compiler.text()
    if not compiler.accept("BLOCK"):
        compiler.emitter.run(quoted("call_named(channel, {0})", name))
        return
    start = _label_text(compiler)
    compiler.expect("TO")
    end = _label_text(compiler)
    compiler.emitter.run(quoted("call_section(channel, {0}, {1}, {2})", name, start, end))


def _label_text(compiler: BlockCompiler) -> Code:
    """A label as STRING variable or text, or as it stands."""
    token = compiler.token
    if token.kind == "name" and compiler.scope.find(token.text) is None:
        return constant(compiler.take().text)
    return compiler.text()


def call_named(channel: Channel, name: str) -> None:
    """CALL of a program by its name."""
    call_without_arguments(channel, named_program(channel, name))


def call_without_arguments(
    channel: Channel, program: Program, kind: LevelKind = LevelKind.SUBPROGRAM
) -> None:
    """Call a program with all its parameters left out; alarm 14010 if it has one that must be written."""
    header = _header(channel, program)
    call_program(channel, program, header.arguments_left_out(), (False,) * len(header.parameters), 1, kind)


def call_section(channel: NcChannel, name: str, start: str, end: str) -> None:
    """CALL … BLOCK: run a program from one label to another; alarm 14082 if one is missing."""
    program = named_program(channel, name) if name else channel.level.code.program
    code = channel.executable(program).whole
    first = code.find_label(start, 0)
    ends = code.section_ends(first, end, 0) if first >= 0 else set()
    if not ends:
        raise AlarmError("14082", text=start if first < 0 else end)
    caller = channel.level
    local = caller.locals
    call_without_arguments(channel, program)
    level = channel.level
    code.run_definitions(channel)
    level.code = Section(code, ends)
    level.steps = ()
    level.scanner = None
    level.index = level.current = level.entry = first
    if not name:
        level.locals = local


def path_call(compiler: BlockCompiler) -> None:
    """PCALL path(parameters): the path stands without quotes (1.25.3.8)."""
    start = compiler.take()
    line = compiler.program.text(compiler.index)
    while compiler.token.kind != "end" and not compiler.at("("):
        compiler.take()
    path = line[start.end : compiler.token.start].strip()
    program = find_program(compiler.channel, path)
    if program is None:
        raise NcSyntaxError("14011", start.end + 1, path)
    args, given = _arguments(compiler, start, program)
    compiler.emitter.run(quoted(_CALL, compiler.emitter.object(program), args, given, 1))


def modal_call(compiler: BlockCompiler) -> None:
    """MCALL program(parameters): runs after every block with path motion; alone: no more (1.25.3.4)."""
    compiler.take()
    memory = compiler.emitter.object(compiler.scope.memory)
    if compiler.token.kind == "end":
        compiler.emitter.add(assigned(attribute(memory, "modal_call"), constant(None)))
        return
    token = compiler.take()
    if token.kind not in ("name", "word"):
        raise compiler.error(token)
    program = find_program(compiler.channel, token.text)
    if program is not None:
        args, given = _arguments(compiler, token, program)
        called = compiler.emitter.object(program)
        code = quoted("modal_program({0}, {1}, {2})", called, args, given)
    elif token.text in keywords.CYCLES:
        arguments = compiler.scope.arguments(compiler, token, "*")
        compiler.emitter.knows_place = True
        code = quoted("modal_cycle({0}, {1}, {2})", token.text, arguments, token.column)
    else:
        raise NcSyntaxError("14011", token.column, token.text)
    compiler.emitter.add(assigned(attribute(memory, "modal_call"), code))


def modal_program(
    program: Program, args: tuple[Any, ...], given: tuple[bool, ...]
) -> Callable[[Channel], None]:
    """A modal call of a program: the parameters were handed over once."""
    return lambda channel: call_program(channel, program, args, given, 1, LevelKind.MODAL)


def modal_cycle(name: str, args: tuple[Any, ...], column: int) -> Callable[[Channel], None]:
    """A modal call of a cycle of the control."""

    def run(channel: Channel) -> None:
        caller = channel.level
        channel.control.procedure(channel, name, args, column)
        if channel.level is not caller:
            channel.level.kind = LevelKind.MODAL

    return run


def call_modal(channel: Channel) -> None:
    """A block with path motion has ended: run what MCALL has set, unless it is running, or a contour is only read."""
    modal = channel.memory.language.modal_call
    if (
        modal is not None
        and not channel.path.is_diverted
        and all(level.kind is not LevelKind.MODAL for level in channel.stack)
    ):
        modal(channel)


def external_call(compiler: BlockCompiler) -> None:
    """EXTCALL text (1.25.3.10)."""
    compiler.take()
    compiler.emitter.run(quoted("call_external(channel, {0})", compiler.text()))


def call_external(channel: Channel, name: str) -> None:
    """Run a program of the external memory, else of the user memory; alarm 14011 for neither."""
    control = channel.control
    setting = control.system_variable("$SC_EXT_PROG_PATH").read(channel, ())
    program = channel.store.find_external(name, str(setting))
    if program is not None:
        call_without_arguments(channel, program, LevelKind.EXTERNAL)
    else:
        call_named(channel, name)


def iso_call(compiler: BlockCompiler) -> None:
    """ISOCALL text (1.25.3.7)."""
    compiler.take()
    compiler.emitter.run(quoted("call_as_iso(channel, {0})", compiler.text()))


def call_as_iso(channel: NcChannel, name: str) -> None:
    """Call a program in the ISO dialect that is set up, to its end; with none (MD18800) it runs as it is."""
    program = named_program(channel, name)
    if not channel.control.calls_iso(channel):
        call_without_arguments(channel, program)
        return
    channel.executable(program).whole.become_iso()
    call_program(channel, program, (), (), 1)
    channel.level.data[LANGUAGE] = channel.mode["language"]
    channel.mode = channel.mode.with_code("language", "G291")


def search_path(compiler: BlockCompiler) -> None:
    """CALLPATH("directory"), CALLPATH() (1.25.3.9)."""
    compiler.take()
    compiler.expect("(")
    text = constant("") if compiler.at(")") else compiler.text()
    compiler.expect(")")
    compiler.emitter.run(quoted("set_search_path(channel, {0})", text))


def set_search_path(channel: Channel, directory: str) -> None:
    """Search a directory before the cycle directories; alarm 14009 if it does not exist."""
    directory = directory.strip()
    is_path = directory.startswith("/") and len(directory) <= MAX_PATH
    if directory and not (is_path and channel.store.has_directory(directory)):
        raise AlarmError("14009", text=directory)
    memory: LanguageMemory = channel.memory.language
    memory.call_path = directory
    memory.programs.forget_steps()


# ---- returns -----------------------------------------------------------------------------------------------


def return_(compiler: BlockCompiler) -> None:
    """RET, RET(target[,after[,levels[,to_start]]]) (1.25.2.6, 1.25.2.7)."""
    compiler.take()
    if compiler.token.kind == "end":
        compiler.emitter.run(quoted("channel.control.end_of_program(channel)"))
        return
    codes = [constant(""), constant(0), constant(1), constant(False)]
    compiler.expect("(")
    for place, type_ in enumerate((Type.STRING, Type.INT, Type.INT, Type.BOOL)):
        if compiler.at(")"):
            break
        if place:
            compiler.expect(",")
        if not compiler.at(",") and not compiler.at(")"):
            codes[place] = compiler.value(type_)
    compiler.expect(")")
    compiler.emitter.run(quoted("return_to(channel, {0}, {1}, {2}, {3})", *codes))


def return_to(channel: NcChannel, target: str, after: int, levels: int, to_start: bool) -> None:
    """Return over several levels, and go on at a place of the program there; alarm 14080 if it has none.

    A repeated section is a level of its own (1.11).
    """
    if not 1 <= levels < len(channel.stack):
        raise AlarmError("14091", text="RET")
    for _ in range(levels):
        leave(channel)
    if to_start and len(channel.stack) == 1 and not target:
        return
    if target:
        level = channel.level
        index = level.code.whole.find_return_target(target, level.current)
        if index < 0:
            raise AlarmError("14080", text=target)
        level.index = index + 1 if after > 0 else index


def execute_string(compiler: BlockCompiler) -> None:
    """EXECSTRING(text): the text as a block (1.2.3)."""
    compiler.take()
    program = compiler.emitter.object(compiler.program)
    compiler.emitter.run(quoted("{0}.execute_text(channel, {1})", program, compiler.text()))


STATEMENTS: dict[str, Callable[[BlockCompiler], None]] = {
    "CALL": call,
    "PCALL": path_call,
    "MCALL": modal_call,
    "EXTCALL": external_call,
    "ISOCALL": iso_call,
    "CALLPATH": search_path,
    "RET": return_,
    "EXECSTRING": execute_string,
}
provide(
    call_program=call_program,
    call_named=call_named,
    call_as_iso=call_as_iso,
    call_section=call_section,
    call_external=call_external,
    call_modal=call_modal,
    modal_program=modal_program,
    modal_cycle=modal_cycle,
    set_search_path=set_search_path,
    return_to=return_to,
)
