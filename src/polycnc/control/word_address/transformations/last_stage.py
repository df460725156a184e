"""A stage behind all others, in front of the rows: it changes what the axes do, whatever the path in front of it is."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.channel.path import PathStage


def put_last(channel: Channel, stage: PathStage) -> None:
    """Lead every move through a stage as its last one; the stage's `after` must be the rows."""
    node = channel.head
    if node is None:
        channel.head = stage
    else:
        while node.after is not channel.table:
            node = node.after
        node.after = stage
    channel.table = stage


def remove_last(channel: Channel) -> None:
    """The last stage goes: all that was held back is written, the path ends at the rows again."""
    channel.flush()
    last, rows = channel.table, channel.rows
    if channel.head is last:
        channel.head = None
    node = channel.head
    while node is not None and node is not rows:
        if node.after is last:
            node.after = rows
        node = node.after
    channel.table = rows
