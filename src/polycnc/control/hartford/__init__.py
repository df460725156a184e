"""The Hartford machining centre, which two controls drive: `m_codes`, and its rules, alarms and messages as tables."""
