"""The guard of experiment_node: should the node end without a word, killed by the kernel, say, it breaks off the experiment in
its stead. Without it roslaunch would end all the same, but with status 0, as if everything had been evaluated.
"""

import contextlib
import os
import select
import subprocess
import sys

from sunlit_experiment import display
from sunlit_experiment.launch import Launch

LOOK_EVERY_S = 1.0
IN_ORDER = b"."  # what the node says before it leaves


class Guard:
    """The guard as its node sees it: a process beside it, out of reach of what ends the node's process group."""

    def __init__(self, launch):
        self.launch = launch
        self._start()

    def _start(self):
        scripts = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
        self.process = subprocess.Popen([sys.executable, "-m", "sunlit_experiment.guard", str(self.launch.pid),
                                         self.launch.log_folder], cwd=scripts, stdin=subprocess.PIPE, start_new_session=True)

    def check(self):
        """Starts it again, should it have been killed."""
        if self.process.poll() is not None:
            self._start()

    def dismiss(self):
        """Before the node leaves in order."""
        with contextlib.suppress(BrokenPipeError):
            self.process.communicate(IN_ORDER)


def main():
    launch = Launch(int(sys.argv[1]), sys.argv[2])
    while not select.select([sys.stdin], [], [], LOOK_EVERY_S)[0]:
        launch.look()
    if os.read(sys.stdin.fileno(), 1) != IN_ORDER:
        display.restore(sys.stdout)
        launch.break_off("the node that watches over it was killed")


if __name__ == "__main__":
    main()
