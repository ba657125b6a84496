#!/usr/bin/env python3
"""A camera slides along a painted wall, at noon and at dusk: where each picture of dusk is in a map of noon, from live topics,
from a bag by the same parameters and by --map and --query, is the same to the byte."""
import math
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
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from sensor_msgs.msg import CameraInfo, Image
from sunlit.msg import Localisation, LocalisationSummary
from visualization_msgs.msg import MarkerArray

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from evaluator_runs import Evaluator, Streams, image_message, located, read, rows, stamp_of, wait_until  # noqa: E402

STREAMS = ['noon', 'dusk']
POSES = 6
FRAME = 'odom'  # whatever the poses are sent in
WIDTH, HEIGHT, FOCAL_PX = 160, 120, 100.0
WALL_M = 5.0
STEP_PX = 10  # a pose
STEP_M = STEP_PX * WALL_M / FOCAL_PX
PARAMETERS = {'streams': STREAMS, 'differences': ['boolean_rgb', 'sift', 'orb'], 'poses': POSES,
              'localisation': {'map': 'noon', 'map_every': 1.0}}


def wall():
    """Grey blobs, as wide as all pictures together."""
    random = numpy.random.RandomState(3)
    paint = numpy.full((HEIGHT, WIDTH + STEP_PX * POSES, 3), 128, numpy.uint8)
    for _ in range(700):
        place = (int(random.randint(paint.shape[1])), int(random.randint(HEIGHT)))
        cv2.circle(paint, place, int(random.randint(2, 9)), (int(random.randint(256)),) * 3, -1)
    return cv2.GaussianBlur(paint, (0, 0), 1.0)


WALL = wall()


def picture(pose, stream):
    left = STEP_PX * pose
    seen = WALL[:, left:left + WIDTH]
    return numpy.ascontiguousarray(seen if stream == 0 else (seen * 0.4).astype(numpy.uint8))


def camera_info(pose):
    info = CameraInfo(width=WIDTH, height=HEIGHT, distortion_model='plumb_bob', D=[0.0] * 5)
    info.header.stamp = stamp_of(pose)
    cx, cy = (WIDTH - 1) / 2, (HEIGHT - 1) / 2
    info.K = [FOCAL_PX, 0, cx, 0, FOCAL_PX, cy, 0, 0, 1]
    info.R = [1, 0, 0, 0, 1, 0, 0, 0, 1]
    info.P = [FOCAL_PX, 0, cx, 0, 0, FOCAL_PX, cy, 0, 0, 0, 1, 0]
    return info


def depth(pose):
    return image_message(stamp_of(pose), numpy.full((HEIGHT, WIDTH), WALL_M, numpy.float32), '32FC1')


def place(pose):
    """The link looks along x at the wall, so that the picture's right is −y."""
    message = PoseStamped()
    message.header.stamp = stamp_of(pose)
    message.header.frame_id = FRAME
    message.pose.position.y = -STEP_M * pose
    message.pose.orientation.w = 1.0
    return message


class Truth:
    """Publishers of what is known beside the images; without a queue, as Streams."""

    def __init__(self):
        self.poses = rospy.Publisher('/camera/pose', PoseStamped, queue_size=None)
        self.depths = rospy.Publisher('/camera/depth/image_raw', Image, queue_size=None)
        self.cameras = [rospy.Publisher('/%s/camera/camera_info' % name, CameraInfo, queue_size=None) for name in STREAMS]

    def all(self):
        return [self.poses, self.depths] + self.cameras

    def wait_for(self, evaluator):
        wait_until(lambda: all(one.impl.has_connection('/' + evaluator.name) for one in self.all()), 'connections')

    def send(self, pose, deep=depth, info=camera_info):
        self.poses.publish(place(pose))
        self.depths.publish(deep(pose))
        for camera in self.cameras:
            camera.publish(info(pose))

    def close(self):
        for publisher in self.all():
            publisher.unregister()


