"""Functions of the macro language that need the control: arguments, stack, bits, messages, files."""

from __future__ import annotations

import re
from functools import partial

from polycnc.channel.waits import TIME_SLICE
from polycnc.control.syntec.macros import records
from polycnc.control.syntec.macros.system_variables import system_variable
from polycnc.control.syntec.macros.variables import BitState, FunctionState
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.syntec.values import VACANT, Text, Vacant, Value, number, whole
from polycnc.messages import AlarmError
from polycnc.toolpath.events import Circle, Message, Pen, Print

with loaded_when_called():
    from polycnc.control.syntec.macros import diagnosis, machine_parameters, registers

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.syntec.memory import SyntecMemory

WRONG_TYPE = "COR-023"
NO_SUCH_VARIABLE = "COR-016"
WRONG_BIT = "COR-138"
WRONG_REGISTER_BIT = "COR-135"
WRONG_MODE = "COR-301"
WRONG_CHECK = "COR-353"
LAST_BIT, LAST_REGISTER, LAST_REGISTER_BIT = 511, 65535, 31
LAST_ALARM = 65535
DEFAULT_MESSAGE = 65535
MAX_TEXT = 39


# ---- units -----------------------------------------------------------------------------------------------


def standard(memory: SyntecMemory, value: Value, unit: Value = VACANT) -> Value:
    """STD(x, u): a Long counts units u; a Double stands for itself; Pr3241 = 1 makes a Long whole units."""
    return _scaled(memory, value, memory.least_unit if isinstance(unit, Vacant) else number(unit))


def standard_of_axis(memory: SyntecMemory, value: Value, axis: Value) -> Value:
    """STDAX(x, A): as STD with the least unit of the axis."""
    index = memory.channel.axis_index.get(str(axis))
    rotary = index is not None and memory.channel.axis_data[index].rotary
    return _scaled(memory, value, memory.least_angle if rotary else memory.least_unit)


def _scaled(memory: SyntecMemory, value: Value, unit: float) -> Value:
    if isinstance(value, Text):
        raise AlarmError(WRONG_TYPE)
    if not isinstance(value, int):
        return value
    return float(value) if memory.parameters.whole_units else value * unit


# ---- arguments, axes, parameters -------------------------------------------------------------------------


def argument(memory: SyntecMemory, name: Value) -> Value:
    """GETARG(w): a word of the calling block."""
    arguments = memory.arguments
    return VACANT if arguments is None else arguments.argument(str(name))


def trapped_argument(memory: SyntecMemory, name: Value) -> Value:
    """GETTRAPARG(w): a word of the block that a modal macro follows."""
    arguments = memory.arguments
    return VACANT if arguments is None else arguments.trapped.get(str(name), VACANT)


def axis_number(memory: SyntecMemory, name: Value) -> Value:
    """AXID(a): number of an axis, from 1."""
    index = memory.channel.axis_index.get(str(name))
    return VACANT if index is None else index + 1


def machine_parameter(memory: SyntecMemory, index: Value, _group: Value = VACANT) -> Value:
    """PARAM(n): a parameter as a Long; VACANT where it is not supported."""
    if not isinstance(index, int):
        raise AlarmError(WRONG_TYPE)
    found = machine_parameters.read_long(memory, index)
    return VACANT if found is None else found


def write_parameter(memory: SyntecMemory, index: Value, value: Value) -> Value:
    """SETPR(n, v): writes a parameter and gives 1."""
    if not isinstance(index, int) or not isinstance(value, int):
        raise AlarmError(WRONG_TYPE)
    machine_parameters.write_long(memory, index, value)
    return 1


def random_number(memory: SyntecMemory) -> Value:
    """RANDOM(): 0 to 32767, the same sequence in every run."""
    return FunctionState.of(memory.channel).random.randrange(32768)


# ---- stack -----------------------------------------------------------------------------------------------


def push(memory: SyntecMemory, value: Value) -> Value:
    """PUSH(v)."""
    FunctionState.of(memory.channel).stack.append(value)
    return VACANT


def pop(memory: SyntecMemory) -> Value:
    """POP(): the top, removed."""
    state = FunctionState.of(memory.channel)
    if not state.stack:
        raise AlarmError(NO_SUCH_VARIABLE, hint="hint.syntec.stack")
    return state.stack.pop()


