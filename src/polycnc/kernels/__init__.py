"""Kernels: plain functions on arrays and records that run as they are, or as machine code.

`layout` is how a kernel's data is declared: kinds of arrays, records with named fields, places in flat arrays. A kernel
says with its annotations what it takes, so that one declaration serves Python, the compiler and the call. `library`
is a set of kernels that are compiled together, and gives each of them compiled or as it is written. The machine code is
made when polycnc is built (`build_kernels` beside `src`) and lies in one file of the installation (`native`), whose
types and functions are those of `c_types`. That file says by itself what its kernels take (`description`), from which
`call` makes what Python calls, and holds the sources that it was made of: while they are those of the installation,
byte by byte, it is used, and modules that hold nothing but kernels are not imported.

Both ways work on the same memory and give the same numbers, bit for bit. `POLYCNC_KERNELS=python` in the environment
chooses the plain one.
"""
