from __future__ import annotations

import pytest

from polycnc.geometry.frames import rotation, translation
from polycnc.machine.layout import AxisLayout
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.events import Auxiliary, Message, Raised
from polycnc.toolpath.modes import FeedMode
from polycnc.transformation.kinematic.cylinder import Cylinder
from polycnc.transformation.kinematic.parallel import ParallelAxes
from tests.toolpath.paths import MILL, Z_UP, Draft


def test_a_move_names_all_axes_on_both_displays_and_its_feed_in_mm_per_minute() -> None:
    draft = Draft().under(Context(frame=translation(100, 0, 0), offsets=(0, 0, 25)))
    draft.move(Kind.FEED, 1, 2, 3, feed=5.0)
    (record,) = draft.display().records()
    assert record == {
        "type": "feed",
        "program": "O0001",
        "line": 1,
        "unit": "mm",
        "to": {"X": 1, "Y": 2, "Z": 3},
        "machine": {"X": 101, "Y": 2, "Z": 28},
        "feed": 300,
    }


def test_a_rapid_has_no_feed_unless_its_block_gave_one() -> None:
    draft = Draft().move(Kind.RAPID, 1, 0, 0).move(Kind.RAPID, 2, 0, 0, feed=10)
    without, with_feed = draft.display().records()
    assert "feed" not in without
    assert with_feed["feed"] == 600


def test_an_inch_program_shows_inches_but_the_machine_display_stays_metric() -> None:
    layout = AxisLayout(geometry=(0, 1, 2), rotary=frozenset((3,)))
    draft = Draft(("X", "Y", "Z", "A")).under(Context(inch=True))
    draft.move(Kind.FEED, 25.4, 50.8, 0, 90, feed=25.4 / 60)
    (record,) = draft.display(layout).records()
    assert record["unit"] == "inch"
    assert record["to"] == pytest.approx({"X": 1, "Y": 2, "Z": 0, "A": 90})
    assert record["machine"] == pytest.approx({"X": 25.4, "Y": 50.8, "Z": 0, "A": 90})
    assert record["feed"] == pytest.approx(1)


def test_contexts_that_come_and_go_are_not_taken_for_one_another() -> None:
    display = Draft().display()
    for _ in range(50):  # a new one may stand where the last one stood in memory
        for inch in (True, False):
            assert display.scale(Context(inch=inch)).unit == ("mm", "inch")[inch]


def test_diameter_axes_show_twice_the_radius_in_positions_and_centres() -> None:
    layout = AxisLayout(geometry=(0, -1, 1))
    draft = Draft(("X", "Z")).under(
        Context(plane="G18", diameter_axes=0b01, feed_mode=FeedMode.PER_REVOLUTION)
    )
    draft.move(Kind.CW, 20, -20, feed=0.2, curve=(20, 0, -15, 0, 1, 0, 0))
    (record,) = draft.display(layout).records()
    assert record["to"] == {"X": 40, "Z": -20}
    assert record["machine"] == {"X": 40, "Z": -20}
    assert record["center"] == {"X": 40, "Z": -15}
    assert record["feed"] == 0.2


@pytest.mark.parametrize(
    ("mode", "inside", "shown"),
    [
        (FeedMode.PER_MINUTE, 2.0, 120.0),
        (FeedMode.PER_REVOLUTION, 2.0, 2.0),
        (FeedMode.INVERSE_TIME, 2.0, 120.0),
    ],
)
def test_feed_is_shown_in_the_unit_of_the_feed_mode(mode: FeedMode, inside: float, shown: float) -> None:
    draft = Draft().under(Context(feed_mode=mode)).move(Kind.FEED, 1, 0, 0, feed=inside)
    (record,) = draft.display().records()
    assert record["feed"] == shown


def test_inverse_time_is_no_length_and_so_the_same_in_inches() -> None:
    draft = (
        Draft().under(Context(feed_mode=FeedMode.INVERSE_TIME, inch=True)).move(Kind.FEED, 1, 0, 0, feed=2)
    )
    (record,) = draft.display().records()
    assert record["feed"] == 120


def test_the_feed_of_a_thread_is_its_lead_even_in_feed_per_minute() -> None:
    draft = (
        Draft()
        .under(Context(feed_mode=FeedMode.PER_MINUTE))
        .move(Kind.THREAD, 0, 0, -9, feed=1.5, curve=(1.5, 90))
    )
    (record,) = draft.display().records()
    assert (record["feed"], record["lead"], record["start_angle"]) == (1.5, 1.5, 90)


