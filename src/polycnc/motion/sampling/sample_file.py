"""Writes sampled motion to a file: Parquet, or CSV."""

from __future__ import annotations

from typing import IO, TYPE_CHECKING, Protocol, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    import numpy as np
    from numpy.typing import NDArray

    from polycnc.motion.sampling.samples import Samples

#: A column: numbers, or the names of programs.
Column: TypeAlias = "NDArray[np.float64] | NDArray[np.int64] | list[str]"

_KINDS = ("position", "velocity", "acceleration")


class SampleWriter(Protocol):
    """Writes samples as they come. `close` writes what belongs behind the last; the stream stays open."""

    def take(self, samples: Samples) -> None:
        """Write samples."""

    def close(self) -> None:
        """Write what belongs behind the last sample."""


def columns(axes: tuple[str, ...], programs: list[str], samples: Samples) -> dict[str, Column]:
    """Samples as columns by name: `x_position`, `x_velocity`, `x_acceleration` for every axis."""
    named: dict[str, Column] = {"time": samples.time}
    moved = samples.position, samples.velocity, samples.acceleration
    for kind, values in zip(_KINDS, moved, strict=True):
        named.update({f"{axis.lower()}_{kind}": values[:, i] for i, axis in enumerate(axes)})
    named["spindle_rpm"], named["spindle_angle"] = samples.spindle_rpm, samples.spindle_angle
    named["program"] = [programs[k] if k < len(programs) else "" for k in samples.program]
    named["line"] = samples.line
    return named


class Parquet:
    """An Arrow table in Parquet. Needs pyarrow."""

    def __init__(
        self, stream: IO[bytes], axes: tuple[str, ...], programs: list[str], metadata: Mapping[str, str]
    ) -> None:
        import pyarrow as pa
        from pyarrow import parquet

        self._axes, self._programs = axes, programs
        types = {"program": pa.dictionary(pa.int32(), pa.string()), "line": pa.int32()}
        fields = [pa.field(name, types.get(name, pa.float64())) for name in names(axes)]
        self._schema = pa.schema(fields, metadata=dict(metadata))
        self._writer = parquet.ParquetWriter(stream, self._schema)

    def take(self, samples: Samples) -> None:
        """Write samples."""
        import pyarrow as pa

        self._writer.write_table(pa.table(columns(self._axes, self._programs, samples), schema=self._schema))

    def close(self) -> None:
        """Write the end of the file."""
        self._writer.close()


class Csv:
    """A header line and one line a sample."""

    def __init__(
        self, stream: IO[str], axes: tuple[str, ...], programs: list[str], _metadata: Mapping[str, str]
    ) -> None:
        import csv

        self._axes, self._programs = axes, programs
        self._writer = csv.writer(stream, lineterminator="\n")
        self._writer.writerow(names(axes))

    def take(self, samples: Samples) -> None:
        """Write samples."""
        values = columns(self._axes, self._programs, samples).values()
        self._writer.writerows(zip(*(v if isinstance(v, list) else v.tolist() for v in values), strict=True))

    def close(self) -> None:
        """Nothing stands behind the last line."""


def names(axes: tuple[str, ...]) -> list[str]:
    """Names of the columns, in order."""
    moved = [f"{axis.lower()}_{kind}" for kind in _KINDS for axis in axes]
    return ["time", *moved, "spindle_rpm", "spindle_angle", "program", "line"]


#: Writers by the suffix of the file, with the mode in which it is opened.
SAMPLE_WRITERS: dict[str, tuple[str, Callable[..., SampleWriter]]] = {
    ".parquet": ("wb", Parquet),
    ".csv": ("w", Csv),
}
