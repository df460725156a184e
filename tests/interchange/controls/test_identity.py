"""From a memory to its files and back: nothing is lost, whatever the memory holds (Hypothesis)."""

from __future__ import annotations

from typing import Any

from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from polycnc.control.fanuc.lathe.tools.offset_memory import TurningOffset
from polycnc.control.sinumerik.tools.edges import PARAMETERS as EDGE_PARAMETERS
from polycnc.control.sinumerik.tools.edges import Edge
from polycnc.control.sinumerik.tools.memory import Tool
from polycnc.control.word_address.memory import ToolOffset
from polycnc.language.sinumerik.names.frame import NEUTRAL
from polycnc.machine.setup.values import ParameterKey
from polycnc.memory.retained import InMemoryStore
from tests.interchange.support import check_identity, filled

FEW = settings(
    max_examples=15,
    deadline=None,
    phases=[Phase.explicit, Phase.generate],
    suppress_health_check=[HealthCheck.too_slow],
)
NUMBERS = st.floats(allow_nan=False, allow_infinity=False, min_value=-1e12, max_value=1e12).filter(
    lambda value: value == 0 or abs(value) > 1e-9
)
MICRONS = st.integers(-999_999, 999_999).map(lambda value: value / 1000)
#: These controls cut what is finer than their increment.
LENGTHS = MICRONS
SHIFTS = st.lists(LENGTHS, min_size=3, max_size=3)
OFFSETS = st.builds(ToolOffset, LENGTHS, LENGTHS, LENGTHS, LENGTHS)
SYSTEMS = st.sampled_from(["EXT", "G54", "G55", "G59", "G54.1 P1", "G54.1 P48"])


def store(**tables: Any) -> InMemoryStore:
    made = InMemoryStore()
    for name, (channel, values) in tables.items():
        made.table(name.replace("_", " "), channel).update(values)
    return made


MILL_PARAMETERS = st.fixed_dictionaries(
    {},
    optional={
        ParameterKey(5003, 0, None, None): st.sampled_from([0, 1]),
        ParameterKey(6003, 7, None, None): st.sampled_from([0, 1]),
        ParameterKey(1241, None, None, "Y"): MICRONS,
        ParameterKey(5460, None, None, None): st.integers(0, 3),
    },
)


@FEW
@given(
    st.dictionaries(st.integers(500, 999), st.one_of(st.none(), NUMBERS), max_size=6),
    st.dictionaries(st.from_regex(r"\A[A-Z][A-Z0-9]{0,7}\Z"), st.integers(500, 999), max_size=2),
    st.dictionaries(st.integers(1, 400), OFFSETS, max_size=3),
    st.dictionaries(st.one_of(SYSTEMS, st.sampled_from(["G54.2 P1", "G54.2 P8"])), SHIFTS, max_size=3),
    st.dictionaries(st.integers(0, 7), st.lists(LENGTHS, min_size=8, max_size=8), max_size=2),
    MILL_PARAMETERS,
)
def test_of_a_fanuc_mill(
    variables: dict[int, float | None],
    names: dict[str, int],
    offsets: dict[int, ToolOffset],
    systems: dict[str, list[float]],
    errors: dict[int, list[float]],
    parameters: dict[ParameterKey, float],
) -> None:
    check_identity(
        "fanuc-m",
        store(
            variables=(1, variables),
            variable_names=(1, names),
            tool_offsets=(1, offsets),
            work_offsets=(1, systems),
            workpiece_errors=(1, errors),
            parameters=(1, parameters),
        ),
    )


@FEW
@given(
    st.dictionaries(st.integers(500, 549), NUMBERS, max_size=6),
    st.dictionaries(st.integers(1, 99), OFFSETS, max_size=3),
)
def test_of_a_meldas_mill(variables: dict[int, float], offsets: dict[int, ToolOffset]) -> None:
    check_identity("meldas-m", store(variables=(1, variables), tool_offsets=(1, offsets)))


LATHE_AXES = st.fixed_dictionaries({}, optional={"X": MICRONS, "Z": MICRONS})


