"""A render node under test: its process, its suns, and a reader of all its streams."""
import datetime
import math
import os
import subprocess
import sys
import threading
import unittest

import rospkg
import rospy
from geometry_msgs.msg import PoseStamped, QuaternionStamped
from nav_msgs.msg import Path
from sensor_msgs.msg import CameraInfo, CompressedImage, Image
from std_msgs.msg import UInt32
from sunlit.msg import Activity, Capture, MoonPosition, SunPosition
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "support"))
from programs import located  # noqa: E402

TIMEOUT_S = 60.0  # how long a machine under load may take for what should be seconds
PACKAGE = rospkg.RosPack().get_path("sunlit")
SUPPORT = os.path.join(PACKAGE, "test", "support", "worlds")
WORLD = os.path.join(SUPPORT, "two_boxes.urdf")
WAYPOINTS = os.path.join(SUPPORT, "straight.csv")
BOX_FACE_M = 12.0  # x of the face that the camera drives towards


def parameters(**changes):
    """A small camera on the way to the box."""
    tree = {"world": WORLD, "path": {"file": WAYPOINTS, "spacing": 0.5}, "start_stamp": 1000.0, "frame_rate": 8.0,
            "camera": {"width": 96, "height": 72, "supersampling": 1}, "night": {"enabled": False}}
    for key, value in changes.items():
        tree[key] = dict(tree[key], **value) if isinstance(tree.get(key), dict) else value
    return tree


def following(**changes):
    """The same camera after a TF frame, without what is for a path alone."""
    tree = parameters(**changes)
    tree["camera"]["follow"] = "tf"
    del tree["path"], tree["start_stamp"]
    return tree


def service(name, kind):
    rospy.wait_for_service(name, TIMEOUT_S)
    return rospy.ServiceProxy(name, kind)


def instant_of(capture):
    """Of its `utc`; Python reads a Z from 3.11 on."""
    return datetime.datetime.fromisoformat(capture.utc.replace("Z", "+00:00"))