def stack_top(memory: SyntecMemory, depth: Value) -> Value:
    """STKTOP[i]: copied from the top down, i = 0 the top itself."""
    state = FunctionState.of(memory.channel)
    at = whole(depth, NO_SUCH_VARIABLE)
    if not 0 <= at < len(state.stack):
        raise AlarmError(NO_SUCH_VARIABLE, hint="hint.syntec.stack")
    return state.stack[-1 - at]


# ---- bits ------------------------------------------------------------------------------------------------


def _bit_name(family: str, index: Value) -> str:
    at = whole(index, WRONG_BIT)
    if not 0 <= at <= LAST_BIT:
        raise AlarmError(WRONG_BIT)
    return f"{family}{at}"


def read_bit(family: str, memory: SyntecMemory, index: Value) -> Value:
    """READDI, READDO, READABIT."""
    return BitState.of(memory.channel).bits.get(_bit_name(family, index), 0)


def write_bit(family: str, memory: SyntecMemory, index: Value, value: Value) -> Value:
    """SETDO, SETABIT."""
    BitState.of(memory.channel).bits[_bit_name(family, index)] = int(whole(value, WRONG_BIT) != 0)
    return VACANT


def _register_bit(register: Value, bit: Value) -> tuple[int, int]:
    r, b = whole(register, WRONG_REGISTER_BIT), whole(bit, WRONG_REGISTER_BIT)
    if not (0 <= r <= LAST_REGISTER and 0 <= b <= LAST_REGISTER_BIT):
        raise AlarmError(WRONG_REGISTER_BIT)
    return r, b


def read_register_bit(memory: SyntecMemory, register: Value, bit: Value) -> Value:
    """READRREGBIT(r, b)."""
    r, b = _register_bit(register, bit)
    return memory.globals.read_register(r) >> b & 1


def write_register_bit(memory: SyntecMemory, register: Value, bit: Value, value: Value) -> Value:
    """SETRREGBIT(r, b, v)."""
    r, b = _register_bit(register, bit)
    mask = 1 << b
    old = memory.globals.read_register(r) & 0xFFFFFFFF
    new = old | mask if whole(value, WRONG_REGISTER_BIT) else old & ~mask
    registers.write_register(memory.channel, r, new - 2**32 if new >= 2**31 else new)
    return VACANT


# ---- messages --------------------------------------------------------------------------------------------


def alarm(_memory: SyntecMemory, identity: Value, text: Value = VACANT) -> Value:
    """ALARM(id, "text"): the program ends with the macro's own alarm."""
    if not isinstance(identity, int) or not 0 <= identity <= LAST_ALARM:
        raise AlarmError(WRONG_TYPE)
    told = "" if isinstance(text, Vacant) else str(text)[:MAX_TEXT]
    raise AlarmError(f"MAR-{identity:03d}", detail=told, number=identity)


def message(memory: SyntecMemory, first: Value, second: Value = VACANT) -> Value:
    """MSG(id), MSG("text"), MSG(id, "text"): a note on the screen; the program goes on."""
    text = second if isinstance(first, int) else first
    identity = first if isinstance(first, int) else DEFAULT_MESSAGE
    if isinstance(text, Vacant) and isinstance(first, int):
        text = Text(identity)
    if not isinstance(text, Text) or not 0 <= identity <= LAST_ALARM:
        raise AlarmError(WRONG_TYPE)
    memory.channel.event(Message(str(text)))
    return VACANT


def wait(memory: SyntecMemory) -> Value:
    """WAIT(): everything before is done before anything behind is read."""
    memory.channel.flush()
    memory.channel.synchronise()
    return VACANT


def sleep(memory: SyntecMemory) -> Value:
    """SLEEP(): gives up a time slice, in which the main run, its inputs and other channels go on."""
    if memory.channel.main_run is None:
        memory.channel.toolpath.rest()
    else:
        memory.channel.wait = TIME_SLICE
    return VACANT


# ---- files -----------------------------------------------------------------------------------------------

_ESCAPE = regex(r'\\([\\@#p"*])|([#@])(\d+)(?:\[(\d)\])?')
_ESCAPED = {"p": "%"}


def open_file(_memory: SyntecMemory, name: Value, mode: Value = VACANT) -> Value:
    """OPEN("name", "a" | "w")."""
    if not isinstance(name, Text):
        raise AlarmError(WRONG_TYPE)
    if not isinstance(mode, Vacant) and str(mode) not in ("a", "w"):
        raise AlarmError(WRONG_MODE)
    return VACANT


