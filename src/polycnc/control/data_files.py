"""Data files: what a control keeps, as the text that it punches and reads."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Any, Protocol
from polycnc.messages import UserError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel


class DataFileError(UserError):
    """A data file that a control refuses: the line, and why (a text of the table `data`)."""

    def __init__(self, line: int, reason: str, **args: str) -> None:
        super().__init__(f"data.{reason}", **args)
        self.line = line


class Taken(Protocol):
    """What a file has written."""

    @property
    def blocks(self) -> int:
        """How many blocks."""


class DataFiles(Protocol):
    """The data files of a control.

    Attributes:
        KINDS: What can be written, with the control's name for the file.
    """

    @property
    def KINDS(self) -> Mapping[str, str]:  # noqa: N802 - a constant of a module
        """What can be written, with the control's name for the file."""

    def write(self, channel: Channel, kind: str) -> str:
        """The file of a kind of data."""

    def read(self, channel: Channel, content: str) -> Any:
        """Take a file over, whole or not at all; raises `DataFileError`. Gives a `Taken`."""

    def as_setup(self, channel: Channel, taken: Any) -> dict[str, dict[Any, Any]]:
        """What a file has written, as a setup writes it."""


def data_files(control: object) -> DataFiles | None:
    """The data files of a control; None where polycnc knows none."""
    found: DataFiles | None = getattr(control, "data_files", None)
    return found