@FEW
@given(
    st.dictionaries(
        st.integers(1, 99),
        st.builds(TurningOffset, LATHE_AXES, LATHE_AXES, LATHE_AXES, MICRONS, MICRONS, st.integers(0, 9)),
        max_size=3,
    ),
    st.lists(MICRONS, min_size=2, max_size=2),
    st.dictionaries(SYSTEMS, st.lists(MICRONS, min_size=2, max_size=2), max_size=2),
    st.dictionaries(st.integers(500, 999), NUMBERS, max_size=3),
)
def test_of_a_lathe(
    offsets: dict[int, TurningOffset],
    shift: list[float],
    systems: dict[str, list[float]],
    variables: dict[int, float],
) -> None:
    check_identity(
        "fanuc-0i-tf",
        store(
            tool_offsets=(1, offsets),
            work_shift=(1, {"work": shift}),
            work_offsets=(1, systems),
            variables=(1, variables),
        ),
    )


LONGS = st.integers(-(2**31) + 1, 2**31 - 1)


@FEW
@given(
    st.dictionaries(
        st.one_of(st.integers(1, 400), st.integers(60000, 79999)), st.one_of(LONGS, NUMBERS), max_size=6
    ),
    st.dictionaries(st.integers(50, 80), LONGS, max_size=3),
    st.dictionaries(st.integers(4001, 4200), LONGS, max_size=3),
    st.dictionaries(st.integers(1, 99), OFFSETS, max_size=3),
    st.dictionaries(st.sampled_from(["EXT", "G54", "G59.9"]), SHIFTS, max_size=3),
)
def test_of_a_syntec_mill(
    variables: dict[int, float],
    registers: dict[int, int],
    parameters: dict[int, int],
    offsets: dict[int, ToolOffset],
    systems: dict[str, list[float]],
) -> None:
    check_identity(
        "syntec-mill",
        store(
            variables=(0, variables),
            registers=(0, registers),
            parameters=(0, parameters),
            tool_offsets=(1, offsets),
            work_offsets=(1, systems),
        ),
    )


EDGES = st.builds(
    Edge,
    st.lists(NUMBERS, min_size=EDGE_PARAMETERS - 1, max_size=EDGE_PARAMETERS - 1).map(
        lambda v: [0.0, 120.0, *v]
    ),
    st.integers(0, 9).map(float),
    st.integers(0, 9),
    st.just(True),
    st.dictionaries(
        st.tuples(st.sampled_from(["SCP", "ECP"]), st.sampled_from([13, 21, 64])), NUMBERS, max_size=2
    ),
)
TOOL_NAMES = st.text("ABCXYZ0189_", max_size=8)


@FEW
@given(
    st.lists(NUMBERS, min_size=100, max_size=100),
    st.dictionaries(
        st.integers(1, 99),
        st.tuples(TOOL_NAMES, st.dictionaries(st.integers(1, 9), EDGES, max_size=2)),
        max_size=2,
    ),
    st.lists(st.lists(LENGTHS, min_size=3, max_size=3), min_size=2, max_size=4),
    st.sampled_from([{}, {("$MN_INT_INCR_PER_MM", ()): 100.0}]),
)
def test_of_a_sinumerik(
    r: list[float],
    tools: dict[int, tuple[str, dict[int, Edge]]],
    shifts: list[list[float]],
    data: dict[Any, float],
) -> None:
    frames = [NEUTRAL] * 100
    for i, values in enumerate(shifts, 1):
        frame = NEUTRAL
        for axis, value in zip("XYZ", values, strict=True):
            frame = frame.with_component(axis, "TR", value)
        frames[i] = frame
    check_identity(
        "sinumerik-840d",
        store(
            variables=(1, {"R": r}),
            tools=(1, {n: Tool(n, name, edges) for n, (name, edges) in tools.items()}),
            work_offsets=(1, {"$P_UIFR": frames, "$P_CHBFR": [NEUTRAL]}),
            parameters=(0, data),
        ),
    )


def test_frames_that_turn_come_back() -> None:
    frames = "$P_UIFR[1]=CTRANS(X,5):CROT(Z,30):CMIRROR(X)\n"
    memory = filled("sinumerik-840d", f"{frames}$TC_CARR21[1]=X\n$TC_CARR1[1]=4\nM30\n")
    check_identity("sinumerik-840d", memory)
