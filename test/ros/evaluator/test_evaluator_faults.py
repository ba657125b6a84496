#!/usr/bin/env python3
"""Everything that can go wrong with streams: 991 of 991 good pairs are evaluated, all else is counted and named."""
import os
import random
import shutil
import sys
import tempfile
import unittest

import numpy
import rospy
import rostest
import yaml
from geometry_msgs.msg import PoseStamped
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from evaluator_runs import (DIRECT, Evaluator, Streams, image_message, picture, read, rows, stamp_of,  # noqa: E402
                            wait_until)

POSES = 991
STREAMS = ['h04', 'h12', 'h20']


def send_pose(streams, pose, only=(0, 1, 2)):
    for stream in only:
        streams.send(stream, stamp_of(pose), picture(pose, stream))


class TestFaults(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.streams = Streams(STREAMS)

    def tearDown(self):
        self.streams.close()
        self.folder.cleanup()

    def settings(self, **parameters):
        return dict({'streams': STREAMS, 'differences': DIRECT, 'output_dir': self.folder.name + '/out',
                     'images': 'none', 'exit_when_done': True}, **parameters)

    def start(self, **parameters):
        evaluator = Evaluator(self.settings(**parameters))
        self.streams.wait_for(evaluator)
        return evaluator

    def wait_for_progress(self, evaluator, poses):
        wait_until(lambda: evaluator.progress == poses or evaluator.process.poll() is not None, '%d poses' % poses)
        self.assertIsNone(evaluator.process.poll(), 'the evaluator ended by itself')

    def run_file(self):
        return yaml.safe_load(read(self.folder.name + '/out', 'run.yaml'))

    def problems(self, kind):
        return [row for row in rows(self.folder.name + '/out', 'problems.csv') if row['kind'] == kind]

    def assert_all_evaluated(self, status, output):
        self.assertEqual(status, 0, output)
        summary = rows(self.folder.name + '/out', 'summary.csv')
        self.assertEqual(len(summary), 3 * len(DIRECT))
        for row in summary:
            self.assertEqual(row['n'], str(POSES))

    def test_a_stream_that_lags_by_500_frames_loses_nothing(self):
        evaluator = self.start(poses=POSES)
        for pose in range(POSES + 500):
            if pose < POSES:
                send_pose(self.streams, pose, (0, 1))
            if pose >= 500:
                send_pose(self.streams, pose - 500, (2,))
        self.assert_all_evaluated(*evaluator.wait())
        self.assertEqual(self.problems('dropped'), [])

    def test_images_out_of_order_are_used_and_counted(self):
        evaluator = self.start(poses=POSES)
        order = list(range(POSES))
        random.Random(1).shuffle(order)
        for pose in range(POSES):
            send_pose(self.streams, pose, (0, 1))
            send_pose(self.streams, order[pose], (2,))
        self.assert_all_evaluated(*evaluator.wait())
        newest, late = -1, 0
        for pose in order:
            late += pose < newest
            newest = max(newest, pose)
        self.assertEqual(self.run_file()['counters']['streams']['h20']['out_of_order'], late)
        self.assertEqual(len(self.problems('out_of_order')), late)

    def test_duplicate_stamps_are_counted_and_the_first_image_stays(self):
        evaluator = self.start(poses=POSES)
        for pose in range(POSES):
            send_pose(self.streams, pose, (0,))
            if pose % 10 == 3:
                self.streams.send(0, stamp_of(pose), picture(pose, 0))  # while its set still waits
            send_pose(self.streams, pose, (1, 2))
            if pose % 10 == 5 and pose < 980:
                self.streams.send(1, stamp_of(pose), picture(12345, 1))  # after its set was whole, other content
        self.assert_all_evaluated(*evaluator.wait())
        counters = self.run_file()['counters']['streams']
        self.assertEqual([counters[s]['duplicate'] for s in STREAMS], [99, 98, 0])
        self.assertEqual(len(self.problems('duplicate')), 99 + 98)

    def test_missing_partners_are_named_and_all_other_pairs_evaluated(self):
        lost = {1: {7, 500, 900}, 2: {7, 8}}
        evaluator = self.start(poses=POSES)
        for pose in range(POSES):
            send_pose(self.streams, pose, [s for s in range(3) if pose not in lost.get(s, ())])
        # The last pose is whole, and each stream keeps its order: with it, all that was sent has come.
        self.wait_for_progress(evaluator, POSES - len({7, 8, 500, 900}))
        self.assertTrue(rospy.ServiceProxy('/%s/finish' % evaluator.name, Trigger)().success)
        status, output = evaluator.wait()
        self.assertEqual(status, 3, output)
        self.assertIn('3 missing_partner (h04-h12), 2 missing_partner (h04-h20), 4 missing_partner (h12-h20)', output)
        counters = self.run_file()['counters']['pairs']
        self.assertEqual(counters['h04-h12']['evaluated'], POSES - 3)
        self.assertEqual(counters['h04-h20']['evaluated'], POSES - 2)
        self.assertEqual(counters['h12-h20']['evaluated'], POSES - 4)
        named = {(int(row['pose']), row['where']) for row in self.problems('missing_partner')}
        self.assertEqual(named, {(7, 'h04-h12'), (500, 'h04-h12'), (900, 'h04-h12'), (7, 'h04-h20'), (8, 'h04-h20'),
                                 (7, 'h12-h20'), (500, 'h12-h20'), (900, 'h12-h20'), (8, 'h12-h20')})

    def test_poses_that_are_none_are_named_and_left_out_of_the_path(self):
        places = rospy.Publisher('/camera/pose', PoseStamped, queue_size=None)
        evaluator = self.start(poses=4)
        wait_until(lambda: places.get_num_connections() > 0, 'a reader of poses')
        for pose, (east, turn) in enumerate([(1.0, 1.0), (float('nan'), 1.0), (3.0, 0.0), (4.0, 1.0), (5.0, 1.0), (6.0, 0.0)]):
            message = PoseStamped()
            message.header.stamp = stamp_of(pose)
            message.pose.position.x, message.pose.orientation.w = east, turn
            places.publish(message)
            if pose < 3:
                send_pose(self.streams, pose)
        wait_until(lambda: len(self.problems('unusable')) == 3, 'places')
        places.unregister()
        send_pose(self.streams, 3)
        status, output = evaluator.wait()
        self.assertEqual(status, 0, output)
        self.assertEqual(self.places(), [('0', '1'), ('3', '4')])  # not the fifth, of which there is no image
        self.assertIn('path.csv: 1 poses of stamps without an image left out', output)
        self.assertEqual([row['stamp'] for row in self.problems('unusable')], ['%.9f' % stamp_of(p).to_sec() for p in (1, 2, 5)])

    def test_poses_of_other_frames_are_warned_of(self):
        places = rospy.Publisher('/camera/pose', PoseStamped, queue_size=None)
        evaluator = self.start(poses=4)
        wait_until(lambda: places.get_num_connections() > 0, 'a reader of poses')
        for pose, frame in enumerate(['/map', 'map', 'odom', 'odom']):
            message = PoseStamped()
            message.header.stamp, message.header.frame_id = stamp_of(pose), frame
            message.pose.orientation.w = 1.0
            places.publish(message)
            if pose < 3:
                send_pose(self.streams, pose)
        wait_until(lambda: self.problems('other_frame'), 'a warning')
        places.unregister()
        send_pose(self.streams, 3)
        status, output = evaluator.wait()
        self.assertEqual(status, 0, output)
        warning = 'poses of /camera/pose are in the frame odom, others in map: errors mean nothing unless these are one frame'
        self.assertEqual(output.count(warning), 1, output)
        self.assertEqual([(row['stamp'], row['reason'].strip('"')) for row in self.problems('other_frame')],
                         [('1000.200000000', warning)])

    def places(self):
        return [(row['pose'], row['x']) for row in rows(self.folder.name + '/out', 'path.csv')]

    def test_a_capture_of_no_image_says_nothing_of_those_that_come(self):
        captures = self.folder.name + '/out/captures.csv'
        evaluator = self.start(poses=4)
        for pose in range(4):
            if pose == 2:
                self.streams.send_capture(0, stamp_of(500), 3)
                wait_until(lambda: os.path.exists(captures) and len(rows(*os.path.split(captures))) == 1, 'the capture')
            send_pose(self.streams, pose)
            if pose < 3:
                self.wait_for_progress(evaluator, pose + 1)
        status, output = evaluator.wait()
        self.assertEqual(status, 0, output)
        self.assertIn('captures.csv: 1 stamps, none of them that of an image: poses are numbered by the order of their '
                      'images', output)
        self.assertEqual([row['n'] for row in rows(self.folder.name + '/out', 'summary.csv')], ['4'] * 3 * len(DIRECT))

    def test_silence_ends_a_run_and_what_it_has_is_written(self):
        first = self.start(poses=4)
        for pose in range(3):
            send_pose(self.streams, pose)
        self.wait_for_progress(first, 3)
        first.kill()
        # Taken up again, and now nobody sends anything: a slow machine only ends later.
        status, output = Evaluator(self.settings(poses=4, idle_timeout=1.0)).wait()
        self.assertEqual(status, 3, output)
        self.assertIn('no image for 1 s', output)
        self.assertEqual({row['n'] for row in rows(self.folder.name + '/out', 'summary.csv')}, {'3'})

    def test_a_folder_that_is_removed_or_moved_ends_the_run_at_once(self):
        for take_away in (shutil.rmtree, lambda folder: os.rename(folder, folder + '_elsewhere')):
            evaluator = self.start(poses=4)
            send_pose(self.streams, 0)
            self.wait_for_progress(evaluator, 1)
            take_away(self.folder.name + '/out')
            status, output = evaluator.wait()
            self.assertEqual(status, 1, output)
            self.assertIn(self.folder.name + '/out: this folder was removed, moved or replaced', output)

    def test_unusable_images_are_named_and_the_node_ends_with_status_3(self):
        evaluator = self.start(poses=POSES)
        for pose in range(POSES):
            send_pose(self.streams, pose, (0, 2))
            message = image_message(stamp_of(pose), picture(pose, 1))
            if pose == 100:
                message.data = message.data[:-1]  # truncated
            elif pose == 101:
                message.encoding = '32FC1'
            elif pose == 102:
                message.encoding = 'no such encoding'
            elif pose == 103:
                message.step = 10
            elif pose == 104:
                message.height = message.width = message.step = 0
                message.data = b''
            elif pose == 105:  # another size in one stream
                message = image_message(stamp_of(pose), picture(pose, 1, 32, 24))
            self.streams.images[1].publish(message)
        status, output = evaluator.wait()
        self.assertEqual(status, 3, output)
        pairs = self.run_file()['counters']['pairs']
        for name in ('h04-h12', 'h12-h20'):
            self.assertEqual((pairs[name]['evaluated'], pairs[name]['undecodable'], pairs[name]['size_mismatch']),
                             (POSES - 6, 5, 1))
        self.assertEqual(pairs['h04-h20']['evaluated'], POSES)
        reasons = {int(r['pose']): r['reason'] for r in self.problems('undecodable') if r['where'] == 'h12'}
        self.assertEqual(sorted(reasons), [100, 101, 102, 103, 104])
        self.assertIn('bytes instead of', reasons[100])
        self.assertIn('32FC1', reasons[101])
        self.assertIn('step 10', reasons[103])
        self.assertEqual({r['reason'] for r in self.problems('size_mismatch')}, {'64x48 against 32x24', '32x24 against 64x48'})

    def test_encodings_of_one_picture_are_equal(self):
        evaluator = self.start(poses=5, pairs=[['h04', 'h12']])
        for pose in range(5):
            rgb = picture(pose, 0)
            other = {0: ('rgb8', rgb), 1: ('bgr8', rgb[:, :, ::-1].copy()), 2: ('rgba8', self.with_alpha(rgb)),
                     3: ('bgra8', self.with_alpha(rgb[:, :, ::-1])), 4: ('mono8', rgb[:, :, 0].copy())}[pose]
            if pose == 4:
                rgb = rgb[:, :, [0, 0, 0]].copy()
            self.streams.send(0, stamp_of(pose), rgb)
            self.streams.send(1, stamp_of(pose), other[1], other[0])
        status, output = evaluator.wait()
        self.assertEqual(status, 0, output)
        self.assertEqual({row['value'] for row in rows(self.folder.name + '/out', 'frames.csv')}, {'0'})

    @staticmethod
    def with_alpha(pixels):
        alpha = numpy.full(pixels.shape[:2] + (1,), 77, numpy.uint8)
        return numpy.concatenate([pixels, alpha], axis=2)


if __name__ == '__main__':
    rospy.init_node('test_evaluator_faults')
    rostest.rosrun('sunlit', 'test_evaluator_faults', TestFaults)
