"""The lists of parameters of all controls that have one, and the modules that are written from them."""

from __future__ import annotations

import ast
import re
from functools import cache
from importlib.resources import files
from pathlib import Path

import pytest

from polycnc.control import registry
from polycnc.control.parameter_module import module_text, table_text
from polycnc.control.parameters import (
    BY_NAME,
    NOT_YET,
    AxisParameters,
    Constant,
    ControlParameters,
    KnownParameter,
    Parameter,
    known_parameters,
)
from polycnc.control.word_address.control import WordAddressControl
from polycnc.control.word_address.parameters import MacroAxisParameters, MacroParameters

FOLDER = Path(str(files("polycnc.control")))
MILL, LATHE, MELDAS, SYNTEC, SINUMERIK = "fanuc-m", "fanuc-0i-tf", "meldas-m", "syntec-mill", "sinumerik-840d"
CONTROLS = (MILL, LATHE, MELDAS, SYNTEC)
#: Folders of SINUMERIK's handlers, which read data by identifier.
BY_IDENTIFIER = (FOLDER / "sinumerik", FOLDER.parent / "language/sinumerik")
_IDENTIFIER = re.compile(r"""(?<=["`])\$(?:[MS][NCA]S?|MM)_[A-Z0-9_{}a-z(), ]+(?=["`])""")
#: Where the handlers of each control stand.
HANDLERS = {MILL: ("fanuc", "word_address"), LATHE: ("fanuc", "word_address"),
            MELDAS: ("meldas", "word_address"), SYNTEC: ("syntec",)}  # fmt: skip
#: Folder and prefix of the classes that those of a control extend.
BASES = {MILL: "fanuc.Fanuc", LATHE: "fanuc.Fanuc", MELDAS: "word_address.Macro", SYNTEC: ""}
#: What mills have and lathes have not.
OF_MILLS = {"SCR", "overrun"}


def control(name: str) -> WordAddressControl:
    found = registry.control(name)
    assert isinstance(found, WordAddressControl)
    return found


def classes(name: str) -> tuple[type[ControlParameters[AxisParameters]], type[AxisParameters]]:
    """The classes of the parameters of the control and of an axis."""
    found = control(name).parameter_class
    assert found is not None
    return found, found.axis_class


def by_number(name: str) -> dict[str, KnownParameter]:
    return {parameter.number: parameter for parameter in known_parameters(registry.control(name))}


@cache
def read_in(folder: str) -> frozenset[str]:
    """The attributes that the modules of a folder name."""
    modules = [path for path in (FOLDER / folder).rglob("*.py") if path.name != "parameters.py"]
    modules += (FOLDER / folder).glob("parameters.py") if folder == "word_address" else ()
    trees = [ast.parse(path.read_text(encoding="utf-8")) for path in modules]
    return frozenset(
        node.attr for tree in trees for node in ast.walk(tree) if isinstance(node, ast.Attribute)
    )


@pytest.mark.parametrize("name", CONTROLS)
def test_the_module_is_what_the_lists_give(name: str) -> None:
    written, lists = classes(name)[0], control(name).parameter_files
    module = FOLDER.joinpath(*written.__module__.split(".")[2:]).with_suffix(".py")
    prefix = written.__name__.removesuffix("Parameters")
    assert module == (FOLDER / lists[-1]).with_suffix(".py")
    assert module.read_text(encoding="utf-8") == module_text(lists[-1], prefix, BASES[name])


def test_the_module_of_what_both_fanuc_controls_have_is_what_its_list_gives() -> None:
    written = (FOLDER / "fanuc/parameters.py").read_text(encoding="utf-8")
    assert written == module_text("fanuc/parameters.toml", "Fanuc", "word_address.Macro", shared=True)


@pytest.mark.parametrize("name", CONTROLS)
def test_the_parameters_that_a_list_gives_to_handlers_are_those_that_they_read(name: str) -> None:
    read = frozenset[str]().union(*map(read_in, HANDLERS[name]))
    known = known_parameters(registry.control(name))
    assert {each.name for each in known if each.read == BY_NAME} <= read
    assert not {each.name for each in known if each.read == NOT_YET} & read
    assert {each.read for each in known} <= {BY_NAME, NOT_YET}


