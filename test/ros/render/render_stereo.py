#!/usr/bin/python3
"""A stereo camera: the right one beside the left in every topic and on TF, and stereo_image_proc measures depth by them."""
import os
import time
import unittest

import numpy as np
import roslib.packages
import rospkg
import rospy
import rostest
from image_geometry import StereoCameraModel
from pixels import right_edge
from rendering import BOX_FACE_M, PACKAGE, Process, Reader, RefusalTest, RenderNode, Sun, parameters
from sensor_msgs.msg import CameraInfo, CompressedImage, Image, PointCloud2

CAMERAS = os.path.join(PACKAGE, "test", "support", "cameras")
LEFT = os.path.join(CAMERAS, "euroc.yaml")
RIGHT = os.path.join(CAMERAS, "euroc_right.yaml")
BASELINE_M = 0.2
POSES = 60
PATIENCE_S = 0.5  # for points of a pose whose pictures may not have been heard
PICTURE_OF = {"left/image_raw": Image, "left/camera_info": CameraInfo, "right/image_raw": Image, "right/camera_info": CameraInfo}


def has_stereo_image_proc():
    """With the descriptions by which its nodelets are found, which Debian has in packages of their own."""
    try:
        rospkg.RosPack().get_path("nodelet")
        return bool(roslib.packages.find_node("stereo_image_proc", "stereo_image_proc"))
    except rospkg.ResourceNotFound:
        return False


def stereo(**changes):
    """An ideal pair in the built-in world, whose ground and trees have something to match."""
    tree = parameters(conditions=["a"], subscribers={"images": 1, "others": 1, "left": 1, "right": 1},
                      camera={"width": 320, "height": 240, "supersampling": 2, "baseline": BASELINE_M}, **changes)
    tree.update(world="race_track", path={"first": 40, "count": POSES}, transport={"enabled": False})
    return tree


class StereoReader(Reader):
    def __init__(self, name, topics=None, **more):
        super().__init__(["a"], node="/" + name, **more)
        for topic, kind in (topics or PICTURE_OF).items():
            self._subscribe("/a/camera/" + topic, kind)

    def of_pair(self, topic, count=1):
        return self.wait("/a/camera/" + topic, count)

    def one_of_each(self, *topics):
        """The message of each topic, and there is no second one."""
        for topic in topics:
            message, = self.of_pair(topic)
            yield message


