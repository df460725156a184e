"""System variables: `registry` finds them.

row            what a variable is
stored         values that only store
blank          the blank of WORKPIECE, for pictures
dialogs        what a program shows: dialogs (MMC), its section (SEFORM)
clock          date and time
block_types    type of the block in execution
run_times      timers of programs
part_counts    workpiece counters
surroundings   version, modal call, compensation
in_force       states of the program that hold in the block in execution, for actions
lengths        values that are lengths: inches under G700
known          names that exist and are not kept
by_name        variables by name, for reports
functions      functions that the control answers
"""
