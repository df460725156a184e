"""Values of parameters as attributes."""

from __future__ import annotations

import pytest

from polycnc.control.parameters import (
    AxisParameters,
    Bit,
    Constant,
    ControlParameters,
    Number,
    Whole,
    WholeRun,
)
from polycnc.machine.setup.values import ParameterKey, Parameters, Value, parameter_key


class OfAxis(AxisParameters):
    """What every axis has."""

    DIA = Bit(1006, 3, delivered=None)
    largest_feed = Number(1430, delivered=0.0)


class Values(ControlParameters["OfAxis"]):
    """What the control has."""

    axis_class = OfAxis
    FPM = Bit(3402, 4, delivered=True)
    CLR = Bit(3402, 6, delivered=False)
    clamp_code = Whole(5110, delivered=0)
    least_move = Number(5010, delivered=0.001)


def values(given: dict[str, Value]) -> Values:
    return Values({parameter_key(name): value for name, value in given.items()})


def test_what_the_setup_does_not_say_is_as_delivered() -> None:
    found = values({})
    assert (found.FPM, found.CLR, found.clamp_code, found.least_move) == (True, False, 0, 0.001)
    assert found.of("X").DIA is None


def test_what_the_setup_says_counts() -> None:
    found = values({"3402#4": 0, "5110": 68.0, "5010": 1})
    assert (found.FPM, found.clamp_code, found.least_move) == (False, 68, 1.0)
    assert isinstance(found.clamp_code, int)


def test_a_bit_is_also_one_of_its_whole_number() -> None:
    found = values({"3402": 0b1000000})
    assert (found.CLR, found.FPM) == (True, False)


def test_an_axis_has_its_own_value_else_that_of_all() -> None:
    found = values({"1430": 1000, "1430 Z": 2000, "1006#3 X": 1})
    assert (found.of("X").largest_feed, found.of("Z").largest_feed) == (1000.0, 2000.0)
    assert (found.of("X").DIA, found.of("Z").DIA) == (True, None)


def test_text_and_lists_count_as_not_given() -> None:
    found = values({"5010": "x", "5110": (1, 2)})
    assert (found.least_move, found.clamp_code) == (0.001, 0)


def test_a_value_is_looked_up_once() -> None:
    found = values({})
    assert "CLR" not in vars(found)
    assert found.CLR is found.CLR
    assert vars(found)["CLR"] is False


def test_the_class_has_the_parameter_itself() -> None:
    assert Values.CLR.key == ParameterKey(3402, 6)
    assert values({"3402#6": 1}).value(Values.CLR) is True


def test_a_number_is_read_with_what_is_delivered() -> None:
    found = values({"3402#6": 1, "5110": 68, "1430 Z": 2000, "9000#3": 1})
    assert (found.at(5010), found.at(5110), found.at(1430, axis="Z"), found.at(1430)) == (
        0.001,
        68.0,
        2000.0,
        0.0,
    )
    assert (found.at(3402, 4), found.at(3402, 6), found.at(3402)) == (1.0, 1.0, 0b1010000)
    assert (found.at(9000, 3), found.at(9000)) == (1.0, 8.0)


def test_a_number_that_the_control_does_not_have_or_the_machine_says_is_none() -> None:
    found = values({})
    assert (found.at(1), found.at(3402, 5), found.at(1006, 3), found.at(1006)) == (None, None, None, None)


def test_a_constant_of_a_control_has_no_number() -> None:
    class Without(Values):
        """A control that has no parameter for it."""

        clamp_code = Constant(5)

    assert Without({parameter_key("5110"): 7}).clamp_code == 5
    assert Without().at(5110) is None


def test_each_of_several_numbers_is_delivered() -> None:
    class Several(Values):
        """Two numbers, ten apart."""

        codes = WholeRun(7001, 2, step=10, delivered=3)

    found = Several({parameter_key("7011"): 9})
    assert (found.codes, found.at(7001), found.at(7002), found.at(7011)) == ((3, 9), 3.0, None, 9.0)


def test_a_name_that_is_not_in_the_list_is_no_attribute() -> None:
    with pytest.raises(AttributeError):
        assert values({}).CLX  # type: ignore[attr-defined]


def test_another_value_makes_other_parameters() -> None:
    found = values({"5110": 1})
    changed = found.having(ParameterKey(3402, 6), 1)
    assert isinstance(changed, Values)
    assert (found.CLR, changed.CLR, changed.clamp_code) == (False, True, 1)


def test_parameters_get_their_names_once() -> None:
    named = Values.naming(Parameters({parameter_key("5110"): 7}))
    assert named.clamp_code == 7
    assert Values.naming(named) is named
