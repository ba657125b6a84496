#!/usr/bin/env python3
"""A camera with the lens of EuRoC slides along a painted wall: by its own D it is found as well as a pinhole is, and without
D it is not; from a bag and from live topics the same to the byte."""
import os
import subprocess
import sys
import tempfile
import unittest

import cv2
import numpy
import rosbag
import rospy
import rostest
import yaml
from sensor_msgs.msg import CameraInfo, CompressedImage

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from evaluator_runs import Evaluator, Streams, image_message, located, read, rows, stamp_of  # noqa: E402
from test_evaluator_localise import PARAMETERS, POSES, STEP_M, STREAMS, WALL_M, Truth, place  # noqa: E402

SCALE = 0.4  # of EuRoC's 752 x 480
WIDTH, HEIGHT = 300, 192
K = numpy.array([[458.654, 0, 367.215], [0, 457.296, 248.375], [0, 0, 1 / SCALE]]) * SCALE
EUROC_D = [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.0]
NO_D = [0.0] * 5
PX_A_METRE = 60  # of the paint
LEFT_M, ABOVE_M = 9.0, 7.0  # of the first place, to the edge of the paint


def painted():
    random = numpy.random.RandomState(5)
    height, width = int(2 * ABOVE_M * PX_A_METRE), int((2 * LEFT_M + STEP_M * POSES) * PX_A_METRE)
    paint = numpy.full((height, width, 3), 128, numpy.uint8)
    for _ in range(6000):
        at = (int(random.randint(width)), int(random.randint(height)))
        cv2.circle(paint, at, int(random.randint(4, 22)), (int(random.randint(256)),) * 3, -1)
    return cv2.GaussianBlur(paint, (0, 0), 2.0)


PAINT = painted()


def rays(distortion):
    """Of each pixel, x and y where z is 1."""
    pixels = numpy.stack(numpy.meshgrid(numpy.arange(WIDTH), numpy.arange(HEIGHT)), axis=-1).reshape(-1, 1, 2).astype(float)
    criteria = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 100, 1e-12)
    found = cv2.undistortPointsIter(pixels, K, numpy.array(distortion), numpy.eye(3), numpy.eye(3), criteria)
    return found.reshape(HEIGHT, WIDTH, 2)


class Drive:
    """What a camera with the lens `bent` by sends of its way, which says that it were bent by `told`."""

    def __init__(self, bent, told):
        self.rays, self.told = rays(bent), told

    def picture(self, pose, stream):
        x, y = self.rays[..., 0] * WALL_M + STEP_M * pose, self.rays[..., 1] * WALL_M
        seen = cv2.remap(PAINT, ((x + LEFT_M) * PX_A_METRE).astype(numpy.float32),
                         ((y + ABOVE_M) * PX_A_METRE).astype(numpy.float32), cv2.INTER_LINEAR)
        return seen if stream == 0 else (seen * 0.4).astype(numpy.uint8)

    def info(self, pose):
        info = CameraInfo(width=WIDTH, height=HEIGHT, distortion_model='plumb_bob', D=self.told, K=list(K.flat))
        info.header.stamp = stamp_of(pose)
        info.R = list(numpy.eye(3).flat)
        info.P = list(numpy.hstack([K, numpy.zeros((3, 1))]).flat)
        return info

    @staticmethod
    def depth(pose):
        """Along the axis, so that of a wall across it all pixels have the same, whatever the lens."""
        return image_message(stamp_of(pose), numpy.full((HEIGHT, WIDTH), WALL_M, numpy.float32), '32FC1')


class Rectified(Streams):
    """Of image_proc, whose pictures are those of P; as PNG."""

    def __init__(self, names):
        super().__init__(names)
        for publisher in self.images:
            publisher.unregister()
        topics = {'%s/camera/image_raw/compressed' % name: '/%s/cam/image_rect_color/compressed' % name for name in names}
        self.images = [rospy.Publisher(topic, CompressedImage, queue_size=None) for topic in topics.values()]
        self.remapped = ['%s:=%s' % item for item in topics.items()]

    def send(self, stream, stamp, pixels, encoding='rgb8'):
        message = CompressedImage(format='png', data=cv2.imencode('.png', pixels[..., ::-1])[1].tobytes())
        message.header.stamp = stamp
        self.images[stream].publish(message)


