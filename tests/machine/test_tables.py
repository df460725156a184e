"""The types of a machine file say what its schema says."""

from typing import NotRequired, get_origin, get_type_hints, is_typeddict

import pytest
from pydantic import BaseModel

from polycnc.machine import schema, tables

MODELS: dict[str, type[BaseModel]] = {
    name.removesuffix("Table"): model
    for name, model in vars(schema).items()
    if isinstance(model, type)
    and issubclass(model, BaseModel)
    and not name.startswith("_")
    and name != "BaseModel"
}


def _type(name: str) -> type:
    found: type = vars(tables)[{"Text": "Languages"}.get(name, name) + "Data"]
    return found


def test_every_table_of_the_schema_has_a_type() -> None:
    found = {value for value in vars(tables).values() if is_typeddict(value)}
    assert found == {_type(name) for name in MODELS}


@pytest.mark.parametrize("name", MODELS)
def test_type_has_the_keys_of_the_schema(name: str) -> None:
    keys = {field.alias or key for key, field in MODELS[name].model_fields.items()}
    assert set(_type(name).__annotations__) == keys


@pytest.mark.parametrize("name", MODELS)
def test_type_requires_what_the_schema_requires(name: str) -> None:
    required = {key for key, field in MODELS[name].model_fields.items() if field.is_required()}
    hints = get_type_hints(_type(name), include_extras=True)
    optional = {key for key, hint in hints.items() if get_origin(hint) is NotRequired}
    assert (set(hints) - optional if vars(_type(name))["__total__"] else set()) == required
