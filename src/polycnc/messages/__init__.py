"""Alarms as values, and every text that a user reads, in English and Traditional Chinese.

`alarm` is what a control raises, `errors` what polycnc itself refuses, and where it has failed (`files`: what cannot
be read or written); `catalogue` has the texts.
"""

from polycnc.messages.alarm import Alarm, AlarmError
from polycnc.messages.catalogue import Catalogue, text
from polycnc.messages.errors import UserError

__all__ = ["Alarm", "AlarmError", "Catalogue", "UserError", "text"]
