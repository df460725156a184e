"""REDEF: attributes of variables and words that exist already (job planning 1.1.6 to 1.1.11).

Which data have which attribute is the table of 1.1.11: GUD can change their rights, init times, first values and
preprocessing stops; R parameters and user data that belong to the control (`$AC_PARAM`, OEM data of tools) limits and
units as well; all other data of the control their rights alone, setting data their init time and first value too.
"""

from __future__ import annotations

from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.expressions.code import quoted, sequence
from polycnc.language.sinumerik import keywords
from polycnc.language.sinumerik.emitter import provide
from polycnc.language.sinumerik.errors import NcSyntaxError, not_supported, unknown
from polycnc.language.sinumerik.names.initialisation import FirstValues
from polycnc.language.sinumerik.names.values import Type
from polycnc.language.sinumerik.names.variables import Variable
from polycnc.language.sinumerik.statements.definitions import (
    Attributes,
    first_values,
    give_first_value,
    read_attributes,
)
from polycnc.messages import AlarmError
from polycnc.program.names import CYCLE_DIRS

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.language.sinumerik.blocks import BlockCompiler
    from polycnc.language.sinumerik.interface import LanguageMemory, SystemVariable
    from polycnc.language.sinumerik.lexer import Token
    from polycnc.language.sinumerik.names.scope import Scope

#: User data that belong to the control: every attribute can be redefined.
_USER_DATA = regex(r"R|\$AC_(PARAM|MARKER|TIMER)|\$TC_(DPC|TPC)\d+")
#: Setting data that commands of programs change: PRLOC brings them back (1.1.7, table 1-1).
_CHANGED_BY_PROGRAMS = """
$SC_THREAD_START_ANGLE $SC_THREAD_RAMP_DISP $SA_PUNCH_DWELLTIME $SA_SPIND_ASSIGN_TAB $SA_SPIND_MIN_VELO_G25
$SA_SPIND_MAX_VELO_G26 $SA_SPIND_MAX_VELO_LIMS $SA_ASSIGN_FEED_PER_REV_SOURCE $SA_WORKAREA_LIMIT_PLUS
$SA_WORKAREA_LIMIT_MINUS $SA_FIXED_STOP_TORQUE $SA_FIXED_STOP_WINDOW $SA_OSCILL_REVERSE_POS1
$SA_OSCILL_REVERSE_POS2 $SA_OSCILL_DWELL_TIME1 $SA_OSCILL_DWELL_TIME2 $SA_OSCILL_VELO
$SA_OSCILL_NUM_SPARK_CYCLES $SA_OSCILL_END_POS $SA_OSCILL_CTRL_MASK $SA_OSCILL_IS_ACTIVE $SA_OSCILL_START_POS
"""
_PROGRAMMABLE_SETTINGS = frozenset(_CHANGED_BY_PROGRAMS.split())


def redefine(compiler: BlockCompiler) -> None:
    """REDEF name attribute: one attribute in a block."""
    compiler.take()
    compiler.emitter.knows_place = True
    compiler.program.forget_shapes()
    token = compiler.take()
    if token.kind == "end":
        raise compiler.error(token)
    variable = compiler.scope.memory.global_variables.get(token.text)
    if variable is not None:
        _redefine_global(compiler, token, variable)
    elif compiler.scope.find(token.text) is not None:
        raise NcSyntaxError("12500", token.column, token.text)
    else:
        _redefine_control(compiler, token)


def _one_attribute(compiler: BlockCompiler, name: Token) -> Attributes:
    """The attribute of the block; 12080 for several, or for a type, which cannot change."""
    attributes = read_attributes(compiler)
    has_limits = attributes.low is not None or attributes.high is not None
    kinds = [has_limits, attributes.unit, attributes.rights, attributes.init_time, attributes.stops]
    if sum(map(bool, kinds)) > 1 or attributes.type is not None or attributes.range:
        raise compiler.error(name)
    return attributes


def _redefine_global(compiler: BlockCompiler, token: Token, variable: Variable) -> None:
    attributes = _one_attribute(compiler, token)
    if attributes.low is not None or attributes.high is not None or attributes.unit:
        raise NcSyntaxError("12500", token.column, f"REDEF {token.text}")
    variable.stops = attributes.stops or variable.stops
    if attributes.init_time:
        # 1.1.7: what all channels share is initialised at power-on alone; a later event changes its first value only.
        variable.init_time = "INIPO" if variable.range == "NCK" else attributes.init_time
    variable.rights.update(attributes.rights or {})
    if compiler.token.kind != "end":
        if not attributes.init_time:
            raise compiler.error()
        give_first_value(compiler, variable)


def _redefine_control(compiler: BlockCompiler, token: Token) -> None:
    """What belongs to the control: system variables, R parameters, words of the language."""
    name, scope = token.text, compiler.scope
    is_variable = name[0] == "$" or name == "R"
    if not is_variable and not _is_executable(compiler, token):
        raise unknown(token.column, name)
    not_kept = _not_kept(scope, name) if name[0] == "$" else None
    attributes = _one_attribute(compiler, token)
    if not_kept is not None and not attributes.rights:
        raise not_kept
    for right, level in (attributes.rights or {}).items():
        if (right == "APX") is is_variable:
            raise NcSyntaxError("12490", token.column, name)
        if level < scope.level:
            raise NcSyntaxError("12490", token.column, str(level))
        scope.memory.rights.setdefault(name, {})[right] = level
    if attributes.init_time:
        _init_time(compiler, token, attributes.init_time)
    elif compiler.token.kind != "end":
        raise compiler.error()
    elif not attributes.rights:
        _limits_and_unit(compiler, token, attributes)


