"""Reads case files: YAML with the numbers of the trade, so that `033` stays a code and `on` stays a word.

They are read as strictly as setups: no key twice, no bombs of aliases, no depth that no case has.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.machine.documents import CASES, DocumentError, yaml_values
from polycnc.machine.errors import SetupError
from polycnc.messages import UserError
from polycnc.messages.files import read_utf_8, reason_of

if TYPE_CHECKING:
    from pathlib import Path


class UnreadableError(UserError):
    """A case file that cannot be read at all."""


def read_cases(path: Path) -> list[Any]:
    """The list that a case file holds, as plain values.

    Raises:
        UnreadableError: The file cannot be read, is no YAML, or holds no list.
    """
    try:
        content = read_utf_8(path)
    except (OSError, UnicodeError) as error:
        raise UnreadableError("file.unreadable", file=path, reason=reason_of(error)) from error
    try:
        data = yaml_values(content, CASES)
    except DocumentError as bad:
        mistake = SetupError("", bad.line, bad.column, bad.message, **bad.args_by_name)
        raise UnreadableError("case.no-yaml", file=path, reason=mistake.text()) from None
    if data is None:
        return []
    if not isinstance(data, list):
        raise UnreadableError("case.no-list", file=path)
    return data
