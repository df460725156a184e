"""Flow of a program: jumps, CASE, control structures, repetition of sections (job planning 1.10 to 1.12)."""

from __future__ import annotations

from polycnc.channel.stack import LevelKind
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.expressions import nodes
from polycnc.language.expressions.code import (
    Code,
    assigned,
    compared,
    constant,
    given,
    name,
    negation,
    quoted,
    when,
)
from polycnc.language.sinumerik.emitter import Branch, provide
from polycnc.language.sinumerik.errors import NcSyntaxError
from polycnc.language.sinumerik.expressions import Expr
from polycnc.language.sinumerik.names.values import Type
from polycnc.language.sinumerik.statements.sections import Section, count_levels
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.language.sinumerik.blocks import BlockCompiler
    from polycnc.language.sinumerik.executable import SinumerikProgram
    from polycnc.language.sinumerik.lexer import Token
    from polycnc.language.sinumerik.statements.structures import Structure

_REPEAT = "repeat_section(channel, {0}, {1}, {2}, {3})"
_LOOPS = frozenset({"LOOP", "WHILE", "FOR", "REPEAT"})
JUMPS = ("GOTO", "GOTOF", "GOTOB", "GOTOC")


def _refuse_external(compiler: BlockCompiler, word: Token) -> None:
    """12500: a program that EXTCALL runs from outside can only be read once, from start to end (1.25.3.10)."""
    if compiler.channel.level.kind is LevelKind.EXTERNAL:
        raise NcSyntaxError("12500", word.column, word.text)


# ---- jumps (1.10) ------------------------------------------------------------------------------------------


def _target(compiler: BlockCompiler) -> Code:
    """Code of a jump target: label, block number, or a text that names one."""
    token = compiler.token
    variable = compiler.scope.find(token.text) if token.kind == "name" else None
    if token.kind == "op" and token.text == ":":
        compiler.take()
        number = compiler.take()
        return constant(f":{number.value}")
    if token.kind in ("name", "word") and (variable is None or variable.type is not Type.STRING):
        compiler.take()
        return constant(token.text)
    if token.kind == "end":
        raise compiler.error()
    return compiler.value(Type.STRING)


def jump(compiler: BlockCompiler) -> None:
    """GOTO, GOTOF, GOTOB, GOTOC alone in a block."""
    compiler.emitter.add(read_jump(compiler))


def read_jump(compiler: BlockCompiler) -> Code:
    """Read a jump; the step ends there."""
    word = compiler.take()
    if word.text not in JUMPS:
        raise compiler.error(word)
    _refuse_external(compiler, word)
    program = compiler.emitter.object(compiler.program)
    compiler.emitter.leaves = True
    return given(quoted("jump(channel, {0}, {1}, {2})", program, word.text, _target(compiler)))


def jump_to(channel: Channel, program: SinumerikProgram, word: str, target: str) -> None:
    """Go on at a target; alarm 14080 if the search finds none (GOTOC: go on with the next block)."""
    level = channel.level
    index = program.find_target(target, level.current, word)
    if index >= 0:
        level.index = index
    elif word != "GOTOC":
        raise AlarmError("14080", text=target)


def restart(compiler: BlockCompiler) -> None:
    """GOTOS: back to the program start behind its definitions, if the PLC wants it (1.10.1)."""
    compiler.take()
    compiler.emitter.uses_stop = compiler.emitter.knows_place = True
    index = compiler.program.first_statement
    compiler.emitter.add(quoted("if channel.control.restarts(channel): channel.level.index = {0}", index))


def case(compiler: BlockCompiler) -> None:
    """CASE (expression) OF constant GOTOF target … DEFAULT GOTOF target (1.10.3)."""
    _refuse_external(compiler, compiler.take())
    chosen = name("case")
    compiler.emitter.add(assigned(chosen, compiler.value(Type.INT)))
    compiler.expect("OF")
    while compiler.token.kind != "end":
        if compiler.accept("DEFAULT"):
            compiler.emitter.add(read_jump(compiler))
            return
        meant = compared(chosen, nodes.Eq, compiler.value(Type.INT))
        compiler.emitter.add(when(meant, (read_jump(compiler),)))


def branch(compiler: BlockCompiler) -> None:
    """IF: one or several conditional jumps, or the beginning of a structure (1.10.2, 1.12.1)."""
    start = compiler.take()
    condition = compiler.condition()
    if compiler.token.kind == "end":
        structure = _structure(compiler, start)
        compiler.emitter.branch = Branch("IF", negation(condition), structure.otherwise)
        return
    compiler.emitter.can_join = True
    while True:
        compiler.emitter.add(when(condition, (read_jump(compiler),)))
        if not compiler.accept("IF"):
            return
        condition = compiler.condition()


# ---- control structures (1.12) -----------------------------------------------------------------------------


def _structure(compiler: BlockCompiler, word: Token) -> Structure:
    """The structure of the block; 12630 if the block has a label or can be skipped."""
    compiler.emitter.knows_place = compiler.emitter.can_join = True
    if word.text in _LOOPS:
        _refuse_external(compiler, word)
    if compiler.marked:
        raise NcSyntaxError("12630", word.column, word.text)
    return compiler.program.structure(compiler.index, word)


def otherwise(compiler: BlockCompiler) -> None:
    """ELSE, reached from above: the branch is over."""
    compiler.emitter.branch = Branch("ELSE", None, _structure(compiler, compiler.take()).end + 1)


def end_if(compiler: BlockCompiler) -> None:
    """ENDIF."""
    _structure(compiler, compiler.take())
    compiler.emitter.branch = Branch("ENDIF")


