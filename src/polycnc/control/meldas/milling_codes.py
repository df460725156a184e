"""G table of the MELDAS machining centre: what differs from FANUC's (Hartford manual §13.1)."""

from __future__ import annotations

from polycnc.control.fanuc.milling_codes import G_CODES as FANUC_G_CODES
from polycnc.control.word_address.codes import not_yet, table

G_CODES = table(
    tuple(FANUC_G_CODES.values()),
    not_yet(
        "G2.1", "G3.1", "G6.2", "G7", "G7.1", "G12", "G13", "G31.1", "G31.2", "G31.3", "G33", "G34", "G35", "G36",
        "G37", "G37.1", "G38", "G39", "G40.1", "G41.1", "G42.1", "G45", "G46", "G47", "G48", "G60", "G61.1",
    ),
)  # fmt: skip
