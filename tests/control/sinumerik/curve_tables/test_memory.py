from __future__ import annotations

from polycnc.control.sinumerik.curve_tables.curve import CurveTable, Segment
from polycnc.control.sinumerik.curve_tables.memory import CurveTables, Usage
from polycnc.memory.encoding import decode, encode
from polycnc.memory.retained import InMemoryStore
from polycnc.session import open_session

TABLE = CurveTable(3, 0, (Segment((0.0, 10.0), (0.0, 5.0)), Segment((10.0, 20.0), (5.0, 0.0, 4.0))))
DEFINITION = 'CTABDEF(Y,X,{0},0,"{1}")\nG1 X0 Y0\nX10 Y{0}\nCTABEND\n'


def test_what_tables_take_up() -> None:
    usage = Usage.of((TABLE, TABLE))
    assert (usage.tables, usage.segments, usage.polynomials) == (2, {"L": 2, "P": 2}, 2)


def test_a_lock_taken_away_during_a_coupling_ends_with_it() -> None:
    tables = CurveTables({3: TABLE}, {})
    tables.lock((3,))
    tables.use(3)
    tables.use(3)
    tables.unlock((3,))
    assert 3 in tables.locks
    tables.leave(3)
    assert tables.is_protected(3)
    assert 3 in tables.locks
    tables.leave(3)
    assert not tables.is_protected(3)


def test_static_memory_outlives_the_power_and_dynamic_memory_does_not() -> None:
    memory = InMemoryStore()

    def run(text: str) -> dict[str, object]:
        session = open_session(text + "M30\n", control="sinumerik-840d", memory=memory)
        return dict(session.run().variables)

    run(DEFINITION.format(4, "SRAM") + DEFINITION.format(5, "DRAM") + "CTABLOCK(4)\n")
    found = run("DEF REAL GRAD\nR1=CTABEXISTS(4) R2=CTABEXISTS(5) R3=CTAB(5,4,GRAD) R4=CTABISLOCK(4)\n")
    assert [found.get(name, 0) for name in ("R1", "R2", "R3", "R4")] == [1, 0, 2, 1]


def test_a_table_can_be_written_into_a_file() -> None:
    assert decode(encode(TABLE)) == TABLE
