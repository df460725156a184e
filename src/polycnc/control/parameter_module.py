"""The module with the parameters of a control as attributes, written from their list (`parameters.toml`).

`python -m polycnc.control.parameter_module fanuc/lathe/parameters.toml Lathe` writes `fanuc/lathe/parameters.py`.
"""

from __future__ import annotations

import json
import sys
from importlib.resources import files
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING

from polycnc.control.parameters import load_parameters

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from polycnc.control.parameters import KnownParameter

_HEAD = '''"""The parameters of the control as attributes; written from {file} by `control/parameter_module.py`."""

from __future__ import annotations

from polycnc.control.parameters import {names}
'''
_CLASS = '''

class {prefix}AxisParameters(AxisParameters):
    """The parameters that every axis has."""{of_axis}


class {prefix}Parameters(ControlParameters["{prefix}AxisParameters"]):
    """The parameters of the control."""

    axis_class = {prefix}AxisParameters{of_control}
'''
#: Width of a comment.
_WIDTH = 110


def module_text(file: str, prefix: str) -> str:
    """The text of the module.

    Args:
        file: The list, in the package `control`.
        prefix: What the names of the two classes begin with.
    """
    known = load_parameters(file)
    kinds = {_kind(parameter) for parameter in known}
    names = ", ".join(sorted({*kinds, "AxisParameters", "ControlParameters"}))
    return _HEAD.format(file=Path(file).name, names=names) + _CLASS.format(
        prefix=prefix,
        of_axis=_lines(parameter for parameter in known if parameter.by_axis),
        of_control=_lines(parameter for parameter in known if not parameter.by_axis),
    )


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
    yield f"    {parameter.name} = {kind}({number}{bit}{count}, delivered={_delivered(parameter, kind)})"


def _kind(parameter: KnownParameter) -> str:
    """The class of the attribute."""
    if parameter.key.bit is not None:
        return "Bit"
    if not parameter.whole:
        return "Number"
    return "Whole" if parameter.count == 1 else "WholeRun"


def _delivered(parameter: KnownParameter, kind: str) -> str:
    value = parameter.delivered
    if value is None:
        return "None"
    return repr(bool(value) if kind == "Bit" else float(value) if kind == "Number" else int(value))


if __name__ == "__main__":
    list_file, class_prefix = sys.argv[1:]
    module = Path(str(files("polycnc.control"))) / Path(list_file).with_suffix(".py")
    module.write_text(module_text(list_file, class_prefix), encoding="utf-8")
