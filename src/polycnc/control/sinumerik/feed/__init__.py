"""Feeds and speeds: `tooth_feed` (FZ), `pace` (OVR, FGROUP, CFC …), `dry_run`, `spindle_speed` (G96), `spindles`.

`axis_settings` (when an axis has arrived) and `tolerances` (CTOL) say how exactly the axes follow.
"""
