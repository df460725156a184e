"""Lines of keys in TOML and YAML texts."""

import pytest

from polycnc.machine.documents import DocumentError, yaml_values
from polycnc.machine.places import toml_place, yaml_place

TOML = """\
top = 1
"quoted.key" = 2
a.b = 3  # [not.a.table]

[axis.X]
  rapid = 4
list = [
  1,
]
[ axis . "Y" ]
name = { en = "a", zh-TW = "b" }
[[joint]]
axis = "X"
[[joint]]
axis = "Y"
[joint.more]
deep = 1
"""


@pytest.mark.parametrize(
    ("path", "place"),
    [
        (("top",), (1, 1)),
        (("quoted.key",), (2, 1)),
        (("a", "b"), (3, 1)),
        (("axis", "X"), (5, 2)),
        (("axis", "X", "rapid"), (6, 3)),
        (("axis", "X", "absent"), (5, 2)),
        (("axis", "X", "list", 0), (7, 1)),
        (("axis", "Y", "name", "zh-TW"), (11, 20)),
        (("joint",), (12, 3)),
        (("joint", 0, "axis"), (13, 1)),
        (("joint", 1, "axis"), (15, 1)),
        (("joint", 1, "more", "deep"), (17, 1)),
        (("absent",), (0, 0)),
    ],
)
def test_a_toml_key_is_found(path: tuple[str | int, ...], place: tuple[int, int]) -> None:
    assert toml_place(TOML, path) == place


@pytest.mark.parametrize(
    ("path", "place"),
    [
        (("start", "X"), (1, 9)),
        (("tools", 1, "length"), (3, 7)),
        (("tools", 1, "absent"), (3, 3)),
        (("list", 1), (5, 5)),
        (("absent",), (0, 0)),
    ],
)
def test_a_yaml_key_is_found(path: tuple[str | int, ...], place: tuple[int, int]) -> None:
    text = "start: {X: 1}\ntools:\n  1: {length: 3}\nlist:\n  - {a: 1}\n"
    if path == ("list", 1):
        text = "start: {X: 1}\ntools:\n  1: {length: 3}\nlist: [1,\n    2]\n"
    assert yaml_place(text, path) == place


def test_a_place_is_found_in_whatever_the_parser_of_values_takes() -> None:
    for text in ("ab: 1\n\ufeff", "ab\t: 1\n"):
        try:
            values = yaml_values(text)
        except DocumentError:
            continue
        assert values
        assert yaml_place(text, ("ab",)) == (1, 1)
