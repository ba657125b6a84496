"""Whether another process has worked off what has reached it."""

import glob
import time

GLANCES = 3  # in a row: one thread may have just woken another when the first glance falls between them
PAUSE_S = 0.02


def wait_until_idle(pid, patience_s):
    """Until every thread of the process waits for something to come; false where that takes longer than so."""
    end = time.monotonic() + patience_s
    idle = 0
    while idle < GLANCES:
        if time.monotonic() > end:
            return False
        idle = idle + 1 if _waits(pid) else 0
        time.sleep(PAUSE_S)
    return True


def _waits(pid):
    for path in glob.glob(f"/proc/{pid}/task/*/stat"):
        try:
            with open(path, encoding="utf-8", errors="replace") as file:
                state = file.read().rpartition(")")[2].split()[0]
        except OSError:  # a thread that has ended
            continue
        if state != "S":
            return False
    return True
