"""Whether plain blocks are scanned: all that a short program needs to know of it."""

from __future__ import annotations

from polycnc.channel.states.unchanging import unchanging
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.language.bulk.layout import Columns, State, Tables
    from polycnc.language.bulk.scanner import Dialect, Scanner

#: Rows that one call of the kernel may give.
ROOMS = 16_384
#: Programs shorter than this are left to the interpreter.
FEWEST_LINES = 500


@unchanging
@dataclass(frozen=True, slots=True)
class Bulk:
    """Whether and how plain blocks are scanned.

    Attributes:
        fewest_lines: Shorter programs are left to the interpreter, and loops that have run fewer blocks.
        scan: The kernel; None for the compiled one.
        rooms: Rows that one call of the kernel may give.
        most_patience: Blocks that are interpreted at the most between two tries.
    """

    fewest_lines: int = FEWEST_LINES
    scan: Callable[[Tables, State, Columns], int] | None = None
    rooms: int = ROOMS
    most_patience: int = 4096

    def pays(self, lines: int) -> bool:
        """Whether a program is long enough, or a loop that has run so many blocks."""
        return lines >= self.fewest_lines

    def scanner(self, channel: Channel) -> Scanner | None:
        """What scans for a channel; None where its control has no plain blocks, or there is no compiled kernel."""
        dialect: Dialect | None = channel.control.plain_blocks(channel)
        if dialect is None:
            return None
        # For long programs only.
        from polycnc.language.bulk.compiled import LIBRARY
        from polycnc.language.bulk.scanner import Scanner

        scan = LIBRARY.compiled("scan") if self.scan is None else self.scan
        if scan is None:
            return None
        return Scanner(
            dialect, scan, len(channel.axes), self.rooms, self.most_patience, plain=self.scan is not None
        )
