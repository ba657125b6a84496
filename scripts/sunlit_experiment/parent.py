"""Processes that shall not outlive who started them."""

import ctypes
import signal


def end_with_parent():
    """Of the process that calls it: SIGINT once its parent has gone, also where that had no time to send it."""
    pr_set_pdeathsig = 1
    ctypes.CDLL(None).prctl(pr_set_pdeathsig, signal.SIGINT)
