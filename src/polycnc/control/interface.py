"""What the rest of polycnc asks of a control, whatever its family."""

from __future__ import annotations

from polycnc.channel.interface import Control as ChannelControl
from polycnc.deferred.typing import TYPE_CHECKING, Literal, Protocol

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel
    from polycnc.machine.kinematics import Kinematics
    from polycnc.messages import Catalogue
    from polycnc.program import Form
    from polycnc.toolpath import Context
    from polycnc.toolpath.motion_settings import MotionSettings


#: What an axis is while it is moved by hand: itself, one of work or tool, one that turns the tool about its tip.
HandMotion = Literal["axis", "geometry", "orientation"]


class Control(ChannelControl, Protocol):
    """A control: what a channel needs, and what reports, cases and the command line ask.

    Attributes:
        alarm_series: None where alarm codes are told apart by their digits alone. Else their prefixes name series of
            alarms; other spellings of a prefix, to the one in the catalogue.
        form: How program files are marked off.
        default_machine: Built-in machine of a run that names none.
        parameter_files: The list of its parameters, as `folder/file`; of two entries for a number the later counts.
        tools_have_names: Programs may call a tool by its name; else by number alone.
        display_names: What the work display may call an axis where its own name does not hold.
        last_bit: The last bit of a parameter.
        mdi_intervenes: Blocks can be typed in and run while a program waits, which then goes on behind them.
        presets_by_hand: An operator can call the place of an axis another one.
    """

    alarm_series: Mapping[str, str] | None
    form: Form
    default_machine: str
    parameter_files: tuple[str, ...]
    tools_have_names: bool
    display_names: tuple[str, ...]
    last_bit: int
    mdi_intervenes: bool
    presets_by_hand: bool

    @property
    def catalogue(self) -> Catalogue:
        """Texts of the control's alarms."""

    def reset(self, channel: Channel) -> None:
        """Bring a channel into the state after reset and after the end of a program; its axes stay."""

    def give_up(self, channel: Channel, modal: Mapping[str, str], context: Context) -> None:
        """A reset in the midst of a program: as `reset`, from what holds in the block in execution.

        What the channel has prepared behind it does not count.
        """

    def reference_point(self, channel: Channel, axis: int, number: int) -> float:
        """Machine position of a reference point (1 to 4) of an axis, given by its column."""

    def clocked(self, channel: Channel) -> None:
        """A main run executes the channel's rows from here on."""

    def moved_together(self, channel: Channel, axis: int) -> tuple[int, ...]:
        """Columns of the axes that go together when one of them is moved by hand."""

    def hand_range(self, channel: Channel, axis: int) -> tuple[float, float]:
        """From where to where software limits of the control let an axis go by hand, machine position."""

    def handwheel_offset(self, channel: Channel, axis: int) -> tuple[float, float]:
        """How fast a handwheel shifts an axis beside its program, mm/s or degrees/s; with what part of its pull.

        The speed is 0 where the control has no such shift.
        """

    def expect_handwheel(self, channel: Channel, *, is_on: bool) -> None:
        """Whether a handwheel may shift axes beside what is prepared from now on."""

    def hand_speed(
        self, channel: Channel, axis: int, what: HandMotion, place: int, *, rapid: bool
    ) -> float | None:
        """How fast an axis is moved by hand at an override of 100 %, mm/s or degrees/s.

        None where the machine says it: its panel for jog, the axis for rapid traverse. `place` says which of the
        geometry or orientation axes it is.
        """

    def stop_spindles(self, channel: Channel) -> None:
        """Emergency stop, or the power is off: no spindle of the channel turns any more."""

    def stays_at_end(self, channel: Channel, code: int) -> bool:
        """Whether a program that has ended with M02 or M30 (`code`: 2 or 30) stays there instead of at its top."""

    def mechanism(self, channel: Channel, context: Context) -> Kinematics:
        """The rotary joints of the machine, and how the tool stands in a context while they are at zero."""

    def motion_settings(self, channel: Channel) -> MotionSettings:
        """How the control leads the axes, by its machine parameters."""

    def read_variable(self, channel: Channel, name: str) -> object:
        """The value of a variable as a user names it; None where it is vacant, `KeyError` where there is none."""

    def write_variable(self, channel: Channel, name: str, value: object) -> None:
        """Set a variable as a user names it; `KeyError` where there is none."""

    def variable_names(self, channel: Channel) -> list[str]:
        """Names of all variables that hold something."""
