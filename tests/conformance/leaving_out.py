"""Finds cases that prove nothing: what they expect comes as well when the code of their function is left out.

    python -m tests.conformance.leaving_out [FILE…]

A case names a function, and `src/polycnc/data/functions/` says by which codes a program meets it. These codes are cut
out of the case (words of the program, of its files and of what its operator types, statements, parameters and switches
of the setup), all at once and then one by one, and the case runs again. If it passes every time, polycnc might not
know the function at all. A case that holds none of its function's codes is asked for less: there must be a line of its
program or a command of its operator that matters.

`exempt.toml` lists the cases that are meant so, mostly because they show that a code has no effect there.
"""

from __future__ import annotations

import re
import sys
import tomllib
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from polycnc.cases.features import functions
from polycnc.cases.format import Case, CaseError, parse_case
from polycnc.cases.runner import run_case
from tests.conformance.reading import FILES, HERE, cases_in

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from polycnc.cases.format import Step

EXEMPT = HERE / "exempt.toml"
#: What may follow an address: a number, an expression in brackets, a variable, a name.
_VALUE = r'\s*=?\s*(?:[-+]*(?:\d+\.?\d*|\.\d+)|[-+]*\[[^\]]*\]|[-+]*#\w+|[-+]*R\d+|\([^)]*\)|"[^"]*")'
#: A line with nothing but the end of a program.
_END = re.compile(r"\s*(?:N\d+\s*)?(?:M0*(?:2|17|30|99)|RET)\s*;?\s*", re.IGNORECASE)
_BEFORE = r"(?<![A-Z0-9_$#.@])"


#: What an operator does who does nothing; a case without any command would run without a panel.
IDLE: list[Step] = [{"step": 0.0}]


#: Without its code a loop may have no end; cases that end need fewer blocks.
BLOCK_LIMIT = 20_000


class Cut(NamedTuple):
    """A piece of program text to leave out: what `text` finds, or each line that has it."""

    text: re.Pattern[str]
    whole_line: bool = False


def _word(found: re.Match[str]) -> Cut:
    """`G54.1`, `M98`, `M00`: the word itself, with and without leading zeros."""
    letter, whole, decimals = found[1], found[2].lstrip("0") or "0", re.escape(found[3] or "")
    return Cut(_pattern(rf"{_BEFORE}{letter}\s*=?0*{whole}{decimals}(?![.]?\d)"))


def _range(found: re.Match[str]) -> Cut:
    """`G80-G89`, `G00..G99`, `M00-M99`: any of them, also with a decimal (`G84.2`)."""
    numbers = "|".join(str(n) for n in range(int(found[2]), int(found[3]) + 1))
    return Cut(_pattern(rf"{_BEFORE}{found[1]}0*(?:{numbers})(?:[.]\d+)?(?!\d)"))


def _either(found: re.Match[str]) -> Cut:
    """`X/U`, `Q`, `,R`, `DISR=`: an address with its value, or at the end of a line without one."""
    addresses = "|".join(re.escape(address) for address in found[1].split("/"))
    before = "" if found[1].startswith(",") else _BEFORE
    return Cut(_pattern(rf"{before}(?:{addresses})(?:{_VALUE}|$)"))


def _exact(found: re.Match[str]) -> Cut:
    """`X-#1`, `X1.2349`, `/2`, `<<`: the text as it stands."""
    return Cut(_pattern(re.escape(found[0])))


def _name(found: re.Match[str]) -> Cut:
    """`CYCLE81`, `FOR`, `$P_UIFR`, `#3000`, `@656`, `#[#1+2]`: each statement with it."""
    name = re.escape(found[1])
    return Cut(_pattern(rf"(?<![A-Z0-9_$]){name}(?![A-Z0-9_])"), whole_line=True)


def _operator(found: re.Match[str]) -> Cut:
    """`+`, `<=`, `:=`, `&`: each statement with it."""
    return Cut(_pattern(re.escape(found[0])), whole_line=True)


def _any_number(found: re.Match[str]) -> Cut:
    """`R<n>`, `#n =`, `G#n`, `@[ ]`: each statement with a number, a variable or a bracket behind it."""
    return Cut(_pattern(rf"{_BEFORE}{re.escape(found[1])}[\d#@\[]"), whole_line=True)


def _pattern(text: str) -> re.Pattern[str]:
    return re.compile(text, re.IGNORECASE | re.MULTILINE)


#: The forms in which a function's codes are written, the first that fits decides.
FORMS: tuple[tuple[re.Pattern[str], Callable[[re.Match[str]], Cut]], ...] = (
    (re.compile(r"([GMTHDE])(\d+)(\.\d+)?"), _word),
    (re.compile(r"([GM])(\d+)(?:-|\.\.)[GM](\d+)"), _range),
    (re.compile(r"(,?[A-Z]\d?(?:/[A-Z]\d?)*)"), _either),
    (re.compile(r"([A-Z]+\d*)="), _either),
    (re.compile(r"/\d?"), _exact),
    (re.compile(r"[XYZU](?:-*#?\d+\.?\d*\.?|\[.*\])"), _exact),
    (re.compile(r"([A-Z$#@]+)(?:<n>|n|n :?=|\[ ?\]|\[expr\]|#\d*)"), _any_number),
    (re.compile(r"([#@]\d+)(?:=\d+)?"), _name),
    (re.compile(r"(\$?\$?[A-Z_][A-Z0-9_]+)(?:\[.*|\(.*|=.*)?"), _name),
    (re.compile(r"[-+*/=<>:&%]+|\(\* \*\)|'B\.\.'|#\[.*\]|\[#_.*\]|//"), _operator),
)
_PARAMETER = re.compile(r"(?:Pr)?(\d{1,5})(?:-(\d+))?(#\d)?")


