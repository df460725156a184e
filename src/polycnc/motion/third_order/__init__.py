"""Limited jerk without averages over time: a path that is smooth by its length, and a law along it.

the path    bent_path (a run as a cubic spline by its way), bend (a programmed path becomes such ones), parts (bent
            between seams, without numpy) by `bends/`
the law     law (phases of constant jerk along the way) by `laws/`
long runs   runs (window by window while they come), windows (their laws, one behind the other)
the rows    `laying/`: rows of a toolpath become runs, for the planner and the main run
compiled    the kernels of bent paths as machine code
"""
