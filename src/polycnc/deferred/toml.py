"""TOML, whose library is loaded by documents that are not plain.

The library takes as long to load as it takes to read all tables of a short run. Plain is a document whose values
stand on one line each: texts without a backslash, decimal numbers, true and false, short lists and tables of these.
Whatever else is in a document, and whatever is wrong with it, is the library's.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["loads", "plain"]
#: A whole number of more digits may be larger than the library takes.
_MOST_DIGITS = 15
_BLANK = " "


class _NotPlainError(Exception):
    """The library has to read it."""


def loads(text: str) -> dict[str, Any]:
    """The values of a document, and its errors, as `tomllib.loads` has them."""
    found = plain(text)
    if found is None:
        import tomllib

        found = tomllib.loads(text)
    return found


def plain(text: str) -> dict[str, Any] | None:
    """The values of a plain document; None for others."""
    document: dict[str, Any] = {}
    made: dict[tuple[str, ...], Any] = {(): document}
    told: set[tuple[str, ...]] = set()
    table = document
    try:
        for line in text.replace("\r\n", "\n").split("\n"):
            line = line.strip(_BLANK)
            if line.startswith("[") and line.isprintable():
                table = _headed(line, made, told)
            elif line and not line.startswith("#"):
                _put(table, *_parts(line))
            elif not line.isprintable():
                return None
    except (_NotPlainError, RecursionError):
        return None
    return document


def _parts(line: str) -> tuple[str, Iterator[str]]:
    """A line with a `"` in the place of each text and without its comment, and these texts."""
    outside, *rest = line.split('"')
    if len(rest) % 2 or "\\" in line or not line.isprintable():
        raise _NotPlainError
    if rest:
        outside = '"'.join((outside, *rest[1::2]))
    return outside.partition("#")[0].strip(_BLANK), iter(rest[::2])


def _headed(line: str, made: dict[tuple[str, ...], Any], told: set[tuple[str, ...]]) -> dict[str, Any]:
    """The table that a heading begins; `made` are tables and lists that headings have made, `told` those they name."""
    heading, texts = _parts(line)
    is_list = heading.startswith("[[")
    brackets = 2 if is_list else 1
    if not heading.endswith("]" * brackets):
        raise _NotPlainError
    path = tuple(_key(each, texts) for each in heading[brackets:-brackets].split("."))
    table: dict[str, Any] = {}
    if is_list and path in told and isinstance(made[path], list):
        made[path].append(table)
        return table
    if path in told:
        raise _NotPlainError
    for length in range(1, len(path)):
        _made(made, path[:length], {})
    if is_list and path in made:
        raise _NotPlainError
    told.add(path)
    begun = _made(made, path, [table] if is_list else table)
    return table if is_list else begun


def _made(made: dict[tuple[str, ...], Any], path: tuple[str, ...], begun: Any) -> Any:
    """The table at a path of headings, `begun` where there is none yet."""
    above = made[path[:-1]]
    if path not in made:
        if isinstance(above, list) or path[-1] in above:
            raise _NotPlainError
        above[path[-1]] = made[path] = begun
    return made[path]


def _put(table: dict[str, Any], line: str, texts: Iterator[str]) -> None:
    """Put what `key = value` says into a table."""
    written, sign, value = line.partition("=")
    key = _key(written, texts)
    if not sign or key in table:
        raise _NotPlainError
    table[key] = _value(value.strip(_BLANK), texts)


def _key(written: str, texts: Iterator[str]) -> str:
    written = written.strip(_BLANK)
    if written == '"':
        return next(texts)
    if not (written.isascii() and written.replace("_", "").replace("-", "").isalnum()):
        raise _NotPlainError
    return written


def _value(written: str, texts: Iterator[str]) -> Any:
    """A value; what stands between two commas of a list or table is one, or all of it is not plain."""
    if written == '"':
        return next(texts)
    ends = written[:1] + written[-1:]
    if ends == "[]":
        inner = written[1:-1].strip(_BLANK)
        return [_value(each.strip(_BLANK), texts) for each in inner.split(",")] if inner else []
    if ends == "{}":
        table: dict[str, Any] = {}
        for each in written[1:-1].split(","):
            _put(table, each, texts)
        return table
    if written in {"true", "false"}:
        return written == "true"
    return _number(written)


def _number(written: str) -> int | float:
    digits = written[1:] if written[:1] in {"-", "+"} else written
    whole, point, behind = digits.partition(".")
    if (
        not digits.isascii()
        or not whole.isdigit()
        or (len(whole) > 1 and whole.startswith("0"))
        or len(digits) > _MOST_DIGITS
    ):
        raise _NotPlainError
    if not point:
        return int(written)
    if not behind.isdigit():
        raise _NotPlainError
    return float(written)
