#!/usr/bin/python3
"""A robot in the picture: its shadow lies where the sun throws it, moves with TF, and errors of its file are named."""
import math
import os
import shutil
import tempfile
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import Point, Pose, Quaternion, TransformStamped
from rendering import SUPPORT, TIMEOUT_S, Reader, RefusalTest, RenderNode, Sun, Transforms, following, parameters, service
from std_srvs.srv import Trigger
from sunlit.srv import RenderView

POLE = os.path.join(SUPPORT, "pole.urdf")
POLE_HEIGHT_M, POLE_BEHIND_M = 3.0, 0.5
CAMERA_HEIGHT_M = 1.0
FOCAL_PX = 48 * 3 ** 0.5  # half the width over the tangent of half of 60 degrees
# Behind the camera, which looks along x: the shadow of a height h reaches 4/3 h forward.
SUN = dict(east=-0.8, north=0.0, up=0.6)
SHADOW_END_M = POLE_HEIGHT_M * 4.0 / 3.0 - POLE_BEHIND_M
FIXED = {"mode": "fixed", "ev100": 13.5}


def transform(parent, child, stamp, x=0.0, y=0.0, z=0.0):
    message = TransformStamped()
    message.header.frame_id, message.child_frame_id, message.header.stamp = parent, child, stamp
    message.transform.translation.x, message.transform.translation.y, message.transform.translation.z = x, y, z
    message.transform.rotation.w = 1.0
    return message


def brightness(image, forward, left):
    """Of the ground so many metres before and beside the camera."""
    column = round(47.5 - FOCAL_PX * left / forward)
    row = round(35.5 + FOCAL_PX * CAMERA_HEIGHT_M / forward)
    return sum(image.data[row * image.step + 3 * column:][:3])


