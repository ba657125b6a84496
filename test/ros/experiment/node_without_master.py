#!/usr/bin/python3
"""What a node does whose master never comes: it waits, unless roslaunch, which started it, is gone."""
import os
import select
import signal
import socket
import subprocess
import sys
import tempfile
import unittest

import rosunit

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "support"))
from programs import located  # noqa: E402

NODES = ("evaluator_node", "render_node", "sun_position_node")
LONG_s = 30.0  # far more than a node takes to notice
MEANWHILE_s = 1.5  # some rounds of the watch


def free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


class Orphan:
    """A node that waits for a master, its parent killed."""

    def __init__(self, node, *words):
        environment = dict(os.environ, ROS_MASTER_URI="http://localhost:%d" % free_port(),
                           ROS_LOG_DIR=tempfile.gettempdir())
        self._said, writes = os.pipe()
        parent = subprocess.Popen(["sh", "-c", '"$@" & echo $!; wait', "sh", located(node)] + list(words),
                                  env=environment, stdout=subprocess.PIPE, stderr=writes, text=True)
        os.close(writes)
        self._node = int(parent.stdout.readline())
        self._heard = b""
        while b"Failed to contact master" not in self._heard:
            self._heard += self._read(LONG_s) or b""
        parent.kill()
        parent.wait()
        parent.stdout.close()

    def _read(self, seconds):
        """What it says next; empty: it has ended; None: nothing so long."""
        ready, _, _ = select.select([self._said], [], [], seconds)
        return os.read(self._said, 4096) if ready else None

    def ends_within(self, seconds):
        while True:
            said = self._read(seconds)
            if not said:
                return said is not None
            self._heard += said

    def heard(self):
        return self._heard.decode()

    def close(self):
        try:
            os.kill(self._node, signal.SIGKILL)
        except ProcessLookupError:
            pass
        os.close(self._said)


class NodeWithoutMaster(unittest.TestCase):

    def orphan(self, *words):
        orphan = Orphan(*words)
        self.addCleanup(orphan.close)
        return orphan

    def test_of_roslaunch_ends_with_it(self):
        for node in NODES:
            with self.subTest(node), tempfile.TemporaryDirectory() as folder:
                orphan = self.orphan(node, "__name:=alone", "__log:=%s/alone.log" % folder)
                self.assertTrue(orphan.ends_within(LONG_s), orphan.heard())
                self.assertIn("roslaunch ended before a master could be reached", orphan.heard())

    def test_of_a_shell_waits_on(self):
        orphan = self.orphan("evaluator_node")
        self.assertFalse(orphan.ends_within(MEANWHILE_s), orphan.heard())


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "node_without_master", NodeWithoutMaster, sysargs=sys.argv)
