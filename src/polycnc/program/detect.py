"""Which control a program is written for, where the text leaves no doubt.

A wrong control runs a program wrongly, so this names one only on evidence that no other control in the table
would accept, and none at all if the evidence disagrees. Mills of FANUC and MELDAS share nearly all words:
their programs usually stay unnamed and the user is asked.
"""

from __future__ import annotations

import re

from polycnc.deferred.records import dataclass
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.program.errors import texts
from polycnc.program.program import Form, Program

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

READ_LINES = 20_000
"""So many lines are looked at; posts put what tells the control at the beginning."""

#: What is a comment, a text or an argument list in some family. Posts write tool lists in the words of other controls.
_NO_CODE = regex(r'"[^"\n]*"|;[^\n]*|//[^\n]*|\(\*.*?\*\)', re.DOTALL)
_INNER_BRACKETS = regex(r"\(([^()\n]*)(?:\)|$)", re.MULTILINE)
#: Flow control of another interpreter: `o100 while`, `o<name> endif`.
_O_WORD = regex(
    r"^\s*(?:N\d+\s*)?O(?:\d+|<\w+>|#\d+)\s*(?:sub|endsub|call|if|elseif|else|endif|while|endwhile|do|repeat|endrepeat"
    r"|return|break|continue)\b[^\n]*",
    re.IGNORECASE | re.MULTILINE,
)


@dataclass(frozen=True, slots=True)
class Reason:
    """One piece of evidence: message id, the line of the file (0 if none), and what stands there."""

    message: str
    line: int = 0
    found: str = ""

    def text(self, lang: str | None = None) -> str:
        """The reason in words."""
        return texts().text(self.message, lang, line=self.line, found=self.found)


@dataclass(frozen=True, slots=True)
class Guess:
    """The control id, or None where it is not certain, and every reason found for any control."""

    control: str | None
    reasons: tuple[Reason, ...] = ()


@dataclass(frozen=True, slots=True)
class _Evidence:
    """Words of one control. `beside` must stand somewhere in the program too."""

    control: str
    message: str
    pattern: re.Pattern[str]
    beside: re.Pattern[str] | None = None


def _words(pattern: str) -> re.Pattern[str]:
    return regex(pattern, re.IGNORECASE | re.MULTILINE)


_AT_BLOCK_START = r"^\s*(?:N\d+\s*)?"
_NOT_IN_NAME = r"(?<![\w$])"

_EVIDENCE = (
    _Evidence("syntec-mill", "detect.assignment", _words(r"[#@]\d+\s*:=")),
    _Evidence(
        "sinumerik-840d",
        "detect.sinumerik-declaration",
        _words(
            _AT_BLOCK_START
            + r"(?:DEF\s+(?:(?:NCK|CHAN|SYNR|SYNW|SYNRW)\s+)*(?:REAL|INT|BOOL|CHAR|STRING|AXIS|FRAME)\b"
            r"|PROC\s+[A-Z_]\w+|EXTERN\s+[A-Z_]\w+|DEFINE\s+\w+\s+AS\b)"
        ),
    ),
    _Evidence(
        "sinumerik-840d",
        "detect.sinumerik-variable",
        _words(
            _NOT_IN_NAME + r"(?:\$(?:TC|MA|MC|MN|SA|SC|SN|P|A|AA|AC|AN|VA|VC|C)_[A-Z]\w*|R\d{1,3}\s*=(?!=))"
        ),
    ),
    _Evidence(
        "sinumerik-840d",
        "detect.sinumerik-command",
        _words(
            _NOT_IN_NAME
            + r"(?:(?:GOTO[BCFS]|STOPRE|SUPA|TRAORI|TRAFOOF|TRANSMIT|TRACYL|MCALL|EXTCALL|DISPLOF|SBLOF"
            r"|DIAMO[NF]|ENDIF|ENDLOOP|ENDWHILE)\b|CR\s*=|[A-Z]\d?\s*=\s*(?:IC|AC|DC|ACP|ACN)\s*\()"
        ),
    ),
    _Evidence(
        "sinumerik-840d",
        "detect.sinumerik-cycle",
        _words(
            _NOT_IN_NAME + r"(?:CYCLE\d{2,4}|POCKET[1-4]|HOLES[12]|SLOT[12]|LONGHOLE|WORKPIECE|CONTPRON)\s*\("
        ),
    ),
    _Evidence(
        "fanuc-0i-tf",
        "detect.turning-cycle",
        _words(r"(?<![A-Z\d.])G7[0-2](?![\d.])[^\n]*?P\s*\d+\s*Q\s*\d+"),
    ),
    _Evidence("fanuc-0i-tf", "detect.speed-limit", _words(_AT_BLOCK_START + r"G50\s*S\s*\d+")),
    _Evidence(
        "fanuc-0i-tf",
        "detect.lathe-tool",
        _words(r"(?<![A-Z])T\s*\d{4,5}(?!\d)"),
        beside=_words(r"(?<![A-Z\d.])G96(?![\d.])"),
    ),
    _Evidence("fanuc-m", "detect.fanuc-named-variable", _words(r"\[#_[A-Z]\w*")),
    _Evidence(
        "fanuc-m",
        "detect.fanuc-command",
        _words(_AT_BLOCK_START + r"(?:SETVN\s*\d+\s*\[|BPRNT\s*\[|G10\s*L52(?!\d))"),
    ),
)
"""Words that one control has and the others refuse. Data: a new row needs no code."""

