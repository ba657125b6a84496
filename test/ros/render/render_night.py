#!/usr/bin/python3
"""Night through the topics: moonlight and its shadow, and what the node says of a sky that is not whole."""
import math
import unittest

import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import Pose
from rendering import Process, Reader, RenderNode, Sky, Sun, TIMEOUT_S, parameters
from sunlit.srv import RenderView

# Full moon high in winter, in the evening, and the same place without a moon.
FULL = {"year": 2024, "month": 12, "day": 15, "hour": 19}
DARK = {"year": 2024, "month": 12, "day": 1, "hour": 1}
EYE_M = (11.0, 0.0, 12.0)  # above the box ahead, looking down
FOCAL_PX = 48 * 3 ** 0.5   # 96 px across 60 degrees


def looking_down():
    """The picture's top is +x, its right is -y."""
    pose = Pose()
    pose.position.x, pose.position.y, pose.position.z = EYE_M
    pose.orientation.y = pose.orientation.w = 0.5 ** 0.5
    return pose


def level_on_ground(image, x, y):
    """Green, 0 to 255, of the pixel that sees a point of the ground."""
    u = round(47.5 - FOCAL_PX * (y - EYE_M[1]) / EYE_M[2])
    v = round(35.5 - FOCAL_PX * (x - EYE_M[0]) / EYE_M[2])
    return image.data[v * image.step + 3 * u + 1]


def direction_of(frame):
    """Towards what a frame's x axis points at, in map, by TF."""
    buffer = tf2_ros.Buffer()
    listener = tf2_ros.TransformListener(buffer)
    origin = buffer.lookup_transform("map", frame, rospy.Time(0), rospy.Duration(TIMEOUT_S)).transform.translation
    listener.unregister()
    length = math.sqrt(origin.x ** 2 + origin.y ** 2 + origin.z ** 2)
    return origin.x / length, origin.y / length, origin.z / length


class RenderNight(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        sky = {"date_time": {"rate": 0.0}, "conditions": {"full": FULL, "dark": DARK}}
        cls.sky = Process("night_sky", sky, "sun_position_node")
        cls.sky.__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.sky.__exit__()

    def test_the_moon_casts_shadows_by_its_frame(self):
        reader = Reader(["full", "dark"], node="/nightly")
        with RenderNode("nightly", parameters(conditions=["full", "dark"], night={"enabled": True},
                                              subscribers={"images": 1})):
            captures = {c: reader.wait("/%s/camera/capture" % c, 1)[0] for c in ("full", "dark")}
            rospy.wait_for_service("/nightly/render_view", TIMEOUT_S)
            view = rospy.ServiceProxy("/nightly/render_view", RenderView)
            images = {c: view(pose=looking_down(), condition=c).image for c in ("full", "dark")}
        reader.close()
        x, y, z = direction_of("full/moon")
        self.assertAlmostEqual(captures["full"].moon_elevation, math.asin(z), 6)
        self.assertTrue(x > 0.3 and 0.2 < z < 0.7, "the moon is in the east, neither low nor high")
        self.assertGreater(captures["full"].moon_illuminated_fraction, 0.98)
        self.assertLess(captures["dark"].moon_illuminated_fraction, 0.02)

        # The box's upper edge at x = 12, y = 0, z = 2 throws the end of the shadow; its penumbra is 0.05 m wide, a pixel 0.15.
        end_x, end_y = 12.0 - 2.0 * x / z, -2.0 * y / z
        dark, lit = (level_on_ground(images["full"], end_x + side, end_y) for side in (0.3, -0.3))
        self.assertGreater(lit, 20)
        # Of full moon and sky at this height the moon alone makes most: at least two stops, which is 1.8 times the level.
        self.assertGreater(lit, 1.5 * dark)
        # Without a moon there is no shadow to speak of, but light to see by.
        dark, lit = (level_on_ground(images["dark"], end_x + side, end_y) for side in (0.3, -0.3))
        self.assertGreater(dark, 5)
        self.assertAlmostEqual(dark, lit, delta=0.2 * lit)
        # Published: 0.27 lx of a full moon overhead, about 0.001 lx without one.
        self.assertTrue(0.02 < captures["full"].scene_illuminance < 0.27, captures["full"])
        self.assertTrue(0.0003 < captures["dark"].scene_illuminance < 0.003, captures["dark"])

    def test_waits_for_a_late_moon(self):
        sky = Sky("/late/")
        sky.send_sun()
        sky.send_celestial()
        reader = Reader(["late"], node="/patient")
        with RenderNode("patient", parameters(conditions=["late"], night={"enabled": True},
                                              subscribers={"images": 1})) as node:
            self.assertIn("a moon on /late/moon", node.line_with("Waiting for"))
            self.assertEqual(reader.of("/late/camera/image_raw"), [])
            sky.send_moon()
            reader.wait("/late/camera/image_raw", 1)
        reader.close()

    def test_never_mixes_moments(self):
        sky = Sky("/mixed/")
        sky.send_sun(stamp=1.0)
        sky.send_celestial(stamp=1.0)
        sky.send_moon(stamp=2.0)
        reader = Reader(["mixed"], node="/unmixed")
        with RenderNode("unmixed", parameters(conditions=["mixed"], night={"enabled": True},
                                              subscribers={"images": 1})) as node:
            line = node.line_with("Waiting for sun")
            for part in ("one stamp", "/mixed/sun", "/mixed/moon", "/mixed/celestial"):
                self.assertIn(part, line)
            sky.send_moon(stamp=1.0)
            reader.wait("/mixed/camera/image_raw", 1)
        reader.close()

    def test_refuses_a_moon_that_cannot_be(self):
        sky = Sky("/odd/")
        sky.send_sun()
        sky.send_celestial()
        with RenderNode("refusing", parameters(conditions=["odd"], night={"enabled": True})) as node:
            sky.send_moon(distance=1.0)
            line = node.line_with("Refused a moon on /odd/moon")
            self.assertIn("distance is 1, but must be from 340000000 to 420000000 m", line)
            self.assertIn("a moon on /odd/moon", node.line_with("Waiting for"))

    def test_without_a_night_the_sun_is_enough(self):
        sun = Sun("/sunny/sun")
        reader = Reader(["sunny"], node="/daily")
        with RenderNode("daily", parameters(conditions=["sunny"], night={"enabled": False}, subscribers={"images": 1})):
            capture = reader.wait("/sunny/camera/capture", 1)[0]
        self.assertTrue(math.isnan(capture.moon_elevation))
        reader.close()
        sun.publisher.unregister()


if __name__ == "__main__":
    rospy.init_node("render_night")
    rostest.rosrun("sunlit", "render_night", RenderNight)
