"""Kernels that find the quickest law along a bent path, and prove it.

the data    courses (paths, axes, nodes, phases as flat arrays)
the passes  grid (estimate of second order, nodes), barrier (Newton's method with barriers), phases (of constant jerk;
            proof), search (all of it, and repairs)
compiled    the kernels as machine code
"""