def loop(compiler: BlockCompiler) -> None:
    """LOOP."""
    _structure(compiler, compiler.take())
    compiler.emitter.branch = Branch("LOOP")


def end_loop(compiler: BlockCompiler) -> None:
    """ENDLOOP."""
    compiler.emitter.branch = Branch("ENDLOOP", None, _structure(compiler, compiler.take()).start + 1)


def while_(compiler: BlockCompiler) -> None:
    """WHILE condition."""
    end = _structure(compiler, compiler.take()).end
    compiler.emitter.branch = Branch("WHILE", negation(compiler.condition()), end + 1)


def end_while(compiler: BlockCompiler) -> None:
    """ENDWHILE: the condition decides at the beginning."""
    compiler.emitter.branch = Branch("ENDWHILE", None, _structure(compiler, compiler.take()).start)


def until(compiler: BlockCompiler) -> None:
    """UNTIL condition: the loop ends when it becomes true."""
    start = _structure(compiler, compiler.take()).start
    compiler.emitter.branch = Branch("UNTIL", negation(compiler.condition()), start + 1)


def for_(compiler: BlockCompiler) -> None:
    """FOR variable=start TO end: no pass if the start is beyond the end."""
    end = _structure(compiler, compiler.take()).end
    compiler.emitter.branch = Branch("FOR", negation(_count(compiler, first=True)), end + 1)


def end_for(compiler: BlockCompiler) -> None:
    """ENDFOR: count up, and go back while the end value is not exceeded."""
    start = _structure(compiler, compiler.take()).start
    if compiler.token.kind != "end":
        raise compiler.error()
    compiler.tokens = compiler.program.tokens(start, compiler.channel)
    compiler.place = 1
    compiler.emitter.branch = Branch("ENDFOR", _count(compiler, first=False), start + 1)


def _count(compiler: BlockCompiler, *, first: bool) -> Code:
    """Read `variable=start TO end`; add the assignment, and return the code of `variable <= end`."""
    token = compiler.take()
    if not compiler.scope.is_place(token):
        raise compiler.error(token)
    place = compiler.scope.place(compiler, token)
    if place.type not in (Type.INT, Type.REAL):
        raise NcSyntaxError("12150", token.column, token.text)
    compiler.expect("=")
    start = compiler.value(Type.INT)
    value = place.read(compiler)
    counted = quoted("checked_int({0})", start) if first else quoted("{0} + 1", value.code)
    place.write(
        compiler, compiler.converted(Expr(counted, Type.INT if first else place.type), place.type, token)
    )
    compiler.expect("TO")
    return compared(value.code, nodes.LtE, compiler.value(Type.INT))


# ---- repetition of program sections (1.11) -----------------------------------------------------------------


def repeat(compiler: BlockCompiler) -> None:
    """REPEAT: without a label a loop with UNTIL, else a section of the program once more."""
    word = compiler.take()
    if compiler.token.kind == "end":
        _structure(compiler, word)
        compiler.emitter.branch = Branch("REPEAT")
        return
    _refuse_external(compiler, word)
    first = compiler.take()
    last = compiler.take().text if compiler.token.kind == "name" and compiler.token.text != "P" else ""
    count = _passes(compiler)
    program = compiler.emitter.object(compiler.program)
    compiler.emitter.run(quoted(_REPEAT, program, first.text, last, count))


def repeat_block(compiler: BlockCompiler) -> None:
    """REPEATB label P=n: the line of the label."""
    _refuse_external(compiler, compiler.take())
    label = compiler.take()
    program = compiler.emitter.object(compiler.program)
    compiler.emitter.run(quoted(_REPEAT, program, label.text, label.text, _passes(compiler)))


def _passes(compiler: BlockCompiler) -> Code:
    token = compiler.token
    if token.kind == "end":
        return constant(1)
    if token.kind == "word" and token.letter == "P":
        return constant(compiler.take().value)
    compiler.expect("P")
    compiler.accept("=")
    return compiler.value(Type.INT)


def repeat_section(channel: Channel, program: SinumerikProgram, first: str, last: str, passes: int) -> None:
    """Run a section as a level of its own; alarm 14082 if a label is missing.

    Two labels, and one without ENDLABEL, stand before REPEAT: the search goes towards the start alone (1.11).
    """
    level = channel.level
    here = level.current
    start = program.find_label(first, here)
    if start < 0 or (start > here and last not in ("", first)):
        raise AlarmError("14082", text=first)
    ends = program.section_ends(start, last, here)
    if not ends:
        raise AlarmError("14082", text=last or first)
    if passes <= 0:
        return
    count_levels(channel)
    section = Section(program, ends, here)
    channel.stack.append(
        replace(
            level,
            code=section,
            index=start,
            current=start,
            entry=start,
            repeats=passes - 1,
            kind=LevelKind.SECTION,
            scanner=None,
        )
    )
    channel.level = channel.stack[-1]


STATEMENTS: dict[str, Callable[[BlockCompiler], None]] = {
    **dict.fromkeys(JUMPS, jump),
    "GOTOS": restart,
    "CASE": case,
    "IF": branch,
    "ELSE": otherwise,
    "ENDIF": end_if,
    "LOOP": loop,
    "ENDLOOP": end_loop,
    "WHILE": while_,
    "ENDWHILE": end_while,
    "FOR": for_,
    "ENDFOR": end_for,
    "REPEAT": repeat,
    "UNTIL": until,
    "REPEATB": repeat_block,
}
provide(jump=jump_to, repeat_section=repeat_section)
