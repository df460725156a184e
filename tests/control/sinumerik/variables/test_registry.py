"""The registry of system variables."""

from __future__ import annotations

import pytest

from polycnc.control.sinumerik.variables.known import is_known
from polycnc.control.sinumerik.variables.registry import VARIABLES, SystemVariables
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError
from tests.control.sinumerik.support import codes, run


@pytest.mark.parametrize("name", ["$TC_DPX1", "$AN_REBOOT_DELAY_TIME", "$VA_CURR"])
def test_a_variable_of_the_control_that_is_not_kept_says_so(name: str) -> None:
    assert is_known(name)
    with pytest.raises(AlarmError) as caught:
        SystemVariables().find(name)
    assert caught.value.code == "PC0001"


@pytest.mark.parametrize("name", ["$P_NONSENSE", "$XY", "$AA_"])
def test_a_name_that_nobody_has_is_unknown(name: str) -> None:
    with pytest.raises(AlarmError) as caught:
        SystemVariables().find(name)
    assert caught.value.code == "12550"


def test_actual_values_belong_to_the_main_run_and_programmed_ones_do_not() -> None:
    assert VARIABLES["$AA_IM"].stop
    assert not VARIABLES["$P_EP"].stop
    assert not VARIABLES["$P_UIFR"].stop


def test_every_variable_is_named_as_the_table_finds_it() -> None:
    assert all(name == variable.name and name[0] == "$" for name, variable in VARIABLES.items())


def test_frames_are_of_type_frame_and_their_components_are_numbers() -> None:
    assert VARIABLES["$P_PFRAME"].type is Type.FRAME
    result = run("TRANS X3 Y4", "R1=$P_PFRAME[Y,TR]")
    assert result.variables["R1"] == 4


def test_tool_data_make_a_tool() -> None:
    result = run(
        "$TC_DP1[3,2]=120", "$TC_DP6[3,2]=4", '$TC_TP2[3]="MILL"', 'T="MILL" D2', "R1=$P_TOOLR R2=$P_TOOLNO"
    )
    assert (result.variables["R1"], result.variables["R2"]) == (4, 3)


def test_tool_data_of_a_tool_that_is_not_there_cannot_be_read() -> None:
    assert codes(run("R1=$TC_DP6[9,1]")) == [("17190", 1)]


def test_one_memory_lies_behind_all_link_variables() -> None:
    result = run("$A_DLB[4]=1", "$A_DLB[5]=1", "R1=$A_DLW[4]")
    assert result.variables["R1"] == 257


def test_a_link_value_that_does_not_fit_is_refused() -> None:
    assert codes(run("$A_DLB[0]=256")) == [("12160", 1)]
