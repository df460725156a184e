"""What inputs do.

`measuring` (MEAS), `measuring_actions` (MEAWA of actions), `interrupts` (SETINT), `retraction` (LIFTFAST), `sections`
without stops, `fixed_stop` (FXS).
"""
