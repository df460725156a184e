"""The bytes of lines over HTTP: a browser asks for what it has not got yet, a part at a time."""

from __future__ import annotations

import json

from fastapi import Response

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.view.lines import Lines

#: Points in one answer at most: a server with machines on it is not held by a browser that has just come.
POINTS = 200_000


def answer(lines: Lines, era: int, first: int) -> Response:
    """Points of a line from one on, as its buffer has them.

    The header `X-Line` tells the era of the line, from which point on the bytes are (0 where the era of the browser is
    over), how many points there are in all, and the tools.

    Args:
        lines: The line.
        era: The era of what the browser has.
        first: How many points it has.
    """
    begin = first if era == lines.era and 0 <= first <= len(lines) else 0
    told = {"era": lines.era, "first": begin, "count": len(lines), "tools": lines.tools}
    return Response(
        lines.part(begin, POINTS),
        media_type="application/octet-stream",
        headers={"X-Line": json.dumps(told), "Cache-Control": "no-store"},
    )
