"""What a control says when it refuses to go on.

An alarm is a value. It is raised inside a channel as `AlarmError`, which knows only the cause; the channel adds the
place at the block boundary and keeps the resulting `Alarm`.
"""

from __future__ import annotations

from polycnc.deferred.records import dataclass, field, replace
from polycnc.deferred.typing import TYPE_CHECKING, Literal
from polycnc.messages.catalogue import language, text

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.messages.catalogue import Catalogue


class AlarmError(Exception):
    """The cause of an alarm, raised where it is found.

    Args:
        code: The control's own code, such as `PS0010`, `COR-006` or `12080`.
        column: Column in the block, from 1; 0 when the whole block is meant.
        line: Line of the program, where it is not the running block (found by a stage that looks ahead).
        program: Number of the program in the toolpath, where it is not the running one.
        address: Word or code of the block (`X`, `G41`) whose column is to be looked up.
        hint: Message id of what the user can do about this very case, beside the catalogue's general remedy.
        detail: Free text that replaces the catalogue's text (user alarms such as `#3000`).
        args: Values for the placeholders of the text.
    """

    def __init__(
        self,
        code: str,
        /,
        *,
        column: int = 0,
        line: int = 0,
        program: int | None = None,
        address: str = "",
        hint: str = "",
        detail: str = "",
        **args: object,
    ) -> None:
        super().__init__(code)
        self.code = code
        self.column = column
        self.line = line
        self.program = program
        self.address = address
        self.hint = hint
        self.detail = detail
        self.args_by_name: Mapping[str, object] = args


@dataclass(frozen=True, slots=True)
class Alarm:
    """An alarm with its place.

    Attributes:
        control: Id of the control.
        code: The control's own code.
        program: Name of the program; empty where none runs.
        line: Line of the program, from 1; 0 is unknown.
        column: Column of the line, from 1; 0 is unknown.
        block: Text of the block.
        args: Values for the placeholders of the text.
        hint: Message id of what the user can do about this very case.
        detail: Free text that replaces the catalogue's.
        file: Path of the program's file; empty where it came as a text.
        call_chain: Programs that have called this one, from outside in, and the lines where they did.
        channel: Number of the channel that raises it; 0 where the control or the machine does.
        catalogue: Where its texts stand; None as long as nobody reads it.
    """

    control: str
    code: str
    program: str = ""
    line: int = 0
    column: int = 0
    block: str = ""
    args: Mapping[str, object] = field(default_factory=dict)
    hint: str = ""
    detail: str = ""
    file: str = ""
    call_chain: tuple[tuple[str, int], ...] = ()
    channel: int = 0
    catalogue: Catalogue | None = field(default=None, compare=False, repr=False)

    def told_by(self, catalogue: Catalogue) -> Alarm:
        """The same alarm with its texts."""
        return self if self.catalogue is catalogue else replace(self, catalogue=catalogue)

    @property
    def text(self) -> str:
        """What it says, in the active language."""
        return self.text_in(language())

    @property
    def cause(self) -> str:
        """Why it comes, in the active language; empty where the catalogue does not tell."""
        return self.note_in("cause", language())

    @property
    def remedy(self) -> str:
        """What to do about it, in the active language; empty where the catalogue does not tell."""
        return self.note_in("remedy", language())

    def text_in(self, lang: str) -> str:
        """What it says in a language, with the hint on this very case if there is one."""
        known = self.catalogue is not None and self.code in self.catalogue
        told = self.detail or (
            self.catalogue.text(self.code, lang, **self.args) if known and self.catalogue else ""
        )
        hint = text(self.hint, lang, **self.args) if self.hint else ""
        return (": " if lang == "en" else "：").join(filter(None, (told, hint)))

    def note_in(self, kind: Literal["cause", "remedy"], lang: str) -> str:
        """Cause or remedy in a language."""
        if self.catalogue is None or self.code not in self.catalogue:
            return ""
        return self.catalogue.note(self.code, kind, lang, self.args)

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file or self.program, self.line, self.column) if part)
        return f"{place}: {self.code} {self.text}".removeprefix(": ").rstrip()
