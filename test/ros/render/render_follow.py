#!/usr/bin/python3
"""A camera that follows a TF frame, and the optical frames that it shares TF with."""
import copy
import math
import struct
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from rendering import BOX_FACE_M, Reader, RenderNode, Sky, Sun, Transforms, following

OPTICAL = "camera_optical_frame"


def robot_at(x, stamp):
    transform = TransformStamped()
    transform.header.frame_id, transform.child_frame_id, transform.header.stamp = "map", "robot", stamp
    transform.transform.translation.x, transform.transform.translation.z = x, 1.0
    transform.transform.rotation.w = 1.0
    return transform


def fixed(parent, child):
    """In the same place, at the moment of the first picture."""
    transform = robot_at(0.0, rospy.Time(2000))
    transform.header.frame_id, transform.child_frame_id, transform.transform.translation.z = parent, child, 0.0
    return transform


def optical_below(parent):
    """z forward, x right, y down."""
    transform = fixed(parent, OPTICAL)
    q = transform.transform.rotation
    q.x, q.y, q.z, q.w = -0.5, 0.5, -0.5, 0.5
    return transform


class RenderFollow(unittest.TestCase):

    def setUp(self):
        self.sun = Sun("/a/sun")

    def test_follows_a_frame_with_its_stamps(self):
        sender = Transforms()
        tree = following(conditions=["a"], frame_rate=1000.0, camera={"follow_frame": "robot"}, subscribers={"images": 1})
        stamps = [rospy.Time(2000 + second) for second in range(5)]
        with RenderNode("follower", tree) as node:
            node.line_with("Waiting for subscribers of /a/camera/image_raw")
            reader = Reader(["a"], node="/follower")
            node.line_with("Waiting for the TF frame robot")
            sender.wait_for_readers(2)  # the node, and the reader here
            sender.send(robot_at(math.inf, rospy.Time(1999)))  # TF takes it
            self.assertIn("from map to robot on TF is not finite, or farther than 10000 km away", node.line_with("finite"))
            sender.send(robot_at(1e20, rospy.Time(1999, 5)))  # too far for rays
            for index, stamp in enumerate(stamps):
                sender.send(robot_at(2.0 * index, stamp))
                reader.wait("/camera/depth/image_raw", index + 1)
            self.assertEqual([i.header.stamp for i in reader.wait("/a/camera/image_raw", 5)], stamps)
            for index, depth in enumerate(reader.of("/camera/depth/image_raw")):
                centre = struct.unpack_from("<f", depth.data, 36 * depth.step + 48 * 4)[0]
                # Single precision and the interpolation of a depth buffer.
                self.assertAlmostEqual(centre, BOX_FACE_M - 2.0 * index, delta=1e-3)
            static, = reader.wait("/tf_static", 1)[0].transforms
            self.assertEqual((static.header.frame_id, static.child_frame_id), ("robot", "camera_optical_frame"))
            self.assertEqual({t.child_frame_id for m in reader.of("/tf") for t in m.transforms}, {"robot"})
            # Under a sun that moves there is one picture for each of its places, whatever frame_rate asks for.
            sky = Sky("/a/")
            for index in range(12):  # the first may be under the sun before
                sky.send_sun(2010.0 + index, rate=1.0)
                sender.send(robot_at(0.0, rospy.Time.from_sec(2010.5 + index)))
                sky.send_sun(2011.0 + index, rate=1.0)
                reader.wait("/a/camera/image_raw", 6 + index)
            self.assertIn("a picture every 0.001 s, but the sun comes every 1.000 s", node.line_with("frame_rate asks"))
            for publisher in sky.publishers:
                publisher.unregister()
        reader.close()
        sender.close()

    def test_leaves_the_optical_frame_to_the_robot_that_has_it(self):
        tree = following(conditions=["a"], frame_rate=1000.0, camera={"follow_frame": "robot", "baseline": 0.5})
        for turned, warned in ((True, False), (False, True)):
            reader, sender = Reader(["a"], node="/follower"), Transforms()
            optical = robot_at(0.0, rospy.Time(2000))
            optical.header.frame_id, optical.child_frame_id, optical.transform.translation.z = "robot", "camera_optical_frame", 0.0
            right = copy.deepcopy(optical)
            right.child_frame_id, right.transform.translation.y = "camera_right_optical_frame", -0.5
            if turned:  # z forward, x right, y down
                for q in (optical.transform.rotation, right.transform.rotation):
                    q.x, q.y, q.z, q.w = -0.5, 0.5, -0.5, 0.5
            with RenderNode("follower", tree) as node:
                node.line_with("Waiting for the TF frame robot")
                sender.wait_for_readers(2)
                sender.send(robot_at(0.0, rospy.Time(2000)), optical, right)
                reader.wait("/a/camera/image_raw", 1)
                node.process.send_signal(2)
                status, said = node.end()
            self.assertEqual(status, 0, said)
            self.assertTrue(any("TF has the frame camera_optical_frame below robot: it is left" in line for line in said), said)
            self.assertEqual(any("is not where pictures are taken from, which is robot" in line for line in said), warned, said)
            of_right = [line for line in said if "WARN" in line and "camera_right_optical_frame" in line]
            self.assertEqual(len(of_right), warned, said)
            for line in of_right:
                self.assertIn("which is 0.5 m to the right of robot,", line)
                self.assertIn("another name as frames/right_optical", line)
            self.assertEqual(reader.of("/tf_static"), [])
            reader.close()
            sender.close()

    def follow(self, *first):
        """A node, which has been sent these and the robot at its first place; its reader, and its sender of TF."""
        reader, sender = Reader(["a"], node="/follower"), Transforms()
        self.addCleanup(sender.close)
        self.addCleanup(reader.close)
        node = RenderNode("follower", following(conditions=["a"], frame_rate=1000.0, camera={"follow_frame": "robot"}))
        node.__enter__()
        self.addCleanup(node.__exit__)
        node.line_with("Waiting for the TF frame robot")
        sender.wait_for_readers(2)
        self.sent_s = time.monotonic()
        sender.send(robot_at(0.0, rospy.Time(2000)), *first)
        reader.wait("/a/camera/image_raw", 1)
        return node, reader, sender

    def warnings(self, node, reader, sender):
        """Of the optical frame, once the node has taken two more pictures, until it ends. It looks before it takes one."""
        taken = len(reader.of("/a/camera/image_raw"))
        for picture in (1, 2):
            sender.send(robot_at(0.0, rospy.Time(3000 + picture)))
            reader.wait("/a/camera/image_raw", taken + picture)
        node.process.send_signal(2)
        status, said = node.end()
        self.assertEqual(status, 0, said)
        return [line for line in said if "WARN" in line and OPTICAL in line]

    def test_an_optical_frame_that_others_send_late_is_told_of_once(self):
        for late, parent in ((optical_below("mast"), "mast"), (fixed("robot", OPTICAL), "robot")):
            node, reader, sender = self.follow()
            reader.wait("/tf_static", 1)
            for _ in range(3):
                sender.send(late)
            warning, = self.warnings(node, reader, sender)
            self.assertIn("Others send the frame %s too, below %s on TF, and this node, which had heard of none, below robot" %
                          (OPTICAL, parent), warning)
            self.assertIn("publish_tf: false", warning)
            self.doCleanups()
        node, reader, sender = self.follow()
        reader.wait("/tf_static", 1)
        sender.send(optical_below("robot"))  # where we have it
        self.assertEqual(self.warnings(node, reader, sender), [])

    def test_an_optical_frame_on_a_chain_that_is_heard_in_parts_is_waited_for(self):
        for _ in range(5):
            node, reader, sender = self.follow(optical_below("mast"))
            node.line_with("TF has the frame %s below mast: it is left" % OPTICAL)
            time.sleep(0.1)  # in which it takes a picture, and looks
            sender.send(fixed("robot", "mast"))
            soon = time.monotonic() - self.sent_s < 0.8  # well within its patience; a busy machine may need another go
            warnings = self.warnings(node, reader, sender)
            if soon:
                break
            self.doCleanups()
        self.assertTrue(soon, "this machine takes most of a second for a picture and two messages")
        self.assertEqual(warnings, [])
        self.assertEqual(reader.of("/tf_static"), [])

    def test_an_optical_frame_that_is_not_connected_is_told_of(self):
        node, reader, sender = self.follow(optical_below("mast"))
        node.line_with("TF has the frame %s below mast: it is left" % OPTICAL)
        time.sleep(1.5)  # more than the patience with it
        warning, = self.warnings(node, reader, sender)
        self.assertIn("The frame %s, on TF below mast, is not connected with robot" % OPTICAL, warning)
        self.assertIn("another name as frames/optical", warning)


if __name__ == "__main__":
    rospy.init_node("render_follow")
    rostest.rosrun("sunlit", "render_follow", RenderFollow)