@dataclass(frozen=True, slots=True)
class Code:
    """A code of a function: what to leave out of programs, or which parameters (with a bit), or which switch."""

    cut: Cut | None = None
    numbers: range = range(0)
    bit: str = ""
    switch: str = ""

    @classmethod
    def of(cls, listed: str) -> Code | None:
        """The code as the list of functions writes it; none where it is only a remark."""
        text = re.sub(r"\s*\([A-Z/]+\)$", "", listed.strip())
        if number := _PARAMETER.fullmatch(text):
            first = int(number[1])
            return cls(numbers=range(first, int(number[2] or first) + 1), bit=number[3] or "")
        # "G90 R" is a word of a code's block: the code goes, and the word with it is of no use.
        head = text.split(" ")[0] if re.match(r"[GM][\d.]+ ", text) else text
        for form, cut in FORMS:
            if found := form.fullmatch(head):
                return cls(cut=cut(found))
        return cls(switch=text) if text else None

    def without(self, case: Case) -> Case:
        """The case without the code; the same case where it has none."""
        if self.cut is not None:
            program = _left_out(case.program, self.cut)
            files = {name: _left_out(content, self.cut) for name, content in case.files.items()}
            operate = [done for step in case.operate if (done := _done_without(step, self.cut))]
            return case.model_copy(update={"program": program, "files": files, "operate": operate})
        part = "switches" if self.switch else "parameters"
        given = case.setup.get(part)
        if not isinstance(given, dict):
            return case
        kept = {key: value for key, value in given.items() if not self._sets(str(key))}
        return case.model_copy(update={"setup": case.setup | {part: kept}})

    def _sets(self, key: str) -> bool:
        if self.switch:
            return key == self.switch
        found = _PARAMETER.match(key)
        return found is not None and int(found[1]) in self.numbers and self.bit in {"", found[3] or ""}


@dataclass(frozen=True, slots=True)
class Codes:
    """The codes by which a program meets a function."""

    codes: tuple[Code, ...]

    @classmethod
    def of(cls, feature: str) -> Codes:
        """The codes of a function; none where the list of functions has none."""
        listed = str(functions().entry(feature).get("codes", "")) if feature in functions() else ""
        return cls(tuple(code for text in re.split(r",\s+", listed) if (code := Code.of(text))))

    def without(self, case: Case) -> Case | None:
        """The case without any of the codes; nothing where it has none."""
        shorter = case
        for code in self.codes:
            shorter = code.without(shorter)
        return None if _same(shorter, case) else shorter

    def without_one(self, case: Case) -> Iterator[Case]:
        """The case without each code that it has, one by one."""
        for code in self.codes:
            shorter = code.without(case)
            if not _same(shorter, case):
                yield shorter


def _left_out(program: str, cut: Cut) -> str:
    lines = program.split("\n")
    if cut.whole_line:
        return "\n".join("" if cut.text.search(line) else line for line in lines)
    return "\n".join(cut.text.sub("", line) for line in lines)


def _done_without(step: Step, cut: Cut) -> Step | None:
    """A command of the operator, cut where he types a program; none where the command itself is left out."""
    name = step if isinstance(step, str) else next(iter(step))
    if cut.whole_line and cut.text.fullmatch(name):
        return None
    if isinstance(step, str) or not isinstance(typed := step.get("mdi"), str):
        return step
    return {"mdi": _left_out(typed, cut)}


def _same(one: Case, other: Case) -> bool:
    return (one.program, one.files, one.operate, one.setup) == (
        other.program,
        other.files,
        other.operate,
        other.setup,
    )


def proves_nothing(case: Case, folder: Path) -> bool:
    """Whether a case that passes would pass as well if its function were left out of its program."""
    codes = Codes.of(case.feature)
    shorter = codes.without(case)
    tried = _without_a_part(case) if shorter is None else chain([shorter], codes.without_one(case))
    return all(run_case(without, folder, BLOCK_LIMIT).status == "passed" for without in tried)


def _without_a_part(case: Case) -> Iterator[Case]:
    """The case without one line of its program, the last lines first, one of its commands, its files.

    The end of the program stays: programs without one alarm.
    """
    lines = case.program.split("\n")
    for number in reversed(range(len(lines))):
        if lines[number].strip() and not _END.fullmatch(lines[number]):
            yield case.model_copy(update={"program": "\n".join([*lines[:number], "", *lines[number + 1 :]])})
    for number in range(len(case.operate)):
        others = [*case.operate[:number], *case.operate[number + 1 :]]
        yield case.model_copy(update={"operate": others or IDLE})
    if case.files:
        yield case.model_copy(update={"files": {}})


def cases(paths: list[Path]) -> Iterator[tuple[Path, Case]]:
    """All cases of files, each with its file."""
    for path in paths:
        for data in cases_in(path):
            yield path, parse_case(data)


def exempt() -> dict[str, str]:
    """Case id to the reason why it may hold without its function's code."""
    return {str(case): str(why) for case, why in tomllib.loads(EXEMPT.read_text(encoding="utf-8")).items()}


def main(arguments: list[str]) -> int:
    """Print each case that proves nothing, with its file and function; status 1 if there is one."""
    found = 0
    known = exempt()
    for path, case in cases([Path(name) for name in arguments] or FILES):
        try:
            empty = proves_nothing(case, path.parent)
        except CaseError as error:
            sys.stderr.write(f"{path.name}: {case.id}: {error}\n")
            continue
        if empty and case.id not in known:
            found += 1
            sys.stdout.write(f"{path.parent.name}/{path.name}: {case.id} [{case.feature}]\n")
    sys.stdout.write(f"{found} cases prove nothing\n")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
