"""An operator panel: keys are pressed, switches turned, lamps read; everything acts on a virtual control.

    panel = Panel(VirtualControl("fanuc-m"))
    panel.turn("mode", "jog")
    panel.press("C8", "B3")  # the safety key together with spindle clockwise
    panel.lamps()["B3"]  # Light.ON

What stands on the panel is data (`description`). What keys do to the machine is data too: the rules and alarms of the
control's `plc.toml`. Here stands only how a hand works a panel.
"""

from __future__ import annotations

from enum import StrEnum
from functools import partial
from math import isfinite

from polycnc.control.sinumerik.data.access import turn_key_switch
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun import CommandRefused, State
from polycnc.mainrun.commands.states import Command
from polycnc.mainrun.errors import OutOfPlace
from polycnc.messages import AlarmError, text
from polycnc.messages.catalogue import listed
from polycnc.panel.description import RETURNED, Key, Lamp, describe, is_returned

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from collections.abc import Set as AbstractSet
    from pathlib import Path

    from polycnc.mainrun import Record, VirtualControl
    from polycnc.panel.description import Switch

SAFETY_KEY = "C8"
POWER_ON = "POWER_ON"
#: The signal of the key for program restart.
RESTART = "PROGRAM_RESTART"
#: A setting of the control: after a block search the first start leads the axes back by itself.
AUTOMATIC_RESTART = "RESTART_AUTOMATIC"


#: Positions of the mode switch in which axis keys move axes, beside the reference approach.
_BY_KEY = ("rapid", "jog", "increment", "teach", "repos")
#: Commands of keys that the control allows in some modes and states only.
_ASKED = {"cycle_start": Command.CYCLE_START, "feed_hold": Command.FEED_HOLD}


class Light(StrEnum):
    """What a lamp shows."""

    OFF = "off"
    ON = "on"
    BLINKING = "blinking"


