#!/usr/bin/python3
"""Start, pause, single views, paths on a topic, and what the node says while it waits."""
import datetime
import math
import os
import re
import sys
import tempfile
import threading
import time
import unittest

import rosbag
import rospy
import rostest
from geometry_msgs.msg import Pose, PoseStamped
from nav_msgs.msg import Path
from rendering import Process, Reader, RenderNode, Sky, Sun, TIMEOUT_S, instant_of, parameters, service
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import CameraInfo, Image
from std_srvs.srv import Trigger
from sunlit.msg import Activity, Capture
from sunlit.srv import RenderView
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "..", "scripts"))
from sunlit_experiment.idle import wait_until_idle  # noqa: E402


def camera_at(x):
    pose = Pose()
    pose.position.x, pose.position.z, pose.orientation.w = x, 1.0, 1.0
    return pose


def route(*xs, frame="map"):
    """A path along x."""
    path = Path()
    path.header.frame_id = frame
    for x in xs:
        path.poses.append(PoseStamped(pose=camera_at(x)))
        path.poses[-1].pose.position.z = 0.0
    return path


class RenderControl(unittest.TestCase):

    def setUp(self):
        self.suns = [Sun("/a/sun"), Sun("/b/sun", up=0.6, north=0.8)]

    def test_nothing_is_rendered_before_start_and_while_paused(self):
        reader = Reader(["a"], node="/controlled")
        tree = parameters(conditions=["a"], autostart=False, wait_for=["/reader/progress"], max_ahead=3,
                          subscribers={"images": 1})
        with RenderNode("controlled", tree) as node:
            view = service("/controlled/render_view", RenderView)
            reader.wait("/path", 1)  # known before the start
            for _ in range(3):
                view(condition="a")
            self.assertEqual(reader.of("/a/camera/image_raw"), [])

            self.assertTrue(service("/controlled/start", Trigger)().success)
            reader.wait_progress("/controlled/progress", 3)
            self.assertTrue(service("/controlled/pause", Trigger)().success)
            reader.done(20)  # it may go on, but for the pause
            for _ in range(3):
                self.assertTrue(view(pose=camera_at(2.0), condition="a").success)
            self.assertEqual(reader.of("/controlled/progress")[-1].data, 3)

            time.sleep(1.0)
            resumed = time.monotonic()
            service("/controlled/start", Trigger)()
            images = reader.wait("/a/camera/image_raw", 20)
            # A pause is no time that poses take: 16 of the 17 are told of, since the first one begins.
            a_pose_ms = float(re.search(r"\), (\d+) ms a pose", node.line_with("pose 20 of 20 (100 %)")).group(1))
            self.assertLess(16 * (a_pose_ms - 0.5), 1000.0 * (time.monotonic() - resumed))
            self.assertEqual([image.header.stamp.to_nsec() for image in images],
                             [1000 * 10**9 + pose * 125 * 10**6 for pose in range(20)])

            reader.wait_activity("/controlled/activity", "done")
            for name in ("start", "pause"):
                answer = service("/controlled/" + name, Trigger)()
                self.assertFalse(answer.success)
                self.assertIn("all poses are rendered", answer.message)
            self.assertEqual(rospy.wait_for_message("/controlled/activity", Activity, TIMEOUT_S).doing, "done")
        reader.close()

    def test_black_pictures_are_told_of(self):
        reader = Reader(["a"], node="/within")
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as waypoints:
            waypoints.write("x,y,z\n11,0,0\n14,0,0\n")
            waypoints.flush()
            tree = parameters(conditions=["a"], path={"file": waypoints.name, "spacing": 2.0, "count": 2},
                              subscribers={"images": 1}, exit_when_done=True)
            with RenderNode("within", tree) as node:  # the box is from 12 to 14 m
                images = reader.wait("/a/camera/image_raw", 2)
                status, said = node.end()
        self.assertEqual(status, 0, said)
        self.assertEqual([not any(image.data) for image in images], [False, True])
        told = [line for line in said if "black all over" in line]
        self.assertEqual(len(told), 2, said)
        self.assertIn("The picture of a at pose 1 is black all over: does the camera stand in a body", told[0])
        self.assertIn("Pictures of a that are black all over: 1 of 2", told[1])
        reader.close()

    def said_along(self, waypoints, **path):
        """What a node says of two poses along these lines of a file."""
        reader = Reader(["a"], node="/lost")
        self.addCleanup(reader.close)
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
            file.write("x,y,z\n" + waypoints)
            file.flush()
            tree = parameters(conditions=["a"], path=dict({"file": file.name}, **path), subscribers={"images": 1},
                              exit_when_done=True)
            with RenderNode("lost", tree) as node:
                status, said = node.end()
            self.assertEqual(status, 0, said)
            return [line.replace(file.name, "FILE") for line in said]

    def test_a_path_in_another_frame_is_told_of_before_the_bake(self):
        said = self.said_along("592000,5760000,0\n592003,5760001,0\n", spacing=2.0)
        told = [line for line in said if "of FILE is near the world" in line]
        self.assertEqual(len(told), 1, said)
        self.assertRegex(told[0], "WARN.*No pose of FILE is near the world, which reaches from .* m: is it in another frame")
        self.assertLess(said.index(told[0]), [k for k, line in enumerate(said) if "Sky light and bounced light at" in line][0])

    def test_a_spacing_a_little_below_the_distance_of_waypoints_is_told_of_unless_only_some_poses_are_taken(self):
        for stride, expected in ((1, 1), (10, 0)):
            said = self.said_along("".join("%.2f,0,0\n" % (1.21 * k) for k in range(7)), spacing=1.2, count=2, stride=stride)
            told = [line for line in said if "poses lie less than a tenth of the spacing" in line]
            self.assertEqual(len(told), expected, said)
            self.assertTrue(all("WARN" in line and "a spacing of 1.3 m takes one a waypoint" in line for line in told), told)

    def test_poses_that_see_nothing_of_the_world_are_told_of(self):
        # High above them; a level camera sees no ground of 400 m from there.
        said = self.said_along("0,0,0\n3,0,0\n", spacing=2.0, camera_height=900.0)
        told = [line for line in said if "nothing of the world" in line]
        self.assertEqual(len(told), 2, said)
        self.assertRegex(told[0], "WARN.*At pose 0 nothing of the world is in view, which reaches from .* More like it are counted")
        self.assertEqual(told[1], "Poses that see nothing of the world: 2 of 2")
        self.assertFalse([line for line in said if "is near the world" in line])
        said = self.said_along("0,0,0\n3,0,0\n", spacing=2.0, camera_height=-3.0)
        told = [line for line in said if "under the ground" in line]
        self.assertEqual(len(told), 2, said)
        self.assertRegex(told[0], "WARN.*At pose 0 nothing of the world, .* but something is above: it is under the ground")
        self.assertEqual(told[1], "Poses that are under the ground, or where there is none: 2 of 2")

    def test_view_is_the_image_of_the_path_at_the_same_pose(self):
        reader = Reader(["a", "b"], node="/viewed")
        with RenderNode("viewed", parameters(conditions=["a", "b"], path={"count": 5},
                                                subscribers={"images": 1, "poses": 1, "others": 1})):
            pose = reader.wait("/camera/pose", 5)[4].pose
            expected = {c: reader.wait("/%s/camera/image_raw" % c, 5)[4] for c in ("a", "b")}
            view = service("/viewed/render_view", RenderView)
            for condition in ("a", "b"):
                answer = view(pose=pose, condition=condition)
                self.assertTrue(answer.success, answer.message)
                self.assertEqual(answer.image.data, expected[condition].data)
                self.assertEqual(answer.camera_info.K, reader.wait("/%s/camera/camera_info" % condition, 1)[0].K)

            for pose, condition, part in ((pose, "c", "one of a, b"), (pose, "", "one of a, b"), (Pose(), "a", "quaternion"),
                                          (camera_at(math.nan), "a", "pose.position.x is nan, but must be from"),
                                          (camera_at(1e30), "a", "but must be from -10000000 to 10000000 m")):
                answer = view(pose=pose, condition=condition)
                self.assertFalse(answer.success)
                self.assertIn(part, answer.message)
        reader.close()

    def test_waits_for_readers_of_images_and_of_their_camera_info_apart(self):
        tree = parameters(conditions=["a"], subscribers={"images": 1, "others": 1})
        topics = ["/a/camera/camera_info", "/a/camera/capture", "/camera/depth/camera_info", "/a/camera/image_raw", "/tf",
                  "/camera/depth/image_raw"]
        kinds = [CameraInfo, Capture, CameraInfo, Image, TFMessage, Image]
        arrived = threading.Event()
        with RenderNode("waiting", tree) as node:
            readers = [rospy.Subscriber(*reader) for reader in list(zip(topics, kinds))[:3]]
            for topic, kind in list(zip(topics, kinds))[3:]:
                node.line_with("Waiting for subscribers of " + topic)
                readers.append(rospy.Subscriber(topic, kind, lambda _: arrived.set()))
            self.assertTrue(arrived.wait(TIMEOUT_S))
        for reader in readers:
            reader.unregister()

    def test_a_viewer_does_not_count_for_the_recorder(self):
        topics = ["/a/camera/image_raw", "/a/camera/camera_info", "/a/camera/capture", "/camera/pose", "/camera/depth/image_raw",
                  "/camera/depth/camera_info"]
        viewer = Reader(["a"], node="/patient")
        self.addCleanup(viewer.close)
        tree = parameters(conditions=["a"], exit_when_done=True, subscribers={"images": 1, "poses": 1, "others": 1, "of": ["recorder"]})
        with tempfile.TemporaryDirectory() as folder, RenderNode("patient", tree) as node:
            self.assertIn("count: /recorder", node.line_with("Waiting for subscribers of /a/camera/image_raw"))
            record = Process("recorder", {}, "record", package="rosbag",
                             arguments=["-O", os.path.join(folder, "all.bag"), *topics, "/tf"])
            with record:
                status, said = node.end()
                self.assertEqual(status, 0, said)
                self.assertTrue(wait_until_idle(record.process.pid, TIMEOUT_S))
            with rosbag.Bag(os.path.join(folder, "all.bag")) as bag:
                for topic in topics:
                    self.assertEqual(bag.get_message_count(topic), 20, topic)

    def test_waits_for_readers_of_what_localisation_needs(self):
        arrived = threading.Event()
        with RenderNode("truthful", parameters(conditions=["a"], subscribers={"truth": 1})) as node:
            node.line_with("Waiting for subscribers of /a/camera/camera_info")
            infos = rospy.Subscriber("/a/camera/camera_info", CameraInfo)
            node.line_with("Waiting for subscribers of /camera/depth/image_raw")
            depths = rospy.Subscriber("/camera/depth/image_raw", Image, lambda _: arrived.set())
            self.assertTrue(arrived.wait(TIMEOUT_S))
        infos.unregister()
        depths.unregister()

    def test_live_pictures_have_the_sky_of_their_stamps_and_none_comes_before_its_time(self):
        arrivals = []
        listener = rospy.Subscriber("/camera/capture", Capture, lambda capture: arrivals.append((rospy.Time.now(), capture)))
        reader = Reader([""], node="/live")
        with Process("live_sun", {"date_time": {"rate": 600.0}}, "sun_position_node"), \
                RenderNode("live", parameters(start_stamp="now", subscribers={"images": 1})):
            captures = reader.wait("/camera/capture", 10)
        first = captures[0]
        begin = instant_of(first)
        for pose, capture in enumerate(captures):
            self.assertEqual((capture.header.stamp - first.header.stamp).to_nsec(), pose * 125 * 10**6)
            elapsed = instant_of(capture) - begin
            self.assertAlmostEqual(elapsed.total_seconds(), 75.0 * pose, delta=0.0011)  # both are rounded to 1 ms
        for now, capture in arrivals:
            self.assertGreaterEqual(now, capture.header.stamp)
        listener.unregister()
        reader.close()

    def test_begins_with_the_first_sky_where_that_is_ahead_of_its_clock(self):
        reader, sky = Reader(["c"], node="/behind"), Sky("/c/")
        with RenderNode("behind", parameters(conditions=["c"], start_stamp="now", subscribers={"images": 1})):
            ahead = []
            for _ in range(int(TIMEOUT_S / 0.05)):
                if reader.of("/c/camera/image_raw"):
                    break
                ahead.append(rospy.Time.now() + rospy.Duration(0.5))
                sky.send_sun(ahead[-1].to_sec(), rate=1.0)
                time.sleep(0.05)
            first = reader.wait("/c/camera/image_raw", 1)[0].header.stamp
        self.assertGreaterEqual(first.to_sec(), ahead[0].to_sec())
        for publisher in sky.publishers:
            publisher.unregister()
        reader.close()

    def test_says_which_sun_it_waits_for(self):
        with RenderNode("sunless", parameters(conditions=["a", "never"])) as node:
            self.assertIn("a sun on /never/sun", node.line_with("Waiting for"))
            answer = service("/sunless/render_view", RenderView)(pose=camera_at(0.0), condition="never")
            self.assertFalse(answer.success)
            self.assertIn("/never/sun", answer.message)
        self.assertEqual(node.status, 0)  # SIGINT is no failure

    def test_says_which_reader_it_waits_for(self):
        with RenderNode("unread", parameters(conditions=["a"], wait_for=["/nobody/progress"])) as node:
            self.assertIn("progress on /nobody/progress", node.line_with("Waiting for"))

    def test_the_last_images_reach_a_reader_that_is_slower_than_the_node(self):
        rendered, changed, arrived = threading.Event(), threading.Condition(), []

        def keep(image):
            # Until the node is done this reader takes nothing more from its socket, which holds two images or so.
            rendered.wait(TIMEOUT_S)
            with changed:
                arrived.append(image.header.stamp)
                changed.notify_all()

        def hear(log):
            if "All poses are rendered" in log.msg:
                rendered.set()

        readers = [rospy.Subscriber("/a/camera/image_raw", Image, keep, queue_size=None),
                   rospy.Subscriber("/a/camera/capture", Capture, lambda _: None),
                   rospy.Subscriber("/rosout", Log, hear)]
        tree = parameters(conditions=["a"], max_ahead=20, exit_when_done=True, subscribers={"images": 1},
                          camera={"width": 1280, "height": 960})
        with RenderNode("ending", tree) as node:
            status, said = node.end()
        self.assertTrue(rendered.is_set(), said)
        self.assertEqual(status, 0, said)
        with changed:
            changed.wait_for(lambda: len(arrived) == 20, TIMEOUT_S)
        self.assertEqual(arrived, [rospy.Time(1000) + rospy.Duration(0.125 * pose) for pose in range(20)])
        for reader in readers:
            reader.unregister()

    def test_takes_a_path_from_a_topic(self):
        sender = rospy.Publisher("/route", Path, queue_size=None, latch=True)  # sent at once
        reader = Reader(["a"], node="/routed")
        elsewhere = route(0.0, 3.0, 4.5)
        elsewhere.poses[2].header.frame_id = "odom"
        beyond = route(0.0, 0.0, math.nan)
        with RenderNode("routed", parameters(conditions=["a"], path={"file": "", "topic": "route", "spacing": 1.0},
                                             subscribers={"images": 1})) as node:
            node.line_with("Waiting for a path on /route")
            # What is no path is refused and named, once however often it comes.
            for bad, reason in ((route(), "two"), (route(0.0, 3.0, frame="odom"), 'its frame_id is "odom", but must be "map"'),
                                (elsewhere, 'waypoint 2: its frame_id is "odom", but must be "map"'),
                                (route(3.0, 3.0), "there is 1; 1 pose left out"), (route(0.0, math.inf), "waypoint"),
                                (beyond, "waypoint 2: x is nan")):
                sender.publish(bad)
                sender.publish(bad)
                line = node.line_with("ERROR")
                self.assertIn("Refused the path on /route: ", line)
                self.assertIn(reason, line)
            # Planners repeat poses, name frames of poses or not, and orientations count for nothing.
            whole = route(0.0, 3.0, 3.0, 4.5, 4.5)
            whole.poses[1].header.frame_id, whole.poses[1].pose.orientation.w = "map", 0.0
            sender.publish(whole)
            self.assertIn("The path on /route: 2 poses left out", node.line_with("left out"))
            # 0, 1, 2, then the start of the next segment and 1 m from there.
            path = reader.wait("/path", 1)[0]
            self.assertEqual([round(p.pose.position.x, 9) for p in path.poses], [0.0, 1.0, 2.0, 3.0, 4.0])
            reader.wait("/a/camera/image_raw", 5)
        sender.unregister()
        reader.close()

    def test_another_path_under_way_is_told_of_once(self):
        sender = rospy.Publisher("/route", Path, queue_size=None, latch=True)
        reader = Reader(["a"], node="/kept")
        with RenderNode("kept", parameters(conditions=["a"], path={"file": "", "topic": "route", "spacing": 1.0},
                                           subscribers={"images": 1}, exit_when_done=True, wait_for=["/reader/progress"],
                                           max_ahead=1)) as node:
            for xs in ((0.0, 3.0), (0.0, 3.0), (0.0, 4.0), (1.0, 5.0), ()):
                sender.publish(route(*xs))
                reader.wait("/path", 1)
            node.line_with("Another path came on /route: it is not heeded")
            reader.done(3)
            status, said = node.end()
        self.assertEqual(status, 0, said)
        self.assertFalse(any("nother path" in line for line in said), said)
        self.assertEqual(len(reader.of("/path")), 1)
        self.assertEqual(len(reader.wait("/a/camera/image_raw", 3)), 3)
        sender.unregister()
        reader.close()

    def test_its_own_path_is_none_that_it_was_sent(self):
        sender = rospy.Publisher("/path", Path, queue_size=None, latch=True)
        reader = Reader(["a"], node="/echoed")
        with RenderNode("echoed", parameters(conditions=["a"], path={"file": "", "topic": "path"}, subscribers={"images": 1},
                                             exit_when_done=True)) as node:
            sender.publish(route(0.0, 3.0))
            status, said = node.end()
        self.assertEqual(status, 0, said)
        self.assertFalse(any("nother path" in line for line in said), said)
        sender.unregister()
        reader.close()

    def test_only_every_third_pose_keeps_index_and_stamp(self):
        reader = Reader(["a"], node="/strider")
        tree = parameters(conditions=["a"], path={"first": 2, "count": 10, "stride": 3}, subscribers={"images": 1})
        with RenderNode("strider", tree):
            captures = reader.wait("/a/camera/capture", 4)
            self.assertEqual([capture.pose_index for capture in captures], [2, 5, 8, 11])
            self.assertEqual([capture.header.stamp.to_nsec() for capture in captures],
                             [1000 * 10**9 + pose * 125 * 10**6 for pose in (2, 5, 8, 11)])
            reader.wait_progress("/strider/progress", 10)
        reader.close()

    def test_a_reader_of_every_third_pose_counts_what_it_gets(self):
        reader = Reader(["a"], node="/counted")
        tree = parameters(conditions=["a"], path={"stride": 3}, wait_for=["/reader/progress"], max_ahead=2,
                          subscribers={"images": 1}, exit_when_done=True)
        with RenderNode("counted", tree) as node:
            for done in range(8):  # 0, 3, … 18 are seven
                reader.done(done)
                captures = reader.wait("/a/camera/capture", min(done + 2, 7))
            status, said = node.end()
        self.assertEqual(status, 0, said)
        self.assertEqual([capture.pose_index for capture in captures], list(range(0, 20, 3)))
        reader.close()

    def test_one_that_goes_on_tells_at_once_what_it_has_nothing_more_to_render_of(self):
        """Else one that waits for it, and that it waits for by way of the reader, would wait for ever."""
        for stride, first in ((10, 20), (5, 15)):  # nothing is left of 0, 10; 15 is too far ahead of 11
            name = "resumed_%d" % stride
            reader = Reader(["a"], node="/" + name)
            reader.done(11)
            tree = parameters(conditions=["a"], path={"stride": stride}, resume_at=11, max_ahead=2,
                              wait_for=["/reader/progress"], count_skipped=True, subscribers={"images": 1})
            with RenderNode(name, tree):
                reader.wait_progress("/%s/progress" % name, first)
                self.assertEqual(reader.of("/a/camera/image_raw"), [])
                reader.done(14)
                reader.wait_progress("/%s/progress" % name, 20)
                captures = reader.wait("/a/camera/capture", 1 if first < 20 else 0)
                self.assertEqual([capture.pose_index for capture in captures], list(range(first, 20, stride)))
            reader.close()

    def test_any_number_of_threads_gives_the_same_bits(self):
        pictures = []
        for threads in (1, 3):
            reader = Reader(["a"], node="/threaded")
            tree = parameters(conditions=["a"], threads=threads, path={"count": 3}, noise={"enabled": True},
                              subscribers={"images": 1})
            with RenderNode("threaded", tree):
                pictures.append([image.data for image in reader.wait("/a/camera/image_raw", 3)])
            reader.close()
        self.assertEqual(pictures[0], pictures[1])


if __name__ == "__main__":
    rospy.init_node("render_control")
    rostest.rosrun("sunlit", "render_control", RenderControl)
