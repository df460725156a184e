"""The module with the parameters of a control as attributes, written from their list (`parameters.toml`).

    python -m polycnc.control.parameter_module syntec/parameters.toml Syntec
    python -m polycnc.control.parameter_module fanuc/parameters.toml Fanuc word_address.Macro --shared
    python -m polycnc.control.parameter_module fanuc/lathe/parameters.toml Lathe fanuc.Fanuc
    python -m polycnc.control.parameter_module sinumerik/data/machine_data.toml

write `syntec/parameters.py`, `fanuc/parameters.py` with what both FANUC controls have, and `fanuc/lathe/parameters.py`,
whose classes extend those. What controls with custom macro B share stands in `word_address/parameters.py`. Programs of
SINUMERIK read its data by name, so that these are no attributes but a table: `sinumerik/data/delivered.py`.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from textwrap import wrap

from polycnc.control.parameters import load_parameters
from polycnc.deferred.paths import package_path
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from polycnc.control.parameters import KnownParameter

_HEAD = '''"""The parameters of the control as attributes; written from {file} by `control/parameter_module.py`."""

from __future__ import annotations

{imports}
'''
_CLASS = '''

class {prefix}AxisParameters({base}AxisParameters):
    """The parameters that every axis has."""{of_axis}


class {prefix}Parameters({base_class}[{axis}]):
    """The parameters of the control."""{axis_class}{of_control}
'''
_AXIS_CLASS = "\n\n    axis_class = {prefix}AxisParameters"
_TABLE = '''"""Numbers, delivered values, lengths of the data, from {file} by `control/parameter_module.py`."""

from __future__ import annotations

DATA: dict[str, tuple[int, bool | float | str]] = {{
{rows}
}}

#: Data that are lengths, or feeds; those of an axis where it is no rotary one.
LENGTHS = frozenset(
    (
{lengths}
    )
)
'''
#: Module of what all controls have.
_COMMON = "polycnc.control.parameters"
#: Width of a comment.
_WIDTH = 110


def module_text(file: str, prefix: str, base: str = "", *, shared: bool = False) -> str:
    """The text of the module.

    Args:
        file: The list, in the package `control`.
        prefix: What the names of the two classes begin with.
        base: Folder and prefix of the classes that they extend, as `fanuc.Fanuc`; empty for those of all controls.
        shared: Classes of several controls extend these.
    """
    known = load_parameters(file)
    folder, _, base = base.rpartition(".")
    base_class = f"{base or 'Control'}Parameters"
    imports = {_COMMON: {_kind(parameter) for parameter in known}}
    extended = imports.setdefault(f"polycnc.control.{folder}.parameters" if folder else _COMMON, set())
    extended |= {f"{base}AxisParameters", base_class, *(("A_co",) if shared else ())}
    lines = [f"from {module} import {', '.join(sorted(names))}" for module, names in sorted(imports.items())]
    return _HEAD.format(file=Path(file).name, imports="\n".join(lines)) + _CLASS.format(
        prefix=prefix,
        base=base,
        base_class=base_class,
        axis="A_co" if shared else f"{prefix}AxisParameters",
        axis_class="" if shared else _AXIS_CLASS.format(prefix=prefix),
        of_axis=_lines(parameter for parameter in known if parameter.by_axis),
        of_control=_lines(parameter for parameter in known if not parameter.by_axis),
    )


def table_text(file: str) -> str:
    """The text of the module with numbers and delivered values by name.

    Args:
        file: The list, in the package `control`.
    """
    rows = "\n".join(
        f"    {json.dumps(each.name)}: ({each.number}, {_literal(each.delivered)}),"
        for each in load_parameters(file)
    )
    lengths = "\n".join(
        f"        {json.dumps(each.name)}," for each in load_parameters(file) if each.unit.startswith("mm")
    )
    return _TABLE.format(file=Path(file).name, rows=rows, lengths=lengths)


def _literal(value: float | str | None) -> str:
    return json.dumps(value) if isinstance(value, str) else repr(value)


def _lines(parameters: Iterable[KnownParameter]) -> str:
    """The attributes, behind an empty line where there are any."""
    found = "\n".join(line for parameter in parameters for line in _attribute(parameter))
    return f"\n\n{found}" if found else ""


def _attribute(parameter: KnownParameter) -> Iterator[str]:
    unit = f" [{parameter.unit}]" if parameter.unit else ""
    comment = f"{parameter.number}: {parameter.texts['en']}{unit}."
    yield from wrap(comment, _WIDTH, initial_indent="    #: ", subsequent_indent="    #: ")
    number, kind = json.dumps(parameter.key.id), _kind(parameter)
    bit = "" if parameter.key.bit is None else f", {parameter.key.bit}"
    count = "" if parameter.count == 1 else f", {parameter.count}"
    step = "" if parameter.step == 1 else f", step={parameter.step}"
    yield f"    {parameter.name} = {kind}({number}{bit}{count}{step}, delivered={_delivered(parameter, kind)})"


def _kind(parameter: KnownParameter) -> str:
    """The class of the attribute."""
    if parameter.key.bit is not None:
        return "Bit"
    if not parameter.whole:
        return "Number"
    return "Whole" if parameter.count == 1 else "WholeRun"


def _delivered(parameter: KnownParameter, kind: str) -> str:
    value = parameter.delivered
    if value is None or isinstance(value, str):
        return _literal(value)
    return repr(bool(value) if kind == "Bit" else float(value) if kind == "Number" else int(value))


if __name__ == "__main__":
    is_shared = sys.argv[-1] == "--shared"
    list_file, *names = sys.argv[1 : -1 if is_shared else None]
    module = Path(package_path("control", list_file))
    if names:
        module.with_suffix(".py").write_text(
            module_text(list_file, *names, shared=is_shared), encoding="utf-8"
        )
    else:
        module.with_name("delivered.py").write_text(table_text(list_file), encoding="utf-8")
