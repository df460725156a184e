"""What is said when a program file cannot be used: a value with a message id, never a raw `OSError`."""

from __future__ import annotations

from functools import cache
from importlib import resources

from polycnc.messages import Catalogue


@cache
def texts() -> Catalogue:
    """The texts of this folder: file errors and the reasons of `detect`."""
    return Catalogue(resources.files("polycnc.program").joinpath("messages.toml"))


class ProgramFileError(Exception):
    """A file or folder of programs cannot be used; the command line ends with status 2.

    Args:
        message: Message id in `messages.toml`, such as `program.missing`.
        path: The file or folder as the user named it.
        args: Values for the other placeholders of the text.
    """

    def __init__(self, message: str, path: str, **args: object) -> None:
        super().__init__(message, path, args)
        self.message = message
        self.path = path
        self.args_by_name = args

    def text(self, lang: str | None = None) -> str:
        """The message in the given language, or in the active one."""
        return texts().text(self.message, lang, path=self.path, **self.args_by_name)

    def __str__(self) -> str:
        return self.text()
