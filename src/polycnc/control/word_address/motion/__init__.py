"""Motion codes: `path` (G00 to G03), and everything beside it.

`arcs` and `planes` belong to circles, `circle_cutting` are circles as one block (G12, G13); `thread` (G33), `nurbs`
(G06.2), `skip` (G31), `path_modes` (G05, G08, G09), `position_offset` (G45 to G48, G60), `corners` (`,C` `,R`),
`line_by_angle` (`,A`), `oscillation` (G81.1), `spindle_led` (axes in step with the spindle), `arc_signals` (where a
signal comes on an arc).
"""
