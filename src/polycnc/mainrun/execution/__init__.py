"""Execution: what is prepared is carried out in time.

clock          simulated time
execution      from event to event, one channel
by_pieces      leads the axes along pieces, behind an interpolator
by_law         leads them along runs with limited jerk, by a law along all of their rows
outside        what it asks of those around it
block_parts    its blocks, those of the program and those that it makes of them
beside_path    axes that an operator has moved beside their path
channel_run    a channel with all that executes it
channel_runs   the channels of a control
interpolator   a channel as its synchronised actions see it
leading_spindles  spindles that lead axes (gears)
operation      from state to state: what follows from commands and from what happens
main_loop      lets time pass on all channels
machinery      what the machine does with M, T, S and messages
"""
