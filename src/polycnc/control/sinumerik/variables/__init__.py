"""System variables: `registry` finds them.

row            what a variable is
stored         values that only store
clock          date and time
surroundings   version, modal call, compensation
known          names that exist and are not kept
by_name        variables by name, for reports
functions      functions that the control answers
"""
