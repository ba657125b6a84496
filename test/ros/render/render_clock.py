#!/usr/bin/python3
"""One time base: the renderer is the clock, the sun moves by it, and each picture has the sky of its stamp, live and in a bag."""
import datetime
import io
import math
import os
import subprocess
import tempfile
import time
import unittest
import xmlrpc.client

import numpy
import rosbag
import rosgraph
import rospy
import rostest
import tf2_py
from rendering import Process, Reader, RenderNode, TIMEOUT_S, instant_of, parameters
from rosgraph_msgs.msg import Clock
from std_srvs.srv import Trigger
from sunlit.msg import Activity, Capture
from tf2_msgs.msg import TFMessage

POSES = 20
START_S, FRAME_RATE, RATE = 1000.0, 8.0, 1800.0  # the whole drive lasts 2.5 s: 75 minutes of the sun's clock
BEGIN = datetime.datetime(2024, 7, 1, 5, 0, tzinfo=datetime.timezone.utc)  # 8 h at UTC+3
SUN = {"date_time": {"hour": 8, "rate": RATE, "start_stamp": START_S}, "conditions": {"a": {}, "b": {"hour": 20}}}
TOPICS = ["/tf", "/tf_static", "/clock", "/camera/depth/image_raw", "/camera/depth/camera_info",
          "/camera/pose"] + [
    "/%s/camera/%s" % (c, name) for c in ("a", "b") for name in ("image_raw", "camera_info", "capture")]


def moving(**changes):
    """A camera under suns that move, and that owns time."""
    return parameters(conditions=["a", "b"], publish_clock=True, night={"enabled": True}, exit_when_done=True,
                      wait_for=["/reader/progress"], subscribers={"images": 1, "poses": 1, "others": 1}, **changes)


def go_by_the_clock():
    """A renderer that was the clock takes this back as it ends."""
    rospy.set_param("/use_sim_time", True)


class Busy:
    """Programs that take the processor from the others."""

    def __enter__(self):
        self.programs = [subprocess.Popen(["sh", "-c", "while :; do :; done"]) for _ in range(3)]

    def __exit__(self, *_):
        for program in self.programs:
            program.kill()
            program.wait()


def connected(node, peer, topic):
    """Whether `node` sends `topic` to `peer`."""
    api = rosgraph.Master("/render_clock").lookupNode(node)
    return any(link[1] == peer and link[2] == "o" and link[4] == topic
               for link in xmlrpc.client.ServerProxy(api).getBusInfo("/render_clock")[2])


def known(message, kind):
    """What a bag holds, as the type that other modules know."""
    data = io.BytesIO()
    message.serialize(data)
    return kind().deserialize(data.getvalue())


def rotation(quaternion):
    x, y, z, w = quaternion.x, quaternion.y, quaternion.z, quaternion.w
    return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def towards_sun(capture):
    return numpy.array([math.sin(capture.sun_azimuth) * math.cos(capture.sun_elevation),
                        math.cos(capture.sun_azimuth) * math.cos(capture.sun_elevation), math.sin(capture.sun_elevation)])


