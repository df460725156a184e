"""G functions of SINUMERIK 840D sl: the groups, their words in the order of `$P_GG`, and what holds at start.

Source: job planning 16.1 (statement list) and the list of G functions of the Fundamentals. Position 0 of a
tuple is number 1 of the group. A group that is not modal acts in its block only.

Where a function acts: groups 1 and 2 in the tables of `plan`, frames of group 3 in `frame_codes`, what else has an
effect of its own when its block runs in `EFFECTS` and `LATE_EFFECTS` of `plan`. The other groups are read by those who
follow them, under the group's name: `mode["path"]`.
"""

from __future__ import annotations

from polycnc.deferred.records import dataclass


@dataclass(frozen=True, slots=True)
class Group:
    """One G group.

    Attributes:
        number: As `$P_GG[number]` and `G[number]=` name it; MD20150 counts from `number - 1`.
        name: Key of the group in a channel's mode.
        words: Functions in the order of their numbers.
        start: Function that holds in the delivered state, "" for groups that act in one block.
    """

    number: int
    name: str
    words: tuple[str, ...]
    start: str = ""

    @property
    def is_modal(self) -> bool:
        """Whether a function of the group stays until another one takes its place."""
        return self.start != ""


def _numbered(prefix: str, first: int, last: int) -> tuple[str, ...]:
    return tuple(f"{prefix}{n}" for n in range(first, last + 1))


def _group(number: int, name: str, words: str, start: str = "") -> Group:
    return Group(number, name, tuple(words.split()), start)


_ZERO_OFFSETS = ("G500", *_numbered("G", 54, 57), *_numbered("G", 505, 599))

