"""What macros ask of the machine behind the control: SYSDATA, DRVDATA (macro manual, data).

The simulated control measures nothing and has no drives: a diagnosis variable has the value that the setup gives it as
a switch (`D376: 3`), else 0; a drive variable is VACANT, which is what the control says where no drive answers.
"""

from __future__ import annotations

from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.syntec.values import VACANT, Text, Value, to_long
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.syntec.memory import SyntecMemory

WRONG_TYPE = "COR-023"
NO_SUCH_VARIABLE = "COR-016"
LAST_DIAGNOSIS = 9999
_DRIVE_VARIABLE = regex(r"D[0-9A-Fa-f]{3}h|D[0-9A-Fa-f]{1,2}h")


def diagnosis(memory: SyntecMemory, index: Value) -> Value:
    """SYSDATA(n): the diagnosis variable Dn."""
    if not isinstance(index, int):
        raise AlarmError(WRONG_TYPE)
    if not 0 <= index <= LAST_DIAGNOSIS:
        raise AlarmError(NO_SUCH_VARIABLE, variable=f"D{index}")
    value = memory.channel.setup.switches.signals.get(f"D{index}", 0)
    return to_long(float(value)) if isinstance(value, int | float) else 0


def drive_variable(_memory: SyntecMemory, _station: Value, index: Value) -> Value:
    """DRVDATA(station, n): a variable of a drive, by its number or as `"D61h"`."""
    if not isinstance(index, int) and not (isinstance(index, Text) and _DRIVE_VARIABLE.fullmatch(index)):
        raise AlarmError(WRONG_TYPE)
    return VACANT
