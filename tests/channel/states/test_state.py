"""State of features: first values come back when a lifetime ends, in the same object."""

from __future__ import annotations

import importlib
import pkgutil

import pytest

import polycnc.control
from polycnc.channel.channel import Channel
from polycnc.channel.states.state import (
    Lifetime,
    State,
    end_of,
    lasting,
    lifetimes,
    plain_states,
    retained,
    tables,
)
from polycnc.control.registry import control
from polycnc.deferred.records import dataclass, field, fields
from polycnc.machine import load_machine
from polycnc.machine.setup.values import Setup
from polycnc.program import ProgramStore


@dataclass(slots=True)
class Kept(State, lifetime=Lifetime.RETAINED):
    """A state whose field is a table."""

    values: dict[str, int] = retained("probe")


@dataclass(slots=True)
class Probe(State, lifetime=Lifetime.RESET):
    """A state with a field of each lifetime, and one with the lifetime of the class."""

    plain: list[int] = field(default_factory=list)
    block: int = lasting(Lifetime.BLOCK, 1)
    program: int = lasting(Lifetime.PROGRAM, 2)
    power: list[int] = lasting(Lifetime.POWER, factory=list)


@pytest.fixture
def channel() -> Channel:
    return Channel(control("fanuc-m"), load_machine("mill3"), Setup(), ProgramStore())


@pytest.mark.parametrize(
    ("event", "left"),
    [
        (Lifetime.BLOCK, {"plain", "program", "power"}),
        (Lifetime.PROGRAM, {"plain", "power"}),
        (Lifetime.RESET, {"power"}),
        (Lifetime.POWER, set()),
    ],
)
def test_an_event_ends_every_lifetime_up_to_its_own(
    channel: Channel, event: Lifetime, left: set[str]
) -> None:
    state = Probe.of(channel)
    first = Probe()
    for name in ("block", "program"):
        setattr(state, name, 77)
    state.plain.append(77)
    state.power.append(77)
    end_of(channel, event)
    changed = {each.name for each in fields(Probe) if getattr(state, each.name) != getattr(first, each.name)}
    assert changed == left
    assert Probe.of(channel) is state


def test_a_class_that_a_parameter_keeps_is_left_alone(channel: Channel) -> None:
    Probe.of(channel).program = 77
    end_of(channel, Lifetime.POWER, kept={Probe})
    assert Probe.of(channel).program == 77


def test_channels_have_states_of_their_own(channel: Channel) -> None:
    other = Channel(control("fanuc-m"), load_machine("mill3"), Setup(), ProgramStore())
    Probe.of(channel).program = 77
    assert Probe.of(other).program == 2


def test_a_state_that_is_as_it_began_does_not_count_in_a_comparison(channel: Channel) -> None:
    before = plain_states(channel)
    state = Probe.of(channel)
    assert plain_states(channel) == before
    state.plain.append(1)
    assert plain_states(channel) != before


def test_no_event_ends_what_is_retained(channel: Channel) -> None:
    Kept.of(channel).values["a"] = 1
    end_of(channel, Lifetime.POWER)
    end_of(channel, Lifetime.RETAINED)
    assert Kept.of(channel).values == {"a": 1}
    assert Kept.of(channel).values is channel.retained.table("probe", channel.number)


def test_a_retained_field_can_only_be_a_table() -> None:
    with pytest.raises(ValueError, match="table"):
        lasting(Lifetime.RETAINED, 5)


def test_every_field_of_every_state_has_a_lifetime() -> None:
    for module in pkgutil.walk_packages(polycnc.control.__path__, "polycnc.control."):
        importlib.import_module(module.name)
    for cls in State.CLASSES.values():
        lives = lifetimes(cls)
        assert all(isinstance(each, Lifetime) for each in lives.values()), cls
        assert {name for name, each in lives.items() if each is Lifetime.RETAINED} == set(tables(cls)), cls
