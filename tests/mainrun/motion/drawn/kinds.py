"""Which seed draws which program."""

from __future__ import annotations

from random import Random

from tests.mainrun.motion.drawn import milling, mixed, sinumerik, threads
from tests.mainrun.motion.random_programs import Writer, writer

MILLS = ("fanuc-m", "syntec-mill", "meldas-m")
ALL = ("sinumerik-840d", *MILLS)
#: Writers with the controls that they write for.
KINDS: tuple[tuple[type[Writer], tuple[str, ...]], ...] = (
    (mixed.Pauses, ALL),
    (mixed.Questions, ALL),
    (mixed.Functions, ALL),
    (mixed.Revolutions, ALL),
    (mixed.InverseTimes, ALL),
    (mixed.Oblique, ALL),
    (mixed.Inches, ALL),
    (mixed.Rotary, ALL),
    (mixed.Contour, ALL),
    (milling.Holes, MILLS),
    (milling.Taps, MILLS),
    (milling.Spirals, ("meldas-m",)),
    (milling.Turned, MILLS),
    (milling.Tip, ("fanuc-m", "syntec-mill")),
    (milling.TipOfHead, ("fanuc-m", "syntec-mill")),
    (milling.Plane, ("fanuc-m",)),
    (milling.Groove, ("fanuc-m", "meldas-m")),
    (sinumerik.Smoothed, ("sinumerik-840d",)),
    (sinumerik.Reduced, ("sinumerik-840d",)),
    (sinumerik.Frames, ("sinumerik-840d",)),
    (sinumerik.Calls, ("sinumerik-840d",)),
    (sinumerik.Taps, ("sinumerik-840d",)),
)
#: One seed out of so many draws threads of a lathe.
THREADS = 20


def drawn(seed: int) -> Writer:
    """The writer of a seed: every other one is that of `random_programs`."""
    if seed % 2 == 0:
        return writer(seed // 2)
    random = Random(seed)
    if seed % THREADS == THREADS - 1:
        return threads.Threads(random, random.choice(("sinumerik-840d", "fanuc-0i-tf")))
    kind, controls = KINDS[seed // 2 % len(KINDS)]
    return kind(random, random.choice(controls))
