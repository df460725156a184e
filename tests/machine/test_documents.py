"""YAML is read strictly: what could be taken for something else is refused, with its line."""

from __future__ import annotations

import pytest

from polycnc.machine.documents import DocumentError, yaml_values

MERGES = "a: &a {x: 1}\n" + "".join(
    f"{chr(98 + i)}: &{chr(98 + i)} {{{', '.join(f'k{j}: *{chr(97 + i)}' for j in range(9))}}}\n"
    for i in range(9)
)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("", None),
        ("{}", {}),
        ("a: 1\n'2': x\n3: [1, -2.5, 1e3, .5, 0x1F]", {"a": 1, "2": "x", 3: [1, -2.5, 1000.0, 0.5, 31]}),
        ("a: on\nb: No\nc: true\nd: ~\ne:", {"a": True, "b": False, "c": True, "d": None, "e": None}),
        ("NO: 1\non: 2", {"NO": 1, "on": 2}),
        ("a: '010'\nb: \"1:30\"\nc: !!str 010", {"a": "010", "b": "1:30", "c": "010"}),
        ("a: &t {x: 1}\nb: *t", {"a": {"x": 1}, "b": {"x": 1}}),
        ("a: &t {x: 1, y: 2}\nb: {<<: *t, y: 3}", {"a": {"x": 1, "y": 2}, "b": {"x": 1, "y": 3}}),
    ],
)
def test_values(text: str, value: object) -> None:
    assert yaml_values(text) == value


@pytest.mark.parametrize(
    ("text", "message", "line"),
    [
        ("start:\n  X: 1\n  X: 2", "key-twice", 3),
        ("tools:\n  1: {}\n  '1': {}", "key-twice", 3),
        ("a: 1\nb: 010", "doubtful-number", 2),
        ("a: 1\n010: 1", "doubtful-number", 2),
        ("a: 1:30", "doubtful-number", 1),
        ("a: -1_000", "doubtful-number", 1),
        ("a: 0b11", "doubtful-number", 1),
        ("a: 0o17", "doubtful-number", 1),
        ("a:\n  b: " + "9" * 5000, "too-many-digits", 2),
        ("a: " + "[" * 3000, "too-deep", 1),
        ("a: " + "{x: " * 60 + "1" + "}" * 60, "too-deep", 1),
        (MERGES, "too-large", 7),
        ("a: &a [*a]", "no-anchor", 1),
        ("a: *b", "no-anchor", 1),
        ("a: {<<: 3}", "merge", 1),
        ("a: !!python/object:os.system {}", "tag", 1),
        ("a: !!binary AAAA", "tag", 1),
        ("? [1, 2]\n: 3", "key-no-word", 1),
        ("a: 1\n---\nb: 2", "second-document", 2),
        ("a: [1", "not-yaml", 2),
        ("a: \x00", "not-yaml", 0),
    ],
)
def test_what_is_refused_is_named_with_its_line(text: str, message: str, line: int) -> None:
    with pytest.raises(DocumentError) as error:
        yaml_values(text)
    assert (error.value.message, error.value.line) == (message, line)
