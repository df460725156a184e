"""Tool compensation as stages of the path: cutter and nose radius, and corners that are chamfered or rounded.

`cutter` is the one engine for all controls (`CutterCompensation`): it holds a window of steps (`step`) until
`ends` and `vectors` tell where each ends; `rows` writes them. `policy` says how controls differ.
`interference` finds vectors that have changed places, `avoidance` leads round them. `corner` is the stage of
chamfers and roundings; `plane` is what both share. `tips` has the imaginary tips of turning tools. `runs` takes many
lines of a contour at once. `spatial` is radius compensation across a tool that tilts. `contour_tool` chooses between
edges that cut between two angles each.
"""