def test_modulo_axes_stay_within_a_turn_on_the_work_display_only() -> None:
    layout = AxisLayout(geometry=(0, 1, 2), rotary=frozenset((3,)), modulo=frozenset((3,)))
    draft = Draft(("X", "Y", "Z", "C"))
    draft.move(Kind.RAPID, 0, 0, 0, 370).move(Kind.RAPID, 0, 0, 0, -1e-12).move(Kind.RAPID, 0, 0, 0, -90)
    records = list(draft.display(layout).records())
    assert [record["to"]["C"] for record in records] == [10, 0, 270]
    assert records[0]["machine"]["C"] == 370


def test_a_centre_names_the_axes_of_the_plane_and_all_three_in_a_tilted_one() -> None:
    draft = Draft()
    draft.move(Kind.CCW, 1, 0, 0, curve=(5, 6, 7, 0, 0, 1, 0))
    draft.move(Kind.CCW, 1, 0, 0, curve=(5, 6, 7, 0, 1, 0, 0))
    draft.move(Kind.CCW, 1, 0, 0, curve=(5, 6, 7, 0.6, 0.8, 0, 0))
    centers = [record["center"] for record in draft.display().records()]
    assert centers == [{"X": 5, "Y": 6}, {"X": 5, "Z": 7}, {"X": 5, "Y": 6, "Z": 7}]


def test_turns_are_told_only_where_there_is_more_than_one() -> None:
    draft = Draft()
    draft.move(Kind.HELIX_CW, 0, 0, -1, curve=(5, 0, 0, *Z_UP, 0))
    draft.move(Kind.HELIX_CW, 0, 0, -9, curve=(5, 0, 0, *Z_UP, 2))
    one, three = draft.display().records()
    assert "turns" not in one
    assert three["turns"] == 3


def test_a_dwell_tells_seconds_or_revolutions() -> None:
    draft = Draft().move(Kind.DWELL, 0, 0, 0, curve=(2.5, 0)).move(Kind.DWELL, 0, 0, 0, curve=(0, 3))
    seconds, revolutions = draft.display().records()
    assert seconds["seconds"] == 2.5
    assert revolutions["revolutions"] == 3
    assert "seconds" not in revolutions


def test_events_keep_their_place_and_their_data() -> None:
    draft = Draft().event(Auxiliary(3)).move(Kind.RAPID, 1, 0, 0).event(Message("完成"))
    assert [record["type"] for record in draft.display().records()] == ["m", "rapid", "message"]


def test_an_alarm_event_gets_the_text_that_the_control_has_for_it() -> None:
    draft = Draft().event(Raised("PS0010", 1, 0, "O1"))
    from polycnc.toolpath.trace import Display

    display = Display(draft.toolpath, MILL, lambda raised: f"text of {raised.code}")
    (record,) = display.records()
    assert record["text"] == "text of PS0010"


def test_a_rotated_frame_leads_to_the_machine_display() -> None:
    draft = Draft().under(Context(frame=rotation(2, 90))).move(Kind.FEED, 10, 0, 0)
    (record,) = draft.display().records()
    assert record["machine"] == {"X": 0, "Y": 10, "Z": 0}


def test_under_a_transformation_the_machine_display_shows_the_real_axes_shifted_by_the_frame() -> None:
    context = Context(
        transformation=Cylinder(0, 2.0, (0, 1, 2)), frame=translation(100, 0, 0), offsets=(0, 0, 5)
    )
    draft = Draft().under(context).move(Kind.FEED, 10, 0, 0)
    display = draft.display()
    (record,) = display.records()
    assert record["to"]["X"] == 10
    assert record["machine"] == {"X": 105, "Y": 0, "Z": 5}
    assert list(display._records_by_column(draft.toolpath.chunks[0])) == [record]


def test_a_rotary_axis_that_is_a_length_of_the_plane_keeps_its_sign() -> None:
    layout = AxisLayout(geometry=(0, 1, -1), rotary=frozenset({2}), modulo=frozenset({2}))
    draft = Draft().under(Context(transformation=ParallelAxes((0, 2, 1)))).move(Kind.FEED, 10, 0, -20)
    (record,) = draft.display(layout).records()
    assert record["to"]["Z"] == -20
    plain = Draft().move(Kind.FEED, 10, 0, -20)
    (record,) = plain.display(layout).records()
    assert record["to"]["Z"] == 340
