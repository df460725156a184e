"""From rows of a toolpath to runs with limited jerk: stretches of a path, from one standstill to the next.

rows        the kernel: rows become stretches of a run, or pieces where no law leads
resting     corners at which it takes less time to rest
least       the least time of a block, for functions beside it
room        room for the stretches of a run, until they are taken over
leading     runs as the planner leads them: windows with their path, their law and their rows
"""
