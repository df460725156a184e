from collections.abc import Sequence
from pathlib import Path
from typing import IO

from pyarrow import Schema, Table

class ParquetWriter:
    def __init__(
        self,
        where: IO[bytes],
        schema: Schema,
        *,
        use_dictionary: bool | Sequence[str] = ...,
        write_statistics: bool | Sequence[str] = ...,
    ) -> None: ...
    def write_table(self, table: Table) -> None: ...
    def close(self) -> None: ...

def read_table(source: Path | IO[bytes]) -> Table: ...
