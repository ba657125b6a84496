"""Turns the output folder of an evaluation into one self-contained page, report.html."""
