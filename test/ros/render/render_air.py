#!/usr/bin/python3
"""The air over a site is the same through the topics as on the command line, at any elevation."""
import os
import subprocess
import tempfile
import time
import unittest

import cv2
import numpy
import rospy
import rostest
from geometry_msgs.msg import Pose
from rendering import Process, RenderNode, TIMEOUT_S, WORLD, located, parameters
from sunlit.srv import RenderView, SetSite

# Late afternoon: the sun is at 10 degrees.
DATE = {"year": 2003, "month": 10, "day": 17, "hour": 16, "minute": 20, "timezone": -7.0, "rate": 0.0}
LATITUDE, LONGITUDE = 39.742476, -105.1786
HIGH_M = 1830.14


def snapshot(elevation_m):
    with tempfile.TemporaryDirectory() as folder:
        picture = os.path.join(folder, "picture.png")
        subprocess.run([located("snapshot"), "--world", WORLD, "--bounced", "off", "--size", "96x64", "--fov", "60",
                        "--pose", "0,0,1", "--ev", "12", "--site", "%.10g,%.10g,%.10g" % (LATITUDE, LONGITUDE, elevation_m),
                        "--date", "2003-10-17", "--timezone", "-7", "--time", "16:20", "--out", picture], check=True,
                       stdout=subprocess.DEVNULL)
        return cv2.cvtColor(cv2.imread(picture), cv2.COLOR_BGR2RGB)


class Camera:
    """Where the snapshots are taken from."""

    def __init__(self, node):
        rospy.wait_for_service("/%s/render_view" % node, TIMEOUT_S)
        self.view = rospy.ServiceProxy("/%s/render_view" % node, RenderView)

    def picture(self):
        """None while the node has no sky."""
        pose = Pose()
        pose.position.z = pose.orientation.w = 1.0
        answer = self.view(pose=pose, condition="")
        return numpy.frombuffer(answer.image.data, numpy.uint8).reshape(64, 96, 3) if answer.success else None

    def until_it_is(self, wanted, levels=0):
        """Waits for a picture, at most so many levels off, since a sky takes its time to come."""
        end = time.monotonic() + TIMEOUT_S
        while time.monotonic() < end:
            picture = self.picture()
            if picture is not None and numpy.abs(picture - wanted.astype(float)).max() <= levels:
                return
            rospy.rostime.wallsleep(0.2)
        raise AssertionError("no picture" if picture is None else
                             "%.2f levels off" % numpy.abs(picture - wanted.astype(float)).mean())


def render_node(name, **more):
    return RenderNode(name, parameters(camera={"width": 96, "height": 64, "horizontal_fov": 60.0, "supersampling": 2},
                                       exposure={"mode": "fixed", "ev100": 12.0}, transport={"enabled": False},
                                       night={"enabled": True}, **more))


class RenderAir(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        site = {"latitude": LATITUDE, "longitude": LONGITUDE, "elevation": HIGH_M}
        cls.sky = Process("hill_sky", {"date_time": DATE, "site": site, "earth": {"delta_t": "auto"}}, "sun_position_node")
        cls.sky.__enter__()
        cls.high, cls.low = snapshot(HIGH_M), snapshot(0.0)

    @classmethod
    def tearDownClass(cls):
        cls.sky.__exit__()

    def test_pictures_are_those_of_snapshot_wherever_the_site_is_moved(self):
        set_site = rospy.ServiceProxy("/hill_sky/set_site", SetSite)
        place = {"latitude": LATITUDE, "longitude": LONGITUDE, "pressure": 1013.25, "temperature": 0.0}
        with render_node("climber") as node:
            camera = Camera("climber")
            camera.until_it_is(self.high)
            self.assertTrue(set_site(elevation=0.0, **place).success)
            camera.until_it_is(self.low)
            self.assertTrue(set_site(elevation=HIGH_M, **place).success)
            camera.until_it_is(self.high)
            self.assertIn("1830.14 m", node.line_with("Air of a height"))
            self.assertIn("of 0 m", node.line_with("Air of a height"))

    def test_a_site_whose_air_cannot_have_the_weather_is_refused_and_the_camera_goes_on(self):
        set_site = rospy.ServiceProxy("/hill_sky/set_site", SetSite)
        place = {"latitude": LATITUDE, "longitude": LONGITUDE, "pressure": 1013.25, "temperature": 0.0}
        with render_node("far_sighted", weather={"visibility": 50000.0}) as node:
            camera = Camera("far_sighted")
            while camera.picture() is None:
                rospy.rostime.wallsleep(0.2)
            before = camera.picture()
            self.assertTrue(set_site(elevation=0.0, **place).success)
            line = node.line_with("Refused a sun on ")
            self.assertIn("at the elevation of its site, 0 m, visibility is 50000 m, but must be less than the ", line)
            self.assertTrue((camera.picture() == before).all())
            self.assertTrue(set_site(elevation=HIGH_M + 500.0, **place).success)
            end = time.monotonic() + TIMEOUT_S
            while (camera.picture() == before).all():
                self.assertLess(time.monotonic(), end)
                rospy.rostime.wallsleep(0.2)
            self.assertTrue(set_site(elevation=HIGH_M, **place).success)
            camera.until_it_is(before)

    def test_a_height_that_is_given_is_kept(self):
        # What differs beside the air is the sun's parallax, far less than a level, which may turn a rounding.
        with render_node("diver", atmosphere={"observer_height": 0.0}):
            Camera("diver").until_it_is(self.low, levels=1)

    def test_height_is_plain_to_see(self):
        # The direct sun by Kasten & Young's air mass of 5.6: a fifth less air above takes some 15 % less light away.
        self.assertGreater(self.high.astype(float).mean(), self.low.astype(float).mean() + 4.0)


if __name__ == "__main__":
    os.environ["ROSCONSOLE_STDOUT_LINE_BUFFERED"] = "1"  # what nodes say is read while they run
    rospy.init_node("render_air")
    rostest.rosrun("sunlit", "render_air", RenderAir)