class Process:
    """A node with these private parameters, until the end of the block."""

    def __init__(self, name, tree, program, namespace="", package="sunlit", arguments=()):
        self.name = ("/" + namespace if namespace else "") + "/" + name
        self.tree = tree
        self.command = [located(program, package), "__name:=" + name, *arguments]

    def __enter__(self):
        rospy.set_param(self.name, self.tree)
        self.process = subprocess.Popen(self.command,
                                        env=dict(os.environ, ROS_NAMESPACE=self.name.rpartition("/")[0] or "/",
                                                 ROSCONSOLE_STDOUT_LINE_BUFFERED="1"),
                                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.send_signal(2)  # as roslaunch does
        self.status = self.process.wait(TIMEOUT_S)
        self.process.stdout.close()
        rospy.delete_param(self.name)

    def line_with(self, part):
        """Reads what the node says until a line holds `part`."""
        said = []
        for line in self.process.stdout:
            said.append(line)
            if part in line:
                return line
        raise AssertionError("never said %r, but %s" % (part, "".join(said)))

    def end(self):
        """Status and lines of a node that ends by itself."""
        watchdog = threading.Timer(TIMEOUT_S, self.process.kill)
        watchdog.start()
        output = self.process.stdout.read()  # communicate() would lose what came along with the latest line_with()
        watchdog.cancel()
        return self.process.wait(TIMEOUT_S), [line for line in output.splitlines() if line.strip()]


class RenderNode(Process):

    def __init__(self, name, tree, namespace=""):
        super().__init__(name, tree, "render_node", namespace)


class RefusalTest(unittest.TestCase):
    """For tests of what ends a render node at once."""

    def assert_refused(self, tree, *parts):
        """Its status is not 0, and its one fatal line, which is returned, holds all `parts`."""
        with RenderNode("refused", tree) as node:
            status, lines = node.end()
        self.assertNotEqual(status, 0)
        fatal = [line for line in lines if "FATAL" in line]
        self.assertEqual(len(fatal), 1, lines)
        for part in parts:
            self.assertIn(part, fatal[0])
        return fatal[0]


class Sun:
    """A sun that stands still."""

    def __init__(self, topic, east=0.0, north=0.6, up=0.8):
        self.publisher = rospy.Publisher(topic, SunPosition, queue_size=1, latch=True)
        message = SunPosition(distance_au=1.0)
        message.header.frame_id = "map"
        message.direction.x, message.direction.y, message.direction.z = east, north, up
        message.elevation_geometric = math.asin(up)
        self.publisher.publish(message)


class Sky:
    """Sun, moon and stars that stand still; each is sent when asked for."""

    def __init__(self, prefix):
        self.publishers = [rospy.Publisher(prefix + name, kind, queue_size=1, latch=True)
                           for name, kind in (("sun", SunPosition), ("moon", MoonPosition), ("celestial", QuaternionStamped))]

    def _send(self, index, message, stamp):
        message.header.frame_id = message.header.frame_id or "map"
        message.header.stamp = rospy.Time.from_sec(stamp)
        self.publishers[index].publish(message)

    def send_sun(self, stamp=1.0, rate=0.0):
        message = SunPosition(distance_au=1.0, rate=rate, elevation_geometric=math.asin(0.8))
        message.direction.y, message.direction.z = 0.6, 0.8
        self._send(0, message, stamp)

    def send_moon(self, stamp=1.0, distance=3.844e8):
        message = MoonPosition(distance=distance, elevation_geometric=math.asin(0.8))
        message.direction.y, message.direction.z = -0.6, 0.8
        self._send(1, message, stamp)

    def send_celestial(self, stamp=1.0):
        message = QuaternionStamped()
        message.quaternion.w = 1.0
        self._send(2, message, stamp)


class Transforms(rospy.SubscribeListener):
    """A sender of TF to nodes that hear it already: what is sent before a connection stands is lost."""

    def __init__(self):
        super().__init__()
        self.changed = threading.Condition()
        self.heard = 0
        self.publisher = rospy.Publisher("/tf", TFMessage, queue_size=10, subscriber_listener=self)

    def peer_subscribe(self, *_):
        with self.changed:
            self.heard += 1
            self.changed.notify_all()

    def peer_unsubscribe(self, *_):
        with self.changed:
            self.heard -= 1

    def wait_for_readers(self, count):
        with self.changed:
            if not self.changed.wait_for(lambda: self.heard >= count, TIMEOUT_S):
                raise AssertionError("/tf: %d of %d readers" % (self.heard, count))

    def send(self, *transforms):
        self.publisher.publish(TFMessage(list(transforms)))

    def close(self):
        self.publisher.unregister()


class Reader:
    """Keeps every message of every stream, and tells the node how many poses it is done with."""

    def __init__(self, conditions, node="/render", prefix="", says_progress=True, compressed=False):
        self.changed = threading.Condition()
        self.messages = {}
        self.subscribers = []
        self.progress = rospy.Publisher("/reader/progress", UInt32, queue_size=1, latch=True)
        for condition in conditions:
            topic = prefix + (condition + "/" if condition else "") + "camera/"
            for name, kind in (("image_raw/compressed", CompressedImage) if compressed else ("image_raw", Image), ("camera_info", CameraInfo), ("capture", Capture)):
                self._subscribe(topic + name, kind)
        for name, kind in (("depth/image_raw", Image), ("depth/camera_info", CameraInfo), ("pose", PoseStamped)):
            self._subscribe(prefix + "camera/" + name, kind)
        self._subscribe("/tf", TFMessage)
        self._subscribe("/tf_static", TFMessage)
        self._subscribe(prefix + "path", Path)
        self._subscribe(node + "/progress", UInt32)
        if says_progress:
            self.done(0)

    def _subscribe(self, topic, kind):
        topic = rospy.resolve_name(topic if topic.startswith("/") else "/" + topic)
        self.messages[topic] = []
        # No limit to the queue: a test should lose nothing by itself.
        self.subscribers.append(rospy.Subscriber(topic, kind, self._keep, topic, queue_size=None))

    def _keep(self, message, topic):
        with self.changed:
            self.messages[topic].append(message)
            self.changed.notify_all()

    def of(self, topic):
        with self.changed:
            return list(self.messages[topic])

    def wait(self, topic, count):
        """The first `count` messages of a topic."""
        with self.changed:
            if not self.changed.wait_for(lambda: len(self.messages[topic]) >= count, TIMEOUT_S):
                raise AssertionError("%s: %d of %d messages" % (topic, len(self.messages[topic]), count))
            return self.messages[topic][:count]

    def wait_progress(self, topic, poses):
        with self.changed:
            reached = lambda: self.messages[topic] and self.messages[topic][-1].data >= poses
            if not self.changed.wait_for(reached, TIMEOUT_S):
                raise AssertionError("%s: %s, never %d" % (topic, self.messages[topic][-1:], poses))

    def wait_activity(self, topic, doing):
        self._subscribe(topic, Activity)  # latched
        with self.changed:
            reached = lambda: self.messages[topic] and self.messages[topic][-1].doing == doing
            if not self.changed.wait_for(reached, TIMEOUT_S):
                raise AssertionError("%s: %s, never %s" % (topic, self.messages[topic][-1:], doing))

    def done(self, poses):
        self.progress.publish(UInt32(data=poses))

    def close(self):
        for subscriber in self.subscribers:
            subscriber.unregister()
        self.progress.unregister()
