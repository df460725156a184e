"""Makes the shared object of polycnc's kernels, when polycnc is built: no part of what is installed.

- `hook`: what the build calls; what it needs, and the tag of the wheel.
- `shared_object`: all libraries into one file; `python -m build_kernels` makes it in the source tree.
- `compiler`: kernels to object code, by Numba; `arguments` is what they take, `sources` what they are made of, `axes`
  and `vectors` give them copies for the usual number of axes, and for processors with wide vectors; `blocks` is how
  they are called.
- `linker`: object code to a shared object, by a C compiler.
"""
