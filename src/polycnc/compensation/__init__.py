"""Tool compensation as stages of the path: cutter and nose radius, and corners that are chamfered or rounded.

`CutterCompensation` is the one engine; `policies` says how controls differ, `vectors` holds the corner rules.
"""

from polycnc.compensation.cutter import CutterCompensation
from polycnc.compensation.plane import Plane
from polycnc.compensation.policies import Approach, Policy, Violation

__all__ = ["Approach", "CutterCompensation", "Plane", "Policy", "Violation"]
