"""G table of the MELDAS machining centre: what differs from FANUC's (Hartford manual §13.1)."""

from __future__ import annotations

from functools import partial

from polycnc.control.fanuc.milling.codes import ALIASES, ROWS, moves
from polycnc.control.word_address.auxiliary import functions
from polycnc.control.word_address.auxiliary.m_codes import MACHINING_CENTRE
from polycnc.control.word_address.block.codes import GCode, MCode, Order, m_table, table, with_aliases
from polycnc.control.word_address.coordinates import systems
from polycnc.control.word_address.motion import path_modes
from polycnc.control.word_address.tools import radius
from polycnc.deferred.functions import loaded_when_called
from polycnc.language.bulk import declare

with loaded_when_called():
    from polycnc.control.meldas import tool_axis_length
    from polycnc.control.word_address.cycles import hole_patterns
    from polycnc.control.word_address.macro_b import calls_as_data, subprograms
    from polycnc.control.word_address.motion import circle_cutting, skip
    from polycnc.control.word_address.tools import data_input, measuring
    from polycnc.control.word_address.transformations import hypothetical_axis, tool_center_point

#: Codes of FANUC that the manual's table does not have.
FOREIGN = frozenset({
    "G5.4", "G10.9", "G41.2", "G41.3", "G41.4", "G41.5", "G41.6", "G42.2", "G42.4", "G42.5", "G42.6", "G25",
    "G26", "G43.5", "G53.6", "G54.2", "G54.4", "G68.3", "G68.4", "G84.2", "G84.3",
})  # fmt: skip

_ROWS = table(
    tuple(row for code, row in ROWS.items() if code not in FOREIGN),
    moves("G2.1", circle_cutting.spiral_cw, "I J K P"),
    moves("G3.1", circle_cutting.spiral_ccw, "I J K P"),
    moves("G4", functions.dwell, "X P U"),
    GCode("G5", handler=path_modes.high_speed_mode, takes="P"),
    moves("G10", data_input.input_data, "L P R"),
    moves("G12", circle_cutting.cut_circle_cw, "I D"),
    moves("G13", circle_cutting.cut_circle_ccw, "I D"),
    moves("G28", systems.return_to_reference),
    moves("G29", systems.return_from_reference),
    moves("G27", systems.check_reference),
    moves("G30", systems.return_to_further_reference, "P"),
    moves("G31", skip.skip_move, "P"),
    moves("G31.1", skip.skip_move),
    moves("G31.2", skip.skip_move),
    moves("G31.3", skip.skip_move),
    moves("G34", hole_patterns.circle_of_holes, "I J K"),
    moves("G35", hole_patterns.line_of_holes, "I J K"),
    moves("G36", hole_patterns.arc_of_holes, "I J P K", reals="P"),
    moves("G37", measuring.measure_length, "R D", reals="D"),
    moves("G37.1", hole_patterns.grid_of_holes, "I J P K"),
    GCode("G40", "compensation", radius.cancel_compensation, takes="I J K", order=Order.COMPENSATION),
    GCode("G43.1", "length", tool_axis_length.compensate_along_tool, takes="H", order=Order.LENGTH),
    GCode("G43.4", "length", tool_center_point.start_following, takes="H", order=Order.LENGTH),
    moves("G53", systems.move_in_machine_system),
    GCode("G61.1", "path", systems.note_context, only_changes=True),
    GCode("G7", handler=hypothetical_axis.switch, axis_words=True, order=Order.MOTION),
)
G_CODES = with_aliases(_ROWS, ALIASES)
#: H is the sequence number at which the subprogram begins.
M98 = MCode(
    98,
    after=True,
    handler=declare(partial(subprograms.call_subprogram, begins_at="H"), calls_as_data.subprogram),
    takes="P H L",
    silent=True,
)
M_CODES = m_table(*MACHINING_CENTRE, M98)
