#!/usr/bin/python3
"""All streams of a run: complete, in order, with one stamp a pose, and consistent with each other."""
import struct
import unittest

import rospy
import rostest
from rendering import BOX_FACE_M, Reader, RenderNode, Sun, TIMEOUT_S, parameters
from sunlit.srv import RenderView

POSES = 20       # 10 m every 0.5 m; the end point begins no segment
SPACING_M = 0.5
MAX_AHEAD = 4
CONDITIONS = ("morning", "noon")
HEIGHT_M = 1.0


def depth_at(image, u, v):
    return struct.unpack_from("<f", image.data, v * image.step + 4 * u)[0]


class RenderStreams(unittest.TestCase):
    """A reader that takes its time: it lets the node go on only when it has checked how far the node went."""

    @classmethod
    def setUpClass(cls):
        cls.suns = [Sun("/morning/sun", east=0.8, north=0.0, up=0.6), Sun("/noon/sun")]
        cls.reader = Reader(CONDITIONS, node="/render")
        tree = parameters(conditions=list(CONDITIONS), wait_for=["/reader/progress"], max_ahead=MAX_AHEAD,
                          subscribers={"images": 1, "poses": 1, "others": 1}, exit_when_done=True)
        cls.published_when_blocked = []
        with RenderNode("render", tree) as node:
            rospy.wait_for_service("/render/render_view", TIMEOUT_S)
            view = rospy.ServiceProxy("/render/render_view", RenderView)
            for done in range(POSES + 1):
                cls.reader.done(done)
                expected = min(done + MAX_AHEAD, POSES)
                cls.reader.wait_progress("/render/progress", expected)
                if done + MAX_AHEAD >= POSES:
                    continue
                # Two answers: between them the node had its chance to render one more.
                for _ in range(2):
                    view(condition="noon")
                cls.published_when_blocked.append((cls.reader.of("/render/progress")[-1].data, expected))
            cls.status, cls.said = node.end()
        for topic in cls.reader.messages:
            if "/camera/" in topic or topic == "/tf":
                cls.reader.wait(topic, POSES)

    @classmethod
    def tearDownClass(cls):
        cls.reader.close()

    def test_never_further_ahead_than_allowed(self):
        for published, expected in self.published_when_blocked:
            self.assertEqual(published, expected)
        self.assertEqual(len(self.published_when_blocked), POSES - MAX_AHEAD)

    def test_ends_with_status_0(self):
        self.assertEqual(self.status, 0, self.said)
        self.assertTrue(any("100 %" in line for line in self.said), self.said)

    def test_every_stream_is_whole_and_in_order(self):
        expected = [rospy.Time(1000 + pose // 8, (pose % 8) * 125000000) for pose in range(POSES)]
        for topic, messages in self.reader.messages.items():
            if "/camera/" in topic:
                self.assertEqual([message.header.stamp for message in messages], expected, topic)
        tf = [message.transforms[0].header.stamp for message in self.reader.of("/tf")]
        self.assertEqual(tf, expected)

    def test_captures_number_the_poses(self):
        for condition in CONDITIONS:
            captures = self.reader.of("/%s/camera/capture" % condition)
            self.assertEqual([capture.pose_index for capture in captures], list(range(POSES)))
        morning = self.reader.of("/morning/camera/capture")[0]
        self.assertAlmostEqual(morning.sun_azimuth, 1.5707963, 6)   # east
        self.assertAlmostEqual(morning.sun_elevation, 0.6435011, 6)  # asin 0.6
        # Clear sky, sun at 37 degrees: tens of thousands of lux, whatever the turbidity.
        self.assertTrue(3e4 < morning.scene_illuminance < 1e5, morning.scene_illuminance)

    def test_images_and_camera_info_belong_together(self):
        for condition in CONDITIONS:
            info = self.reader.of("/%s/camera/camera_info" % condition)[0]
            image = self.reader.of("/%s/camera/image_raw" % condition)[0]
            self.assertEqual((image.width, image.height, image.encoding, image.step), (96, 72, "rgb8", 288))
            self.assertEqual((info.width, info.height), (96, 72))
            self.assertEqual(image.header.frame_id, "camera_optical_frame")
            self.assertEqual(info.header.frame_id, "camera_optical_frame")
            focal_px = 48 * 3 ** 0.5  # half the width over the tangent of half of 60 degrees
            self.assertAlmostEqual(info.K[0], focal_px, 9)
            self.assertEqual((info.K[2], info.K[5]), (47.5, 35.5))
            self.assertEqual(info.P[0], info.K[0])

    def test_two_suns_give_two_pictures(self):
        morning = self.reader.of("/morning/camera/image_raw")
        noon = self.reader.of("/noon/camera/image_raw")
        for a, b in zip(morning, noon):
            self.assertNotEqual(a.data, b.data)

    def test_depth_agrees_with_pose(self):
        focal_px = 48 * 3 ** 0.5
        for pose, depth in zip(self.reader.of("/camera/pose"), self.reader.of("/camera/depth/image_raw")):
            self.assertEqual((depth.encoding, depth.width, depth.height), ("32FC1", 96, 72))
            position = pose.pose.position
            # 1e-4 of the depth: single precision and the interpolation of a depth buffer.
            face_m = BOX_FACE_M - position.x
            self.assertAlmostEqual(depth_at(depth, 48, 36), face_m, delta=1e-4 * face_m)
            ground_m = HEIGHT_M * focal_px / (71 - 35.5)
            self.assertAlmostEqual(depth_at(depth, 10, 71), ground_m, delta=1e-4 * ground_m)

    def test_poses_tf_and_path_agree(self):
        path = self.reader.of("/path")[0]
        self.assertEqual(path.header.frame_id, "map")
        self.assertEqual(len(path.poses), POSES)
        for index, (pose, tf) in enumerate(zip(self.reader.of("/camera/pose"), self.reader.of("/tf"))):
            self.assertEqual(pose.header.frame_id, "map")
            self.assertEqual(pose.pose, path.poses[index].pose)
            self.assertEqual(pose.header.stamp, path.poses[index].header.stamp)
            self.assertAlmostEqual(pose.pose.position.x, SPACING_M * index, 9)
            self.assertAlmostEqual(pose.pose.position.z, HEIGHT_M, 9)
            link, = tf.transforms
            self.assertEqual((link.header.frame_id, link.child_frame_id), ("map", "camera_link"))
            self.assertEqual(link.transform.translation.x, pose.pose.position.x)
            self.assertEqual(link.transform.rotation, pose.pose.orientation)

    def test_the_optical_frame_is_static(self):
        message, = self.reader.of("/tf_static")
        optical, = message.transforms
        self.assertEqual((optical.header.frame_id, optical.child_frame_id), ("camera_link", "camera_optical_frame"))
        # z forward, x right, y down.
        q = optical.transform.rotation
        self.assertAlmostEqual(abs(q.x * 0.5 - q.y * 0.5 + q.z * 0.5 - q.w * 0.5), 1.0, 9)

    def test_depth_has_the_camera_of_the_pictures(self):
        infos = self.reader.of("/camera/depth/camera_info")
        self.assertEqual(infos, self.reader.of("/noon/camera/camera_info"))
        for info, depth in zip(infos, self.reader.of("/camera/depth/image_raw")):
            self.assertEqual((info.header.stamp, info.header.frame_id, info.width, info.height),
                             (depth.header.stamp, depth.header.frame_id, depth.width, depth.height))


if __name__ == "__main__":
    rospy.init_node("render_streams")
    rostest.rosrun("sunlit", "render_streams", RenderStreams)
