"""Regular expressions that are compiled when they are first used."""

import pickle
import re

import pytest

from polycnc.deferred.regexes import regex


def test_it_finds_what_a_compiled_one_finds() -> None:
    ours, theirs = regex("([a-z])(\\d*)", re.IGNORECASE), re.compile("([a-z])(\\d*)", re.IGNORECASE)
    text = "A12 b; 3"
    assert [each.groups() for each in ours.finditer(text)] == [
        each.groups() for each in theirs.finditer(text)
    ]
    assert ours.sub("-", text) == theirs.sub("-", text)
    found = ours.match(text)
    assert found is not None
    assert found[0] == "A12"
    assert (ours.pattern, ours.flags, ours.groups) == (theirs.pattern, theirs.flags, theirs.groups)


def test_its_source_can_be_part_of_another_one() -> None:
    assert regex(f"<{regex('a|b').pattern}>").pattern == "<a|b>"


def test_it_can_be_pickled() -> None:
    assert pickle.loads(pickle.dumps(regex("a+"))).fullmatch("aaa")


def test_a_mistake_shows_when_it_is_used() -> None:
    wrong = regex("(")
    with pytest.raises(re.error):
        wrong.match("")
    with pytest.raises(AttributeError):
        _ = wrong.nothing  # type: ignore[attr-defined]