class Listener:
    """What an evaluator says of what it localised."""

    def __init__(self, name):
        self.queries, self.poses, self.markers, self.summaries = [], [], [], []
        self.subscribers = [
            rospy.Subscriber('/%s/localisation' % name, Localisation, self.queries.append),
            rospy.Subscriber('/%s/localisation/dusk/sift/pose' % name, PoseWithCovarianceStamped, self.poses.append),
            rospy.Subscriber('/%s/localisation/markers' % name, MarkerArray, self.markers.append),
            rospy.Subscriber('/%s/localisation/summary' % name, LocalisationSummary, self.summaries.append)]

    def has_heard_all(self):
        return len(self.queries) == 2 * POSES and len(self.poses) == POSES and self.markers and self.summaries


class TestLocalise(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def write_bag(self, name, depths=range(POSES), without=(), first=0):
        with rosbag.Bag(self.path(name), 'w') as bag:
            for pose in range(first, POSES):
                for stream, called in enumerate(STREAMS):
                    if (called, pose) not in without:
                        bag.write('/%s/camera/image_raw' % called, image_message(stamp_of(pose), picture(pose, stream)),
                                  stamp_of(pose))
                    bag.write('/%s/camera/camera_info' % called, camera_info(pose), stamp_of(pose))
                bag.write('/camera/pose', place(pose), stamp_of(pose))
            for pose in depths:
                bag.write('/camera/depth/image_raw', depth(pose), stamp_of(pose))

    def evaluate_bags(self, *arguments):
        return subprocess.run([located('evaluate_bags')] + list(arguments), stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=100)

    def config(self):
        with open(self.path('config.yaml'), 'w') as file:
            yaml.safe_dump(dict(PARAMETERS, output_dir='by --out', report=False), file)
        return self.path('config.yaml')

    def live(self, name, exit_when_done=False):
        streams, truth = Streams(STREAMS), Truth()
        self.addCleanup(streams.close)
        self.addCleanup(truth.close)
        evaluator = Evaluator(dict(PARAMETERS, output_dir=self.path(name), frame_rate=10.0, stamp_start='1000.0',
                                   exit_when_done=exit_when_done))
        listener = Listener(evaluator.name)
        streams.wait_for(evaluator)
        truth.wait_for(evaluator)
        for pose in range(POSES):
            truth.send(pose)
            for stream in range(len(STREAMS)):
                streams.send(stream, stamp_of(pose), picture(pose, stream))
        return evaluator, listener

    def test_live_and_from_bags_it_is_the_same(self):
        evaluator, listener = self.live('live')
        wait_until(listener.has_heard_all, 'what was localised')
        evaluator.process.terminate()
        status, output = evaluator.wait()
        self.assertEqual(status, 0, output)
        found = rows(self.path('live'), 'localisation.csv')
        self.assertEqual(len(found), 2 * POSES)
        for row in found:
            # Features stay within a few tenths of a pixel of a twentieth of a metre each; tens of them are averaged.
            self.assertEqual(row['status'], 'localised', row)
            self.assertLess(float(row['error_m']), 0.05, row)
        self.check_messages(listener, found)
        # Taken up when it is whole, it is told of again.
        again = Evaluator(dict(PARAMETERS, output_dir=self.path('live'), frame_rate=10.0, stamp_start='1000.0'))
        told = Listener(again.name)
        wait_until(lambda: told.summaries, 'the summary')
        again.process.terminate()
        status, output = again.wait()
        self.assertEqual(status, 0, output)
        self.assertEqual(told.summaries[-1].rows, listener.summaries[-1].rows)
        self.assertIn('AUC@5/10/20 deg', output)

        self.write_bag('all.bag')
        done = self.evaluate_bags('--out', self.path('bag'), '--config', self.config(), self.path('all.bag'))
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn('dusk', done.stdout)
        done = self.evaluate_bags('--out', self.path('map'), '--map', self.path('all.bag:noon'), '--query',
                                  self.path('all.bag:dusk'), '--map-every', '1')
        self.assertEqual(done.returncode, 0, done.stdout)
        for name in ('localisation.csv', 'localisation_summary.csv'):
            self.assertEqual(read(self.path('live'), name), read(self.path('bag'), name), name)
            self.assertEqual(read(self.path('live'), name), read(self.path('map'), name), name)
        compared = read(self.path('live'), 'comparisons.csv').decode().splitlines()
        self.assertEqual(compared, read(self.path('bag'), 'comparisons.csv').decode().splitlines())
        of_queries = [line for line in compared if ',dusk in noon,' in line]
        self.assertEqual(len(of_queries), 4)  # SIFT and ORB, within three reaches and in metres
        self.assertEqual(compared[:1] + of_queries, read(self.path('map'), 'comparisons.csv').decode().splitlines())

    def test_queries_of_two_bags_are_compared_where_they_are_of_one_place(self):
        # The later drive begins two poses further on, so that its images have other numbers at the same places.
        self.write_bag('first.bag')
        self.write_bag('later.bag', first=2)
        done = self.evaluate_bags('--out', self.path('two'), '--map', self.path('first.bag:noon'), '--query',
                                  self.path('first.bag:dusk'), '--query', self.path('later.bag:dusk'), '--map-every', '1')
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, 'have no common numbers of poses, and were paired by place: %d pairs, 2 queries without one' % (POSES - 2))
        hours = [row for row in rows(self.path('two'), 'comparisons.csv') if row['family'] == 'hours']
        self.assertEqual(len(hours), 4 * 2)
        for row in hours:
            self.assertEqual((row['n'], row['unpaired']), (str(POSES - 2), '2'), row)
            self.assertEqual(float(row['mean_difference']), 0.0, row)  # they are the same pictures

    def check_messages(self, listener, found):
        by_key = {(message.pose, message.detector): message for message in listener.queries}
        self.assertEqual(len(by_key), 2 * POSES)
        for row in found:
            message = by_key[int(row['pose']), row['detector']]
            self.assertEqual((message.map, message.query, message.status), ('noon', 'dusk', 'localised'))
            self.assertEqual(message.header.frame_id, FRAME)
            self.assertEqual(message.error, float(row['error_m']))
            self.assertAlmostEqual(math.degrees(message.rotation_error), float(row['error_deg']), 9)
            # The message is of camera_link, whose y the wall lets slide.
            self.assertAlmostEqual(message.truth.position.y, -STEP_M * message.pose, 9)
            offset = [getattr(message.estimate.pose.position, axis) - getattr(message.truth.position, axis) for axis in 'xyz']
            self.assertAlmostEqual(math.hypot(*offset), message.error, 9)
            self.assertGreater(message.estimate.covariance[0], 0.0)
            # A key frame stands every second pose; the nearest shares most of what is seen.
            self.assertEqual((message.key_frame_stream, message.key_frame % 2), ('noon', 0))
            self.assertLessEqual(abs(message.key_frame - message.pose), 1)
        self.assertEqual([one.ns for one in listener.markers[-1].markers], ['truth', 'estimate'])
        self.assertEqual({one.header.frame_id for one in listener.markers[-1].markers + listener.poses}, {FRAME})
        self.assertEqual(len(listener.markers[-1].markers[1].points), 2 * 2 * POSES)
        summary = {row.detector: row for row in listener.summaries[-1].rows}
        self.assertEqual((summary['sift'].queries, summary['sift'].failures, summary['sift'].within[0]), (POSES, 0, 1.0))

    def test_bags_without_a_topic_to_localise_by_are_refused(self):
        self.write_bag('blind.bag', depths=[])
        done = self.evaluate_bags('--out', self.path('blind'), '--config', self.config(), self.path('blind.bag'))
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn('localisation/map is "noon", but must be empty for bags without /camera/depth/image_raw; they hold: '
                      '/camera/pose, /dusk/camera/camera_info', done.stdout)
        self.assertFalse(os.path.exists(self.path('blind/run.yaml')))

    def test_without_depth_the_status_says_so(self):
        self.write_bag('blind.bag', depths=[POSES], without=[('dusk', 0)])  # of a stamp that no image has
        done = self.evaluate_bags('--out', self.path('blind'), '--config', self.config(), self.path('blind.bag'))
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertIn('1 missing_partner (noon-dusk); each is named in %s/problems.csv; nothing localised: the map has no key '
                      'frame' % self.path('blind'), done.stdout)
        named = rows(self.path('blind'), 'problems.csv')
        self.assertEqual({row['where'] for row in named if row['kind'] == 'unlocalised'}, {'noon'})
        self.assertFalse(os.path.exists(self.path('blind/localisation.csv')))


if __name__ == '__main__':
    rospy.init_node('test_evaluator_localise')
    rostest.rosrun('sunlit', 'evaluator_localise', TestLocalise)
