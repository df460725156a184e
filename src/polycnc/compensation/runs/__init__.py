"""Radius compensation of many moves at once: what most of a contour is, in machine code.

`window` takes a stage's window of steps apart, lets the kernel lead moves through it and puts it together again;
`kernels` is what happens to each move: a line whose ends are single vectors and that nothing objects to; `compiled`
has it as machine code. All else is left to the stage itself, a move at a time.
"""
