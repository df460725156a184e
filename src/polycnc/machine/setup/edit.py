"""Writes values into a setup file in YAML; everything else in it stays, but for comments."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias
from polycnc.machine.documents import yaml_values
from polycnc.machine.setup.file import load_setup, parse_setup
from polycnc.messages.files import read_utf_8

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

#: The values of a setup file.
Document: TypeAlias = "dict[object, object]"


def is_writable(path: Path) -> bool:
    """Whether a setup file is one that can be written: YAML."""
    return path.suffix.lower() != ".toml"


def read_document(path: Path) -> Document:
    """The values of a setup file; none where there is no file yet.

    Raises:
        SetupError: The file cannot be read or is no setup.
    """
    if not path.exists():
        return {}
    load_setup(path)
    found = yaml_values(read_utf_8(path))
    return found if isinstance(found, dict) else {}


def document_text(document: Document, source: str) -> str:
    """The text of a setup file with these values.

    Raises:
        SetupError: The values make no setup.
    """
    parse_setup(document, source=source)
    import yaml

    content: str = yaml.safe_dump(document, sort_keys=False, allow_unicode=True)
    return content


def merge(into: Document, values: Mapping[str, object] | Document) -> None:
    """Put values into a document, table by table; a key counts by its text (`1` and `"1"` are one)."""
    for key, value in values.items():
        present = next((old for old in into if str(old) == str(key)), key)
        below = into.get(present)
        if isinstance(value, dict) and isinstance(below, dict):
            merge(below, value)
        else:
            into[present] = value
