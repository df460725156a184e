"""Where a key stands in the text of a TOML or YAML file: parsers give values, people need lines."""

from __future__ import annotations

import re

from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

Place = tuple[int, int]
Found = tuple[tuple[str, ...], Place]
Key = str | int
_HEADER = regex(r"\s*(\[\[?)([^\]]+)\]\]?")
_PART = regex(r"""\s*(?:"((?:[^"\\]|\\.)*)"|'([^']*)'|([A-Za-z0-9_-]+))\s*(\.?)""")
_TOML_ERROR = regex(r"(.*?) \((?:at line (\d+), column (\d+)|at end of document)\)$")


def toml_place(text: str, path: Sequence[Key]) -> Place:
    """Line and column of a key path such as `("axis", "X", "rapid")`, or `("joint", 1, "axis")`.

    The deepest part of the path that the text writes out is found; (0, 0) where it writes nothing of it.
    """
    wanted = tuple(str(part) for part in path)
    best, depth = (0, 0), 0
    for found, place in _toml_keys(text):
        common = 0
        for one, other in zip(wanted, found, strict=False):
            if one != other:
                break
            common += 1
        if common == len(found) and common > depth:
            best, depth = place, common
    return best


def toml_error_place(message: str, text: str) -> tuple[str, Place]:
    """The parser's message without its place, and the place."""
    match = _TOML_ERROR.match(message)
    if match is None:
        return message, (0, 0)
    if match[2] is None:
        return match[1], (text.count("\n") + 1, 1)
    return match[1], (int(match[2]), int(match[3]))


def yaml_loader() -> Any:
    """The parser of YAML: what one parser takes, another may not."""
    import yaml

    return getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def yaml_place(text: str, path: Sequence[Key]) -> Place:
    """Line and column of a key path in a YAML document; (0, 0) where the text writes nothing of it."""
    import yaml

    node = yaml.compose(text, yaml_loader())
    place = (0, 0)
    for part in path:
        if isinstance(node, yaml.MappingNode):
            entry = next(((k, v) for k, v in node.value if k.value == str(part)), None)
            if entry is None:
                break
            mark, node = entry[0].start_mark, entry[1]
        elif isinstance(node, yaml.SequenceNode) and isinstance(part, int) and part < len(node.value):
            node = node.value[part]
            mark = node.start_mark
        else:
            break
        place = (mark.line + 1, mark.column + 1)
    return place


def _toml_keys(text: str) -> Iterator[Found]:
    """All tables and keys of a TOML text as full paths; elements of an array of tables count from 0."""
    table: tuple[str, ...] = ()
    counts: dict[tuple[str, ...], int] = {}
    for number, line in enumerate(text.splitlines(), 1):
        header = _HEADER.match(line)
        if header and not _looks_like_key(line):
            table = _resolved(_parts(header[2])[0], counts)
            if header[1] == "[[":
                if table not in counts:
                    yield table, (number, header.start(2) + 1)
                counts[table] = counts.get(table, -1) + 1
                table = (*table, str(counts[table]))
            yield table, (number, header.start(2) + 1)
            continue
        parts, end = _parts(line)
        if parts and line[end:].lstrip().startswith("="):
            yield table + parts, (number, len(line) - len(line.lstrip()) + 1)
            yield from _inline_keys(line, end, table + parts, number)


def _inline_keys(line: str, start: int, table: tuple[str, ...], number: int) -> Iterator[Found]:
    """The keys of an inline table that stands in one line, one level deep."""
    if line[start:].split("=", 1)[1].lstrip().startswith("{"):
        for match in re.finditer(r"[{,]\s*([\"']?)([A-Za-z0-9_.-]+)\1\s*=", line[start:]):
            yield (*table, match[2]), (number, start + match.start(2) + 1)


def _looks_like_key(line: str) -> bool:
    parts, end = _parts(line)
    return bool(parts) and line[end:].lstrip().startswith("=")


def _resolved(table: tuple[str, ...], counts: dict[tuple[str, ...], int]) -> tuple[str, ...]:
    """`[spindle.gears]` inside an array of tables means its last element."""
    done: tuple[str, ...] = ()
    for part in table[:-1]:
        done = (*done, part)
        if done in counts:
            done = (*done, str(counts[done]))
    return (*done, *table[-1:])


def _parts(text: str) -> tuple[tuple[str, ...], int]:
    """The dotted key at the start of a text, and where it ends."""
    parts: list[str] = []
    end = 0
    while match := _PART.match(text, end):
        parts.append(next(group for group in match.group(1, 2, 3) if group is not None))
        end = match.end()
        if not match[4]:
            break
    return tuple(parts), end