class RenderRobot(RefusalTest):

    def setUp(self):
        self.suns = [Sun("/a/sun", **SUN)]
        self.folder = tempfile.mkdtemp()

    def tearDown(self):
        shutil.rmtree(self.folder)

    def tree(self, **changes):
        return parameters(**dict(dict(conditions=["a"], exposure=FIXED, subscribers={"images": 1}, exit_when_done=True),
                                 **changes))

    def following(self, **changes):
        return following(conditions=["a"], exposure=FIXED, subscribers={"images": 1}, frame_rate=1000.0, **changes)

    def images(self, name, count, **changes):
        """The first images along the path, and what the node said."""
        reader = Reader(["a"], node="/" + name)
        with RenderNode(name, self.tree(**changes)) as node:
            images = reader.wait("/a/camera/image_raw", count)
            status, said = node.end()
        reader.close()
        self.assertEqual(status, 0, said)
        return images, said

    def shaded(self, image, without, forward, left):
        """Whether the ground there has lost the sun; that it has neither lost nor kept all is a failure."""
        share = brightness(image, forward, left) / brightness(without, forward, left)
        self.assertTrue(share < 0.7 or 0.97 < share < 1.03, share)
        return share < 0.7

    def test_its_shadow_falls_where_the_sun_throws_it(self):
        bare, _ = self.images("bare", 4, path={"count": 4})
        seen, said = self.images("robot", 4, path={"count": 4}, robot={"file": POLE})
        self.assertTrue(any("Robot pole: 3 links" in line for line in said), said)
        self.assertFalse(any("above the path" in line for line in said), said)
        for image, without in zip(seen, bare):  # it moves with the camera
            for forward in (2.5, 3.0, SHADOW_END_M - 0.15):
                self.assertTrue(self.shaded(image, without, forward, 0.0), forward)
                self.assertTrue(self.shaded(image, without, forward, 0.22), forward)
                self.assertFalse(self.shaded(image, without, forward, 0.4), forward)
                self.assertFalse(self.shaded(image, without, forward, -0.4), forward)
            self.assertFalse(self.shaded(image, without, SHADOW_END_M + 0.2, 0.0))

    def test_a_description_on_the_parameter_server_is_the_same_as_a_file(self):
        with open(POLE) as file:
            rospy.set_param("/robot_description", file.read())
        from_file, _ = self.images("filed", 2, path={"count": 2}, robot={"file": POLE})
        described, _ = self.images("described", 2, path={"count": 2}, robot={"description": "robot_description"})
        self.assertEqual([image.data for image in described], [image.data for image in from_file])
        # Half a metre to the right of where it was.
        moved, _ = self.images("moved", 2, path={"count": 2}, robot={"file": POLE, "camera_in_base": [0, 0.5, 1]})
        self.assertLess(brightness(moved[0], 3.0, -0.5), 0.7 * brightness(from_file[0], 3.0, -0.5))
        self.assertGreater(brightness(moved[0], 3.0, 0.1), 1.4 * brightness(from_file[0], 3.0, 0.1))

    def with_camera(self, rpy):
        """The pole's robot with its camera on a link turned so."""
        turned = os.path.join(self.folder, "turned.urdf")
        with open(POLE) as file:
            text = file.read()
        with open(turned, "w") as file:
            file.write(text.replace("</robot>", """<link name="camera_link"/><joint name="eye" type="fixed">
              <parent link="base_link"/><child link="camera_link"/><origin xyz="0 0 1" rpy="%s"/></joint></robot>""" % rpy))
        return turned

    def test_a_camera_looks_where_its_link_does(self):
        ahead, said = self.images("ahead", 1, path={"count": 1}, robot={"file": self.with_camera("0 0 0")})
        self.assertFalse(any("tilted" in line for line in said), said)
        plain, _ = self.images("plain", 1, path={"count": 1}, robot={"file": POLE})
        self.assertEqual(ahead[0].data, plain[0].data)
        for name, rpy, path in (("back", "0 0 3.14159265359", {}), ("aside", "0 0 0.5", {"yaw": 160.0})):
            reader = Reader(["a"], node="/" + name)
            tree = self.tree(path=dict(path, count=1), robot={"file": self.with_camera(rpy)}, subscribers={"images": 1, "poses": 1})
            with RenderNode(name, tree) as node:
                pose, = reader.wait("/camera/pose", 1)
                image, = reader.wait("/a/camera/image_raw", 1)
                status, said = node.end()
            reader.close()
            self.assertEqual(status, 0, said)
            turn = 2.0 * math.atan2(pose.pose.orientation.z, pose.pose.orientation.w)
            expected = math.radians(path.get("yaw", 0.0)) + float(rpy.split()[2])
            self.assertAlmostEqual(math.cos(turn - expected), 1.0, 6)
            if not path:  # at the pole's shaded side, which fills the picture
                self.assertLess(brightness(image, 3.0, 0.0), 0.7 * brightness(plain[0], 3.0, 0.6))

    def test_a_link_that_is_not_level_is_told_of(self):
        _, said = self.images("tilted", 1, path={"count": 1}, robot={"file": self.with_camera("0 0.2 0")})
        self.assertTrue(any("WARN" in line and "camera_link" in line and "tilted by 11.5 deg" in line for line in said), said)

    def test_one_that_hovers_is_told_of(self):
        _, said = self.images("hovering", 1, path={"count": 1}, robot={"file": POLE, "camera_in_base": [0, 0, 0.4]})
        self.assertTrue(any("WARN" in line and "0.60 m above the path" in line for line in said), said)

    def test_its_shadow_moves_with_tf_and_links_without_tf_are_counted(self):
        bare, _ = self.images("bare", 1, path={"count": 1})
        reader = Reader(["a"], node="/followed")
        sender = Transforms()
        tree = self.following(camera={"follow_frame": "eye"},
                              robot={"file": POLE, "tf_patience": 0.2, "tf_prefix": "first"})
        with RenderNode("followed", tree) as node:
            node.line_with("Waiting for the TF frame eye")
            sender.wait_for_readers(2)  # the node, and the reader here
            for index, left in enumerate((0.0, 0.8, -0.8)):
                stamp = rospy.Time(2000 + index)
                # The pole goes aside; the weight is not heard of, or nothing that can be.
                sender.send(transform("map", "eye", stamp, z=CAMERA_HEIGHT_M), transform("map", "first/base_link", stamp),
                            transform("first/base_link", "first/pole", stamp, x=-POLE_BEHIND_M, y=left),
                            *([transform("first/pole", "first/weight", stamp, z=math.inf)] if index > 0 else []))
                image = reader.wait("/a/camera/image_raw", index + 1)[index]
                for place in (-0.8, 0.0, 0.8):
                    self.assertEqual(self.shaded(image, bare[0], 3.0, place), place == left, (left, place))
            node.process.send_signal(2)
            status, said = node.end()
        self.assertEqual(status, 0, said)
        self.assertTrue(any("to first/weight on TF is not finite" in line for line in said), said)
        warnings = [line for line in said if "weight" in line and "Waiting" not in line and "finite" not in line]
        self.assertEqual(len(warnings), 2, said)
        self.assertIn("No transform of the robot's link first/weight on TF", warnings[0])
        self.assertIn("weight in 3 of 3 poses", warnings[1])
        sender.close()
        reader.close()

    def test_links_that_are_always_sent_later_than_the_frame_are_waited_for(self):
        reader = Reader(["a"], node="/lagging")
        sender = Transforms()
        tree = self.following(camera={"follow_frame": "eye"},
                              robot={"file": POLE, "tf_patience": TIMEOUT_S})
        arrived = lambda: reader.messages["/a/camera/image_raw"]
        with RenderNode("lagging", tree) as node:
            node.line_with("Waiting for the TF frame eye")
            with reader.changed:
                for second in range(2000, 2000 + int(10 * TIMEOUT_S)):
                    now, late = rospy.Time(second), rospy.Time.from_sec(second - 0.5)
                    sender.send(transform("base_link", "pole", late), transform("pole", "weight", late),
                                transform("map", "eye", now, z=CAMERA_HEIGHT_M), transform("map", "base_link", now))
                    if reader.changed.wait_for(arrived, 0.1):
                        break
            self.assertTrue(arrived(), "the links of the newest moment are never there")
            node.process.send_signal(2)
            status, said = node.end()
        self.assertEqual(status, 0, said)
        self.assertFalse(any("No transform" in line for line in said), said)
        sender.close()
        reader.close()

    def test_joints_that_nobody_renews_on_a_path_are_told_of(self):
        reader = Reader(["a"], node="/left_alone")
        sender = Transforms()
        patience_s = 0.3
        tree = self.tree(autostart=False, path={"count": 3}, wait_for=["/reader/progress"], max_ahead=1,
                         robot={"file": POLE, "joints": "tf", "tf_patience": patience_s})
        links = lambda second, left: (transform("base_link", "pole", rospy.Time(second), x=-POLE_BEHIND_M, y=left),
                                      transform("pole", "weight", rospy.Time(second)),
                                      transform("base_link", "camera_link", rospy.Time(second), z=CAMERA_HEIGHT_M))
        is_at = lambda image, left: brightness(image, 3.0, left) < 0.7 * brightness(image, 3.0, -left)
        eye = Pose(Point(0.0, 0.0, CAMERA_HEIGHT_M), Quaternion(0.0, 0.0, 0.0, 1.0))
        with RenderNode("left_alone", tree) as node:
            start = service("/left_alone/start", Trigger)
            view = service("/left_alone/render_view", RenderView)
            sender.wait_for_readers(2)  # the node, and the reader here
            self.assertFalse(is_at(view(pose=eye).image, 0.8))  # counts for nothing, and nothing stays as it was
            sender.send(*links(2000, 0.8))
            for _ in range(int(TIMEOUT_S / 0.1)):
                if is_at(view(pose=eye).image, 0.8):
                    break
                time.sleep(0.1)
            start()
            for poses, left in ((1, 0.8), (2, -0.8)):
                self.assertTrue(is_at(reader.wait("/a/camera/image_raw", poses)[-1], left), poses)
                time.sleep(2 * patience_s)
                if poses == 1:
                    sender.send(*links(2001, -0.8))
                    time.sleep(patience_s / 2)
                reader.done(poses)
            reader.wait("/a/camera/image_raw", 3)
            reader.done(3)
            status, said = node.end()
        self.assertEqual(status, 0, said)
        told = [line for line in said if "WARN" in line and "the frame camera_link" in line]
        self.assertEqual(len(told), 1, said)
        self.assertIn("sends the frame camera_link below base_link on TF, and so does this node, below map", told[0])
        self.assertIn("publish_tf: false", told[0])
        told = [line for line in said if "renewed" in line]
        self.assertEqual(len(told), 3, said)
        self.assertIn("link pole on TF is that of 2001.000 s and has not been renewed for 0.3 s", told[0])
        self.assertIn("renewed no more: pole in 1 of 3 poses, weight in 1 of 3 poses", told[2])
        sender.close()
        reader.close()

    def refused(self, robot, *parts):
        self.assert_refused(self.tree(robot=robot), *parts)

    def test_what_is_wrong_is_one_clear_line(self):
        broken = os.path.join(self.folder, "broken.urdf")
        with open(broken, "w") as file:
            file.write("<robot name='r'>\n<link name='a'>\n</robot>")
        self.refused({"file": broken}, broken + ":", "XML")
        self.refused({"file": "/none.urdf"}, "there is no robot /none.urdf")
        self.refused({"file": POLE, "base_frame": "head"}, 'robot/base_frame is "head"', "base_link, pole, weight")
        self.refused({"file": POLE, "camera_in_base": "head"}, 'robot/camera_in_base is "head"')
        self.refused({"file": POLE, "camera_in_base": [1, 2]}, "/refused/robot/camera_in_base", "[x, y, z]")
        self.refused({"file": POLE, "camera_in_base": [0, 0, 90]}, "/refused/robot/camera_in_base", "from -50 to 50 m")
        self.refused({"file": POLE, "description": "x"}, "robot/description", "robot/file", "one source")
        self.refused({"description": "nowhere"}, "/nowhere does not exist")
        self.refused({"file": POLE, "joints": "loose"}, "/refused/robot/joints", "loose", "auto, rest, tf")


if __name__ == "__main__":
    rospy.init_node("render_robot")
    rostest.rosrun("sunlit", "render_robot", RenderRobot)
