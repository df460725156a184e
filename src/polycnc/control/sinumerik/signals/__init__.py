"""What inputs do.

`measuring` (MEAS), `measuring_actions` (MEAWA of actions), `workpiece` (MEASURE: what points say), `interrupts`
(SETINT), `retraction` (LIFTFAST), `sections`
without stops, `fixed_stop` (FXS).
"""
