"""What is wrong with a machine or setup file, with the place, as a value that every language can show."""

from __future__ import annotations

from functools import cache

from polycnc.deferred.paths import package_path
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import Catalogue, UserError
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping


@cache
def catalogue() -> Catalogue:
    """The texts of this folder."""
    return Catalogue(package_path("machine", "messages.toml"))


def meant_by(key: str, here: Collection[str], levels: Mapping[str, Collection[str]]) -> dict[str, str]:
    """What an unknown key was probably meant to be: values for the placeholders of the text `unknown-key`.

    Args:
        key: As it was typed.
        here: The keys of the table that it stands in.
        levels: The keys of all tables of such a file by their places; empty for the top level.
    """
    near, known = _nearest(key, here), set().union(*levels.values())
    name = key if key in known or near else _nearest(key, known)
    places = listed(place for place, keys in levels.items() if place and name in keys)
    top = name if name and name in levels.get("", ()) else ""
    return {"near": near, "name": name, "places": places, "top": top}


def _nearest(key: str, known: Iterable[str]) -> str:
    """The known key that is nearest to a mistyped one, or an empty text."""
    from difflib import get_close_matches

    return next(iter(get_close_matches(key, sorted(known), 1, 0.7)), "")


class FileError(UserError):
    """A mistake in a file that the user wrote; the text is `file:line:column: what is wrong`.

    Args:
        path: The file as the user named it, or what stands for it (a case id); may be empty.
        line: From 1; 0 when the whole file is meant.
        column: From 1; 0 when the whole line is meant.
        message: Id of the text in the folder's catalogue.
        args: Values for the placeholders of the text.
    """

    def __init__(self, path: str, line: int, column: int, message: str, **args: object) -> None:
        super().__init__(message, **args)
        self.path = path
        self.line = line
        self.column = column

    def catalogue(self) -> Catalogue:
        """The texts of this folder."""
        return catalogue()

    def text(self, lang: str | None = None) -> str:
        """What is wrong, behind the parts of the place that are known."""
        place = ":".join(str(part) for part in (self.path, self.line, self.column) if part)
        message = super().text(lang)
        return f"{place}: {message}" if place else message


class MachineFileError(FileError):
    """A mistake in a machine file."""


class SetupError(FileError):
    """A mistake in a setup file, or in the `setup` of a case."""
