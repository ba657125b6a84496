#!/usr/bin/env python3
"""Senders that do not wait, and what they may send: memory stays within its limit, an end in the middle writes all
files, all that was lost is counted and named."""
import contextlib
import functools
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from xmlrpc.client import ServerProxy

import cv2
import numpy
import rosgraph
import rospy
import rostest
import yaml
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from sensor_msgs.msg import CompressedImage, Image
from std_srvs.srv import Trigger
from sunlit.msg import PairDifference

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from evaluator_runs import (DIRECT, LONGEST_WAIT_S, Evaluator, Streams, image_message, located, picture, read,  # noqa: E402
                            rows, stamp_of, wait_until)

STREAMS = ['h04', 'h12']
FILES = ['frames.csv', 'problems.csv', 'run.yaml', 'summary.csv']


@functools.lru_cache(maxsize=None)
def large(pose, stream):
    """0.9 MB, with enough to find for every detector."""
    return cv2.GaussianBlur(cv2.resize(picture(pose, stream), (640, 480), interpolation=cv2.INTER_NEAREST), (0, 0), 1.5)


def full_of_features(pose, stream):
    """1920x1080 with 100,000 key points of BRISK: two are matched in half a minute and more."""
    return numpy.repeat(numpy.repeat(numpy.random.RandomState(10 * pose + stream).randint(
        0, 256, (135, 240, 3)).astype(numpy.uint8), 8, 0), 8, 1)


