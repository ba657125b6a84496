#!/usr/bin/python3
"""Every launch file starts, does its work and ends with status 0 at Ctrl-C."""
import sys
import tempfile
import unittest

import rosunit
from launching import WAYPOINTS, WORLD, Launched, kill_leftovers


class LaunchFilesStart(unittest.TestCase):

    @classmethod
    def tearDownClass(cls):
        kill_leftovers()

    def check(self, launched, *topics):
        """Each topic gets a message."""
        for topic in topics:
            launched.wait_for(lambda: launched.ros("rostopic", "info", topic).returncode == 0, "advertised " + topic)
            heard = launched.ros("rostopic", "echo", "-n", "1", "--noarr", topic)
            self.assertEqual(heard.returncode, 0, heard.stdout)
            self.assertIn("header", heard.stdout)
        self.finish(launched)

    def finish(self, launched):
        self.assertEqual(launched.interrupt(), 0, launched.said())
        self.assertEqual(launched.left_running(), [])

    def test_sun_position(self):
        self.check(Launched("sun_position.launch"), "/sun")

    def test_render(self):
        self.check(Launched("render.launch", world=WORLD, path=WAYPOINTS, conditions="{a: {hour: 9}, b: {hour: 12}}"),
                   "/a/sun", "/b/sun", "/path")

    def test_render_with_a_robot(self):
        launched = Launched("render.launch", world=WORLD, path=WAYPOINTS, robot="rover")
        launched.wait_for(lambda: "Robot rover" in launched.said(), "loaded the robot")
        launched.wait_for(lambda: "All poses are rendered" in launched.said(), "rendered the path")
        self.finish(launched)

    def test_demo(self):
        self.check(Launched("demo.launch", world=WORLD, path=WAYPOINTS), "/sun", "/path")

    def test_evaluator(self):
        with tempfile.TemporaryDirectory() as output:
            launched = Launched("evaluator.launch", streams="[a, b]", output=output)
            launched.wait_for(lambda: "data: 0" in launched.ros("rostopic", "echo", "-n", "1",
                                                                "/evaluator/progress").stdout, "said its progress")
            self.finish(launched)


if __name__ == "__main__":
    # Each launch file has a master of its own, so this needs none; also run from an install space.
    rosunit.unitrun("sunlit", "launch_files_start", LaunchFilesStart, sysargs=sys.argv)
