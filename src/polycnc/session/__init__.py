"""One program on one control and one machine, from the file to the result.

result = polycnc.run("part.nc", control="fanuc-m", setup={"work_offsets": {"G54": {"Z": -100}}})
result.alarms, result.time, result.moves.to_pandas()

`opening` finds what a run needs (`errors`: what cannot be found), `session` lets it run, `result` is what it gave and
`record` the same as plain values, without the control: what goes to another process. `notebook` shows it in HTML.
"""

from polycnc.session.errors import SessionError
from polycnc.session.opening import open_session, run
from polycnc.session.record import RunRecord
from polycnc.session.result import ChannelResult, Result, Variables
from polycnc.session.session import Session

__all__ = [
    "ChannelResult",
    "Result",
    "RunRecord",
    "Session",
    "SessionError",
    "Variables",
    "open_session",
    "run",
]
