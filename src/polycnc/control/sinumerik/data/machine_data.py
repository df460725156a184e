"""Machine and setting data: what a program reads as `$MN_…`, `$MC_…`, `$MA_…`, `$SN_…` and so on.

A datum has an identifier and a number; `DELIVERED` gives the delivered values of those that polycnc acts on
or that programs commonly read. What the setup says overrides them, by number (`36110[X]`) or identifier
(`$MA_POS_LIMIT_PLUS[X]`). Lengths are mm, angles degrees, as the control keeps them with a metric basic
system.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from polycnc.control.sinumerik.errors import not_supported

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.machine.setup.values import ParameterKey, Parameters

Index = int | str
Key = tuple[str, tuple[Index, ...]]


class Datum(NamedTuple):
    """One machine or setting datum: number and delivered value."""

    number: int
    value: object


DELIVERED: dict[str, Datum] = {
    "$MN_AXCONF_MACHAX_NAME_TAB": Datum(10000, ""),
    "$MN_INT_INCR_PER_MM": Datum(10200, 1000.0),
    "$MN_INT_INCR_PER_DEG": Datum(10210, 1000.0),
    "$MN_SCALING_SYSTEM_IS_METRIC": Datum(10240, True),
    "$MN_PROG_FUNCTION_MASK": Datum(10280, 0),
    "$MN_FRAME_ANGLE_INPUT_MODE": Datum(10600, 1),
    "$MN_NCBFRAME_RESET_MASK": Datum(10613, 0xFFFF),
    "$MN_IGNORE_SINGLEBLOCK_MASK": Datum(10702, 0),
    "$MN_UPLOAD_MD_CHANGES_ONLY": Datum(11210, 0),
    "$MN_ACCESS_EXEC_CST": Datum(11160, 7),
    "$MN_ACCESS_EXEC_CMA": Datum(11161, 7),
    "$MN_ACCESS_EXEC_CUS": Datum(11162, 7),
    "$MN_ACCESS_WRITE_CST": Datum(11165, 7),
    "$MN_ACCESS_WRITE_CMA": Datum(11166, 7),
    "$MN_ACCESS_WRITE_CUS": Datum(11167, 7),
    "$MN_DEFAULT_VALUES_MEM_MASK": Datum(11270, 1),
    "$MN_WPD_INI_MODE": Datum(11280, 0),
    "$MN_LUD_EXTENDED_SCOPE": Datum(11120, False),
    "$MN_LEN_PROTOCOL_FILE": Datum(11420, 0),
    "$MN_MM_MAX_CUTTING_EDGE_NO": Datum(18105, 9),
    "$MN_MM_MAX_CUTTING_EDGE_PERTOOL": Datum(18106, 9),
    "$MN_MM_FRAME_FINE_TRANS": Datum(18600, 1),
    "$MN_MM_NUM_GLOBAL_USER_FRAMES": Datum(18601, 0),
    "$MN_MM_NUM_GLOBAL_BASE_FRAMES": Datum(18602, 0),
    "$MN_MM_SIZEOF_LINKVAR_DATA": Datum(18700, 1024),
    "$MN_INDEX_AX_LENGTH_POS_TAB_1": Datum(10900, 0),
    "$MN_INDEX_AX_POS_TAB_1": Datum(10910, 0.0),
    "$MN_INDEX_AX_LENGTH_POS_TAB_2": Datum(10920, 0),
    "$MN_INDEX_AX_POS_TAB_2": Datum(10930, 0.0),
    "$MC_CHAN_NAME": Datum(20000, "CHAN1"),
    "$MC_AXCONF_GEOAX_ASSIGN_TAB": Datum(20050, 0),
    "$MC_AXCONF_GEOAX_NAME_TAB": Datum(20060, ""),
    "$MC_AXCONF_MACHAX_USED": Datum(20070, 0),
    "$MC_AXCONF_CHANAX_NAME_TAB": Datum(20080, ""),
    "$MC_SPIND_DEF_MASTER_SPIND": Datum(20090, 1),
    "$MC_DIAMETER_AX_DEF": Datum(20100, ""),
    "$MC_RESET_MODE_MASK": Datum(20110, 1),
    "$MC_START_MODE_MASK": Datum(20112, 0x400),
    "$MC_IGNORE_SINGLEBLOCK_ASUP": Datum(20117, False),
    "$MC_CUTTING_EDGE_RESET_VALUE": Datum(20130, 0),
    "$MC_GCODE_RESET_VALUES": Datum(20150, 0),
    "$MC_GCODE_RESET_MODE": Datum(20152, 0),
    "$MC_EXTERN_GCODE_RESET_VALUES": Datum(20154, 1),
    "$MC_CUBIC_SPLINE_BLOCKS": Datum(20160, 8),
    "$MC_CUTCOM_CORNER_LIMIT": Datum(20210, 100.0),
    "$MC_CUTCOM_MAX_DISC": Datum(20220, 50.0),
    "$MC_CUTCOM_MAXNUM_CHECK_BLOCKS": Datum(20240, 4),
    "$MC_CUTCOM_MAXNUM_DUMMY_BLOCKS": Datum(20250, 3),
    "$MC_CUTTING_EDGE_DEFAULT": Datum(20270, 1),
    "$MC_CHFRND_MODE_MASK": Datum(20201, 0),
    "$MC_CHFRND_MAXNUM_DUMMY_BLOCKS": Datum(20200, 1),
    "$MC_SPF_END_TO_VDI": Datum(20800, 1),
    "$MC_CIRCLE_ERROR_CONST": Datum(21000, 0.01),
    "$MC_CIRCLE_ERROR_FACTOR": Datum(21010, 0.001),
    "$MC_LIFTFAST_DIST": Datum(21200, 5.0),
    "$MC_LIFTFAST_WITH_MIRROR": Datum(21202, False),
    "$MC_TOOL_CHANGE_MODE": Datum(22550, 0),
    "$MC_TOOL_CHANGE_M_CODE": Datum(22560, 6),
    "$MC_FRAME_ADD_COMPONENTS": Datum(24000, True),
    "$MC_CHBFRAME_RESET_MASK": Datum(24002, 0xFFFF),
    "$MC_PROCESSTIMER_MODE": Datum(27860, 0x83),
    "$MC_PART_COUNTER": Datum(27880, 0),
    "$MC_MM_NUM_R_PARAM": Datum(28050, 100),
    "$MC_MM_NUM_USER_FRAMES": Datum(28080, 100),
    "$MC_MM_NUM_BASE_FRAMES": Datum(28081, 1),
    "$MC_MM_NUM_AC_PARAM": Datum(28254, 50),
    "$MC_MM_NUM_AC_MARKER": Datum(28256, 8),
    "$MC_MM_NUM_AC_TIMER": Datum(28258, 8),
    "$MC_NUM_AC_FIFO": Datum(28260, 0),
    "$MC_START_AC_FIFO": Datum(28262, 0),
    "$MC_LEN_AC_FIFO": Datum(28264, 0),
    "$MA_NUM_ENCS": Datum(30200, 1),
    "$MA_IS_ROT_AX": Datum(30300, False),
    "$MA_ROT_IS_MODULO": Datum(30310, False),
    "$MA_MODULO_RANGE": Datum(30330, 360.0),
    "$MA_MODULO_RANGE_START": Datum(30340, 0.0),
    "$MA_BASE_FUNCTION_MASK": Datum(30460, 0),
    "$MA_INDEX_AX_ASSIGN_POS_TAB": Datum(30500, 0),
    "$MA_FIX_POINT_POS": Datum(30600, 0.0),
    "$MA_MAX_AX_VELO": Datum(32000, 10000.0),
    "$MA_POSTCTRL_GAIN": Datum(32200, 1.0),
    "$MA_MAX_AX_ACCEL": Datum(32300, 1.0),
    "$MA_MAX_AX_JERK": Datum(32431, 1e6),
    "$MA_COMPRESS_POS_TOL": Datum(33100, 0.1),
    "$MA_REFP_SET_POS": Datum(34100, 0.0),
    "$MA_SPIND_ACTIVE_AFTER_RESET": Datum(35040, False),
    "$MA_SPIND_VELO_LIMIT": Datum(35100, 10000.0),
    "$MA_ACCEL_REDUCTION_SPEED_POINT": Datum(35220, 1.0),
    "$MA_ACCEL_REDUCTION_FACTOR": Datum(35230, 0.0),
    "$MA_GEAR_STEP_MAX_VELO": Datum(35110, 500.0),
    "$MA_AX_VELO_LIMIT": Datum(36200, 11500.0),
    "$MA_POS_LIMIT_MINUS": Datum(36100, -1e8),
    "$MA_POS_LIMIT_PLUS": Datum(36110, 1e8),
    "$MA_POS_LIMIT_MINUS2": Datum(36120, -1e8),
    "$MA_POS_LIMIT_PLUS2": Datum(36130, 1e8),
    "$SC_DRY_RUN_FEED": Datum(42100, 5000.0),
    "$SC_DRY_RUN_FEED_MODE": Datum(42101, 0),
    "$SC_DEFAULT_FEED": Datum(42110, 0.0),
    "$SC_FRAME_OFFSET_INCR_PROG": Datum(42440, True),
    "$SC_TOOL_OFFSET_INCR_PROG": Datum(42442, True),
    "$SC_COMPRESS_CONTUR_TOL": Datum(42475, 0.05),
    "$SC_COMPRESS_ORI_TOL": Datum(42476, 0.05),
    "$SC_ORISON_TOL": Datum(42678, 0.05),
    "$SC_EXT_PROG_PATH": Datum(42700, ""),
    "$SC_MIRROR_TOOL_LENGTH": Datum(42900, 0),
    "$SC_MIRROR_TOOL_WEAR": Datum(42910, 0),
    "$SC_WEAR_SIGN_CUTPOS": Datum(42920, 0),
    "$SC_WEAR_SIGN": Datum(42930, 0),
    "$SC_TOOL_LENGTH_CONST": Datum(42940, 0),
    "$SC_TOOL_LENGTH_TYPE": Datum(42950, 0),
    "$SA_SPIND_MIN_VELO_G25": Datum(43210, 0.0),
    "$SA_SPIND_MAX_VELO_G26": Datum(43220, 1e8),
    "$SA_SPIND_MAX_VELO_LIMS": Datum(43230, 1e8),
    "$SA_IPOBRAKE_BLOCK_EXCHANGE": Datum(43600, 0.0),
    "$SA_ADISPOSA_VALUE": Datum(43610, 0.0),
    "$SA_ASSIGN_FEED_PER_REV_SOURCE": Datum(43300, 0),
    "$SA_WORKAREA_PLUS_ENABLE": Datum(43400, False),
    "$SA_WORKAREA_MINUS_ENABLE": Datum(43410, False),
    "$SA_WORKAREA_LIMIT_PLUS": Datum(43420, 1e8),
    "$SA_WORKAREA_LIMIT_MINUS": Datum(43430, -1e8),
}
_IDENTIFIER_OF = {datum.number: name for name, datum in DELIVERED.items()}


class MachineData:
    """The machine and setting data of one channel.

    Args:
        parameters: What the setup says, by number or identifier.
        axes: The channel's name of an axis by every identifier: `X`, `X1` and `AX1` mean the same axis.
    """

    def __init__(self, parameters: Parameters, axes: Mapping[str, str]) -> None:
        self._axes = axes
        self._values: dict[Key, object] = {}
        for key, value in parameters.items():
            self._preset(key, value)
        self._first = dict(self._values)

    def _preset(self, key: ParameterKey, value: object) -> None:
        """Take a value of the setup; a list gives its elements, a bit is set in what holds so far."""
        name = _IDENTIFIER_OF.get(key.id, str(key.id)) if isinstance(key.id, int) else key.id
        element = (
            key.element if isinstance(key.element, tuple) else () if key.element is None else (key.element,)
        )
        axis = () if key.axis is None else (self._index(key.axis),)
        indices: tuple[Index, ...] = (*element, *axis)
        if key.bit is not None:
            before = self._values.get((name, indices), DELIVERED[name].value if name in DELIVERED else 0)
            bits = int(before) if isinstance(before, (int, float)) else 0
            self._values[name, indices] = bits | 1 << key.bit if value else bits & ~(1 << key.bit)
        elif isinstance(value, tuple):
            for i, item in enumerate(value):
                self._values[name, (i, *indices)] = item
        else:
            self._values[name, indices] = value

    def _index(self, value: object) -> Index:
        """An index in one form: a number, or the channel's name of an axis."""
        text = str(value).upper()
        return int(text) if text.lstrip("-").isdigit() else self._axes.get(text, text)

    def knows(self, name: str) -> bool:
        """Whether a datum is known: delivered, or named by the setup or a program before."""
        return name in DELIVERED or any(known == name for known, _ in self._values)

    def read(self, name: str, *indices: object) -> object:
        """The value of a datum; without its index that of the first element.

        Raises:
            AlarmError: PC0001 for a datum that polycnc does not keep.
        """
        key = tuple(self._index(index) for index in indices)
        for wanted in (key, key[-1:] if len(key) > 1 else key, () if key else (0,)):
            if (name, wanted) in self._values:
                return self._values[name, wanted]
        if name in DELIVERED:
            return DELIVERED[name].value
        raise not_supported(name)

    def number(self, name: str, *indices: object) -> float:
        """The value of a datum as a number."""
        value = self.read(name, *indices)
        return float(value) if isinstance(value, (int, float)) else 0.0

    def integer(self, name: str, *indices: object) -> int:
        """The value of a datum as a whole number."""
        return int(self.number(name, *indices))

    def write(self, name: str, indices: tuple[object, ...], value: object) -> None:
        """Set a datum."""
        self._values[name, tuple(self._index(index) for index in indices)] = value

    def items(self) -> list[tuple[Key, object]]:
        """Every datum that setup or programs gave a value, sorted by name and index."""
        return sorted(self._values.items(), key=lambda item: (item[0][0], tuple(map(str, item[0][1]))))

    def restore(self, name: str) -> None:
        """A datum takes the values that the setup gave it, or the delivered ones."""
        for key in [key for key in self._values if key[0] == name]:
            del self._values[key]
        self._values.update((key, value) for key, value in self._first.items() if key[0] == name)

    @property
    def keeps_first_values(self) -> bool:
        """MD11270 bit 0: user variables go back to the values of their definition, not to zero."""
        return bool(self.integer("$MN_DEFAULT_VALUES_MEM_MASK") & 1)

    def forget_settings(self) -> None:
        """Setting data take their delivered values."""
        for key in [key for key in self._values if key[0].startswith("$S")]:
            del self._values[key]

    def is_set(self, name: str, *indices: object) -> bool:
        """Whether the setup or a program gave a datum a value of its own."""
        return (name, tuple(self._index(index) for index in indices)) in self._values
