"""What is said when a program file cannot be used: a value with a message id, never a raw `OSError`."""

from __future__ import annotations

from functools import cache

from polycnc.deferred.paths import package_path
from polycnc.messages import Catalogue, UserError


@cache
def texts() -> Catalogue:
    """The texts of this folder: file errors and the reasons of `detect`."""
    return Catalogue(package_path("program", "messages.toml"))


class ProgramFileError(UserError):
    """A file or folder of programs cannot be used; the command line ends with status 2.

    Args:
        message: Message id in `messages.toml`, such as `program.missing`.
        path: The file or folder as the user named it: the placeholder that all these texts share.
        args: Values for the other placeholders of the text.
    """

    def __init__(self, message: str, path: str, **args: object) -> None:
        super().__init__(message, path=path, **args)
        self.path = path

    def catalogue(self) -> Catalogue:
        """The texts of this folder."""
        return texts()