class TestLens(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def from_bag(self, name, drive):
        """SIFT's errors in m."""
        with rosbag.Bag(self.path(name + '.bag'), 'w') as bag:
            for pose in range(POSES):
                for stream, called in enumerate(STREAMS):
                    bag.write('/%s/camera/image_raw' % called, image_message(stamp_of(pose), drive.picture(pose, stream)),
                              stamp_of(pose))
                    bag.write('/%s/camera/camera_info' % called, drive.info(pose), stamp_of(pose))
                bag.write('/camera/pose', place(pose), stamp_of(pose))
                bag.write('/camera/depth/image_raw', drive.depth(pose), stamp_of(pose))
        with open(self.path('config.yaml'), 'w') as file:
            yaml.safe_dump(dict(PARAMETERS, output_dir='by --out'), file)
        done = subprocess.run([located('evaluate_bags'), '--out', self.path(name), '--config', self.path('config.yaml'),
                               self.path(name + '.bag')], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=100)
        self.assertEqual(done.returncode, 0, done.stdout)
        return self.errors(name)

    def errors(self, name):
        found = [row for row in rows(self.path(name), 'localisation.csv') if row['detector'] == 'sift']
        self.assertEqual([row['status'] for row in found], ['localised'] * POSES)
        return numpy.array([float(row['error_m']) for row in found])

    def live(self, name, drive, streams=None, **parameters):
        streams, truth = streams or Streams(STREAMS), Truth()
        self.addCleanup(streams.close)
        self.addCleanup(truth.close)
        evaluator = Evaluator(dict(PARAMETERS, output_dir=self.path(name), frame_rate=10.0, stamp_start='1000.0',
                                   exit_when_done=True, **parameters), getattr(streams, 'remapped', ()))
        streams.wait_for(evaluator)
        truth.wait_for(evaluator)
        for pose in range(POSES):
            truth.send(pose, drive.depth, drive.info)
            for stream in range(len(STREAMS)):
                streams.send(stream, stamp_of(pose), drive.picture(pose, stream))
        status, output = evaluator.wait()
        self.assertEqual(status, 0, output)

    def test_the_lens_of_euroc_is_seen_through(self):
        bent = Drive(EUROC_D, EUROC_D)
        by_d = self.from_bag('by_d', bent)
        ignored = self.from_bag('ignored', Drive(EUROC_D, NO_D))
        pinhole = self.from_bag('pinhole', Drive(NO_D, NO_D))
        print('median errors: %.4f m by D, %.4f m without, %.4f m of a pinhole' % tuple(map(numpy.median, (by_d, ignored, pinhole))))
        # A key point is good to a fifth of a pixel of 27 mm, and tens of them are averaged: a centimetre holds for either camera.
        for errors in (by_d, pinhole):
            self.assertLess(errors.max(), 0.01, errors)
        # Between key frames, which stand every second pose and forgive a lens that both pictures share.
        self.assertGreater(ignored[1::2].min(), 0.1, ignored)
        self.live('live', bent)
        for name in ('localisation.csv', 'localisation_summary.csv'):
            self.assertEqual(read(self.path('live'), name), read(self.path('by_d'), name), name)

    def test_rectified_pictures_that_come_compressed_are_not_bent_again(self):
        self.live('rectified', Drive(NO_D, EUROC_D), Rectified(STREAMS), image_transport='compressed')
        self.assertLess(self.errors('rectified').max(), 0.01)  # as a pinhole below


if __name__ == '__main__':
    rospy.init_node('test_evaluator_lens')
    rostest.rosrun('sunlit', 'evaluator_lens', TestLens)