class RenderClock(unittest.TestCase):

    def setUp(self):
        go_by_the_clock()

    def drive(self, hold_back, **changes):
        """Pictures and captures of one run, for a reader that is done with a pose when it has `hold_back` poses more."""
        go_by_the_clock()
        reader = Reader(["a", "b"], node="/owner")
        with Process("suns", SUN, "sun_position_node"), RenderNode("owner", moving(**changes)) as node:
            for done in range(POSES + 1):
                reader.done(done)
                reader.wait("/a/camera/image_raw", min(done + hold_back, POSES))
            status, said = node.end()
        self.assertEqual(status, 0, said)
        self.assertFalse(rospy.has_param("/use_sim_time"))  # or nodes to come would wait for a clock that has gone
        found = {c: (reader.wait("/%s/camera/image_raw" % c, POSES), reader.wait("/%s/camera/capture" % c, POSES))
                 for c in ("a", "b")}
        reader.close()
        return found

    def test_a_moving_sun_gives_the_same_bytes_at_any_speed(self):
        quick = self.drive(hold_back=6, max_ahead=6)
        with Busy():
            slow = self.drive(hold_back=1, max_ahead=1, threads=1)
        for condition in ("a", "b"):
            for index in (0, 1):
                self.assertEqual(quick[condition][index], slow[condition][index])
            pictures, captures = quick[condition]
            self.assertEqual(len({picture.data for picture in pictures}), POSES)
            begin = BEGIN + datetime.timedelta(hours=12 if condition == "b" else 0)
            for capture in captures:
                elapsed_s = RATE * (capture.header.stamp.to_sec() - START_S)
                self.assertEqual(instant_of(capture), begin + datetime.timedelta(seconds=elapsed_s))

    def test_a_run_that_goes_on_and_a_second_process_see_the_same_sky(self):
        whole = self.drive(hold_back=1, max_ahead=2)["a"][0]
        go_by_the_clock()
        reader = Reader(["a", "b"], node="/owner")
        second = Reader(["a"], node="/second/follower", prefix="second/", says_progress=False)
        tree = moving(resume_at=5, max_ahead=7)
        tree["wait_for"] = ["/reader/progress", "/second/follower/progress"]
        follower = moving(path={"stride": 3}, resume_at=5, max_ahead=1, count_skipped=True, exact_sky=True, sun_namespace="/",
                          publish_tf=False)
        follower.update(publish_clock=False, subscribers={"images": 1}, conditions=["a"])
        with Process("suns", SUN, "sun_position_node"), RenderNode("owner", tree) as node, \
                RenderNode("follower", follower, namespace="second") as late:
            for done in range(5, POSES + 1):
                reader.done(done)
            self.assertEqual(node.end()[0], 0)
            self.assertEqual(late.end()[0], 0)
        self.assertEqual([i.data for i in reader.wait("/a/camera/image_raw", POSES - 5)], [i.data for i in whole[5:]])
        self.assertEqual([i.data for i in second.wait("/second/a/camera/image_raw", 5)], [whole[p].data for p in range(6, POSES, 3)])
        reader.close()
        second.close()

    def test_a_bag_alone_tells_where_the_sun_stands_from_the_camera_and_what_time_it_is(self):
        reader = Reader(["a", "b"], node="/owner")
        reader.done(POSES)
        tree = moving(autostart=False)
        tree["subscribers"] = {"images": 2, "poses": 2, "others": 2}
        with tempfile.TemporaryDirectory() as folder:
            bag = os.path.join(folder, "run.bag")
            with Process("recorder", {}, "record", package="rosbag", arguments=["-b", "0", "-O", bag] + TOPICS) as recorder, \
                    Process("suns", SUN, "sun_position_node"), RenderNode("owner", tree) as node:
                rospy.wait_for_service("/owner/start", TIMEOUT_S)
                while not connected("/suns", "/recorder", "/tf"):
                    self.assertIsNone(recorder.process.poll())
                rospy.ServiceProxy("/owner/start", Trigger)()
                self.assertEqual(node.end()[0], 0)
            self.check_bag(bag)
        reader.close()

    def check_bag(self, path):
        tf = tf2_py.BufferCore(rospy.Duration(1e6))
        captures, images, times = [], [], []
        with rosbag.Bag(path) as bag:
            for topic, message, _ in bag.read_messages():
                if topic.startswith("/tf"):
                    for transform in known(message, TFMessage).transforms:
                        (tf.set_transform_static if topic == "/tf_static" else tf.set_transform)(transform, "bag")
                elif topic == "/clock":
                    times.append(message.clock.to_nsec())
                elif topic == "/b/camera/capture":
                    captures.append(known(message, Capture))
                elif topic == "/b/camera/image_raw":
                    images.append(message.header.stamp)
        self.assertEqual([capture.header.stamp for capture in captures], images)
        self.assertEqual(len(captures), POSES)
        for capture in captures:
            stamp = capture.header.stamp
            seen = tf.lookup_transform_core("camera_link", "b/sun", stamp).transform.rotation
            camera = tf.lookup_transform_core("map", "camera_link", stamp).transform.rotation
            axis = rotation(camera) @ rotation(seen) @ [1.0, 0.0, 0.0]
            # Roundings of doubles; half a degree is between two stamps.
            self.assertLess(numpy.linalg.norm(axis - towards_sun(capture)), 1e-9)
            tf.lookup_transform_core("camera_optical_frame", "b/moon", stamp)
        self.assertEqual(times, sorted(times))
        self.assertEqual(times[0], round(1e9 * (START_S - 1.0 / FRAME_RATE)))  # while the world loads
        self.assertLessEqual({stamp.to_nsec() for stamp in images}, set(times))

    def test_ctrl_c_while_light_is_baked_or_waited_for_ends_at_once_and_takes_the_clock_back(self):
        with tempfile.TemporaryDirectory() as cache, tempfile.NamedTemporaryFile("w", suffix=".urdf") as world:
            boxes = "".join('<visual><origin xyz="%d %d 1"/><geometry><box size="1 1 2"/></geometry></visual>' % (3 * x, 3 * y)
                            for x in range(10, 30) for y in range(-10, 10))
            world.write('<robot name="boxes"><link name="boxes">%s</link></robot>' % boxes)
            world.flush()
            # Would take minutes.
            long = {"world": world.name, "transport": {"cache_dir": cache, "rays": 64, "samples": 10000000, "finest": 0.02}}
            other = parameters(conditions=["a"], **long)
            with RenderNode("owner", moving(**long)) as owner:
                says = rospy.wait_for_message("/owner/activity", Activity, TIMEOUT_S).doing
                while says != "baking":
                    says = rospy.wait_for_message("/owner/activity", Activity, TIMEOUT_S).doing
                with RenderNode("second", other) as waiting:
                    waiting.line_with("Another process bakes the light of this world")
                    self.interrupt(waiting)
                self.assertTrue(rospy.has_param("/use_sim_time"))
                self.interrupt(owner)
            self.assertFalse(rospy.has_param("/use_sim_time"))
            self.assertEqual(os.listdir(cache), [])

    def interrupt(self, node):
        begin = time.monotonic()
        node.process.send_signal(2)
        status, said = node.end()
        self.assertEqual(status, 0, said)
        self.assertFalse([line for line in said if "ERROR" in line or "FATAL" in line], said)
        self.assertLess(time.monotonic() - begin, 15.0)  # after which roslaunch loses its patience

    def test_who_refuses_a_parameter_leaves_no_clock_to_wait_for(self):
        with RenderNode("owner", moving(frame_rate=-1.0)) as node:
            status, said = node.end()
        self.assertEqual(status, 1, said)
        self.assertTrue(any("frame_rate is -1" in line for line in said), said)
        self.assertFalse(rospy.has_param("/use_sim_time"))

    def test_there_is_one_clock(self):
        other = rospy.Publisher("/clock", Clock, queue_size=1)
        with RenderNode("owner", moving()) as node:
            status, lines = node.end()
        self.assertEqual(status, 1)
        self.assertIn("publish_clock is true, but %s publishes /clock already" % rospy.get_name(),
                      "".join(line for line in lines if "FATAL" in line))
        other.unregister()


if __name__ == "__main__":
    rospy.init_node("render_clock")
    rostest.rosrun("sunlit", "render_clock", RenderClock)
