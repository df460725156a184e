"""The page in a browser, without a browser: markup, the JSON interface, who may come in."""

from __future__ import annotations

import asyncio
import json
from random import Random
from typing import Any

import pytest

from polycnc.mainrun import State, VirtualControl
from polycnc.messages import UserError
from polycnc.panel.screens.view import Cell, View, Window
from polycnc.panel.web.desk import Desk
from polycnc.panel.web.guard import COOKIE, Guard, is_own_origin
from polycnc.panel.web.markup import of_view
from polycnc.panel.web.messages import COMMANDS, LONGEST, READS, answer


@pytest.fixture
def desk() -> Desk:
    return Desk(VirtualControl("fanuc-m"))


def asked(desk: Desk, do: str, **given: Any) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(answer(desk, json.dumps({"do": do, "with": given})))
    return found


# ---- markup ------------------------------------------------------------------------------------------------


def test_what_a_control_shows_is_never_markup() -> None:
    nasty = "<script>x</script>"
    window = Window("program", nasty, ((Cell(nasty, "code"),),))
    view = View(
        "p", nasty, nasty, (window,), (), entry=nasty, message=nasty, status=(Cell(nasty),), alarm=nasty
    )
    assert "<script" not in of_view(view)
    assert of_view(view).count("&lt;script") == 8


# ---- the desk ----------------------------------------------------------------------------------------------


def test_cycle_start_in_mdi_runs_what_was_typed(desk: Desk) -> None:
    desk.turn("mode", "mdi")
    desk.screen.mdi_text = "G0 X2.\n"
    desk.press("START")
    desk.control.run()
    assert desk.control.positions.work["X"] == pytest.approx(2.0)


def test_what_a_key_refuses_is_the_message_of_the_screen(desk: Desk) -> None:
    desk.press("B3")
    assert "C8" in desk.screen.message
    desk.press("C8", "C1")
    assert desk.screen.message == ""
    assert desk.control.switches.single_block
    desk.turn("mode", "jog")
    desk.press("X+")
    desk.control.step(0.5)
    desk.release("X+")
    assert desk.control.positions.work["X"] > 0.0


# ---- messages ----------------------------------------------------------------------------------------------


def test_a_program_is_loaded_run_and_read_over_the_wire(desk: Desk) -> None:
    assert asked(desk, "load", source="O1\n#100=7.\nG0 X5.\nM30\n") == {"ok": None}
    assert asked(desk, "cycle_start") == {"ok": None}
    desk.control.run()
    shown = asked(desk, "snapshot")["ok"]
    assert shown["positions"]["work"]["X"] == 5.0
    assert shown["state"] == "ready"
    assert asked(desk, "read_variable", name="#100") == {"ok": 7.0}
    assert asked(desk, "press", keys=["C8", "C2"]) == {"ok": None}
    assert desk.control.switches.optional_stop
    assert asked(desk, "screen")["ok"]["page"] == "pos-abs"


def test_cycle_start_over_the_wire_runs_what_was_typed_at_mdi(desk: Desk) -> None:
    asked(desk, "turn", switch="mode", position="mdi")
    asked(desk, "screen_key", key="PROG")
    desk.screen.show("mdi")
    asked(desk, "type", text="G0 X2.")
    asked(desk, "screen_key", key="INSERT")
    assert asked(desk, "press", keys=["START"]) == {"ok": None}
    desk.control.run()
    assert desk.control.positions.work["X"] == pytest.approx(2.0)


def test_a_refusal_has_the_text_that_python_raises(desk: Desk) -> None:
    found = asked(desk, "jog", axis="X", direction=1)
    assert found == {"refused": str(_refusal(desk))}


def _refusal(desk: Desk) -> Exception:
    with pytest.raises(Exception) as caught:  # noqa: PT011 - the text is compared
        desk.control.jog("X", 1)
    return caught.value


@pytest.mark.parametrize("name", ["close", "checkpoint", "change", "_data", "listeners", "__class__", "step"])
def test_nothing_but_the_commands_is_reached(desk: Desk, name: str) -> None:
    assert "refused" in asked(desk, name)


def test_no_file_of_the_server_is_reached(desk: Desk, tmp_path: Any) -> None:
    secret = tmp_path / "secret.nc"
    secret.write_text("O1\nG0 X77.\nM30\n", encoding="utf-8")
    asked(desk, "load", source=str(secret))
    asked(desk, "cycle_start")
    desk.control.run()
    assert desk.control.positions.work["X"] == 0.0


def test_ten_thousand_random_messages_end_in_answers(desk: Desk) -> None:
    random = Random(3)
    names: list[Any] = [
        *COMMANDS,
        *READS,
        *desk.actions,
        "nothing",
        "",
        5,
        None,
        [],
    ]
    values = [
        0,
        -1,
        1e308,
        "X",
        "#500",
        "",
        None,
        [],
        {},
        True,
        "O1\nG0 X1.\nM30\n",
        "auto",
        "START",
        float("inf"),
    ]
    words = ["source", "axis", "direction", "name", "value", "mode", "keys", "number", "switch", "position", "text",
             "feed", "rapid", "notches", "index", "size", "steps", "pulses", "target", "seconds",
             "channel", "pressed"]  # fmt: skip
    for _ in range(10_000):
        if random.random() < 0.1:
            message = "".join(chr(random.randrange(1, 300)) for _ in range(random.randrange(40)))
        else:
            given: Any = {random.choice(words): random.choice(values) for _ in range(random.randrange(4))}
            message = json.dumps(
                {"do": random.choice(names), "with": random.choice([given, given, values[7]])}
            )
        found = json.loads(answer(desk, message))
        assert found.keys() in ({"ok"}, {"refused"})
    assert desk.control.state in State


