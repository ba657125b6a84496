"""rosbag record beside an experiment, and the account of what all bags of its folder hold at the end."""

import contextlib
import os
import signal
import subprocess

import roslib.packages

from sunlit_experiment import recording
from sunlit_experiment.idle import wait_until_idle
from sunlit_experiment.launch import Failure
from sunlit_experiment.parent import end_with_parent

LIST = "recording.csv"
PATIENCE_S = 10.0


class Recorder:
    """rosbag record, as long as the experiment runs."""

    def __init__(self, output, plan, poses, is_verbose):
        """`plan`: the parameter ~recording."""
        self.output = output
        self.poses = poses
        self.topics = plan["topics"]
        self.clock = recording.Clock(plan["start_stamp"], plan["frame_rate"])
        self.has_poses_left = plan["begin"] < poses
        self.process = None
        self.earlier = set(recording.bags(output)) if self.has_poses_left else set()
        if self.has_poses_left:
            # -b 0: its buffer may grow, so that nothing is dropped. Below --min-space (1 GB by default) it would go on without
            # recording; so a full disk ends it, and the run with it. At SIGINT it closes its bag in order.
            self.process = subprocess.Popen(
                [roslib.packages.find_node("rosbag", "record")[0], "-b", "0", "--min-space=1", "-o",
                 os.path.join(output, recording.PREFIX[:-1]), "__name:=" + recording.NODE] + self.topics,
                preexec_fn=end_with_parent, stdout=None if is_verbose else subprocess.DEVNULL)

    def check(self):
        if self.process and self.process.poll() is not None:
            raise Failure("the recorder ended early; its reason stands above")

    def stop(self):
        if self.process and self.process.poll() is None:
            wait_until_idle(self.process.pid, PATIENCE_S)  # at SIGINT it forgets what has reached it and is not written yet
            self.process.send_signal(signal.SIGINT)
            self.process.wait()
            self._remove_empty()

    def _remove_empty(self):
        """Of a start that is refused, or interrupted before the first pose, no bag is left in the folder."""
        for bag in recording.bags(self.output):
            if bag not in self.earlier and not recording.holds_poses(bag, self.topics):
                with contextlib.suppress(OSError):
                    os.remove(bag)

    def verify(self):
        """A recording that lacks an image is worse than none. Gives a line about all bags together."""
        union = recording.Union(self.output, self.topics, self.clock, self.poses)
        self._list(union)
        reasons = "".join(f"; {reason}" for reason in union.unreadable)
        missing = union.missing()
        if missing:
            lacking = "; ".join(f"{topic}: {recording.ranges(poses)}" for topic, poses in missing.items())
            raise Failure(f"the recording in {self.output} lacks poses: {lacking}{reasons}")
        twice = union.twice()
        return (f"{self.poses} poses in {len(union.by_bag)} bag{'s' if len(union.by_bag) > 1 else ''}"
                + (f", poses {recording.ranges(twice)} more than once" if twice else "") + reasons)

    def _list(self, union):
        path = os.path.join(self.output, LIST)
        draft = path + ".part"
        try:
            with open(draft, "w", encoding="utf-8") as file:
                file.write("bag,first_pose,last_pose,poses\n")
                for bag, first, last, count in union.table():
                    file.write(f"{bag},{'' if first is None else first},{'' if last is None else last},{count}\n")
            os.replace(draft, path)
        except OSError as error:
            with contextlib.suppress(OSError):
                os.remove(draft)
            raise Failure(f"{path} cannot be written: {error.strerror}; start the same again once it can") from None
