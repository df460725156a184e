"""Writes sampled motion to a file: Parquet, or CSV."""

from __future__ import annotations

from array import array

from polycnc.deferred.typing import IO, TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    import numpy as np
    from numpy.typing import NDArray

    from polycnc.motion.sampling.samples import Samples

#: So many samples are written at once.
BATCH = 1 << 16
_KINDS = ("position", "velocity", "acceleration")


class SampleWriter(Protocol):
    """Writes samples as they come. `close` writes what belongs behind the last; the stream stays open."""

    def take(self, samples: Samples) -> None:
        """Write samples."""

    def close(self) -> None:
        """Write what belongs behind the last sample."""


def columns(samples: Samples) -> list[NDArray[np.float64] | NDArray[np.int64]]:
    """Samples as columns in the order of `names`; of the program its number."""
    moved = samples.position, samples.velocity, samples.acceleration
    each = [values[:, i] for values in moved for i in range(values.shape[1])]
    spindle = samples.spindle_rpm, samples.spindle_angle
    return [samples.time, *each, *spindle, samples.program, samples.line]


class _Gathered:
    """Samples until they are worth to be written: a run that lasts a moment has few."""

    def __init__(self) -> None:
        self._samples: list[Samples] = []
        self._count = 0

    def add(self, samples: Samples) -> Samples | None:
        """More samples; gives all of them when they are enough."""
        self._samples.append(samples)
        self._count += len(samples.time)
        return self.all() if self._count >= BATCH else None

    def all(self) -> Samples | None:
        """Those that are left, if there are any."""
        import numpy as np

        gathered, self._samples, self._count = self._samples, [], 0
        if not gathered:
            return None
        kind = type(gathered[0])
        return kind(*(np.concatenate(column) for column in zip(*gathered, strict=True)))


class Parquet:
    """An Arrow table in Parquet, one row group a batch."""

    def __init__(
        self, stream: IO[bytes], axes: tuple[str, ...], programs: list[str], metadata: Mapping[str, str]
    ) -> None:
        from polycnc.parquet.schema import Content, Field
        from polycnc.parquet.writer import Writer
        from polycnc.version import MADE_BY

        contents = {"program": Content.NAME, "line": Content.WHOLE}
        fields = [Field(name, contents.get(name, Content.NUMBER)) for name in names(axes)]
        self._programs = programs
        self._writer = Writer(stream, fields, metadata, MADE_BY)
        self._gathered = _Gathered()

    def take(self, samples: Samples) -> None:
        """Write samples."""
        self._write(self._gathered.add(samples))

    def _write(self, samples: Samples | None) -> None:
        if samples is None:
            return
        import numpy as np

        writer, height = self._writer, len(samples.time)
        *each, line = columns(samples)
        # A dictionary would give rows that stand -0.0 or 0.0 as the first of them is.
        numbers = array("d", (np.array(each, np.float64) + 0.0).tobytes())
        writer.begin(height)
        for place in range(len(each) - 1):
            writer.numbers(numbers, place * height)
        writer.names(numbers, (len(each) - 1) * height, self._programs)
        writer.whole(array("I", line.astype(np.uint32).tobytes()))

    def close(self) -> None:
        """Write the end of the file."""
        self._write(self._gathered.all())
        self._writer.close()


class Csv:
    """A header line and one line a sample."""

    def __init__(
        self, stream: IO[str], axes: tuple[str, ...], programs: list[str], _metadata: Mapping[str, str]
    ) -> None:
        import csv

        self._programs = programs
        self._writer = csv.writer(stream, lineterminator="\n")
        self._writer.writerow(names(axes))

    def take(self, samples: Samples) -> None:
        """Write samples."""
        *numbers, program, line = (column.tolist() for column in columns(samples))
        named = [self._programs[int(number)] for number in program]
        self._writer.writerows(zip(*numbers, named, line, strict=True))

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