@pytest.mark.parametrize(
    "message",
    [
        "[" * 100_000,
        '{"do":' * 50_000,
        "1" * 5_000,
        " " * LONGEST + "1",
        '{"do": "load", "with": 5}',
        "\ud800",
    ],
)
def test_what_is_no_message_is_refused(desk: Desk, message: str) -> None:
    assert json.loads(answer(desk, message)).keys() == {"refused"}


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1e999"])
def test_numbers_without_end_are_refused(desk: Desk, number: str) -> None:
    wanted = f'{{"do": "write_variable", "with": {{"name": "#11001", "value": {number}}}}}'
    assert "refused" in json.loads(answer(desk, wanted))
    signal = f'{{"do": "signal", "with": {{"name": "DOOR_OPEN", "value": {number}}}}}'
    assert "refused" in json.loads(answer(desk, signal))
    for command in (desk.control.write_variable, desk.control.write_parameter):
        with pytest.raises(UserError):
            command("#500" if command == desk.control.write_variable else "1320", float(number))


def test_a_fault_and_a_signal_come_over_the_wire(desk: Desk) -> None:
    assert asked(desk, "fault", name="air") == {"ok": None}
    assert desk.control.signals["AIR_LOW"] == 1.0
    assert asked(desk, "fault", name="air", pressed=False) == {"ok": None}
    assert asked(desk, "signal", name="SKIP", value=1) == {"ok": None}
    assert desk.control.signals["SKIP"] == 1.0
    assert "refused" in asked(desk, "fault", name="nothing")
    assert "refused" in asked(desk, "signal", name="SKIP", value="x")
    done = asked(desk, "recording")["ok"]
    assert [act["do"] for act in done] == ["fault", "fault", "signal", "fault", "signal"]


def test_a_memory_that_cannot_be_written_is_told_and_the_other_things_go_on(desk: Desk) -> None:
    def commit() -> None:
        raise UserError("memory.full", file="m.db")

    asked(desk, "load", source="O1\nG0 X5.\nM30\n")
    desk.control._retained.commit = commit  # type: ignore[method-assign]
    asked(desk, "cycle_start")
    for _ in range(200):
        desk._then -= 0.05
        desk.tick()
    assert desk.control.positions.work["X"] == 5.0
    assert desk.control.state is State.READY
    assert "m.db" in desk.screen.message
    asked(desk, "cycle_start")
    asked(desk, "reset")
    desk._then -= 0.2
    desk.tick()
    assert desk.control.state is State.READY
    asked(desk, "turn", switch="mode", position="mdi")
    assert desk.control.mode == "mdi"


# ---- who may come in ---------------------------------------------------------------------------------------


def status_of(token: str, query: str = "", **headers: str) -> int:
    """The status that a request gets."""
    seen: list[Any] = []

    async def application(scope: Any, receive: Any, send: Any) -> None:
        await send({"type": "http.response.start", "status": 200, "headers": []})

    async def send(message: Any) -> None:
        seen.append(message)

    async def receive() -> Any:
        return {}

    listed = [(name.encode(), value.encode()) for name, value in headers.items()]
    scope = {"type": "http", "headers": listed, "query_string": query.encode()}
    asyncio.run(Guard(application, token)(scope, receive, send))
    status: int = seen[0]["status"]
    return status


def test_on_the_loopback_no_token_is_needed() -> None:
    assert status_of("") == 200


def test_elsewhere_the_token_opens_the_door() -> None:
    assert status_of("secret") == 403
    assert status_of("secret", "token=wrong") == 403
    assert status_of("secret", "token=secret") == 200
    assert status_of("secret", cookie=f"{COOKIE}=secret") == 200


def test_a_name_that_has_been_led_to_this_computer_is_refused() -> None:
    assert status_of("", host="evil.example:8620", origin="http://evil.example:8620") == 403
    assert status_of("", host="evil.example:8620") == 403
    assert status_of("secret", "token=secret", host="shop.example:8620") == 200
    for own in ("127.0.0.1:8620", "localhost:8620", "[::1]:8620"):
        assert status_of("", host=own, origin=f"http://{own}") == 200


@pytest.mark.parametrize("wrong", ["http://[", "null", "http://127.0.0.1:8620@evil.example"])
def test_an_origin_that_is_none_is_refused(wrong: str) -> None:
    assert status_of("", host="127.0.0.1:8620", origin=wrong) == 403


def test_a_wrong_token_beside_the_right_cookie_goes_into_no_cookie() -> None:
    assert status_of("secret", "token=a%0d%0ab%E4%B8%AD", cookie=f"{COOKIE}=secret") == 200
    assert status_of("secret", cookie="a b,;=\x00;" + COOKIE) == 403


def test_a_page_of_another_server_is_refused() -> None:
    assert status_of("", host="127.0.0.1:8620", origin="http://evil.example") == 403
    assert status_of("", host="127.0.0.1:8620", origin="http://127.0.0.1:8620") == 200
    assert is_own_origin({"host": "a:1"})