class RenderStereo(RefusalTest):

    def setUp(self):
        self.sun = Sun("/a/sun")

    def tearDown(self):
        self.sun.publisher.unregister()

    def test_a_calibrated_pair_is_told_of_as_read(self):
        reader = StereoReader("pair")
        tree = parameters(conditions=["a"], path={"count": 2}, exposure={"mode": "auto"},
                          wait_for=["/reader/progress"], max_ahead=1,
                          subscribers={"images": 1, "truth": 1, "others": 1, "left": 1, "right": 1})
        tree["camera"] = {"calibration": LEFT, "right": {"calibration": RIGHT}, "supersampling": 1}
        with RenderNode("pair", tree):
            left, right, image, info, left_info, usual_info = reader.one_of_each(
                "left/image_raw", "right/image_raw", "image_raw", "right/camera_info", "left/camera_info", "camera_info")
            static, = reader.wait("/tf_static", 1)
        reader.close()
        self.assertEqual((left.data, left.header.stamp, left_info), (image.data, image.header.stamp, usual_info))
        self.assertEqual({message.header.stamp for message in (left, right, info)}, {image.header.stamp})
        # The frame that P of the right one speaks of; where a pair has two, image_geometry ends.
        self.assertEqual({message.header.frame_id for message in (left, right, info, left_info)}, {"camera_optical_frame"})
        self.assertEqual((info.width, info.height), (right.width, right.height))
        self.assertEqual((info.K[0], info.K[2], info.P[3]), (457.587, 379.999, -47.90639384423901))
        self.assertEqual(list(info.D), [-0.28368365, 0.07451284, -0.00010473, -3.555907e-05, 0.0])
        self.assertNotEqual(left.data, right.data)
        self.assert_measures(left_info, info, 47.90639384423901 / 435.2046959714599, 9.581)
        frames = {transform.child_frame_id: transform for transform in static.transforms}
        self.assertEqual(set(frames), {"camera_optical_frame", "camera_right_optical_frame"})
        place = frames["camera_right_optical_frame"]
        self.assertEqual(place.header.frame_id, "camera_link")
        # 0.1101 m to the right, which is -y, give or take the two degrees by which the pair is turned.
        self.assertAlmostEqual(place.transform.translation.y, -0.1101, delta=1e-4)
        self.assertAlmostEqual(place.transform.translation.x, 0.0, delta=2e-3)

    def assert_measures(self, left_info, right_info, baseline_m, disparity_at_5_m):
        """As all of image_pipeline reads a pair; z by a disparity, and a disparity by z."""
        model = StereoCameraModel()
        model.fromCameraInfo(left_info, right_info)
        self.assertAlmostEqual(-model.right.P[0, 3] / model.right.P[0, 0], baseline_m, delta=1e-9)
        self.assertAlmostEqual(model.getDisparity(5.0), disparity_at_5_m, delta=0.005)
        self.assertAlmostEqual(model.getZ(disparity_at_5_m), 5.0, delta=0.005)
        return model

    def test_image_geometry_has_a_known_point_where_both_pictures_show_it(self):
        reader = StereoReader("known")
        tree = parameters(conditions=["a"], path={"count": 1}, subscribers={"images": 1, "truth": 1, "others": 1, "left": 1, "right": 1})
        tree["camera"].update(baseline=1.0, supersampling=4)
        with RenderNode("known", tree):
            left, right, left_info, right_info = reader.one_of_each(
                "left/image_raw", "right/image_raw", "left/camera_info", "right/camera_info")
            pose, = reader.wait("/camera/pose", 1)
        reader.close()
        focal_px = 48 * 3 ** 0.5  # 96 px across 60 degrees
        model = self.assert_measures(left_info, right_info, 1.0, focal_px / 5.0)
        # The upright edge of the box that is nearest on its right: 2 m beside its middle, which is ahead.
        place = pose.pose.position
        away_m = BOX_FACE_M - place.x
        expected = model.project3dToPixel((place.y + 2.0, 0.0, away_m))
        self.assertAlmostEqual(expected[0][0] - expected[1][0], focal_px / away_m, delta=1e-9)
        found = [np.mean([right_edge(image, row) for row in range(31, 36)]) for image in (left, right)]
        print("edge at %.3f and %.3f px, found at %.3f and %.3f px" % (expected[0][0], expected[1][0], *found))
        # Four samples a pixel know it to an eighth; levels and the sky's gradient are worth a few hundredths.
        for (x, _), measured in zip(expected, found):
            self.assertAlmostEqual(measured, x, delta=0.2)

    def test_what_is_no_pair_is_refused(self):
        def refused(camera, *parts):
            tree = parameters()
            tree["camera"] = camera
            self.assert_refused(tree, *parts)
        refused({"right": {"calibration": RIGHT}}, "/refused/camera/right/calibration", "/refused/camera/calibration is not")
        refused({"calibration": LEFT, "right": {"calibration": RIGHT}, "baseline": 0.1}, "/refused/camera/baseline", "both given")
        refused({"calibration": LEFT, "right": {"calibration": LEFT}}, "euroc.yaml: the baseline", "is 0, but must be above 0")
        refused({"calibration": RIGHT, "right": {"calibration": LEFT}}, "is it the right one?")
        refused({"baseline": -0.1}, "/refused/camera/baseline is -0.1, but must be from 0 to 100 m")

    def test_no_reader_of_either_side_no_pictures(self):
        reader = Reader(["a"], node="/lonely")
        with RenderNode("lonely", stereo()) as node:
            node.line_with("subscribers of /a/camera/left/image_raw")
            left = [rospy.Subscriber("/a/camera/left/" + topic, kind) for topic, kind in (("image_raw", Image), ("camera_info", CameraInfo))]
            node.line_with("subscribers of /a/camera/right/image_raw")
        self.assertEqual(reader.of("/a/camera/image_raw"), [])
        for subscriber in left:
            subscriber.unregister()
        reader.close()

    def test_packed_pairs_are_packed_on_both_sides(self):
        packed = {side + "/image_raw/compressed": CompressedImage for side in ("left", "right")}
        reader = StereoReader("packed", {**packed, "left/camera_info": CameraInfo, "right/camera_info": CameraInfo}, compressed=True)
        with RenderNode("packed", stereo(compressed=True)):
            left, right, usual = reader.one_of_each(
                "left/image_raw/compressed", "right/image_raw/compressed", "image_raw/compressed")
        reader.close()
        self.assertEqual(left.data, usual.data)
        self.assertNotEqual(left.data, right.data)
        self.assertEqual(left.header.stamp, right.header.stamp)

    def points_at_a_pose(self, reader):
        """The points of a pose, from when stereo_image_proc hears both cameras on, and the renderer's depth of it."""
        for pose in range(POSES):
            reader.wait_progress("/measured/progress", pose + 1)
            deadline = time.monotonic() + PATIENCE_S
            while time.monotonic() < deadline and not reader.of("/a/camera/points2"):
                time.sleep(0.01)
            if reader.of("/a/camera/points2"):
                points = reader.of("/a/camera/points2")[0]
                depth, = [image for image in reader.of("/camera/depth/image_raw") if image.header.stamp == points.header.stamp]
                return points, depth
            reader.done(pose + 1)
        raise AssertionError("stereo_image_proc never answered")

    @unittest.skipUnless(has_stereo_image_proc(), "stereo_image_proc is not installed: in Debian it is ros-stereo-image-proc, "
                                                  "libstereo-image-proc-dev and libnodeletlib-tools")
    def test_stereo_image_proc_measures_the_depth(self):
        reader = StereoReader("measured", {"points2": PointCloud2})
        tree = stereo(wait_for=["/reader/progress"], max_ahead=1)
        with Process("stereo_image_proc", {}, "stereo_image_proc", "a/camera", "stereo_image_proc"), RenderNode("measured", tree):
            points, depth = self.points_at_a_pose(reader)
        reader.close()
        self.assertEqual(points.header.frame_id, "camera_optical_frame")
        self.assertEqual((points.width, points.height), (depth.width, depth.height))
        z, = [field.offset for field in points.fields if field.name == "z"]
        measured = np.frombuffer(points.data, np.uint8).reshape(points.height, points.width, points.point_step)[..., z:z + 4]
        measured = np.ascontiguousarray(measured).view("<f4")[..., 0]
        true = np.frombuffer(depth.data, "<f4").reshape(depth.height, depth.width)
        both = np.isfinite(measured) & np.isfinite(true)
        self.assertGreater(both.mean(), 0.1)  # the sky and the plain ground far away have nothing to match
        focal_px = 160 * 3 ** 0.5
        off = focal_px * BASELINE_M * (1 / measured[both] - 1 / true[both])
        print("stereo_image_proc: %.0f %% of the pixels, disparity off by %.3f px in the median, half within %.3f px" %
              (100 * both.mean(), np.median(off), np.median(np.abs(off))))
        self.assertLess(abs(np.median(off)), 0.1)
        self.assertLess(np.median(np.abs(off)), 0.2)


if __name__ == "__main__":
    rospy.init_node("render_stereo")
    rostest.rosrun("sunlit", "render_stereo", RenderStereo)
