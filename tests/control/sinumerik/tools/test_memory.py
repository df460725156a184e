"""Tool lengths by plane and type."""

from __future__ import annotations

import pytest

from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.control.sinumerik.tools.edges import DP_LENGTH, DP_TYPE
from polycnc.control.sinumerik.tools.lengths import Rules
from polycnc.control.sinumerik.tools.memory import Tools, tools_of_setup
from polycnc.machine.setup.values import Offsets, Parameters, Tool


def loaded(type_: float) -> Tools:
    tools = Tools({})
    values = tools.new_edge(1, 1).values
    values[DP_TYPE] = type_
    values[DP_LENGTH : DP_LENGTH + 3] = [1.0, 2.0, 3.0]
    tools.load(1, data())
    return tools


def data() -> MachineData:
    return MachineData.of_setup(Parameters({}), {})


@pytest.mark.parametrize(
    ("type_", "plane", "lengths"),
    [
        (120, "G17", (3, 2, 1)),
        (120, "G18", (2, 1, 3)),
        (120, "G19", (1, 3, 2)),
        (500, "G17", (2, 1, 3)),
        (500, "G18", (1, 3, 2)),
        (500, "G19", (3, 2, 1)),
    ],
)
def test_lengths_go_to_the_axes_of_the_plane(type_: float, plane: str, lengths: tuple[float, ...]) -> None:
    tools = loaded(type_)
    tools.assign_lengths(plane)
    assert tools.lengths == lengths


@pytest.mark.parametrize(
    ("constant", "lengths"), [(17, (3, 2, 1)), (-17, (2, 3, 1)), (-19, (1, 2, 3)), (99, (3, 2, 1))]
)
def test_the_assignment_can_be_held_by_setting_data(constant: int, lengths: tuple[float, ...]) -> None:
    tools = loaded(120)
    tools.rules = Rules(constant=constant)
    tools.assign_lengths("G18")
    assert tools.lengths == lengths


def test_a_tool_of_the_setup_has_length_wear_and_base() -> None:
    given = Tool(length=100.0, radius=5.0, wear=Offsets(length=-0.2, radius=0.1), geom2=Offsets(length=30.0))
    edge = tools_of_setup({7: given})[7].edges[1]
    assert [edge.length(i) for i in range(3)] == pytest.approx([129.8, 0.0, 0.0])
    assert edge.radius() == pytest.approx(5.1)


def test_a_tool_with_a_name_gets_a_free_number() -> None:
    tools = Tools(tools_of_setup({2: Tool(), "DRILL": Tool(length=10.0)}))
    assert tools.find("drill").number == 3
