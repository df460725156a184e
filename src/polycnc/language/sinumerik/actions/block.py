"""A block that is a synchronised action: `ID=1 WHENEVER $AA_IM[X]>10 DO $A_OUT[1]=1` (10.1)."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.expressions.code import constant, quoted, sequence
from polycnc.language.sinumerik.actions.code import KEYWORDS, UNITS, ActionCode, Needs
from polycnc.language.sinumerik.actions.cycle import technology_cycle
from polycnc.language.sinumerik.actions.live import LiveReader
from polycnc.language.sinumerik.errors import NcSyntaxError
from polycnc.language.sinumerik.names.values import Type

if TYPE_CHECKING:
    from polycnc.language.expressions.code import Code
    from polycnc.language.sinumerik.actions.code import Condition
    from polycnc.language.sinumerik.blocks import BlockCompiler
    from polycnc.language.sinumerik.lexer import Token

#: Technology cycles that an action may run.
MOST_CYCLES = 8
#: Effects that belong to the next block alone.
_OF_BLOCK = frozenset({"STOPREOF", "DELDTG()"})


def fine_offset_of_block(compiler: BlockCompiler) -> None:
    """`PUTFTOCF(function,reference,length[,channel[,spindle]])`: FTOC as an action of the next block alone (7.4)."""
    live = LiveReader(compiler)
    tokens = list(live.tokens)
    tokens[live.place] = live.token._replace(text="FTOC")
    live.tokens = tokens
    live.effect()
    if live.token.kind != "end":
        raise live.error()
    _define(compiler, live, "", "", None, "", constant(None))


def action(compiler: BlockCompiler) -> None:
    """`[ID=n] [keyword condition] DO …`: nothing else stands in its block."""
    word, number = _number(compiler)
    live = LiveReader(compiler)
    keyword, unit, condition = "", "", None
    if live.token.text in KEYWORDS:
        keyword = live.take().text
        unit = live.take().text if live.token.text in UNITS else ""
        condition = live.compiled_condition()
    first = live.expect("DO")
    if live.token.kind == "end":
        raise live.error(first)
    cycles = 0
    while live.token.kind != "end":
        cycles += _one(live, compiler)
    if cycles > MOST_CYCLES:
        raise live.refused(first)
    _check(live.needs, word, keyword, first)
    _define(compiler, live, word, keyword, condition, unit, number)


def _define(
    compiler: BlockCompiler,
    live: LiveReader,
    word: str,
    keyword: str,
    condition: Condition | None,
    unit: str,
    number: Code,
) -> None:
    """Let the block hand the action over."""
    compiler.place = live.place
    emitter = compiler.emitter
    made = ActionCode(
        word, keyword, condition, unit, live.compiled_effect(), live.needs, compiler.program.program.name,
        compiler.program.line(compiler.index),
    )  # fmt: skip
    emitter.knows_place = True
    written = "channel.control.define_action(channel, {0}, {1}, {2})"
    emitter.run(quoted(written, emitter.object(made), number, sequence(live.frozen)))


def _number(compiler: BlockCompiler) -> tuple[str, Code]:
    """ID or IDS with its number; no word and None for an action of the next block."""
    if compiler.token.text not in ("ID", "IDS"):
        return "", constant(None)
    word = compiler.take().text
    compiler.expect("=")
    return word, compiler.value(Type.INT)


def _one(live: LiveReader, compiler: BlockCompiler) -> int:
    """Read one effect; whether it is a technology cycle."""
    token = live.token
    if token.text in KEYWORDS or token.text in ("DO", "ID", "IDS"):
        raise live.error()
    cycle = technology_cycle(live, compiler, token)
    if cycle is None:
        live.effect()
        return 0
    return 1


def _check(needs: Needs, word: str, keyword: str, token: Token) -> None:
    """What the manual allows with some keywords only: 10.4.2, 10.4.4, 10.4.5."""
    refused = ""
    if word and needs.words & _OF_BLOCK:
        refused = "STOPREOF" if "STOPREOF" in needs.words else "DELDTG"
    elif "STOPREOF" in needs.words and keyword != "WHEN":
        refused = "STOPREOF"
    elif not word and needs.words & {"M", "H"} and keyword not in ("WHEN", "EVERY"):
        refused = "M" if "M" in needs.words else "H"
    elif "PRESETON" in needs.words and keyword not in ("WHEN", "EVERY"):
        refused = "PRESETON"
    if refused:
        raise NcSyntaxError("12571", token.column, refused)