_SINUMERIK_SUFFIXES = (".mpf", ".spf")


def guess_control(programs: Sequence[Program], name: str = "") -> Guess:
    """Guess the control from the programs of one file.

    Args:
        programs: As `load_programs` or `split_programs` gives them for a file of unknown control.
        name: Name of the file; empty to take that of the first program.
    """
    form = programs[0].form
    first_line = programs[0].first_line
    if form is Form.MACRO:
        return Guess("syntec-mill", (Reason("detect.macro-header", max(first_line - 1, 1)),))
    if form is Form.SINUMERIK:
        return Guess("sinumerik-840d", (_header_reason(programs[0]),))
    reasons = list(_found_in(programs))
    suffix = "." + (name or programs[0].path or programs[0].name).rpartition(".")[2].lower()
    if suffix in _SINUMERIK_SUFFIXES:
        reasons.insert(0, ("sinumerik-840d", Reason("detect.sinumerik-suffix", found=suffix.upper())))
    controls = {_family(control, reasons) for control, _ in reasons}
    certain = controls.pop() if len(controls) == 1 else None
    return Guess(certain, tuple(reason for _, reason in reasons))


def _header_reason(program: Program) -> Reason:
    """A header in comments is still in the text; that of an archive unit stood in the line above it."""
    for index, line in enumerate(program.lines[:10]):
        if re.match(r"\s*;\s*(?:%\s*_N_|\$PATH)", line, re.IGNORECASE):
            return Reason("detect.archive-header", program.line_number(index), line.strip())
    return Reason("detect.archive-header", max(program.first_line - 1, 1), program.name)


def _family(control: str, reasons: list[tuple[str, Reason]]) -> str:
    """What only FANUC has does not speak against a FANUC lathe."""
    is_lathe = any(each == "fanuc-0i-tf" for each, _ in reasons)
    return "fanuc-0i-tf" if control == "fanuc-m" and is_lathe else control


def _found_in(programs: Sequence[Program]) -> Iterable[tuple[str, Reason]]:
    """The first place of each piece of evidence."""
    open_rows = list(_EVIDENCE)
    left = READ_LINES
    for program in programs:
        text = "\n".join(program.lines[:left])
        left -= min(left, len(program.lines))
        code = _code_of(text)
        for row in list(open_rows):
            match = row.pattern.search(code)
            if match and (row.beside is None or row.beside.search(code)):
                open_rows.remove(row)
                line = program.line_number(code.count("\n", 0, match.start()))
                yield row.control, Reason(row.message, line, match[0].strip())


def _code_of(text: str) -> str:
    """The text with blanks in place of all that is a comment in any family; columns and lines stay."""
    code = _O_WORD.sub(_blank, _NO_CODE.sub(_blank, text))
    while (emptied := _INNER_BRACKETS.sub(_emptied, code)) != code:
        code = emptied
    return code.replace("\x01", "(")


def _emptied(match: re.Match[str]) -> str:
    """A pair of brackets without what stands between; the opening one is marked as done."""
    return "\x01" + " " * (len(match[0]) - 1)


def _blank(match: re.Match[str]) -> str:
    return "".join("\n" if char == "\n" else " " for char in match[0])
