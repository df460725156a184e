"""Tilted planes of the work: `tilted` is how they are told and what turning axes do to them, `feature` their frame."""
