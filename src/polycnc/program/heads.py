"""What stands in front of a block on every control: block skip and the sequence number."""

from __future__ import annotations

import re

from polycnc.deferred.regexes import regex

_HEAD = regex(r"\s*(?:/\d*\s*)?(?P<number>[N:]\d+)?\s*", re.IGNORECASE)


def sequence_number(line: str) -> str:
    """The sequence number of a block as it is written, `N50`, or `:3` of a main block, in capitals; empty for none."""
    head = _HEAD.match(line)
    return (head["number"] or "").upper() if head is not None else ""


def after_head(line: str) -> int:
    """Index of the first character behind blanks, block skip and sequence number."""
    head = _HEAD.match(line)
    return head.end() if head is not None else 0