class Panel:
    """The operator panel of a virtual control.

    Args:
        control: The control; its id says which panel it has.

    Attributes:
        control: The control.
        description: What stands on the panel.
        positions: Position of every switch by its id; of the mode switch under `mode`, of the handwheel's axis switch
            under `handle_axis`.
        locked: Gives axes with directions in which they must not be moved by hand now (+1, -1).

    Raises:
        CommandRefused: polycnc knows no panel of this control.
    """

    def __init__(self, control: VirtualControl) -> None:
        self.control = control
        try:
            self.description = describe(control.control.id, control.channel.axes)
        except KeyError:
            raise CommandRefused("panel.none", control=control.control.id) from None
        self.positions = {switch.id: switch.start for switch in self.description.switches.values()}
        self.positions["handle_axis"] = control.channel.axes[0]
        self.positions["mode"] = next(
            (each.id for each in self.description.modes.values() if each.mode is control.mode), "memory"
        )
        self.locked: Callable[[], AbstractSet[tuple[str, int]]] = frozenset
        self._pressed: set[str] = set()
        self._turned: set[str] = set()
        self._was_off = False
        control.listeners.append(self._hear)

    # ---- keys ----------------------------------------------------------------------------------------------

    def press(self, *keys: str) -> None:
        """Press keys together. A key that acts as long as it is held stays pressed until `release`.

        Axis keys are `X+`, `X-` and so on: in zero return mode they start the return, in rapid and jog mode the axis
        moves until `release`; in increment mode it goes the step of the handwheel's switch.

        Raises:
            CommandRefused: A key does nothing now: in this mode, without the safety key, while the power is off, or
                because the machine refuses it. Keys that stand before it in the call have acted.
        """
        together = {name.upper() for name in keys} | self._pressed
        for name in (key.upper() for key in keys):
            if name in (SAFETY_KEY, *self._pressed):
                continue
            if self._axis_of(name):
                self._press_axis(name)
            else:
                self._press_key(self._key(name), together)
        if SAFETY_KEY in keys and len(keys) == 1:
            self._pressed.add(SAFETY_KEY)

    def release(self, *keys: str) -> None:
        """Let keys go; all that are held where none is named."""
        for name in [key.upper() for key in keys] or sorted(self._pressed):
            if name not in self._pressed:
                continue
            self._pressed.discard(name)
            if self._axis_of(name):
                self.control.stop_jog(self._axis_of(name))
            elif name != SAFETY_KEY:
                key = self._key(name)
                if key.command == "emergency":
                    self.control.emergency_stop(pressed=False)
                elif key.signal:
                    self.control.signals[key.signal] = 0.0
                else:
                    self.control.key(name, pressed=False)

    def _key(self, name: str) -> Key:
        key = self.description.keys.get(name)
        if key is None:
            raise CommandRefused("panel.unknown", name=name, known=listed(self.description.keys))
        return key

    def why_not(self, name: str) -> CommandRefused | None:
        """Why a key would do nothing now, even together with the safety key; None where it would act.

        What the machine's controller says it says when the key is pressed.
        """
        key = self._key(name.upper())
        if (self.control.state is State.OFF) != (key.id == POWER_ON):
            return CommandRefused("panel.power", part=key.id)
        if key.modes and self.positions["mode"] not in key.modes:
            return CommandRefused("panel.mode", part=key.id, modes=listed(key.modes))
        command = _ASKED.get(key.command)
        if command is not None and not self.control.allows(command):
            control = self.control
            return OutOfPlace(command, control.mode, control.state)
        return None

    def _press_key(self, key: Key, together: set[str]) -> None:
        if key.safety and SAFETY_KEY not in together and self.control.state is not State.OFF:
            raise CommandRefused("panel.safety", part=key.id)
        if (refusal := self.why_not(key.id)) is not None:
            raise refusal
        if key.switch:
            now = getattr(self.control.switches, key.switch)
            self.control.set_switches(**{key.switch: not now})
        elif key.signal:
            self.control.signals[key.signal] = float(key.hold or not self.control.signals[key.signal])
        elif key.command:
            self._do(key.command)
        else:
            self.control.key(key.id)
            if not key.hold:
                self.control.key(key.id, pressed=False)
        if key.hold:
            self._pressed.add(key.id)

    def _do(self, command: str) -> None:
        control = self.control
        if command == "cycle_start":
            self._cycle_start()
        elif command == "emergency":
            control.emergency_stop()
        else:
            {"feed_hold": control.feed_hold, "reset": control.reset, "power_on": control.power_on}[command]()

    def _cycle_start(self) -> None:
        """Cycle start.

        On a panel with a key for program restart only the automatic way leads back while that is on, and until the axes
        are back (Hartford 5.2.4.8); elsewhere the control leads them back.
        """
        control = self.control
        automatic = bool(control.signals[AUTOMATIC_RESTART])
        away = any(not is_returned(left) for _, left in control.restart.values())
        if self._restarts and not automatic:
            raise CommandRefused("panel.restart-on")
        if self._has_restart_key and self._searched and away and not automatic:
            raise CommandRefused("panel.restart-away")
        control.cycle_start()

    @property
    def _restarts(self) -> bool:
        return bool(self.control.signals[RESTART])

    @property
    def _has_restart_key(self) -> bool:
        return any(key.signal == RESTART for key in self.description.keys.values())

    @property
    def _searched(self) -> bool:
        """Whether the program waits where a search has brought it."""
        return self.control.state is State.STOPPED and not self.control.halt

    # ---- axes ----------------------------------------------------------------------------------------------

    def _axis_of(self, name: str) -> str:
        """The axis of an axis key, else empty."""
        return name[:-1] if name[-1:] in ("+", "-") and name[:-1] in self.control.channel.axis_index else ""

    def _press_axis(self, name: str) -> None:
        axis, direction = self._axis_of(name), 1 if name.endswith("+") else -1
        mode = self.positions["mode"]
        if self.control.state is State.OFF:
            raise CommandRefused("panel.power", part=name)
        self._check_locked(axis, direction)
        if mode == "zero" and direction > 0:
            self.control.home(axis)  # once started, the return goes on by itself
        elif mode == "increment":
            step = self.description.switches["handle_step"]
            self.control.increment(axis, direction, step.value(self.positions["handle_step"]))
        elif mode in ("jog", "rapid", "repos", "teach"):
            self.control.jog(axis, direction, rapid=mode == "rapid")
            self._pressed.add(name)
        else:
            moves = ("zero (+)", *(each for each in self.description.modes if each in _BY_KEY))
            raise CommandRefused("panel.mode", part=name, modes=listed(moves))

    def wheel(self, notches: int) -> None:
        """Turn the handwheel, clockwise for plus, with the axis and the step of its switches.

        Where the control lets it shift axes beside a program (DRF), it does so in the modes that run programs.
        """
        if self.positions["mode"] != "handle" and not self.control.switches.drf:
            raise CommandRefused("panel.mode", part="MPG", modes="handle")
        self._check_locked(self.positions["handle_axis"], 1 if notches > 0 else -1)
        step = self.description.switches["handle_step"]
        self.control.handle(self.positions["handle_axis"], notches, step.value(self.positions["handle_step"]))

    def _check_locked(self, axis: str, direction: int) -> None:
        if (axis, direction) in self.locked():
            raise CommandRefused("panel.locked", part=f"{axis}{'+' if direction > 0 else '-'}")

    # ---- switches ------------------------------------------------------------------------------------------

    def turn(self, switch: str, position: str | int) -> None:
        """Turn a switch: `mode`, `feed`, `spindle`, `rapid`, `handle_axis`, `handle_step`, `edit_protect`.

        Raises:
            CommandRefused: There is no such switch or position, or the control refuses the mode.
        """
        wanted = str(position)
        if switch == "mode":
            self._turn_mode(wanted.lower())
        elif switch == "handle_axis":
            self._check(switch, wanted.upper(), self.control.channel.axes)
            self.positions[switch] = wanted.upper()
        else:
            row = self.description.switches.get(switch)
            if row is None:
                known = listed(("mode", "handle_axis", *self.description.switches))
                raise CommandRefused("panel.unknown", name=switch, known=known)
            self._check(switch, wanted, row.positions)
            self.positions[switch] = wanted
            self._turned.add(switch)
            self._apply(row)

    def _check(self, switch: str, position: str, known: tuple[str, ...]) -> None:
        if position not in known:
            raise CommandRefused("mainrun.value", name=switch, allowed=listed(known), value=position)

    def _turn_mode(self, position: str) -> None:
        self._check("mode", position, tuple(self.description.modes))
        self.control.stop_jog()
        self._pressed = {name for name in self._pressed if not self._axis_of(name)}
        self.control.select_mode(self.description.modes[position].mode)
        self.positions["mode"] = position
        for each in self.description.modes.values():
            if each.signal:
                self.control.signals[each.signal] = float(each.id == position)

    def _apply(self, switch: Switch) -> None:
        value = switch.value(self.positions[switch.id])
        if switch.rights:
            for number in range(1, max(len(self.control.machine.channels), 1) + 1):
                turned = partial(turn_key_switch, level=int(value))
                self.control.change(turned, channel=number, protected=False)
        elif switch.signal:
            self.control.signals[switch.signal] = value
        elif switch.id == "rapid":
            self.control.override(rapid=value or self._f0_share())
        elif switch.id in ("feed", "spindle"):
            self.control.override(**{switch.id: value})

    def _hear(self, record: Record) -> None:
        """Behind power-on programs have the rights of the key switch again, which keeps its position without power.

        As long as nobody has turned it they have those of `polycnc run`: the manufacturer's password is set.
        """
        state = record.data.get("state") if record.what == "state" else None
        if state == State.OFF:
            self._was_off = True
        elif state == State.READY and self._was_off:
            self._was_off = False
            for row in self.description.switches.values():
                if row.rights and row.id in self._turned:
                    self._apply(row)

    def _f0_share(self) -> float:
        """The lowest position of the rapid override as a share of the fastest axis' rapid traverse."""
        channel = self.control.channel
        slowest = channel.control.motion_settings(channel).slowest_rapid
        fastest = max((a.rapid for a in channel.axis_data if isfinite(a.rapid)), default=0.0)
        return min(slowest / fastest, 1.0) if fastest > 0.0 else 1.0

    # ---- programs and offsets ------------------------------------------------------------------------------

    def store(self, source: str | bytes | Path) -> None:
        """Write a program into the memory: in mode edit, on a panel without it in memory; edit protection off."""
        writing = "edit" if "edit" in self.description.modes else "memory"
        if self.positions["mode"] != writing:
            raise CommandRefused("panel.mode", part="program", modes=writing)
        self._check_protection()
        self.control.load(source)

    def write(self, variable: str, value: object) -> None:
        """Write an offset or variable by its name in programs (`#2001`); edit protection must be off."""
        self._check_protection()
        try:
            self.control.control.write_variable(self.control.channel, variable, value)
        except (KeyError, ValueError, AlarmError):
            raise CommandRefused("setup.no-variable", name=variable) from None

    def search(self, target: int | str) -> None:
        """Program restart: with its key on, look for the block at which the program is to go on (line or N word)."""
        if not self._restarts:
            raise CommandRefused("panel.restart-off")
        self.control.block_search(target)

    def _check_protection(self) -> None:
        if self.control.signals["EDIT_PROTECT"]:
            raise CommandRefused("panel.protected")

    # ---- what it shows -------------------------------------------------------------------------------------

    def lamps(self) -> Mapping[str, Light]:
        """What every lamp shows, those in the keys too; all are dark while the power is off."""
        return {name: self._light(lamp) for name, lamp in self.description.lights.items()}

    def _light(self, lamp: Lamp) -> Light:
        if self.control.state is State.OFF:
            return Light.OFF
        signal = self.control.signals.__getitem__
        if lamp.is_on(signal) or any(alarm.code in lamp.codes for alarm in self.control.alarms):
            return Light.ON
        return Light.BLINKING if lamp.is_blinking(signal) else Light.OFF

    @property
    def buzzer(self) -> bool:
        """Whether the buzzer sounds."""
        return bool(self.control.signals["BUZZER"])

    @property
    def tool_display(self) -> tuple[int | str, int | str]:
        """The two numbers of the tool display: left the tool that stands by, right the one in the spindle."""
        tool = self.control.tool
        return tool.next_tool, tool.tool

    def tool_text(self, lang: str | None = None) -> str:
        """The tool display as a text; `-` for no tool."""
        waiting, spindle = self.tool_display
        return text("panel.tools", lang, waiting=waiting or "-", spindle=spindle or "-")

    def alarm_lines(self, lang: str | None = None) -> list[str]:
        """The alarm page: alarms with their numbers, then messages from the machine's controller."""
        control, catalogue = self.control, self.control.catalogue
        alarms = [f"{alarm.code} {control.alarm_text(alarm, lang)}" for alarm in control.alarms]
        return alarms + [f"{code} {catalogue.text(code, lang)}" for code in control.notices]

    def restart_lines(self) -> list[tuple[str, float, str, float]]:
        """The restart page: axis, position where the program goes on, `RP` once the axis is there, way that is left."""
        rows = self.control.restart.items()
        return [(axis, at, RETURNED if is_returned(left) else "", left) for axis, (at, left) in rows]
