#!/usr/bin/python3
"""A camera of a calibration file is told of as it stands there, and shows as much as it says."""
import importlib
import importlib.util
import math
import os
import struct
import tempfile
import unittest

import rospy
import rostest
import yaml
from geometry_msgs.msg import Pose
from rendering import BOX_FACE_M, PACKAGE, TIMEOUT_S, Reader, RefusalTest, RenderNode, Sun, parameters
from sunlit.srv import RenderView

CAMERAS = os.path.join(PACKAGE, "test", "support", "cameras")


def file(name):
    return os.path.join(CAMERAS, name + ".yaml")


def camera_of(calibration, **changes):
    """The parameters of a node with this camera and no other size."""
    tree = parameters(**changes)
    tree["camera"] = {"calibration": calibration, "supersampling": 1}
    return tree


def read_as_yaml(path):
    with open(path) as opened:
        return yaml.safe_load(opened)


class RenderLens(RefusalTest):

    def assert_as_read(self, info, read):
        self.assertEqual((info.width, info.height), (read["image_width"], read["image_height"]))
        self.assertEqual(info.distortion_model, read["distortion_model"])
        for numbers, key in ((info.D, "distortion_coefficients"), (info.K, "camera_matrix"), (info.R, "rectification_matrix"),
                             (info.P, "projection_matrix")):
            self.assertEqual(list(numbers), [float(number) for number in read[key]["data"]], key)

    def run_with(self, name, calibration=None):
        """The depth of a node whose CameraInfo is everywhere as the file has it."""
        calibration = calibration or file(name)
        sun = Sun("/a/sun")
        reader = Reader(["a"], node="/" + name)
        tree = camera_of(calibration, conditions=["a"], path={"count": 1}, subscribers={"images": 1, "truth": 1, "others": 1})
        with RenderNode(name, tree):
            image, = reader.wait("/a/camera/image_raw", 1)
            info, = reader.wait("/a/camera/camera_info", 1)
            depth, = reader.wait("/camera/depth/image_raw", 1)
            of_depth, = reader.wait("/camera/depth/camera_info", 1)
            rospy.wait_for_service("/" + name + "/render_view", TIMEOUT_S)
            pose = Pose()
            pose.position.z = 1.0
            pose.orientation.w = 1.0
            view = rospy.ServiceProxy("/" + name + "/render_view", RenderView)(pose=pose, condition="a")
        reader.close()
        sun.publisher.unregister()
        self.assertTrue(view.success, view.message)
        for told in (info, of_depth, view.camera_info):
            self.assert_as_read(told, read_as_yaml(calibration))
        for picture in (image, depth, view.image):
            self.assertEqual((picture.width, picture.height), (info.width, info.height))
        return depth

    def depth_at(self, depth, x, y):
        return struct.unpack_from("<f", bytes(depth.data), y * depth.step + 4 * x)[0]

    def test_euroc_is_told_of_as_read(self):
        depth = self.run_with("euroc")
        self.assertAlmostEqual(self.depth_at(depth, 367, 248), BOX_FACE_M, delta=1e-3)

    def test_a_fisheye_is_told_of_as_read_and_sees_the_ground_beneath_itself(self):
        depth = self.run_with("tum_vi")
        # Along the axis distance is depth; 1 m above level ground the bottom of the picture looks 77 degrees down.
        self.assertAlmostEqual(self.depth_at(depth, 255, 257), BOX_FACE_M, delta=1e-2)
        self.assertAlmostEqual(self.depth_at(depth, 255, 511), 1.0 / math.sin(math.radians(76.2)), delta=0.02)

    def test_what_others_publish_is_told_of_as_read(self):
        for name in ("kitti", "d435i", "rational", "omni"):
            with self.subTest(name):
                read = read_as_yaml(file(name))
                depth = self.run_with(name)
                # Where the axis is seen depth is that of the wall ahead, whatever bends around it.
                x, y = round(read["camera_matrix"]["data"][2]), round(read["camera_matrix"]["data"][5])
                self.assertAlmostEqual(self.depth_at(depth, x, y), BOX_FACE_M, delta=0.02)

    def test_eight_coefficients_are_told_of_where_the_file_says_that_they_are_five(self):
        # As camera_calibration wrote them.
        with open(file("rational")) as opened:
            text = opened.read()
        self.assertIn("cols: 8", text)
        with tempfile.TemporaryDirectory() as folder:
            trap = os.path.join(folder, "camera.yaml")
            with open(trap, "w") as out:
                out.write(text.replace("cols: 8", "cols: 5"))
            self.run_with("trap", trap)

    @unittest.skipUnless(importlib.util.find_spec("camera_calibration_parsers"),
                         "camera_calibration_parsers is not installed: in Debian it is python3-camera-calibration-parsers")
    def test_camera_info_manager_reads_the_same(self):
        # What it reads files by.
        parsers = importlib.import_module("camera_calibration_parsers")
        names = sorted(name[:-len(".yaml")] for name in os.listdir(CAMERAS))
        self.assertGreaterEqual(len(names), 7)
        for name in names:
            with self.subTest(name):
                read = read_as_yaml(file(name))
                called, info = parsers.readCalibration(file(name))
                self.assertEqual(called, read["camera_name"])
                self.assert_as_read(info, read)

    def test_what_contradicts_the_file_is_refused(self):
        for key, value, read in (("width", 640, "752"), ("height", 512, "480"), ("horizontal_fov", 60.0, "93.1")):
            tree = camera_of(file("euroc"))
            tree["camera"][key] = value
            self.assert_refused(tree, "/refused/camera/" + key, "%g" % value, read, "euroc.yaml")
        tree = camera_of(file("euroc"))
        tree["camera"]["width"] = 752
        tree["camera"]["calibration"] = "/nowhere/camera.yaml"
        self.assert_refused(tree, "/nowhere/camera.yaml")


if __name__ == "__main__":
    rospy.init_node("render_lens")
    rostest.rosrun("sunlit", "render_lens", RenderLens)