def print_line(memory: SyntecMemory, text: Value) -> Value:
    """PRINT("text"): one line; `#n` and `@n` in it are replaced, `#n[d]` with d decimals."""
    if not isinstance(text, Text):
        raise AlarmError(WRONG_TYPE)

    def replaced(match: re.Match[str]) -> str:
        if match[1]:
            return _ESCAPED.get(match[1], match[1])
        index = int(match[3])
        value = memory.variable(index) if match[2] == "#" else memory.register(index)
        return _printed(memory, value, match[4])

    line = _ESCAPE.sub(replaced, text).removesuffix(";")
    memory.channel.event(Print(line))
    return VACANT


def _printed(memory: SyntecMemory, value: Value, decimals: str | None) -> str:
    if isinstance(value, Vacant):
        return ""
    if isinstance(value, float) or (decimals is not None and not isinstance(value, Text)):
        places = int(decimals) if decimals is not None else max(memory.parameters.input_unit + 1, 0)
        return f"{float(value):.{places}f}"
    return str(value)


def close_file(_memory: SyntecMemory) -> Value:
    """CLOSE()."""
    return VACANT


def stored_text(memory: SyntecMemory, index: Value) -> Value:
    """SCANTEXT(n): the text stored from @n on."""
    return memory.globals.read_text(index)


# ---- picture and checks ----------------------------------------------------------------------------------


def set_colour(memory: SyntecMemory, colour: Value, fill: Value = 0, radius: Value = 0) -> Value:
    """SETDRAW(c, fill, r): colour (BGR) of the simulated path, and what DRAWHOLE draws; gives the previous colour."""
    state = FunctionState.of(memory.channel)
    previous, state.colour = state.colour, whole(colour, WRONG_TYPE)
    state.filled, state.radius = bool(whole(fill, WRONG_TYPE)), abs(number(radius))
    red, green, blue = (state.colour >> shift & 0xFF for shift in (0, 8, 16))
    memory.channel.event(Pen(f"#{red:02x}{green:02x}{blue:02x}"))
    return previous


def draw_hole(memory: SyntecMemory) -> Value:
    """DRAWHOLE(): a circle in the simulated picture about the present point."""
    state = FunctionState.of(memory.channel)
    memory.channel.event(Circle(state.radius, state.filled))
    return VACANT


def check_machine(_memory: SyntecMemory, _code: Value) -> Value:
    """CHKMN, CHKSN, CHKMT, CHKMI: the simulated control has no maker, serial number, type or model."""
    return 0


def check_information(_memory: SyntecMemory, kind: Value, _code: Value) -> Value:
    """CHKINF(1…5, "…")."""
    if whole(kind, WRONG_CHECK) not in range(1, 6):
        raise AlarmError(WRONG_CHECK)
    return 0


FUNCTIONS: dict[str, Callable[..., Value]] = {
    "STD": standard,
    "STDAX": standard_of_axis,
    "GETARG": argument,
    "GETTRAPARG": trapped_argument,
    "AXID": axis_number,
    "PARAM": machine_parameter,
    "GETPR": machine_parameter,
    "SETPR": write_parameter,
    "SYSDATA": diagnosis.diagnosis,
    "DRVDATA": diagnosis.drive_variable,
    "SYSVAR": system_variable,
    "RANDOM": random_number,
    "PUSH": push,
    "POP": pop,
    "STKTOP": stack_top,
    "READDI": partial(read_bit, "I"),
    "READDO": partial(read_bit, "O"),
    "READABIT": partial(read_bit, "A"),
    "READRREGBIT": read_register_bit,
    "SETDO": partial(write_bit, "O"),
    "SETABIT": partial(write_bit, "A"),
    "SETRREGBIT": write_register_bit,
    "ALARM": alarm,
    "MSG": message,
    "WAIT": wait,
    "SLEEP": sleep,
    "OPEN": open_file,
    "PRINT": print_line,
    "CLOSE": close_file,
    **records.FUNCTIONS,
    "SCANTEXT": stored_text,
    "SETDRAW": set_colour,
    "DRAWHOLE": draw_hole,
    "CHKMN": check_machine,
    "CHKSN": check_machine,
    "CHKMT": check_machine,
    "CHKMI": check_machine,
    "CHKINF": check_information,
}


def bound(memory: SyntecMemory) -> dict[str, Callable[..., Value]]:
    """The functions as expressions call them."""
    return {name: partial(function, memory) for name, function in FUNCTIONS.items()}
