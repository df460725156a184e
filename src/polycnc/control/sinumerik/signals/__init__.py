"""What inputs do.

`measuring` (MEAS), `measuring_actions` (MEAWA of actions), `workpiece` (MEASURE: what points say; its kinds
are in `workpiece_kinds`, what is written for it in `workpiece_memory`), `interrupts` (SETINT), `retraction` (LIFTFAST),
`sections` without stops, `fixed_stop` (FXS).
"""
