"""Reads case files: YAML with the numbers of the trade, so that `033` stays a code and `on` stays a word."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import yaml

from polycnc.messages import UserError
from polycnc.messages.files import read_utf_8, reason_of

if TYPE_CHECKING:
    from pathlib import Path

_Base: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


class _CaseLoader(_Base):  # type: ignore[misc]  # the C loader where PyYAML has it
    """Scalars of YAML 1.2: no octal `033`, no sexagesimal `1:30`, no dates, no `on`/`off`."""


_CaseLoader.yaml_implicit_resolvers = {}
for _tag, _pattern, _first in (
    ("bool", r"true|True|TRUE|false|False|FALSE", "tTfF"),
    ("null", r"null|Null|NULL|~|", ["n", "N", "~", ""]),
    ("int", r"[-+]?(?:0|[1-9][0-9]*)|0x[0-9a-fA-F]+", "-+0123456789"),
    ("float", r"[-+]?(?:\.[0-9]+|[0-9]+\.[0-9]*|[0-9]+(?=[eE]))(?:[eE][-+]?[0-9]+)?", "-+.0123456789"),
):
    _CaseLoader.add_implicit_resolver(
        f"tag:yaml.org,2002:{_tag}", re.compile(rf"^(?:{_pattern})$"), list(_first)
    )


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
        data = yaml.load(content, Loader=_CaseLoader)
    except yaml.YAMLError as error:
        raise UnreadableError("case.no-yaml", file=path, reason=" ".join(str(error).split())) from error
    if data is None:
        return []
    if not isinstance(data, list):
        raise UnreadableError("case.no-list", file=path)
    return data
