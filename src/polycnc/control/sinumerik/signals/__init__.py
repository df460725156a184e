"""What inputs do: `measuring` (MEAS), `interrupts` (SETINT), `retraction` (LIFTFAST), `sections` without stops.

`fixed_stop` is FXS.
"""
