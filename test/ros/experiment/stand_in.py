#!/usr/bin/python3
"""Stands in for the renderer or the evaluator of an experiment, to leave at moments that the true ones hardly ever choose.

stand_in.py render: leaves once it has heard that everything is evaluated; with ~images, only after the evaluator has, and so
many images, which it sends to the recorder then. stand_in.py evaluator: has evaluated everything from the start; with
~is_slow it writes its results only once there is a file `go` in the output folder.
"""
import os
import sys
import threading
import xmlrpc.client

import rosgraph
import rospy
from sensor_msgs.msg import Image
from std_msgs.msg import UInt32

LOOK_EVERY_S = 0.02  # at a master, which tells nobody of a node that leaves
POSES = 3
LISTENERS = 2  # the renderer, and the watcher, which shows how far it is


def await_true(condition):
    while not condition() and not rospy.is_shutdown():
        rospy.rostime.wallsleep(LOOK_EVERY_S)


def has_left(name):
    """Whether a node that was there has gone."""
    try:
        rosgraph.Master("/stand_in").lookupNode(name)
    except rosgraph.MasterError:
        return True
    return False


def recorded(topic):
    """How many messages the recorder has received."""
    recorder = xmlrpc.client.ServerProxy(rosgraph.Master("/stand_in").lookupNode("/recorder"))
    _, subscriptions, _ = recorder.getBusStats("/stand_in")[2]
    return sum(connection[2] for name, connections in subscriptions if name == topic for connection in connections)


def render():
    heard = threading.Event()
    rospy.Subscriber("/evaluator/progress", UInt32, lambda progress: heard.set())
    topics, images = rospy.get_param("~topics", []), rospy.get_param("~images", 0)
    senders = [rospy.Publisher(topic, Image, queue_size=None) for topic in topics]  # None: sent at once
    heard.wait()
    if not senders:
        return
    await_true(lambda: all(sender.get_num_connections() for sender in senders))
    await_true(lambda: has_left("/evaluator"))
    for pose in range(images):
        image = Image()
        image.header.stamp = rospy.Time(1000, pose * 100000000)
        for sender in senders:
            sender.publish(image)
    await_true(lambda: all(recorded(topic) == images for topic in topics))


class Visits(rospy.SubscribeListener):
    """Who asks for a topic."""

    def __init__(self):
        super().__init__()
        self.count = 0
        self.told = threading.Event()  # all that have to be

    def peer_subscribe(self, topic_name, topic_publish, peer_publish):
        peer_publish(UInt32(data=POSES))
        self.count += 1
        if self.count >= LISTENERS:
            self.told.set()


def evaluator():
    visits = Visits()
    progress = rospy.Publisher("/evaluator/progress", UInt32, subscriber_listener=visits, queue_size=None)
    visits.told.wait()
    output = rospy.get_param("~output")
    if rospy.get_param("~is_slow", False):
        await_true(lambda: os.path.exists(os.path.join(output, "go")))
    with open(os.path.join(output, "summary.csv"), "w") as summary:
        summary.write("a,b,difference,n,undefined,mean,sd,ci_low,ci_high\nh10,h12,orb,%d,0,0.5,0.1,0.4,0.6\n" % POSES)
    with open(os.path.join(output, "run.yaml"), "w") as run:
        run.write("outcome:\n  whole: true\n")
    progress.unregister()


if __name__ == "__main__":
    rospy.init_node("stand_in")
    {"render": render, "evaluator": evaluator}[sys.argv[1]]()
