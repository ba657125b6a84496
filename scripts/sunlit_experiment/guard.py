"""The guard of experiment_node: should the node end without a word, killed by the kernel, say, it breaks off the experiment in
its stead. Without it roslaunch would end all the same, but with status 0, as if everything had been evaluated. Likewise where
roslaunch has gone and the node does nothing about it: without a master it waits for one, as rospy has it, forever.
"""

import contextlib
import os
import select
import subprocess
import sys
import time

from sunlit_experiment import display
from sunlit_experiment.launch import GONE, Launch

LOOK_EVERY_S = 1.0
PATIENCE_S = 5.0  # with a node whose roslaunch has gone
OF_ROSLAUNCH = "of_roslaunch"  # said to the guard, which may start too late to see it
IN_ORDER = b"."  # what the node says before it leaves
STARTS = 10
# Not by -m, which finds nothing of ours where PYTHONSAFEPATH is set; and nothing of the current folder is taken for ours.
BEGIN = ("import sys; sys.path[:] = sys.argv[1:2] + [*filter(None, sys.path)]; "
         "import sunlit_experiment.guard; sunlit_experiment.guard.main(*sys.argv[2:])")


class Guard:
    """The guard as its node sees it: a process beside it, out of reach of what ends the node's process group."""

    def __init__(self, launch):
        self.launch = launch
        self.starts_left, self.has_gone = STARTS, False
        self._start()

    def _start(self):
        scripts = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
        words = [str(self.launch.pid), self.launch.log_folder] + [OF_ROSLAUNCH] * self.launch.may_end_children
        self.starts_left -= 1
        self.process = subprocess.Popen([sys.executable, "-B", "-c", BEGIN, scripts] + words, stdin=subprocess.PIPE,
                                        start_new_session=True)

    def check(self):
        """Starts it again, should it have been killed, but not for ever; nor one that cannot run."""
        status = None if self.has_gone else self.process.poll()
        if status is None:
            return
        if status < 0 and self.starts_left:
            self.process.stdin.close()
            self._start()
            return
        self.has_gone = True
        display.say(f"experiment: WARNING: the guard of this node ended, with status {status}: should the node itself be killed, "
                    "roslaunch ends with status 0", sys.stderr)

    def dismiss(self):
        """Before the node leaves in order; once is enough."""
        if self.process.stdin.closed:
            return
        with contextlib.suppress(BrokenPipeError):
            self.process.communicate(IN_ORDER)


def reason_to_act(launch):
    """Once there is one; None where the node has left in order."""
    gone_since = None
    while not select.select([sys.stdin], [], [], LOOK_EVERY_S)[0]:
        launch.look()
        if launch.is_gone():
            gone_since = gone_since or time.monotonic()
            if time.monotonic() - gone_since > PATIENCE_S:
                return "roslaunch has gone"
    return None if os.read(sys.stdin.fileno(), 1) == IN_ORDER else "the node that watches over it was killed"


def main(pid, log_folder, *said):
    display.open_standard_streams()
    launch = Launch(int(pid), log_folder)
    if OF_ROSLAUNCH in said and not launch.may_end_children:
        launch = Launch(GONE, log_folder)
    reason = reason_to_act(launch)
    if reason:
        display.restore(sys.stdout)
        launch.break_off(reason)

