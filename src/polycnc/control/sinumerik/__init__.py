"""SINUMERIK 840D sl: G groups, words, frames, tools, system variables and alarms of the control.

a block       gcodes (the groups), plan (what a block does in a modal state), block, words (beside motion),
positions, arguments, tables, errors; control, memory, machine_data, reset
bulk          plain: the same told as data, for the scanner
motion        motion (G0, G1, G33, G4 …), circles, splines with spline_stage, indexing, repositioning (REPOS),
single_block
feed          tooth_feed (FZ), pace (OVR, FGROUP, CFC …), dry_run, spindle_speed (G96), spindles
frames        frames, frame_codes (TRANS …), frame_variables, adding_frames
tools         tools (T, D), d_numbers, tool_variables; stages (chamfers and G41), smooth_approach with smooth_stage
limits        limits (WALIMON), protection (zones)
procedures    procedures (the table), sections, axis_settings, tolerances, auxiliary (M)
signals       measuring, interrupts (SETINT), retraction (LIFTFAST)
channels      coordination (INIT, WAITM), axis_exchange (GET), link_memory
variables     system_variables (the registry), known_variables, variables_by_name; functions, calcposi
data          access (protection levels), data_archive (COMPLETE), init_programs
cycles/       the machining cycles
"""
