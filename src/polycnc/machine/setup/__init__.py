"""The setup that a run starts from: `values`; `file` reads it, `check` holds it against machine, `edit` writes."""
