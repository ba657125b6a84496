"""Where the line of a run is shown: at the foot of a terminal, in place, or else as a line from time to time.

At a terminal the lowest row is kept free for it: all other output, whoever writes it, scrolls above, so that no warning of
a node is ever mixed with the line, and none has to be caught.
"""

import os
import sys
import time

from sunlit_experiment import progress

LINE_EVERY_S = 30.0
LOWEST = 4  # rows of a terminal of which one can be spared

STANDARD_STREAMS = ((1, "stdout"), (2, "stderr"))  # descriptors, and names as Python has them

SAVE, RESTORE = "\x1b7", "\x1b8"
CLEAR_LINE = "\x1b[2K"
WHOLE_SCREEN = "\x1b[r"


def _lead_nowhere(descriptor):
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, descriptor)
    os.set_inheritable(descriptor, True)
    if nowhere != descriptor:
        os.close(nowhere)


def open_standard_streams():
    """Those that were closed, of which Python makes None: all that is written is lost, and no other file gets their descriptors.
    What print() gets of None goes to standard output, which others may read for something else."""
    for descriptor, name in STANDARD_STREAMS:
        if getattr(sys, name) is None:
            _lead_nowhere(descriptor)
            setattr(sys, name, open(descriptor, "w", encoding="utf-8", closefd=False))


def restore(stream):
    """Gives a terminal all its rows back: for whoever remains when a Foot was killed."""
    if stream.isatty() and _knows_rows():
        _write(stream.fileno(), SAVE + WHOLE_SCREEN + RESTORE)


def say(text, stream):
    """Prints it. A run goes on where nobody reads any more, and all that is written to `stream` is then lost."""
    try:
        print(text, file=stream, flush=True)
    except OSError:
        _lead_nowhere(stream.fileno())  # or Python would try once more as it ends, and end with another status


def _write(descriptor, text):
    try:
        os.write(descriptor, text.encode())
    except OSError:
        pass  # the terminal or the reader has gone


def _size(descriptor):
    """Of a terminal; None where it has gone."""
    try:
        return os.get_terminal_size(descriptor)
    except OSError:
        return None


def _knows_rows():
    return os.environ.get("TERM", "dumb") not in ("dumb", "")


class Foot:
    """The lowest row of a terminal. Each change is one write, so that nobody else's comes between."""

    def __init__(self, descriptor):
        self.descriptor = descriptor
        self.size = None
        self.shown = None

    def show(self, status, _now):
        size = _size(self.descriptor)
        if size is None:
            return
        if size != self.size:
            self._reserve(size)
        text = progress.fitted(status, size.columns - 1)  # a full row would wrap
        if text != self.shown:
            _write(self.descriptor, f"{SAVE}\x1b[{size.lines};1H{CLEAR_LINE}{text}{RESTORE}")
            self.shown = text

    def _reserve(self, size):
        """A new row first, lest the cursor stands in the one that is taken."""
        has_grown = self.size and self.size.lines < size.lines
        old = f"{SAVE}\x1b[{self.size.lines};1H{CLEAR_LINE}{RESTORE}" if has_grown else ""
        _write(self.descriptor, f"{old}\n{SAVE}\x1b[1;{max(size.lines - 1, 1)}r{RESTORE}\x1b[1A")
        self.size, self.shown = size, None

    def close(self):
        if self.size:
            _write(self.descriptor, f"{SAVE}{WHOLE_SCREEN}\x1b[{self.size.lines};1H{CLEAR_LINE}{RESTORE}")
            self.size = None


class Lines:
    """Into a file or pipe: a line whenever it turns to something else, and every half a minute."""

    def __init__(self, descriptor):
        self.descriptor = descriptor
        self.doing = None
        self.latest = -float("inf")

    def show(self, status, now):
        if status.doing == self.doing and now - self.latest < LINE_EVERY_S:
            return
        self.doing, self.latest = status.doing, now
        _write(self.descriptor, f"experiment: {progress.line(status)}\n")

    def close(self):
        pass


class Display:
    """What a user sees of a run, on `stream`."""

    def __init__(self, stream):
        self.place = self._place_on(stream)
        self.pace = progress.Pace()

    @staticmethod
    def _place_on(stream):
        size = _size(stream.fileno()) if stream.isatty() and _knows_rows() else None
        in_place = size is not None and size.lines >= LOWEST
        return (Foot if in_place else Lines)(stream.fileno())

    def show(self, status):
        now = time.monotonic()
        if status.done is not None:
            self.pace.update(now, status.done)
        status.poses_a_second = self.pace.poses_a_second(now)
        self.place.show(status, now)

    def close(self):
        self.place.close()
