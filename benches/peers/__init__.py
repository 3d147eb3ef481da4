"""Other systems on the same triads as assur, in one run; see run.py."""