@pytest.mark.parametrize("name", registry.ids())
def test_every_parameter_has_both_languages_and_a_name_and_numbers_of_its_own(name: str) -> None:
    known = known_parameters(registry.control(name))
    keys = [key for parameter in known for key in parameter.keys]
    assert all(parameter.texts["en"] and parameter.texts["zh-TW"] for parameter in known)
    assert len(set(keys)) == len(keys)
    assert len({parameter.name for parameter in known}) == len(known) > 0
    assert all(parameter.name.removeprefix("$").isidentifier() for parameter in known)


@pytest.mark.parametrize("name", CONTROLS)
def test_no_name_is_one_of_the_values_themselves(name: str) -> None:
    own = {*dir(ControlParameters), *dir(AxisParameters), "given", "axis"}
    assert not own & {parameter.name for parameter in known_parameters(registry.control(name))}


@pytest.mark.parametrize(("name", "constant"), [(MILL, set()), (LATHE, OF_MILLS), (MELDAS, None)])
def test_every_shared_name_has_a_number_or_a_constant_on_every_control(
    name: str, constant: set[str] | None
) -> None:
    of_control, of_axis = classes(name)
    found = {each: getattr(of_control, each) for each in MacroParameters.__annotations__}
    found |= {each: getattr(of_axis, each) for each in MacroAxisParameters.__annotations__}
    assert all(isinstance(parameter, Parameter) for parameter in found.values())
    assert constant in (None, {each for each, p in found.items() if isinstance(p, Constant)})


def test_both_fanuc_controls_have_the_shared_list_and_each_its_own() -> None:
    assert (by_number(MILL)["5114"], by_number(MILL)["6008#6"]) == (
        by_number(LATHE)["5114"],
        by_number(LATHE)["6008#6"],
    )
    assert "5440" not in by_number(LATHE)
    assert "3402#4" not in by_number(MILL)


def test_a_list_is_in_the_order_of_its_numbers() -> None:
    known = [parameter.key for parameter in known_parameters(registry.control(LATHE))]
    keys = [(key.id, -1 if key.bit is None else key.bit) for key in known if isinstance(key.id, int)]
    assert keys == sorted(keys)
    assert len(keys) == len(known) > 200


def test_a_name_takes_numbers_that_lie_apart() -> None:
    calls = by_number(MELDAS)["7201"]
    assert [key.id for key in calls.keys] == list(range(7201, 7300, 10))
    assert calls.numbers == "7201-7291"


def test_the_table_of_machine_data_is_what_the_list_gives() -> None:
    written = (FOLDER / "sinumerik/data/delivered.py").read_text(encoding="utf-8")
    assert written == table_text("sinumerik/data/machine_data.toml")


def test_machine_data_that_act_are_those_that_handlers_name() -> None:
    # Two modules only tell values: those that are delivered, and those of the machine file.
    telling = {"delivered", "of_machine"}
    modules = [path for folder in BY_IDENTIFIER for path in folder.rglob("*.py") if path.stem not in telling]
    named = {name for path in modules for name in _IDENTIFIER.findall(path.read_text(encoding="utf-8"))}
    # A name that is put together, as `$MA_POS_LIMIT_{side}`, means every datum that it can be.
    patterns = [re.compile(r"\w*".join(map(re.escape, re.split(r"\{.*?\}", name)))) for name in named]
    known = known_parameters(registry.control(SINUMERIK))
    acting = {each.name for each in known if any(pattern.fullmatch(each.name) for pattern in patterns)}
    assert acting == {each.name for each in known if each.read == BY_NAME}


def test_names_of_machine_data_say_whether_every_axis_has_its_own() -> None:
    known = known_parameters(registry.control(SINUMERIK))
    assert all(each.by_axis == (each.name[2] == "A") for each in known)
