"""Kernels that find the quickest law along a bent path, and prove it.

the data    courses (paths, axes, nodes, phases as flat arrays)
the passes  grid (estimate of second order, nodes), stencils (of the spline between nodes), barrier (slopes and bends
            of time and limits), newton (steps with them, and the first x), phases (of constant jerk; proof), search
            (all of it, and repairs), joining (laws cut into parts), records (pieces and times of rows, by the phases)
quickest    all of them in turn, without numpy
compiled    the kernels as machine code
"""
