"""Access rights: who may read and write what (job planning 1.1.10); who may execute it, `Scope.check_word` says.

A protection level is a number from 0 (system) to 7 (key switch position 0). A right names the level that a program must
have at least, and a level is the higher the lower its number. A program has the level that is set on the control; one
in a cycle directory has that of its directory, if it is higher.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.errors import NcSyntaxError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.language.sinumerik.expressions import ExpressionReader

READ, WRITE = "read", "write"
#: For each right: its keywords and the alarm. APR does not restrict programs, APW 0…7 is APWP.
_RIGHTS = {READ: (("APRP",), "17071"), WRITE: (("APWP", "APW"), "17070")}
#: Levels of the short forms APR and APW from here on are for clients of the operator interface.
_INTERFACE_LEVELS = 10
LOWEST = 7


def check(reader: ExpressionReader, name: str, rights: Mapping[str, int], right: str) -> None:
    """Raise the alarm if the program that is being compiled lacks a right: 17070 or 17071."""
    if not rights:
        return
    keys, alarm = _RIGHTS[right]
    for key in keys:
        level = rights.get(key, LOWEST)
        if level < _INTERFACE_LEVELS and reader.scope.level > level:
            raise NcSyntaxError(alarm, reader.token.column, name)