GROUPS: tuple[Group, ...] = (
    _group(
        1,
        "motion",
        "G0 G1 G2 G3 CIP ASPLINE BSPLINE CSPLINE POLY G33 G331 G332 OEMIPO1 OEMIPO2 CT G34 G35 INVCW INVCCW",
        "G1",
    ),
    _group(
        2,
        "block_motion",
        "G4 G63 G74 G75 REPOSL REPOSQ REPOSH REPOSA REPOSQA REPOSHA G147 G247 G347 G148 G248 G348 G5 G7 G751",
    ),
    _group(
        3,
        "frame",
        "TRANS ROT SCALE MIRROR ATRANS AROT ASCALE AMIRROR - G25 G26 G110 G111 G112 G58 G59 ROTS AROTS",
    ),
    _group(4, "fifo", "STARTFIFO STOPFIFO FIFOCTRL", "STARTFIFO"),
    _group(6, "plane", "G17 G18 G19", "G17"),
    _group(7, "compensation", "G40 G41 G42", "G40"),
    Group(8, "wcs", _ZERO_OFFSETS, "G500"),
    _group(9, "suppression", "G53 SUPA G153"),
    _group(10, "path", "G60 G64 G641 G642 G643 G644 G645", "G60"),
    _group(11, "block_exact_stop", "G9"),
    _group(12, "exact_stop", "G601 G602 G603", "G601"),
    _group(13, "unit", "G70 G71 G700 G710", "G71"),
    _group(14, "distance", "G90 G91", "G90"),
    _group(15, "feed", "G93 G94 G95 G96 G97 G931 G961 G971 G942 G952 G962 G972 G973", "G94"),
    _group(16, "curve_feed", "CFC CFTCP CFIN", "CFC"),
    _group(17, "approach", "NORM KONT KONTT KONTC", "NORM"),
    _group(18, "corner", "G450 G451", "G450"),
    _group(19, "spline_start", "BNAT BTAN BAUTO", "BNAT"),
    _group(20, "spline_end", "ENAT ETAN EAUTO", "ENAT"),
    _group(21, "acceleration", "BRISK SOFT DRIVE", "BRISK"),
    _group(22, "tool_offset", "CUT2D CUT2DF CUT3DC CUT3DF CUT3DFS CUT3DFF CUT3DCC CUT3DCCD", "CUT2D"),
    _group(23, "bottlenecks", "CDOF CDON CDOF2", "CDOF"),
    _group(24, "feedforward", "FFWOF FFWON", "FFWOF"),
    _group(25, "orientation_reference", "ORIWKS ORIMKS", "ORIWKS"),
    _group(26, "repos_point", "RMB RMI RME RMN", "RMI"),
    _group(27, "corner_orientation", "ORIC ORID", "ORIC"),
    _group(28, "working_area", "WALIMON WALIMOF", "WALIMON"),
    _group(29, "diameter", "DIAMOF DIAMON DIAM90 DIAMCYCOF", "DIAMOF"),
    _group(30, "compressor", "COMPOF COMPON COMPCURV COMPCAD", "COMPOF"),
    Group(31, "oem_1", _numbered("G", 810, 819), "G810"),
    Group(32, "oem_2", _numbered("G", 820, 829), "G820"),
    _group(33, "fine_tool_offset", "FTOCOF FTOCON", "FTOCOF"),
    _group(34, "orientation_smoothing", "OSOF OSC OSS OSSE OSD OST", "OSOF"),
    _group(35, "punching", "SPOF SON PON SONS PONS", "SPOF"),
    _group(36, "punching_delay", "PDELAYON PDELAYOF", "PDELAYON"),
    _group(37, "feed_profile", "FNORM FLIN FCUB", "FNORM"),
    _group(38, "punching_byte", "SPIF1 SPIF2", "SPIF1"),
    _group(39, "contour_accuracy", "CPRECOF CPRECON", "CPRECOF"),
    _group(40, "constant_side", "CUTCONOF CUTCONON", "CUTCONOF"),
    _group(41, "thread_interruption", "LFOF LFON", "LFOF"),
    _group(42, "tool_carrier", "TCOABS TCOFR TCOFRZ TCOFRY TCOFRX", "TCOABS"),
    _group(43, "smooth_approach_side", "G140 G141 G142 G143", "G140"),
    _group(44, "smooth_approach_path", "G340 G341", "G340"),
    _group(45, "path_reference", "SPATH UPATH", "SPATH"),
    _group(46, "retraction_plane", "LFTXT LFWP LFPOS", "LFTXT"),
    _group(47, "language", "G290 G291", "G290"),
    _group(48, "approach_collision", "G460 G461 G462", "G460"),
    _group(49, "point_to_point", "CP PTP PTPG0", "CP"),
    _group(50, "orientation_angles", "ORIEULER ORIRPY ORIVIRT1 ORIVIRT2 ORIAXPOS ORIRPY2", "ORIEULER"),
    _group(
        51,
        "orientation_motion",
        "ORIVECT ORIAXES ORIPATH ORIPLANE ORICONCW ORICONCCW ORICONIO ORICONTO ORICURVE ORIPATHS",
        "ORIVECT",
    ),
    _group(52, "workpiece_frame", "PAROTOF PAROT", "PAROTOF"),
    _group(
        53,
        "tool_frame",
        "TOROTOF TOROT TOROTZ TOROTY TOROTX TOFRAME TOFRAMEZ TOFRAMEY TOFRAMEX",
        "TOROTOF",
    ),
    _group(54, "rotation_vector", "ORIROTA ORIROTR ORIROTT ORIROTC", "ORIROTA"),
    _group(55, "rapid", "RTLION RTLIOF", "RTLION"),
    _group(56, "wear_system", "TOWSTD TOWMCS TOWWCS TOWBCS TOWTCS TOWKCS", "TOWSTD"),
    _group(57, "corner_deceleration", "FENDNORM G62 G621", "FENDNORM"),
    _group(59, "dynamics", "DYNNORM DYNPOS DYNROUGH DYNSEMIFIN DYNFINISH", "DYNNORM"),
    Group(60, "working_area_wcs", _numbered("WALCS", 0, 10), "WALCS0"),
    _group(61, "orientation_profile", "ORISOF ORISON", "ORISOF"),
)

BY_NUMBER = {group.number: group for group in GROUPS}
BY_NAME = {group.name: group for group in GROUPS}
GROUP_OF = {word: group for group in GROUPS for word in group.words}

#: Modal state at power-on and program start in the delivered state (marks 4 of the statement list).
START_CODES = {group.name: group.start for group in GROUPS if group.is_modal}

#: Further modal state that decides how a block acts, beside the groups: a straight line whose end the next block
#: tells (ANG); the function of group 15 whose feed G962 and G972 keep; the kind of transformation that acts; whether
#: SPP cuts paths into segments; the geometry axes of GEOAX; the columns of axes that follow the path. Each axis that
#: DIAMONA and the like have named adds a group of its own.
INTERNAL_CODES = {
    "open_line": "",
    "feed_kept": "G94",
    "speed_kept": "",
    "transformation": "",
    "segments": "",
    "geometry": "",
    "tangential": "",
}

#: Known functions that polycnc does not execute: the path would differ, so they raise an alarm.
_NOT_EXECUTED = """
OEMIPO1 OEMIPO2
G291
"""
NOT_EXECUTED = frozenset(_NOT_EXECUTED.split())


def number_of(code: str) -> int:
    """The number of a function in its group, from 1 (as `$P_GG` gives it); 0 for no function."""
    group = GROUP_OF.get(code)
    return group.words.index(code) + 1 if group else 0
