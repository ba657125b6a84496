#!/usr/bin/python3
"""Frames by other names: two suns and two cameras on one master, without remapping /tf."""
import contextlib
import unittest

import rospy
import rostest
import tf2_py
from rendering import Process, Reader, RefusalTest, RenderNode, Sun, TIMEOUT_S, following, parameters
from sensor_msgs.msg import CameraInfo

POSES = 3


def frames(side, *names):
    return {name: side + "/" + name for name in names}


class RenderFrames(RefusalTest):

    def test_two_of_each_live_on_one_master(self):
        sides = ("left", "right")
        expected = {}
        for side in sides:
            top = side + "/map"
            expected.update({side + "/camera": {top}, side + "/optical": {side + "/camera"}, "h12/%s_sun" % side: {top},
                             "h12/%s_moon" % side: {top}, "h12/%s/celestial" % side: {top}})
        readers = [Reader(["h12"], node="/%s/render" % side, prefix="/%s/" % side) for side in sides]
        with contextlib.ExitStack() as nodes:
            for side in sides:
                sun = dict(frames(side, "map", "celestial"), sun=side + "_sun", moon=side + "_moon")
                sun = {"date_time": {"hour": 12, "rate": 0.0}, "conditions": ["h12"], "publish_rate": 100.0, "frames": sun}
                nodes.enter_context(Process("sun", sun, "sun_position_node", namespace=side))
                nodes.enter_context(RenderNode("render", parameters(
                    conditions=["h12"], path={"count": POSES}, night={"enabled": True},
                    frames=frames(side, "map", "camera", "optical"), subscribers={"images": 1, "poses": 1, "others": 1}),
                    namespace=side))
            transforms = self.heard(readers, set(expected))
            for side, reader in zip(sides, readers):
                for topic in ("camera/pose", "camera/depth/image_raw", "h12/camera/image_raw"):
                    reader.wait("/%s/%s" % (side, topic), POSES)
                self.check_headers(side, reader)
        parents = {t.child_frame_id: set() for t in transforms}
        for t in transforms:
            parents[t.child_frame_id].add(t.header.frame_id)
        self.assertEqual(parents, expected)
        tree = tf2_py.BufferCore(rospy.Duration(1e6))
        for t in transforms:
            tree.set_transform_static(t, "test")  # nothing moves that is asked for
        for side in sides:
            self.assertTrue(tree.can_transform_core(side + "/optical", "h12/%s_sun" % side, rospy.Time(0))[0])
        self.assertFalse(tree.can_transform_core("left/map", "right/map", rospy.Time(0))[0])
        for reader in readers:
            reader.close()

    def heard(self, readers, children):
        """All that was sent on TF until each of these frames was. Only one reader may have been there in time."""
        def sent():
            return [t for r in readers for m in r.messages["/tf"] + r.messages["/tf_static"] for t in m.transforms]
        with readers[0].changed:  # which the suns wake up all the time
            self.assertTrue(readers[0].changed.wait_for(lambda: children <= {t.child_frame_id for t in sent()}, TIMEOUT_S),
                            {t.child_frame_id for t in sent()})
        return sent()

    def check_headers(self, side, reader):
        for topic, frame in (("camera/pose", "map"), ("path", "map"), ("camera/depth/image_raw", "optical"),
                             ("camera/depth/camera_info", "optical"), ("h12/camera/image_raw", "optical"),
                             ("h12/camera/camera_info", "optical"), ("h12/camera/capture", "optical")):
            messages = reader.wait("/%s/%s" % (side, topic), 1)
            self.assertEqual({m.header.frame_id for m in messages}, {side + "/" + frame}, topic)

    def test_senders_of_one_frame_are_told_of_each_other(self):
        sun = Sun("/noon/sun")
        info = rospy.Subscriber("/left/camera/camera_info", CameraInfo, lambda _: None)  # waited for before /tf
        cameras = {}
        with contextlib.ExitStack() as nodes:
            for side in ("left", "right"):
                cameras[side] = nodes.enter_context(RenderNode("render", parameters(
                    path={"count": POSES}, sun_namespace="/noon", subscribers={"others": 1}), namespace=side))
                said = cameras[side].line_with("subscribers of")  # from now on it listens
                if side == "left":  # no node is a reader of its own
                    self.assertIn("subscribers of /tf", said)
            readers = [Reader([""], node="/%s/render" % side, prefix="/%s/" % side) for side in cameras]
            for side, other in (("left", "right"), ("right", "left")):
                told = cameras[side].line_with("on TF, and so does this node")
                self.assertIn("/%s/render sends the frame camera_link below map on TF, and so does this node, below map" % other, told)
                self.assertIn("publish_tf: false", told)
        for reader in readers:
            reader.close()
        info.unregister()
        sun.publisher.unregister()

    def test_a_sky_of_another_map_is_refused(self):
        suns = [Sun("/a/sun"), Sun("/b/sun")]  # of `map`
        with RenderNode("elsewhere", parameters(conditions=["a", "b"], frames={"map": "world"})) as node:
            said = node.line_with("Refused a sun on /") + node.line_with("Refused a sun on /")
            self.assertEqual(said.count('frame_id is "map", but must be "world"'), 2, said)
            for condition in ("a", "b"):  # none of them hides the other
                self.assertIn("Refused a sun on /%s/sun" % condition, said)
        for sun in suns:
            sun.publisher.unregister()

    def test_names_that_make_no_tree_are_refused(self):
        for key in ("map", "camera", "optical"):
            self.assert_refused(parameters(frames={key: ""}), "/refused/frames/" + key, "name of a TF frame")
            self.assert_refused(parameters(frames={key: "/" + key}), "/refused/frames/" + key, "without a slash in front")
        self.assert_refused(parameters(frames={"optical": "map"}), "/refused/frames/optical", "/refused/frames/map is called so")
        self.assert_refused(following(camera={"follow_frame": "map"}), "/refused/camera/follow_frame",
                            "/refused/frames/map is called so")
        self.assert_refused(following(frames={"camera": "eye"}), "/refused/frames/camera is given",
                            "/refused/camera/follow_frame")


if __name__ == "__main__":
    rospy.init_node("render_frames")
    rostest.rosrun("sunlit", "render_frames", RenderFrames)