def _not_kept(scope: Scope, name: str) -> AlarmError | None:
    """The alarm of a variable that polycnc does not keep: only its rights can be redefined, each use is that alarm."""
    try:
        scope.control.system_variable(name)
    except AlarmError as alarm:
        if alarm.code != "PC0001":
            raise
        return alarm
    return None


def _limits_and_unit(compiler: BlockCompiler, token: Token, attributes: Attributes) -> None:
    """Limits, unit and preprocessing stop of user data; 12160 if a value lies outside new limits."""
    if not _USER_DATA.fullmatch(token.text):
        raise NcSyntaxError("12500", token.column, f"REDEF {token.text}")
    memory = compiler.scope.memory
    variable = memory.user_data.get(token.text) or Variable(token.text, Type.REAL)
    low = variable.low if attributes.low is None else attributes.low
    high = variable.high if attributes.high is None else attributes.high
    values = memory.r if token.text == "R" else ()
    if any((low is not None and value < low) or (high is not None and value > high) for value in values):
        raise NcSyntaxError("12160", token.column, token.text)
    variable.low, variable.high = low, high
    variable.unit = attributes.unit or variable.unit
    variable.stops = attributes.stops or variable.stops
    memory.user_data[token.text] = variable


def _is_executable(compiler: BlockCompiler, token: Token) -> bool:
    """Whether a name is a function, a procedure, or a cycle."""
    name, scope = token.text, compiler.scope
    if token.kind == "word":
        name = f"{token.letter}{token.value}"
    return (
        name in scope.control.g_groups
        or name == "DO"
        or any(name in table for table in (keywords.PROCEDURES, keywords.CONTROL_FUNCTIONS, keywords.CYCLES))
        or compiler.channel.store.find_sinumerik(name, CYCLE_DIRS[0]) is not None
    )


def _init_time(compiler: BlockCompiler, token: Token, time: str) -> None:
    """`REDEF name INIRE [value]`, `INIRE (value, …)`: the first values, from power-on and again at that event."""
    name = token.text
    is_setting = name.startswith(("$SC_", "$SN_", "$SA_"))
    if time == "PRLOC" and name not in _PROGRAMMABLE_SETTINGS:
        raise NcSyntaxError("12500", token.column, f"REDEF {name} PRLOC")
    step: Callable[[Channel], None] | None = None
    if compiler.token.kind != "end":
        if not (is_setting or _USER_DATA.fullmatch(name)):
            raise NcSyntaxError("12261", token.column, name)
        first_line = len(compiler.emitter.statements)
        _write_first_values(compiler, name)
        step = compiler.emitter.step() if len(compiler.emitter.statements) > first_line else None
    compiler.scope.memory.first_values[name] = FirstValues(name, time, step)


def _write_first_values(compiler: BlockCompiler, name: str) -> None:
    """Values of the first elements, or one value, which is for all R parameters."""
    is_single = not (compiler.at("(") or compiler.at("SET") or compiler.at("REP"))
    values = first_values(compiler, Type.REAL)
    if name == "R":
        items = compiler.emitter.object(compiler.scope.memory.r)
        fill = quoted("set_elements({0}, 0, {1})", items, sequence(values.codes))
        if is_single or values.is_repeated:
            fill = quoted("repeat_element({0}, 0, {1}, {2})", items, values.codes[0], values.times)
        compiler.emitter.run(fill)
        return
    code = sequence(values.codes)
    if values.is_repeated:
        count = values.times or quoted("element_count_of(channel, {0})", name)
        code = quoted("({0},) * {1}", values.codes[0], count)
    compiler.emitter.run(quoted("set_first_values(channel, {0}, {1})", name, code))


def element_count_of(channel: Channel, name: str) -> int:
    """How many elements a repeated first value fills; PC0001 where polycnc does not know."""
    if name.startswith("$SA_"):
        return 1
    variable: SystemVariable = channel.control.system_variable(name)
    count = variable.element_count(channel)
    if count is None:
        raise not_supported(0, f"REDEF {name} REP")
    return count


def set_first_values(channel: Channel, name: str, values: tuple[float, ...]) -> None:
    """First values of a system variable.

    Axial data take one value for all axes, data of cutting edges theirs for D1, D2 … of T1, all others those of the
    first elements.
    """
    memory: LanguageMemory = channel.memory.language
    variable = channel.control.system_variable(name)
    if name.startswith("$SA_"):
        places: list[tuple[Any, ...]] = [(axis,) for axis in memory.axes.values()]
        values = (values[0],) * len(places)
    elif name.startswith("$TC_DP"):
        places = [(1, edge) for edge in range(1, len(values) + 1)]
    elif name.startswith("$TC_"):
        places = [(tool,) for tool in range(1, len(values) + 1)]
    else:
        places = [(index,) for index in range(len(values))]
    for place, value in zip(places, values, strict=True):
        variable.write(channel, place, value)


STATEMENTS: dict[str, Callable[[BlockCompiler], None]] = {"REDEF": redefine}
provide(element_count_of=element_count_of, set_first_values=set_first_values)
