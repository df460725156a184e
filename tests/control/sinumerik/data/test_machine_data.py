"""Machine data of the setup, by number and by identifier."""

from __future__ import annotations

import pytest

from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.language.sinumerik.names.values import Axis
from polycnc.machine.setup.values import Parameters, Value, parameter_key
from polycnc.messages import AlarmError

AXES = {"X": "X", "X1": "X", "AX1": "X", "Y": "Y"}


def data(**parameters: Value) -> MachineData:
    return MachineData.of_setup(
        Parameters({parameter_key(key): value for key, value in parameters.items()}), AXES
    )


def test_a_number_and_an_identifier_mean_the_same_datum() -> None:
    assert data(**{"21000": 0.5}).number("$MC_CIRCLE_ERROR_CONST") == 0.5
    assert data(**{"$MC_CIRCLE_ERROR_CONST": 0.5}).number("$MC_CIRCLE_ERROR_CONST") == 0.5


def test_every_name_of_an_axis_means_the_same_element() -> None:
    values = data(**{"36110[X]": 30})
    assert [values.read("$MA_POS_LIMIT_PLUS", Axis(name)) for name in ("X", "X1", "AX1")] == [30, 30, 30]
    assert values.read("$MA_POS_LIMIT_PLUS", Axis("Y")) == 1e8


def test_a_list_gives_its_elements_and_the_first_without_an_index() -> None:
    values = data(**{"$MC_GCODE_RESET_VALUES": (3, 4)})
    assert values.read("$MC_GCODE_RESET_VALUES", 1) == 4
    assert values.read("$MC_GCODE_RESET_VALUES") == 3


def test_a_bit_is_set_in_what_the_datum_has() -> None:
    assert data(**{"10280#1": 1}).integer("$MN_PROG_FUNCTION_MASK") == 2


def test_what_a_program_writes_it_reads_again() -> None:
    values = data()
    values.write("$MA_AX_VELO_LIMIT", (1, Axis("AX1")), 7.0)
    assert values.read("$MA_AX_VELO_LIMIT", 1, Axis("X")) == 7.0


def test_a_datum_that_is_not_kept_says_so() -> None:
    with pytest.raises(AlarmError) as caught:
        data().read("$MC_NO_SUCH_DATUM")
    assert caught.value.code == "PC0001"
