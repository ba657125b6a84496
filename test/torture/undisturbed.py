#!/usr/bin/python3
"""One short experiment that nobody disturbs: all stages, in a cold cache. Says what it said where it fails."""
import signal
import sys
import tempfile

from trial import Trial, kill_leftovers

if __name__ == "__main__":
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("interrupted"))
    with tempfile.TemporaryDirectory() as folder:
        try:
            run = Trial(folder, poses=20, spacing=0.5).start()
            status = run.process.wait()
            print(run.said())
        finally:
            kill_leftovers()
    sys.exit(status)
