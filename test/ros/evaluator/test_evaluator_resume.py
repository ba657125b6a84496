#!/usr/bin/env python3
"""SIGKILL in the middle, started again on the same folder: the same bytes in the summaries as an undisturbed run."""
import os
import sys
import tempfile
import unittest

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from evaluator_runs import Evaluator, Streams, picture, read, rows, stamp_of, wait_until  # noqa: E402

POSES = 120
STREAMS = ['h04', 'h12']


class TestResume(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.streams = Streams(STREAMS)

    def tearDown(self):
        self.streams.close()
        self.folder.cleanup()

    def start(self, name, **parameters):
        settings = {'streams': STREAMS, 'differences': ['boolean_rgb', 'orb', 'brisk'], 'poses': POSES,
                    'output_dir': self.folder.name + '/' + name, 'exit_when_done': True}
        settings.update(parameters)
        return Evaluator(settings)

    def send(self, evaluator, poses, stamp_shift=0, most_ahead=20):
        """Paced by ~progress, as the renderer is."""
        for sent, pose in enumerate(poses):
            wait_until(lambda: sent - evaluator.progress < most_ahead or evaluator.process.poll() is not None,
                       'progress')
            for stream in range(2):
                stamp = stamp_of(pose + stamp_shift)
                self.streams.send_capture(stream, stamp, pose)
                self.streams.send(stream, stamp, picture(pose, stream, 160, 120))

    def test_a_killed_run_goes_on_to_the_same_bytes(self):
        undisturbed = self.start('undisturbed')
        self.streams.wait_for(undisturbed)
        self.send(undisturbed, range(POSES))
        status, output = undisturbed.wait()
        self.assertEqual(status, 0, output)

        first = self.start('killed')
        self.streams.wait_for(first)
        self.send(first, range(70))
        wait_until(lambda: first.progress >= 50, 'progress of 50')
        first.kill()  # with up to 20 poses in work
        self.assertFalse(os.path.exists(self.folder.name + '/killed/summary.csv'))
        frames = self.folder.name + '/killed/frames.csv'
        with open(frames, 'r+b') as file:  # what a full disk or a crash of the machine would leave
            file.truncate(os.path.getsize(frames) - 7)

        second = self.start('killed')
        self.streams.wait_for(second)
        self.send(second, range(POSES), stamp_shift=5000)  # rendered again, with other stamps
        status, output = second.wait()
        self.assertEqual(status, 0, output)
        self.assertIn('not evaluated again', output)
        self.assertIn('torn end', output)
        for name in ('summary.csv', 'verified_summary.csv', 'comparisons.csv'):
            self.assertEqual(read(self.folder.name + '/killed', name), read(self.folder.name + '/undisturbed', name), name)
        # All but the stamps, since the rest was rendered again with others.
        verified = [[dict(row, stamp='') for row in rows(self.folder.name + '/' + run, 'verified.csv')]
                    for run in ('killed', 'undisturbed')]
        self.assertEqual(len(verified[0]), POSES)  # of orb
        self.assertEqual(*verified)
        frames = rows(self.folder.name + '/killed', 'frames.csv')
        self.assertEqual(len(frames), 3 * POSES)
        kept = sum(float(row['stamp']) < float(stamp_of(5000).to_sec()) for row in frames)
        self.assertGreaterEqual(kept, 3 * 49)  # the first life's values, all but the torn pair
        self.assertLess(kept, 3 * POSES)
        self.assertEqual(sorted(os.listdir(self.folder.name + '/killed/images/h12')),
                         sorted(os.listdir(self.folder.name + '/undisturbed/images/h12')))

        third = self.start('killed')  # nothing left to do: ends without any image
        status, output = third.wait()
        self.assertEqual(status, 0, output)

        other = self.start('killed', ratio=0.8)
        status, output = other.wait()
        self.assertEqual(status, 1, output)
        self.assertIn('ratio was 0.5, now 0.8', output)

        other = self.start('killed', verify=[])
        status, output = other.wait()
        self.assertEqual(status, 1, output)
        self.assertIn('verify was [orb], now []', output)


if __name__ == '__main__':
    rospy.init_node('test_evaluator_resume')
    rostest.rosrun('sunlit', 'test_evaluator_resume', TestResume)
