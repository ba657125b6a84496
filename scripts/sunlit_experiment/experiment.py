"""An experiment as it runs: what has to be true at its end, and what is shown meanwhile.

The experiment runs on the renderer's clock, which stands still while nothing is rendered: all waiting here is by the wall.
"""

import os
import subprocess
import sys
import time

import rospy
from std_msgs.msg import UInt32
from sunlit.msg import Activity

from sunlit_experiment import progress, summary
from sunlit_experiment.display import Display
from sunlit_experiment.launch import Failure
from sunlit_experiment.recorder import Recorder

POLL_S = 0.2
PATIENCE_S = 5.0
RENDERERS = {"render", "self_test/render"}


class Progress:
    """What the nodes say of themselves, as a Status."""

    def __init__(self, poses, images_a_pose):
        self.status = progress.Status(total=poses, images_a_pose=images_a_pose)
        self.doing = None  # ours, once the nodes have done theirs
        self.activity = self.localising = None
        self.told_at = time.monotonic()
        rospy.Subscriber("/evaluator/progress", UInt32, self._on_progress)
        rospy.Subscriber("/render/activity", Activity, self._on_activity)
        rospy.Subscriber("/evaluator/activity", Activity, self._on_localising)

    def _on_progress(self, message):
        self.status.done = message.data

    def _on_activity(self, message):
        self.activity, self.told_at = message, time.monotonic()

    def _on_localising(self, message):
        self.localising = message

    def is_everything_evaluated(self):
        return (self.status.done or 0) >= self.status.total

    def now(self, dead):
        """`dead`: names of nodes that have ended."""
        if self.doing:
            self.status.turn_to(self.doing)
        elif self.localising:
            self.status.turn_to(self.localising.doing, self.localising.share, self.localising.seconds_left)
        else:
            self.status.follow(self.activity, "render" in dead, time.monotonic() - self.told_at)
        return self.status


class Experiment:
    """Records, watches over the nodes and ends with a report."""

    def __init__(self, launch, guard, interruptions):
        """`interruptions`: filled by signals."""
        self.launch, self.guard, self.interruptions = launch, guard, interruptions
        launch.look()
        self.output = rospy.get_param("~output")
        self.poses = rospy.get_param("~poses")
        self.self_test_every = rospy.get_param("~self_test_every")
        self.needed = set(rospy.get_param("~needed"))
        self.report = rospy.get_param("~report", "")
        self.earlier = rospy.get_param("~earlier", {"summary": ""})
        self.inputs = rospy.get_param("~inputs", None)  # of an earlier run that left nothing to evaluate
        plan = rospy.get_param("~recording", {})
        self.recorder = Recorder(self.output, plan, self.poses, rospy.get_param("~verbose")) if plan else None
        self.missed_since = None  # a renderer, while not everything seemed evaluated
        self.progress = Progress(self.poses, rospy.get_param("~images_a_pose"))
        self.display = Display(sys.stdout)

    def run(self):
        """The lines that are to be said when all is done."""
        try:
            self._await_evaluator()
            rows = summary.read(self.output, self.earlier)
            if self.inputs is not None:
                self._await(self._are_inputs_compared)
            summary.check(rows, self.poses, self.self_test_every)
            summary.check_localised(self.output)
            # What the evaluator has, the recorder may not have yet: only the renderer's end says so. With no pose left to
            # render it may have begun too late to hear of its end from an evaluator that had nothing to do.
            if self.recorder and self.recorder.has_poses_left:
                self._await(lambda dead: "render" in dead)
            said = self._recorded()
            before = "" if self.inputs is None else "an earlier run had evaluated all; "
            return [*said, *self._reported(rows), f"done; {before}results in {self.output}"]
        finally:
            if self.recorder:
                self.recorder.stop()
            self.display.close()

    def _recorded(self):
        if not self.recorder:
            return []
        self._say("checking the recording")
        self.recorder.stop()
        return [f"recorded {self.recorder.verify()}"]

    def _reported(self, rows):
        if not self.report:
            return [f"all is evaluated\n{summary.tables(rows)}"]
        self._say("reporting")
        # Whatever letters the terminal has, so that it is only in our own line that some may be replaced.
        with subprocess.Popen([self.report, self.output], stdout=subprocess.PIPE,
                              env=dict(os.environ, PYTHONIOENCODING="utf-8")) as report:
            tables = self._waited_for(report)
        if report.returncode != 0:
            raise Failure("interrupted" if self.interruptions else
                          f"there is no report of {self.output}; the reason stands above")
        return ["all is evaluated\n" + tables.decode(errors="replace").rstrip()]

    def _waited_for(self, process):
        """What it prints. It is of our group, so that what interrupts us mostly interrupts it as well."""
        while True:
            try:
                return process.communicate(timeout=POLL_S)[0]
            except subprocess.TimeoutExpired:
                if self.interruptions:
                    process.terminate()

    def _say(self, doing):
        self.progress.doing = doing
        self.display.show(self.progress.now(set()))

    def _await(self, is_over):
        """Until `is_over` of the names of dead nodes."""
        while True:
            if self.launch.is_gone():
                raise Failure("roslaunch has gone")
            if self.interruptions:
                raise Failure("interrupted")
            if self.recorder:
                self.recorder.check()
            self.guard.check()
            _, dead = self.launch.nodes(rospy.get_param("/roslaunch/uris", {}).values())
            if is_over(dead):
                return
            self.display.show(self.progress.now(dead))
            time.sleep(POLL_S)

    def _await_evaluator(self):
        def is_over(dead):
            if "evaluator" in dead:
                return True
            missed = sorted(self.needed & dead)
            # The renderers may leave once everything is evaluated, long before it is written to disk.
            if set(missed) <= RENDERERS and (not missed or self._may_renderers_leave(dead)):
                return False
            raise Failure(f"{missed[0]} ended before everything was evaluated; its reason stands above")

        self._await(is_over)

    def _are_inputs_compared(self, dead):
        """With nothing left to evaluate only the renderer can tell whether what is there is of this world and this path."""
        if summary.identity(summary.inputs_in(self.output)) != self.inputs:
            return True
        if "render" in dead:
            raise Failure("render ended before it had compared world and path with those of this folder; its reason stands above")
        return False

    def _may_renderers_leave(self, dead):
        """Once everything is evaluated. What the evaluator said of it may reach us a little later than them."""
        if self.inputs is not None:  # it was from the beginning
            self._are_inputs_compared(dead)
            return True
        if self.progress.is_everything_evaluated():
            return True
        now = time.monotonic()
        self.missed_since = self.missed_since or now
        return now - self.missed_since < PATIENCE_S
