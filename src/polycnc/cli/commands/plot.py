"""`polycnc plot`: the path as a drawing."""

from __future__ import annotations

from enum import StrEnum

from polycnc.cli import options
from polycnc.cli.console import fail, note
from polycnc.cli.declaration import Argument, Commands, Option, Path
from polycnc.cli.diagnostics import diagnostics_of
from polycnc.cli.progress import Waiting, WaitingForRun
from polycnc.deferred.modules import is_installed
from polycnc.deferred.typing import TYPE_CHECKING, Annotated
from polycnc.messages import text

if TYPE_CHECKING:
    from polycnc.session import Result, Session

commands = Commands()


class ViewName(StrEnum):
    """The projections of `--view`."""

    XY = "xy"
    XZ = "xz"
    YZ = "yz"
    ZX = "zx"
    THREE = "three"


@commands.command("help.plot", runs="file")
def plot(
    file: Annotated[Path, Argument("help.run.file", metavar="FILE")],
    output: Annotated[Path, Option("help.plot.output", "--output", "-o", metavar="X.svg|X.png")],
    view: Annotated[ViewName | None, Option("help.plot.view", shows_default=False)] = None,
    profile: Annotated[bool, Option("help.plot.profile", "--profile")] = False,
    *,
    opening: options.Opening,
) -> int:
    """Draw the path of a program; an alarm ends the path where it came."""
    from polycnc.cli.output import write_whole
    from polycnc.messages.files import refuse_inputs

    refuse_inputs([output], opening.inputs(file))
    suffix = output.suffix.lower()
    if suffix not in (".svg", ".png"):
        return fail(text("plot.suffix", file=output), 2)
    if profile and not is_installed("numpy"):
        return fail(text("run.no-samples"), 2)
    session = opening.session(file, keep=not profile)
    result, drawing = _profile(session, file.name) if profile else _path(session, view, file.name)
    if suffix == ".svg":
        write_whole(output, drawing)
    else:
        _write_png(output, drawing)
    for diagnostic in diagnostics_of(result, str(file)):
        note(str(diagnostic))
    return 0 if result.ok else 1


def _path(session: Session, view: ViewName | None, title: str) -> tuple[Result, str]:
    with WaitingForRun(session):
        result = session.run()
    return result, _drawing(result, view, title)


def _profile(session: Session, title: str) -> tuple[Result, str]:
    """Run and draw speed and acceleration over time."""
    from polycnc.motion.sampling.profile import Profile

    machine, axes = session.result.machine, session.result.toolpath.axes
    rotary = {i for i, axis in enumerate(machine.channel(1).axes) if machine.axis[axis].rotary}
    profile = Profile(axes, rotary)
    sampler = session.sample(machine.interpolation_cycle_s, profile.take)
    with WaitingForRun(session, sampler):
        result = session.run()
        result.plan  # noqa: B018 - planning to the end gives the last samples
        sampler.close()
    return result, profile.svg(title)


def _drawing(result: Result, view: ViewName | None, title: str) -> str:
    from polycnc.toolpath.plot import VIEWS, AxisLabel, svg
    from polycnc.toolpath.strokes import strokes

    geometry = result.machine.geometry_indices(1)
    is_lathe = geometry[1] < 0
    contexts = result.toolpath.contexts
    diameters = contexts[0].diameter_axes if contexts else 0
    labels = [
        AxisLabel(result.toolpath.axes[i], 1.0 + (diameters >> i & 1)) if i >= 0 else AxisLabel("")
        for i in geometry
    ]
    views = VIEWS[view or ("zx" if is_lathe else "three")]
    with Waiting(title, len(result.toolpath), "rows") as waiting:
        rows = waiting.each(result.toolpath.rows())
        drawn = list(strokes(result.toolpath, geometry, rows=rows))
    points = sum(len(stroke.points) for stroke in drawn)
    with Waiting(title, len(views) * points, "points") as waiting:
        return svg(drawn, views, title, labels, waiting.each)


def _write_png(output: Path, drawing: str) -> None:
    import resvg_py

    from polycnc.cli.output import whole_file

    with whole_file(output, "wb") as stream:
        stream.write(bytes(resvg_py.svg_to_bytes(svg_string=drawing)))