def processor_seconds(node):
    """That the process of a node of this master has used."""
    _, _, pid = ServerProxy(rosgraph.Master('/test').lookupNode(node)).getPid('/test')
    with open('/proc/%d/stat' % pid) as file:
        fields = file.read().rpartition(')')[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


class UnnumberedImage(Image):
    """rospy numbers what has a header; this one keeps the number that it is given."""
    _has_header = False


class TestLimits(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.out = self.folder.name + '/out'
        self.streams = Streams(STREAMS)

    def tearDown(self):
        self.streams.close()
        self.folder.cleanup()

    def start(self, **parameters):
        evaluator = Evaluator(dict({'streams': STREAMS, 'output_dir': self.out, 'differences': DIRECT,
                                    'images': 'none',
                                    'features_cache_limit': 0.0},  # pictures come again, and must take as long
                                   **parameters))
        self.streams.wait_for(evaluator)
        return evaluator

    def run_file(self):
        return yaml.safe_load(read(self.out, 'run.yaml'))

    def problems(self, kind):
        return [row for row in rows(self.out, 'problems.csv') if row['kind'] == kind]

    def send_large(self, poses):
        for pose in poses:
            for stream in range(2):
                self.streams.send(stream, stamp_of(pose), large(pose % 3, stream))

    @staticmethod
    def most_memory_mb(evaluator):
        """The largest resident set that the process ever had."""
        with open('/proc/%d/status' % evaluator.process.pid) as status:
            return next(int(line.split()[1]) for line in status if line.startswith('VmHWM')) / 1000.0

    def check_fast_sender(self, number, poses):
        limit_mb = 20.0
        # As much as is ever in work at once, without anything that waits.
        paced = self.start(differences=['sift', 'orb'], output_dir=self.folder.name + '/paced')
        for pose in range(0, 8, 2):
            self.send_large([pose, pose + 1])
            wait_until(lambda: paced.progress >= pose + 2, 'progress')
        at_work_mb = self.most_memory_mb(paced)
        paced.kill()
        # 1.8 MB each, as fast as they can be sent.
        fast = self.start(differences=['sift', 'orb'], memory_limit=limit_mb / 1000.0)
        self.send_large(range(poses))
        most_mb = self.most_memory_mb(fast)
        fast.process.send_signal(number)
        status, output = fast.wait()
        self.assertEqual(status, 3, output)
        # 30 MB: messages under way in roscpp, and what the allocator keeps of images that come and go.
        self.assertLess(most_mb, at_work_mb + limit_mb + 30.0)
        for name in FILES:
            self.assertTrue(os.path.exists(self.out + '/' + name), name)
        counters = self.run_file()['counters']
        pair = counters['pairs']['h04-h12']
        seen = {int(row['pose']) for row in self.problems('dropped') if row['where'] == 'h04-h12'}
        self.assertEqual(len(seen), pair['dropped'])
        self.assertGreater(pair['dropped'], 0)
        self.assertEqual(pair['evaluated'], len(rows(self.out, 'frames.csv')) / 2)
        for name in STREAMS:
            self.assertEqual(counters['streams'][name]['lost'], 0)
        self.assertIn('dropped, since memory_limit was reached', output)
        self.assertIn('interrupted; writing results', output)

    def test_a_fast_sender_stays_within_the_memory_limit_and_ctrl_c_writes_all_files(self):
        self.check_fast_sender(signal.SIGINT, 160)

    def test_ctrl_c_ends_the_wait_for_a_reader_that_takes_nothing(self):
        has_one, read_on = threading.Event(), threading.Event()

        def take(_):
            has_one.set()
            read_on.wait(LONGEST_WAIT_S)  # it takes nothing more from its socket
        evaluator = self.start(poses=3, exit_when_done=True)
        reader = rospy.Subscriber('/%s/pair_difference' % evaluator.name, PairDifference, take, queue_size=None)
        wait_until(lambda: reader.get_num_connections() > 0, 'a connection')
        for pose in range(3):
            for stream in range(2):
                self.streams.send(stream, stamp_of(pose), picture(pose, stream))
            has_one.wait(5.0)  # the evaluator may learn of its reader later than the reader of it, and send it less
        self.assertTrue(has_one.wait(LONGEST_WAIT_S))
        wait_until(lambda: os.path.exists(self.out + '/summary.csv'), 'the results')
        time.sleep(0.5)
        self.assertIsNone(evaluator.process.poll())  # it waits for 30 s
        interrupted = time.monotonic()
        evaluator.process.send_signal(signal.SIGINT)
        status, output = evaluator.wait()
        self.assertLess(time.monotonic() - interrupted, 10.0)
        self.assertEqual(status, 0, output)
        read_on.set()
        reader.unregister()

    def test_ctrl_c_in_the_middle_of_a_long_matching_does_not_try_the_patience_of_roslaunch(self):
        launch = subprocess.Popen(['roslaunch', 'sunlit', 'evaluator.launch', 'streams:=[h04, h12]', 'differences:=[brisk]',
                                   'verify:=[]', 'output:=' + self.out],
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        wait_until(lambda: all(p.impl.has_connection('/evaluator') for p in self.streams.images), 'connections')
        poses = 3
        for pose in range(poses):
            for stream in range(2):
                self.streams.send(stream, stamp_of(pose), full_of_features(pose, stream))
        # Six pictures have their key points after 13 at most, 2.1 each; the first match takes 30 more.
        wait_until(lambda: processor_seconds('/evaluator') > 14, 'the matching')
        # It is asked to finish, and waits for what is left to match, as it is interrupted.
        asking = threading.Thread(target=self.ask_to_finish)
        asking.start()
        time.sleep(1.0)
        launch.send_signal(signal.SIGINT)
        output, _ = launch.communicate(timeout=LONGEST_WAIT_S)
        asking.join()
        self.assertNotIn('escalating', output)  # to SIGTERM, after 15 s
        self.assertRegex(output, '(asked to finish|interrupted); writing results')
        for name in FILES:
            self.assertTrue(os.path.exists(self.out + '/' + name), name)
        self.assertFalse(self.run_file()['outcome']['whole'])
        pair = self.run_file()['counters']['pairs']['h04-h12']
        self.assertEqual((pair['evaluated'], pair['dropped']), (0, poses))
        self.assertEqual([(int(row['pose']), row['where'], row['reason']) for row in self.problems('dropped')],
                         [(pose, 'h04-h12', 'the run was broken off before it was compared') for pose in range(poses)])

    def ask_to_finish(self):
        with contextlib.suppress(rospy.ServiceException):  # of a node that ended meanwhile
            rospy.ServiceProxy('/evaluator/finish', Trigger)()

    def test_sigterm_is_as_ctrl_c(self):
        self.check_fast_sender(signal.SIGTERM, 40)

    def test_other_nodes_end_in_order_at_sigterm_too(self):
        node = subprocess.Popen([located('sun_position_node'), '__name:=sun_that_is_ended'],
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        rospy.wait_for_service('/sun_that_is_ended/get_sun_position', LONGEST_WAIT_S)
        node.send_signal(signal.SIGTERM)
        output, _ = node.communicate(timeout=LONGEST_WAIT_S)
        self.assertEqual(node.returncode, 0, output)

    def test_finish_answers_when_the_files_are_there(self):
        evaluator = self.start()
        for stream in range(2):
            self.streams.send(stream, stamp_of(0), picture(0, stream))
        wait_until(lambda: evaluator.progress == 1, 'progress')
        answer = rospy.ServiceProxy('/%s/finish' % evaluator.name, Trigger)()
        self.assertEqual(len(rows(self.out, 'summary.csv')), len(DIRECT))
        self.assertTrue(self.run_file()['outcome']['whole'])
        self.assertTrue(answer.success, answer.message)
        self.assertIn(self.out, answer.message)
        again = rospy.ServiceProxy('/%s/finish' % evaluator.name, Trigger)()
        self.assertEqual((again.success, again.message), (answer.success, answer.message))
        evaluator.process.send_signal(signal.SIGTERM)
        self.assertEqual(evaluator.wait()[0], 0)

    def test_finish_says_so_where_a_file_cannot_be_written(self):
        evaluator = self.start()
        for stream in range(2):
            self.streams.send(stream, stamp_of(0), picture(0, stream))
        wait_until(lambda: evaluator.progress == 1, 'progress')
        os.makedirs(self.out + '/summary.csv/in the way')
        answer = rospy.ServiceProxy('/%s/finish' % evaluator.name, Trigger)()
        self.assertFalse(answer.success)
        self.assertIn('summary.csv', answer.message)
        status, output = evaluator.wait()
        self.assertEqual(status, 1, output)
        self.assertIn('summary.csv', output)

    def test_expected_poses_are_absent_or_unexpected_by_membership(self):
        evaluator = self.start(first_pose=10, poses=6, pose_stride=2, exit_when_done=True)  # 10, 12, 14
        for pose in (10, 14, 16):
            for stream in range(2):
                self.streams.send_capture(stream, stamp_of(pose), pose)
                self.streams.send(stream, stamp_of(pose), picture(pose, stream))
        wait_until(lambda: evaluator.progress == 3, 'progress')  # of three poses, but not of those expected
        self.assertIsNone(evaluator.process.poll())
        self.assertTrue(rospy.ServiceProxy('/%s/finish' % evaluator.name, Trigger)().success)
        status, output = evaluator.wait()
        self.assertEqual(status, 3, output)
        self.assertIn('1 expected poses never came', output)
        self.assertIn(': 2 poses in ', output)
        self.assertEqual([row['pose'] for row in self.problems('absent')], ['12'])
        self.assertEqual({(row['pose'], row['where']) for row in self.problems('unexpected')},
                         {('16', 'h04'), ('16', 'h12')})
        self.assertIn('h04: 1 images of poses that are not expected, left out', output)
        self.assertEqual({row['pose'] for row in rows(self.out, 'frames.csv')}, {'10', '14'})

    def test_what_a_sender_lost_is_told_by_its_numbers(self):
        publisher = rospy.Publisher('/h04/camera/image_raw', UnnumberedImage, queue_size=None)
        self.streams.images[0].unregister()
        self.streams.images[0] = publisher
        evaluator = self.start()
        for pose, number in enumerate([7, 8, 12, 13, 0, 1]):  # the last two: a sender that began anew
            numbered = image_message(stamp_of(pose), picture(pose, 0))
            message = UnnumberedImage(*[getattr(numbered, name) for name in Image.__slots__])
            message.header.seq = number
            publisher.publish(message)
            self.streams.send(1, stamp_of(pose), picture(pose, 1))
        wait_until(lambda: evaluator.progress == 6, 'progress')
        self.assertTrue(rospy.ServiceProxy('/%s/finish' % evaluator.name, Trigger)().success)
        counters = self.run_file()['counters']['streams']
        self.assertEqual([counters[name]['lost'] for name in STREAMS], [3, 0])
        row, = self.problems('lost')
        self.assertEqual((row['where'], row['stamp']), ('h04', '1000.200000000'))
        evaluator.process.send_signal(signal.SIGINT)
        self.assertIn('h04: 3 images missing by their sequence numbers (lost, or left out by a throttle)', evaluator.wait()[1])

    def test_too_many_pixels_and_nonsense_sizes_are_refused_before_anything_is_allocated(self):
        evaluator = self.start(max_pixels=64 * 48, poses=5, exit_when_done=True)
        for pose in range(5):
            self.streams.send(1, stamp_of(pose), picture(pose, 1))
            message = image_message(stamp_of(pose), picture(pose, 0))
            if pose == 1:
                message = image_message(stamp_of(pose), picture(pose, 0, 72, 48))
            elif pose == 2:  # 2³² · 2³² · 3 bytes, or 3 if a product overflows
                message.width = message.height = message.step = 2**32 - 1
            elif pose == 3:  # their product is 0 in 32 bit
                message.width = message.height = message.step = 2**16
                message.data = b''
            elif pose == 4:
                message.step = 2**31
            self.streams.images[0].publish(message)
        status, output = evaluator.wait()
        self.assertEqual(status, 3, output)
        reasons = {int(row['pose']): row['reason'] for row in self.problems('undecodable') if row['where'] == 'h04'}
        self.assertEqual(sorted(reasons), [1, 2, 3, 4])
        self.assertEqual(reasons[1], '72x48 pixels are more than max_pixels (3072)')
        self.assertIn('max_pixels', reasons[2])
        self.assertIn('65536x65536 pixels', reasons[3])
        self.assertIn('bytes instead of', reasons[4])

    def test_whatever_cv_bridge_converts_is_taken(self):
        evaluator = self.start(poses=5, exit_when_done=True)
        flat = numpy.full((48, 64, 3), 100, numpy.uint8)
        grey16 = numpy.arange(48 * 64, dtype=numpy.uint16).reshape(48, 64) * 21
        as_8_bit = numpy.rint(grey16 * (255.0 / 65535.0)).astype(numpy.uint8)
        yuv = numpy.empty((48, 64, 2), numpy.uint8)
        yuv[:, :, 0], yuv[:, :, 1] = 128, 102  # no colour; Y = 16 + 100 · 219 / 255
        sent = [('mono16', grey16, numpy.repeat(as_8_bit[:, :, None], 3, 2)),
                ('rgb16', flat.astype(numpy.uint16) * 257, flat),
                ('bayer_rggb8', flat[:, :, 0].copy(), flat),
                ('yuv422', yuv, flat),
                ('8UC3', flat, flat)]  # of no colour that anybody named
        for pose, (encoding, pixels, expected) in enumerate(sent):
            self.streams.send(0, stamp_of(pose), pixels, encoding)
            self.streams.send(1, stamp_of(pose), expected)
        status, output = evaluator.wait()
        self.assertEqual(status, 3, output)
        values = {(int(r['pose']), r['difference']): float(r['value']) for r in rows(self.out, 'frames.csv')}
        self.assertEqual({pose for pose, _ in values}, {0, 1, 2, 3})
        self.assertEqual({value for value in values.values()}, {0.0})
        reasons = [row['reason'] for row in self.problems('undecodable') if row['where'] == 'h04']
        self.assertEqual(len(reasons), 1)
        self.assertIn('encoding ""8UC3"" cannot be converted to rgb8: it tells numbers, not colours; mono8, rgb8', reasons[0])

    def test_compressed_images_need_no_plug_in(self):
        self.streams.close()
        publishers = [rospy.Publisher('/%s/camera/image_raw/compressed' % name, CompressedImage, queue_size=None)
                      for name in STREAMS]
        evaluator = Evaluator({'streams': STREAMS, 'output_dir': self.out, 'differences': DIRECT, 'images': 'all',
                               'image_transport': 'compressed', 'poses': 6, 'exit_when_done': True,
                               'max_pixels': 10000})
        wait_until(lambda: all(p.impl.has_connection('/' + evaluator.name) for p in publishers), 'connections')
        grey16 = numpy.arange(48 * 64, dtype=numpy.uint16).reshape(48, 64) * 21
        bomb = bytearray(cv2.imencode('.png', picture(4, 0))[1].tobytes())
        bomb[16:24] = b'\x00\x01\x00\x00\x00\x01\x00\x00'  # 65536 x 65536, it says
        whole_jpeg = cv2.imencode('.jpg', picture(5, 0))[1].tobytes()
        for pose in range(6):
            png = cv2.imencode('.png', picture(pose, 0)[:, :, ::-1])[1].tobytes()
            pairs = {0: (png, png), 1: (cv2.imencode('.jpg', picture(1, 0)[:, :, ::-1])[1].tobytes(), png),
                     2: (cv2.imencode('.png', grey16)[1].tobytes(),
                         cv2.imencode('.png', numpy.rint(grey16 * (255.0 / 65535.0)).astype(numpy.uint8))[1].tobytes()),
                     3: (png[:len(png) // 2], png), 4: (bytes(bomb), png), 5: (whole_jpeg[:len(whole_jpeg) // 2], png)}
            for publisher, data in zip(publishers, pairs[pose]):
                message = CompressedImage(format='rgb8; png compressed bgr8', data=data)
                message.header.stamp = stamp_of(pose)
                publisher.publish(message)
        status, output = evaluator.wait()
        for publisher in publishers:
            publisher.unregister()
        self.assertEqual(status, 3, output)
        values = {int(r['pose']): float(r['value']) for r in rows(self.out, 'frames.csv')
                  if r['difference'] == 'euclidean_rgb'}
        self.assertEqual((values[0], values[2]), (0.0, 0.0))
        self.assertGreater(values[1], 0.0)
        self.assertLess(values[1], 0.1)
        self.assertTrue((cv2.imread(self.out + '/images/h04/000000.png')[:, :, ::-1] == picture(0, 0)).all())
        reasons = {int(row['pose']): row['reason'] for row in self.problems('undecodable') if row['where'] == 'h04'}
        self.assertEqual(sorted(reasons), [3, 4, 5])
        self.assertIn('65536x65536 pixels are more than max_pixels', reasons[4])
        self.assertIn('cut short', reasons[5])
        self.assertEqual(self.run_file()['counters']['streams']['h04']['lossy'], 1)
        self.assertEqual(output.count('compressed with loss (JPEG): differences contain'), 1, output)

    def test_a_transport_that_is_not_there_is_one_line_that_names_the_others(self):
        # What an earlier plug-in left of its own parameters is known.
        evaluator = Evaluator({'streams': STREAMS, 'output_dir': self.out, 'image_transport': 'carrier_pigeon',
                               'carrier_pigeon': {'coops': 2}})
        status, output = evaluator.wait()
        self.assertEqual(status, 1, output)
        fatal, = [line for line in output.splitlines() if 'FATAL' in line]
        self.assertIn('image_transport is "carrier_pigeon", but must be one of those that are installed: raw, compressed', fatal)

    def test_diagnostics_tell_progress_backlog_and_what_is_awaited(self):
        told = []
        subscriber = rospy.Subscriber('/diagnostics', DiagnosticArray, lambda m: told.extend(m.status))
        misspelt = Evaluator({'streams': ['h04', 'noon', 'h20'], 'output_dir': self.folder.name + '/misspelt'})
        evaluator = self.start(poses=10)
        wait_until(lambda: any('nobody publishes images of noon, h20' == s.message and s.level == DiagnosticStatus.WARN
                               and s.name.startswith(misspelt.name) for s in told), 'a warning')
        misspelt.kill()
        wait_until(lambda: any('0 poses evaluated' == s.message and s.level == DiagnosticStatus.OK
                               and s.name.startswith(evaluator.name) for s in told), 'a status')
        for pose in range(3):
            for stream in range(2 if pose < 2 else 1):
                self.streams.send(stream, stamp_of(pose), picture(pose, stream))

        def tells(**expected):
            for status in told:
                values = {v.key: v.value for v in status.values}
                if status.name.startswith(evaluator.name) and all(values.get(k.replace('_', ' ')) == v
                                                                  for k, v in expected.items()):
                    return values
            return None
        wait_until(lambda: tells(completed_poses='2', waits_for='images of h12'), 'diagnostics')
        values = tells(completed_poses='2', waits_for='images of h12')
        self.assertEqual((values['expected poses'], values['images that wait for a partner']), ('10', '1'))
        self.assertIn('3 received, 0 dropped', values['h04'])
        self.assertEqual(values['pairs that could not be evaluated'], '0')
        # What cannot be compared is no success, nor is an image that comes again.
        self.streams.send(1, stamp_of(2), picture(2, 1, 32, 24))
        self.streams.send(0, stamp_of(0), picture(0, 0))
        wait_until(lambda: any('1 images dropped, late, lost, duplicate or unusable; 1 pairs could not be evaluated' == s.message
                               and s.level == DiagnosticStatus.WARN for s in told), 'a warning')
        # Nor is what comes after the end.
        self.assertTrue(rospy.ServiceProxy('/%s/finish' % evaluator.name, Trigger)().success)
        for pose in (3, 4):
            self.streams.send(0, stamp_of(pose), picture(pose, 0))
        wait_until(lambda: any('2 images came after the end, and were left out' == s.message
                               and s.level == DiagnosticStatus.WARN for s in told), 'a warning')
        subscriber.unregister()
        evaluator.process.send_signal(signal.SIGINT)
        self.assertEqual(evaluator.wait()[1].count('Images come after the end and are left out'), 1)


if __name__ == '__main__':
    rospy.init_node('test_evaluator_limits')
    rostest.rosrun('sunlit', 'test_evaluator_limits', TestLimits)
