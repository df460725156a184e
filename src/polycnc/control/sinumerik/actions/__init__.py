"""Synchronised actions in the main run (job planning 10): `actions` looks at them in every interpolation cycle.

action       one action: when it acts, what it is about
actions      all of a channel, in their order, and what becomes of them
run          what effects know and leave behind while they run
acting       what their compiled effects call
words        axes, spindles, auxiliary functions
procedures   the path, other actions, wait marks, alarms
cycles       technology cycles, line by line
axes         axes that actions command, and how programs have them again
couplings    axes that follow others beside the path
overlay      $AA_OFF
fixed_stop   travel to fixed stop, torque
polynomials  FCTDEF, SYNFCT
timers       timers
fifo         ring buffers
variables    variables of the main run
user_data    SYG_…: user data of actions
"""
