"""roslaunch under test: started on a master of its own, watched, and counted for what it leaves running."""
import fcntl
import os
import pty
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import threading
import time
import unittest.mock
import uuid

import rosgraph
import rospy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "support"))
from ports import free_port  # noqa: E402

TIMEOUT_S = 240.0  # for runs that take seconds on an idle machine
WORLDS = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "support", "worlds")
WORLD = os.path.join(WORLDS, "two_boxes.urdf")
WAYPOINTS = os.path.join(WORLDS, "straight.csv")
POSES = 20
LONG = dict(spacing=0.05, poses=200)  # for runs that are disturbed, so that none is over before, however slow the machine
DIFFERENCES = "[boolean_rgb, euclidean_grey, orb]"


class Terminal:
    """Of so many rows and columns. All that is written to it is read at once, by a thread, so that nobody waits."""

    def __init__(self, rows, columns):
        self.master, self.slave = pty.openpty()
        fcntl.ioctl(self.slave, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))
        self.parts = []
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def _read(self):
        try:
            while True:
                self.parts.append(os.read(self.master, 65536))
        except OSError:
            pass  # the last writer has closed it

    def hand_over(self):
        """Once those that write to it have been started: it ends with them."""
        os.close(self.slave)

    def text(self):
        """All, once its writers have ended."""
        self.reader.join(TIMEOUT_S)
        return b"".join(self.parts).decode()


class Launched:
    """One roslaunch, with everything that it started known by a mark in their environment."""

    all_of_them = []

    def __init__(self, launch_file, surroundings=None, terminal=None, **arguments):
        """`launch_file`: one of ours by its name, or a path. `surroundings`: environment variables of this launch, such as
        the ROS_MASTER_URI of a master that runs already. `terminal`: where it is shown, instead of a file."""
        self.all_of_them.append(self)
        self.mark = "SUNLIT_TEST_RUN=" + uuid.uuid4().hex
        key, value = self.mark.split("=")
        self.environment = dict(os.environ, ROS_MASTER_URI="http://localhost:%d" % free_port(),
                                ROS_HOSTNAME="localhost", **{key: value})
        self.environment.update(surroundings or {})
        # a: what is read here does not move where they write. Letters of two that write at once may lie within each other.
        self.log = tempfile.TemporaryFile(mode="a+", encoding="utf-8", errors="replace")
        port = self.environment["ROS_MASTER_URI"].rsplit(":", 1)[1]
        command = ["roslaunch", "-p", port] + ([launch_file] if "/" in launch_file else ["sunlit", launch_file])
        command += ["%s:=%s" % (name, value) for name, value in arguments.items()]
        self.process = subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL,
                                        stdout=terminal.slave if terminal else self.log, stderr=subprocess.STDOUT)
        if terminal:
            terminal.hand_over()

    def said(self):
        self.log.seek(0)
        return self.log.read()

    def end(self):
        """Its status, once it has ended."""
        try:
            return self.process.wait(TIMEOUT_S)
        except subprocess.TimeoutExpired:
            self.kill()
            raise AssertionError("never ended:\n" + self.said())

    def interrupt(self):
        self.process.send_signal(signal.SIGINT)
        return self.end()

    def running(self):
        """(pid, command line) of all that is alive of what was started, roslaunch and master included."""
        alive = []
        for entry in os.listdir("/proc"):
            if not entry.isdigit():
                continue
            try:
                with open("/proc/%s/environ" % entry, "rb") as environ:
                    if self.mark.encode() not in environ.read():
                        continue
                with open("/proc/%s/cmdline" % entry, "rb") as cmdline:
                    alive.append((int(entry), cmdline.read().replace(b"\0", b" ").decode()))
            except OSError:
                continue  # ended while we looked
        return alive

    def left_running(self):
        """What does not end in the wake of roslaunch."""
        deadline = time.monotonic() + TIMEOUT_S
        while self.running() and time.monotonic() < deadline:
            time.sleep(0.02)
        return self.running()

    def kill(self, part=""):
        """As the kernel does when memory runs out: all whose command line holds `part`, without a chance to react."""
        for pid, command in self.running():
            if part in command:
                os.kill(pid, signal.SIGKILL)
        if not part:
            self.process.wait(TIMEOUT_S)

    def wait_for(self, condition, what):
        """Polls something that nobody would wake us for, such as the growth of a file."""
        deadline = time.monotonic() + TIMEOUT_S
        while not condition():
            if self.process.poll() is not None:
                raise AssertionError("ended before %s:\n%s" % (what, self.said()))
            if time.monotonic() > deadline:
                self.kill()
                raise AssertionError("never %s:\n%s" % (what, self.said()))
            time.sleep(0.02)

    def master(self):
        """Of this launch, to be asked without a program for each question."""
        return rosgraph.Master("/test", self.environment["ROS_MASTER_URI"])

    def topics(self):
        """All that are published; none where the master is not there yet."""
        try:
            return {topic for topic, _ in self.master().getPublishedTopics("")}
        except OSError:
            return set()

    def subscribers(self, topic):
        """The nodes that hear it."""
        try:
            return dict(self.master().getSystemState()[1]).get(topic, [])
        except OSError:
            return []

    def has_service(self, name):
        try:
            return bool(self.master().lookupService(name))
        except (OSError, rosgraph.MasterException):
            return False

    def call(self, service, kind, **request):
        """The answer of a service of this launch."""
        with unittest.mock.patch.dict(os.environ, ROS_MASTER_URI=self.environment["ROS_MASTER_URI"]):
            return rospy.ServiceProxy(service, kind)(**request)

    def ros(self, *command):
        """A ROS command line tool on the master of this launch."""
        return subprocess.run(command, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              universal_newlines=True, timeout=TIMEOUT_S)


def kill_leftovers():
    """What a failed test did not end."""
    for launched in Launched.all_of_them:
        launched.kill()


def small_experiment(output, surroundings=None, terminal=None, **changes):
    """Two hours, a few tiny images of a tiny world."""
    arguments = dict(world=WORLD, path=WAYPOINTS, spacing=0.5, poses=POSES, hours="[10, 12]", width=96, height=72,
                     differences=DIFFERENCES, self_test_every=5, output=output, report="false")
    arguments.update(changes)
    return Launched("experiment.launch", surroundings, terminal, **arguments)
