#!/usr/bin/python3
"""A bad or unknown parameter stops the node with one clear line and a non-zero exit status."""
import os
import re
import subprocess
import sys
import unittest

import rospkg
import rospy
import rostest
import yaml
from sun_reading import TIMEOUT_S

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "support"))
from programs import located  # noqa: E402


def start(parameters):
    """Runs the node with these private parameters until it gives up."""
    rospy.set_param("/bad_sun", parameters)
    try:
        return subprocess.run([located("sun_position_node"), "__name:=bad_sun"], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, encoding="utf-8", timeout=TIMEOUT_S,
                              env={**os.environ, "LC_ALL": "C"})
    finally:
        rospy.delete_param("/bad_sun")


class SunRefusesParameters(unittest.TestCase):

    def check(self, parameters, *parts):
        done = start(parameters)
        self.assertNotEqual(done.returncode, 0)
        lines = [line for line in (done.stdout + done.stderr).splitlines() if line.strip()]
        self.assertEqual(len(lines), 1, lines)
        for part in parts:
            self.assertIn(part, lines[0])

    def test_unknown_keys(self):
        self.check({"site": {"lattitude": 5.0}}, "/bad_sun/site/lattitude", "unknown", "site/latitude")
        self.check({"colour": "red"}, "/bad_sun/colour", "unknown")
        self.check({"conditions": {"h04": {"huor": 4}}}, "h04/huor", "unknown")

    def test_every_parameter_is_explained_in_the_shipped_file(self):
        def keys(tree, prefix=""):
            for key, value in tree.items():
                yield from keys(value, prefix + key + "/") if isinstance(value, dict) else [prefix + key]

        with open(os.path.join(rospkg.RosPack().get_path("sunlit"), "config", "sun_position.yaml")) as file:
            shipped = yaml.safe_load(file)
        done = start(dict(shipped, unknown_key=1))  # all but that one are accepted
        self.assertIn("/bad_sun/unknown_key is unknown", done.stdout + done.stderr)
        known = re.search("known are ([a-z0-9_/, ]*)", done.stdout + done.stderr).group(1).split(", ")
        self.assertEqual(sorted(set(known) - {"conditions", "diagnostic_period"}), sorted(keys(shipped)))

    def test_values_out_of_range(self):
        self.check({"site": {"latitude": 91.0}}, "/bad_sun/site/latitude", "91", "from -90 to 90")
        self.check({"date_time": {"month": 13}}, "/bad_sun/date_time/month", "13", "from 1 to 12")
        self.check({"date_time": {"month": 2, "day": 31}}, "/bad_sun/date_time/day", "31", "from 1 to 29")
        self.check({"conditions": {"h04": {"month": 2}}, "date_time": {"day": 31}}, "date_time/day, in /bad_sun/conditions/h04, is 31")
        self.check({"date_time": {"second": 60.0}}, "/bad_sun/date_time/second", "60")
        self.check({"earth": {"delta_t": "soon"}}, "/bad_sun/earth/delta_t", "soon", "auto")
        self.check({"earth": {"delta_t": "später …"}}, "später …")  # whatever the locale
        self.check({"publish_rate": 0}, "/bad_sun/publish_rate", "0", "from 0.01 to 1000")
        self.check({"conditions": {"h04": {"hour": 25}}}, "h04/hour", "25", "from 0 to 23")

    def test_frames_that_make_no_tree(self):
        self.check({"frames": {"sun": ""}}, "/bad_sun/frames/sun", "name of a TF frame")
        self.check({"frames": {"map": "/map"}}, "/bad_sun/frames/map", "without a slash in front")
        self.check({"conditions": ["a"], "frames": {"moon": "sun"}}, "frames/moon", "frames/sun is called so already")

    def test_bad_conditions(self):
        self.check({"conditions": ["a", "a"]}, "/bad_sun/conditions", "twice")
        self.check({"conditions": 7}, "/bad_sun/conditions")
        self.check({"conditions": {"4h": {"hour": 4}}}, "/bad_sun/conditions", "4h")


if __name__ == "__main__":
    rospy.init_node("sun_refuses_parameters")
    rostest.rosrun("sunlit", "sun_refuses_parameters", SunRefusesParameters)
