from pathlib import Path
from typing import IO, Any

from pyarrow import Schema, Table

class ParquetWriter:
    def __init__(
        self, where: IO[bytes], schema: Schema, *, use_dictionary: list[str] | bool = True
    ) -> None: ...
    def write_table(self, table: Table) -> None: ...
    def close(self) -> None: ...

class ParquetFile:
    metadata: Any
    schema_arrow: Schema
    def __init__(self, source: IO[bytes]) -> None: ...

def read_table(source: Path | IO[bytes]) -> Table: ...
