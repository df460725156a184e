"""The memory card of a control: a folder with files that are read and written."""

from __future__ import annotations

from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun import CommandRefused

if TYPE_CHECKING:
    from pathlib import Path

#: Names of files, without a way out of the folder.
_NAME = regex(r"[\w-][\w.+ -]{0,62}")


class Card:
    """The card that is in the control.

    Args:
        folder: The folder that it is; None for no card.
    """

    def __init__(self, folder: Path | None = None) -> None:
        self._folder = folder

    @property
    def files(self) -> list[tuple[str, int]]:
        """Names and sizes of its files, bytes; none without a card."""
        if self._folder is None or not self._folder.is_dir():
            return []
        found = (
            each for each in sorted(self._folder.iterdir()) if each.is_file() and _NAME.fullmatch(each.name)
        )
        return [(each.name, each.stat().st_size) for each in found]

    def path(self, name: str) -> Path:
        """The path of a file, there or not.

        Raises:
            CommandRefused: There is no card, or this is no name of a file.
        """
        if self._folder is None or not self._folder.is_dir():
            raise CommandRefused("screen.no-card")
        path = self._folder / name
        if not _NAME.fullmatch(name) or path.resolve().parent != self._folder.resolve():
            raise CommandRefused("screen.no-file", name=name)
        return path

    def read(self, name: str) -> str:
        """The text of a file; raises `CommandRefused` where it cannot be read."""
        try:
            return self.path(name).read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError):
            raise CommandRefused("screen.no-file", name=name) from None

    def write(self, name: str, content: str) -> None:
        """Write a file, in the place of one with its name; raises `CommandRefused` where that cannot be done."""
        try:
            self.path(name).write_text(content, encoding="utf-8")
        except OSError:
            raise CommandRefused("screen.no-file", name=name) from None
