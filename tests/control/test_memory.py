"""The memory of a control gives its features' states names: what changes in a run belongs to a state."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from typing import TYPE_CHECKING

import pytest

from polycnc.channel.channel import Channel
from polycnc.channel.states.state import lifetimes, plain
from polycnc.control.registry import control
from polycnc.machine import load_machine, parse_setup
from polycnc.program import Form, ProgramStore
from tests.channel.states.test_snapshot import LANGUAGES, Language

if TYPE_CHECKING:
    from collections.abc import Iterator

#: What a memory has at hand of something else: the variables of the running level, parameters of the channel's setup.
AT_HAND = {"locals", "parameters"}


def run_of(control_id: str, language: Language, block: str) -> Iterator[Channel]:
    """A channel behind power-on, and again at the end of a program with a block."""
    chosen = control(control_id)
    store = ProgramStore(form=chosen.form)
    folder = "/_N_MPF_DIR/" if chosen.form is Form.SINUMERIK else ""
    main = store.add_text(f"{folder}MAIN", f"{language.head}\n{block}\n{language.tail}\n")
    for name, more in language.files.items():
        store.add_text(folder + name, more)
    channel = Channel(
        chosen, load_machine(chosen.default_machine), parse_setup(language.setup), store, block_limit=3000
    )
    channel.begin(main, power_on=True)
    yield channel
    while channel.advance() is not None:
        pass
    yield channel


def own_contents(channel: Channel) -> dict[str, object]:
    """The fields of a memory that no state has, as plain values."""
    states, memory = channel.states.values(), channel.memory
    of_states = {id(state) for state in states}
    of_states |= {id(getattr(state, name)) for state in states for name in lifetimes(type(state))}
    names = [each.name for each in fields(memory)] if is_dataclass(memory) else list(vars(memory))
    values = {name: getattr(memory, name) for name in names if name not in AT_HAND}
    return {name: plain(value) for name, value in values.items() if id(value) not in of_states}


@pytest.mark.parametrize("control_id", LANGUAGES)
def test_no_program_changes_a_field_of_the_memory_that_is_no_state(control_id: str) -> None:
    language = LANGUAGES[control_id]
    changed = set()
    for block in language.blocks:
        run = run_of(control_id, language, block)
        before = own_contents(next(run))
        after = own_contents(next(run))
        changed |= {name for name, value in after.items() if before.get(name) != value}
    assert changed == set()
