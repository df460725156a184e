"""Policies as controls have them, for tests of the engine."""

from __future__ import annotations

from dataclasses import replace

from polycnc.compensation.corner import CornerPolicy
from polycnc.compensation.policy import Approach, Policy
from polycnc.control.fanuc.lathe.tools.nose_radius import TYPE_A as FANUC_A
from polycnc.control.sinumerik.tools.stages import CORNERS as SINUMERIK_CORNERS
from polycnc.control.sinumerik.tools.stages import POLICIES
from polycnc.control.word_address.machining_centre import hartford

__all__ = ["FANUC_A", "SINUMERIK_CORNERS"]

#: Hartford machining centres, FANUC and MELDAS.
HARTFORD = hartford()
FANUC_B = replace(FANUC_A, approach=Approach.CORNER)
FANUC_C = replace(FANUC_A, shifts_without_motion=True)
FANUC_CORNERS = CornerPolicy()
#: MELDAS with its own look-ahead of five blocks.
MELDAS = Policy(read_blocks=5)
SYNTEC = Policy()
SINUMERIK_NORM_G450, SINUMERIK_NORM_G451 = POLICIES["NORM", "G450"], POLICIES["NORM", "G451"]
SINUMERIK_KONT_G450, SINUMERIK_KONT_G451 = POLICIES["KONT", "G450"], POLICIES["KONT", "G451"]
