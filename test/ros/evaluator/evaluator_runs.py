"""Runs the evaluator node as a user would, and feeds it images over real topics."""
import os
import signal
import subprocess
import sys
import time
import warnings

import numpy
import rospy
from sensor_msgs.msg import Image
from std_msgs.msg import UInt32

from sunlit.msg import Capture

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..', 'support'))
from programs import located  # noqa: E402

# A publisher without a queue is what we want; see Streams.
warnings.filterwarnings('ignore', message='The publisher should be created')

LONGEST_WAIT_S = 120.0  # far above what any step takes; only bounds a failure
DIRECT = ['boolean_rgb', 'boolean_grey', 'euclidean_rgb', 'euclidean_grey']


def wait_until(condition, what):
    """Polls, since what is waited for is a file, a process or a connection."""
    end = time.monotonic() + LONGEST_WAIT_S
    while not condition():
        if time.monotonic() > end:
            raise AssertionError('waited %g s for %s' % (LONGEST_WAIT_S, what))
        time.sleep(0.005)


def picture(pose, stream, width=64, height=48):
    """Different for every pose and stream, always the same."""
    generator = numpy.random.RandomState(1000 * pose + stream)
    small = generator.randint(0, 256, (6, 8, 3))
    return numpy.kron(small, numpy.ones((height // 6, width // 8, 1))).astype(numpy.uint8)


def image_message(stamp, pixels, encoding='rgb8'):
    message = Image()
    message.header.stamp = stamp
    message.height, message.width = pixels.shape[:2]
    message.encoding = encoding
    message.step = pixels.strides[0]
    message.data = pixels.tobytes()
    return message


def stamp_of(pose):
    return rospy.Time(1000 + pose // 10, (pose % 10) * 100000000)


class Evaluator:
    """One process of evaluator_node, with parameters of its own."""
    count = 0

    def __init__(self, parameters, remapped=()):
        """Without a report, which takes seconds, unless they ask for it."""
        Evaluator.count += 1
        parameters = dict({'report': False}, **parameters)
        self.name = 'evaluator_%d' % Evaluator.count
        rospy.set_param('/' + self.name, parameters)
        self.progress = 0
        self.subscriber = rospy.Subscriber('/' + self.name + '/progress', UInt32, self.on_progress)
        self.process = subprocess.Popen([located('evaluator_node'), '__name:=' + self.name, *remapped],
                                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def on_progress(self, message):
        self.progress = message.data

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()

    def wait(self):
        """Exit status and everything that it logged."""
        try:
            output, _ = self.process.communicate(timeout=LONGEST_WAIT_S)
        except subprocess.TimeoutExpired:
            self.process.send_signal(signal.SIGINT)  # says what it waits for, and how far it came
            output, _ = self.process.communicate(timeout=LONGEST_WAIT_S)
            raise AssertionError('the evaluator still ran after %g s:\n%s' % (LONGEST_WAIT_S, output))
        return self.process.returncode, output


class Streams:
    """Publishers of several streams, connected to one evaluator before anything is sent."""

    def __init__(self, names):
        self.names = names
        # Without a queue, publish() returns when the message has been written to the socket: nothing is lost.
        self.images = [rospy.Publisher('/%s/camera/image_raw' % n, Image, queue_size=None) for n in names]
        self.captures = [rospy.Publisher('/%s/camera/capture' % n, Capture, queue_size=None) for n in names]

    def wait_for(self, evaluator):
        def is_connected():
            if evaluator.process.poll() is not None:
                raise AssertionError('the evaluator ended: ' + evaluator.process.stdout.read())
            # By name: rospy keeps connections to an evaluator that has ended until it sees them broken.
            return all(p.impl.has_connection('/' + evaluator.name) for p in self.images + self.captures)
        wait_until(is_connected, 'connections')

    def send(self, stream, stamp, pixels, encoding='rgb8'):
        self.images[stream].publish(image_message(stamp, pixels, encoding))

    def send_capture(self, stream, stamp, pose):
        message = Capture()
        message.header.stamp = stamp
        message.pose_index = pose
        message.ev100 = 14.5
        self.captures[stream].publish(message)

    def close(self):
        for publisher in self.images + self.captures:
            publisher.unregister()


def read(folder, name):
    with open(os.path.join(folder, name), 'rb') as file:
        return file.read()


def rows(folder, name):
    lines = read(folder, name).decode().splitlines()
    header = lines[0].split(',')
    return [dict(zip(header, line.split(',', len(header) - 1))) for line in lines[1:]]
