#!/usr/bin/python3
"""Every launch file starts, does its work and ends with status 0 at Ctrl-C."""
import unittest

import rospy
import rostest
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
        self.assertEqual(launched.interrupt(), 0, launched.said())
        self.assertEqual(launched.left_running(), [])

    def test_sun_position(self):
        self.check(Launched("sun_position.launch"), "/sun")

    def test_render(self):
        self.check(Launched("render.launch", world=WORLD, path=WAYPOINTS, conditions="{a: {hour: 9}, b: {hour: 12}}"),
                   "/a/sun", "/b/sun", "/path")

    def test_demo(self):
        self.check(Launched("demo.launch", world=WORLD, path=WAYPOINTS), "/sun", "/path")


if __name__ == "__main__":
    rospy.init_node("launch_files_start")
    rostest.rosrun("sunlit", "launch_files_start", LaunchFilesStart)
