"""Which words of the language a control of the machine does without (job planning 16.1, columns of 828D).

The machine file names the variant of the control and the options that it has. Without a variant every word is there, as
on 840D sl.
"""

from __future__ import annotations

from polycnc.deferred.paths import package_path, read_text
from polycnc.deferred.toml import loads
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Collection

TABLE = package_path("control", "sinumerik", "data", "availability.toml")
#: Marks of the table.
ABSENT, OPTION = "-", "o"


def refused(variant: str, options: Collection[str]) -> frozenset[str]:
    """The words that a variant does not have, with the options that are on; none without a variant."""
    if not variant:
        return frozenset()
    table = loads(read_text(TABLE))
    column = table["variants"].index(variant)
    return frozenset(
        word
        for group in table["group"]
        if group["marks"][column] == ABSENT
        or (group["marks"][column] == OPTION and group["option"] not in options)
        for word in group["words"].split()
    )
