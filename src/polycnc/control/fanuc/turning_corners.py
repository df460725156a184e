"""Chamfer and corner R between two G01 blocks of one axis each (0i-TF Plus II.4.7)."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.plan import Builder


def plan_corner(builder: Builder) -> Callable[[Channel, list[float]], object] | None:
    """I, J, K (or C by 3405#4) and R of a G01 block."""
    return None
