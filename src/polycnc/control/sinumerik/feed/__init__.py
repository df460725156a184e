"""Feeds and speeds of path, axes and spindles.

`path_feed` has what goes with F, `profiles`, `profile_stage` and `feed_words` its course (FLIN, FCUB, FPO),
`tooth_feed` FZ, `pace` OVR, FGROUP, CFC and the like, `dry_run`, `spindles` and `spindle_speed` (G96), `thread_ramps`
(DITS, DITE), `wheels` (GWPSON, TMON).

`axis_settings` (when an axis has arrived), `tolerances` (CTOL) and `compressor` (COMPON …) say how exactly the axes
follow.
"""
