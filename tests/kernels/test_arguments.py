"""What kernels take, as their annotations say it."""

from __future__ import annotations

from typing import NamedTuple

import pytest
from build_kernels.arguments import Kind, arguments, signature

from polycnc.kernels.layout import Bytes, Ints32
from tests.kernels import sums


def test_a_kernel_says_with_its_annotations_what_it_takes() -> None:
    group, total, number = arguments(sums.add)
    assert (group.kind, group.type, [part.code for part in group.parts]) == (
        Kind.GROUP,
        sums.Columns,
        ["d", "i"],
    )
    assert (total.kind, total.type, number.kind) == (Kind.RECORD, sums.Total, Kind.NUMBER)


def test_what_machine_code_cannot_have_is_refused() -> None:
    def kernel(_name: str, _text: Bytes, _numbers: Ints32) -> int:
        return 0

    class Strange(NamedTuple):
        names: dict[str, int]

    def other(_strange: Strange) -> int:
        return 0

    def nested(_nested: Strange) -> int:
        return 0

    class Nested(NamedTuple):
        columns: sums.Columns

    other.__annotations__["_strange"], nested.__annotations__["_nested"] = Strange, Nested
    for refused in (kernel, other, nested):
        with pytest.raises(TypeError, match="cannot take"):
            arguments(refused)


def test_arguments_are_told_by_a_sign_each() -> None:
    assert signature(arguments(sums.add)) == "(di)*."
    assert signature(arguments(sums.put)) == "d#"
    assert signature(arguments(sums.count)) == "$#d"
