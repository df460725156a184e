"""The operator panel: what stands on it (`description`, data), and what its keys, switches and lamps do (`panel`).

`editing` has what an editor says of a program's text, `checking` goes through
long ones in another process, `course` has what a picture shows: the path of the
program and of the tool, `keyed` reads numbers as keys have them. `screens/` has the screens, `teaching/` faults and
exercises, `web/` the page.
"""

from polycnc.panel.description import PanelDescription, describe
from polycnc.panel.panel import Light, Panel

__all__ = ["Light", "Panel", "PanelDescription", "describe"]
