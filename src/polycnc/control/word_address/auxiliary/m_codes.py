"""M codes that a machining centre of the FANUC kind has on any machine."""

from __future__ import annotations

from polycnc.control.word_address.auxiliary import functions
from polycnc.control.word_address.block.codes import MCode
from polycnc.deferred.functions import loaded_when_called

with loaded_when_called():
    from polycnc.control.word_address.macro_b import subprograms

#: Stops, ends and calls, and what the control itself must know of spindle, tool and coolant.
MACHINING_CENTRE = (
    MCode(0, after=True, handler=functions.stop, silent=True),
    MCode(1, after=True, handler=functions.optional_stop, silent=True),
    MCode(2, after=True, handler=functions.end_program),
    MCode(3, handler=functions.spindle_clockwise, turns=True),
    MCode(4, handler=functions.spindle_counter_clockwise, turns=True),
    MCode(5, after=True, handler=functions.spindle_stop, turns=True),
    MCode(6, after=True, handler=functions.change_tool),
    MCode(8),
    MCode(9, after=True),
    MCode(19, after=True, handler=functions.spindle_stop, turns=True),
    MCode(30, after=True, handler=functions.end_program),
    MCode(98, after=True, handler=subprograms.call_subprogram, takes="P L Q", silent=True),
    MCode(99, after=True, handler=subprograms.return_from_subprogram, takes="P L", silent=True),
    MCode(198, after=True, handler=subprograms.call_external_subprogram, takes="P L", silent=True),
)
