"""The planner's kernels: rows of a toolpath become pieces, pieces get speeds and times.

What everything propagates is the *square* of the path speed, `x = v²`: under a constant acceleration it
changes linearly with the way, so that one step of look-ahead is `x + 2·a·length`. Names ending in `2` are
such squares.

    lay       rows to pieces: length, tangents, curvature, caps on x inside      (`lay.py`, `arcs.py`)
    chord     the curve between the points of a spline, and what it allows         (`chords.py`)
    join      the cap on x where two rows meet, and how the path is bent there   (`corners.py`, `rounding.py`)
    led       rows of a tool's tip, by what the axes behind it allow             (`led.py`, `demands.py`)
    feed      what a row asks for: the length that its feed counts, and the speed (`feeds.py`)
    leads     threads whose lead changes, or that name the ways on which they take up speed and brake (`leads.py`)
    jerk      what limited jerk allows: at one place, as far around it as the average reaches, and on a line from
              rest to rest                                                       (`jerk.py`, `hold.py`, `alone.py`)
    backward  how fast a joint may be passed so that all behind it can be braked for   (`speeds.py`)
    forward   how fast each joint is passed, and how long each piece takes

A *piece* is a straight line, or so short a part of a curve that tangent and curvature may be interpolated
over it. The path parameter `s` is the length that the feed counts; `q'` and `q''` are the derivatives of the
machine's axes by it: an axis has the velocity `q'·v` and the acceleration `q''·x + q'·u`, where `u` is the
acceleration along the path.

The functions know no class of the project beside the columns (`columns.py`). They run as they are on
`array.array`, and as machine code on the same memory (`motion/compiled.py`); both
give the same numbers.
"""
