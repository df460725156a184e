"""`python -m build_kernels`: makes the shared object of this source tree, where it is not there or does not fit."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "src"))

from build_kernels import shared_object

if not shared_object.is_current():
    shared_object.make()
