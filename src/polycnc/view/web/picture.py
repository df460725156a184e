"""The picture as an element of a page."""

from __future__ import annotations

from dataclasses import asdict

from nicegui import ui
from nicegui.element import Element

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import text

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.view.bodies import MachineBodies, Pose
    from polycnc.view.lines import Lines

#: The page knows three.js by the scene of NiceGUI, which brings it.
_BRINGS_THREE = ui.scene
#: What stands on the keys of a picture.
_WORDS = ("tool", "feed", "space", "top", "front", "side", "fit", "machine", "no-webgl", "name")


class Picture(Element, component="picture.js"):
    """A picture of lines, a machine and a tool.

    Args:
        lines: Addresses of the lines (`delivery`), by their names: `path` is drawn pale, `trail` in colours.
        bodies: The machine.
        lang: Language of its keys.
        over: CSS selector of the element of the page that it lies over; empty where it has its own place.
    """

    def __init__(self, lines: Mapping[str, str], bodies: MachineBodies, lang: str, over: str = "") -> None:
        super().__init__()
        self._props["lines"] = dict(lines)
        self._props["bodies"] = [asdict(body) for body in bodies.bodies]
        self._props["lathe"] = bodies.is_lathe
        self._props["words"] = {word: text(f"view.{word}", lang) for word in _WORDS}
        self._props["over"] = over
        self._told: object = None

    def show(self, pose: Pose, lines: Mapping[str, Lines]) -> None:
        """Show where everything stands, and that lines have grown; nothing is sent where nothing has changed."""
        told = (pose.point, pose.machine, pose.along, tuple(pose.angles.values()),
                *((each.era, len(each)) for each in lines.values()))  # fmt: skip
        if told == self._told:
            return
        self._told = told
        counts = {name: [each.era, len(each)] for name, each in lines.items()}
        self.run_method("show", asdict(pose), counts)
