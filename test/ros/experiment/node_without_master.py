#!/usr/bin/python3
"""What a node does whose master does not come, or goes: it waits, unless roslaunch, which started it, is gone."""
import os
import select
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xmlrpc.client

import rosgraph
import rosunit

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "support"))
from ports import free_port  # noqa: E402
from programs import located  # noqa: E402

NODES = ("evaluator_node", "render_node", "sun_position_node")
LONG_s = 30.0  # far more than a node takes to notice
MEANWHILE_s = 1.5  # some rounds of the watch


class Master:
    """Of a free port, once it is started."""

    def __init__(self):
        self.port = free_port()
        self.uri = "http://localhost:%d" % self.port
        self.proxy = xmlrpc.client.ServerProxy(self.uri)
        self._process = None

    def is_there(self):
        try:
            return bool(self.proxy.getPid("/test"))
        except OSError:
            return False

    def start(self):
        self._process = subprocess.Popen(["rosmaster", "--core", "-p", str(self.port)], stdout=subprocess.DEVNULL)

    def knows(self, node):
        try:
            return bool(rosgraph.Master("/test", self.uri).lookupNode(node))
        except (OSError, rosgraph.MasterException):
            return False

    def kill(self):
        if self._process:
            self._process.kill()
            self._process.wait()


class Child:
    """A node, started by a process that can be killed."""

    def __init__(self, master, node, *words):
        environment = dict(os.environ, ROS_MASTER_URI=master.uri, ROS_LOG_DIR=tempfile.gettempdir())
        self._said, writes = os.pipe()
        self._parent = subprocess.Popen(["sh", "-c", '"$@" & echo $!; wait', "sh", located(node)] + list(words),
                                        env=environment, stdout=subprocess.PIPE, stderr=writes, text=True)
        os.close(writes)
        self._node = int(self._parent.stdout.readline())
        self._heard = b""

    def await_words(self, words):
        while words.encode() not in self._heard:
            said = self._read(LONG_s)
            if not said:
                raise AssertionError("never said %s: %s" % (words, self.heard()))
            self._heard += said

    def interrupt(self):
        os.kill(self._node, signal.SIGINT)

    def orphan(self):
        self._parent.kill()
        self._parent.wait()
        self._parent.stdout.close()

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

    def setUp(self):
        self.master = Master()
        self.addCleanup(self.master.kill)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.as_roslaunch_does = ("__name:=alone", "__log:=%s/alone.log" % folder.name)

    def child(self, *words):
        child = Child(self.master, *words)
        self.addCleanup(child.close)
        return child

    def wait_for(self, condition):
        deadline = time.monotonic() + LONG_s
        while not condition():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.02)

    def registered(self, node, **parameters):
        self.master.start()
        self.wait_for(self.master.is_there)
        for name, value in parameters.items():
            self.master.proxy.setParam("/test", "/alone/" + name, value)
        child = self.child(node, *self.as_roslaunch_does)
        self.wait_for(lambda: self.master.knows("/alone"))
        return child

    def test_a_name_or_address_that_cannot_be_ends_it_with_one_line(self):
        def refused(node, words, **surroundings):
            done = subprocess.run([located(node)] + words, env=dict(os.environ, **surroundings), stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=LONG_s)
            self.assertEqual((done.returncode, done.stdout.count("\n")), (1, 1), done.stdout)
            self.assertTrue(done.stdout.startswith(node[:-len("_node")] + ": "), done.stdout)
            return done.stdout

        for node in NODES:
            for word, named in (("__name:=my-node", "my-node"), ("__name:=/a/b", "/a/b"), ("a-b:=c", "a-b"), ("__ns:=x-y", "x-y")):
                self.assertIn(named, refused(node, [word]))
        for words, surroundings, named in (([], {"ROS_NAMESPACE": "x-y"}, "x-y"),
                                           ([], {"ROS_MASTER_URI": "foo"}, 'ROS_MASTER_URI is "foo", but must be as http://'),
                                           (["__master:=localhost"], {}, '__master is "localhost", but must be as http://')):
            self.assertIn(named, refused("sun_position_node", words, **surroundings))

    def test_of_roslaunch_ends_with_it(self):
        for node in NODES:
            with self.subTest(node):
                child = self.child(node, *self.as_roslaunch_does)
                child.await_words("Failed to contact master")
                child.orphan()
                self.assertTrue(child.ends_within(LONG_s), child.heard())
                self.assertIn("roslaunch has gone", child.heard())

    def test_of_a_shell_waits_on(self):
        child = self.child("evaluator_node")
        child.await_words("Failed to contact master")
        child.orphan()
        self.assertFalse(child.ends_within(MEANWHILE_s), child.heard())

    def test_of_roslaunch_ends_with_it_though_there_is_a_master(self):
        child = self.registered("sun_position_node")
        child.orphan()
        self.assertTrue(child.ends_within(LONG_s), child.heard())

    def test_of_roslaunch_writes_its_results_though_others_end_it_too(self):
        with tempfile.TemporaryDirectory() as folder:
            child = self.registered("evaluator_node", streams=["h04", "h12"], output_dir=folder)
            child.orphan()
            child.await_words("roslaunch has gone")
            child.interrupt()  # as experiment_node does, or its guard
            self.assertTrue(child.ends_within(LONG_s), child.heard())
            with open(os.path.join(folder, "run.yaml")) as file:
                self.assertIn("outcome:", file.read())

    def test_of_roslaunch_ends_with_it_though_there_was_a_master(self):
        """As where the master is killed while roslaunch starts nodes: it ends at once, and leaves them."""
        child = self.registered("sun_position_node")
        self.master.kill()
        child.orphan()
        self.assertTrue(child.ends_within(LONG_s), child.heard())


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "node_without_master", NodeWithoutMaster, sysargs=sys.argv)
