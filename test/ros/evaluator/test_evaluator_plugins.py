#!/usr/bin/env python3
"""A detector that another package brings: found by pluginlib, the same as when it is built in, refused where it fails."""
import os
import pathlib
import sys
import tempfile
import unittest

import rospy
import rostest
import yaml

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from evaluator_runs import Evaluator, Streams, located, picture, read, rows, stamp_of  # noqa: E402

CORNERS = 'example_detectors/Corners'


class TestPlugins(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.output = folder.name + '/out'
        # The package as a workspace would hold it, for those who are started here alone.
        example = pathlib.Path(located('evaluator_node')).resolve().parents[3] / 'example_detectors'
        self.assertTrue((example / 'lib' / 'libexample_detectors.so').exists())
        before = os.environ['ROS_PACKAGE_PATH']
        self.addCleanup(os.environ.__setitem__, 'ROS_PACKAGE_PATH', before)
        os.environ['ROS_PACKAGE_PATH'] = '%s:%s' % (example, before)

    def run_with(self, features, differences, size=(320, 240), poses=3):
        evaluator = Evaluator({'streams': ['h04', 'h12'], 'output_dir': self.output, 'differences': differences,
                               'features': features, 'poses': poses, 'exit_when_done': True})
        streams = Streams(['h04', 'h12'])
        try:
            streams.wait_for(evaluator)
            for pose in range(poses):
                for stream in range(2):
                    streams.send(stream, stamp_of(pose), picture(pose, stream, *size))
            return evaluator.wait()
        finally:
            streams.close()

    def refused(self, features):
        """The one line that the node gives up with."""
        evaluator = Evaluator({'streams': ['h04', 'h12'], 'output_dir': self.output, 'differences': ['mine'],
                               'features': features})
        status, output = evaluator.wait()
        fatal = [line for line in output.splitlines() if 'FATAL' in line]
        self.assertEqual((status, len(fatal)), (1, 1), output)
        return fatal[0]

    def test_finds_what_the_same_detector_finds_that_is_built_in(self):
        features = {'orb': {'n_features': 200, 'fast_threshold': 10},
                    'mine': {'type': CORNERS, 'n_features': 200, 'threshold': 10},
                    'usual': {'type': CORNERS}, 'equal': {'type': CORNERS, 'preprocessing': 'clahe'}}
        status, output = self.run_with(features, ['orb', 'mine', 'usual', 'equal'])
        self.assertEqual(status, 0, output)
        found = {name: [{key: row[key] for key in ('value', 'features_a', 'features_b', 'matches')}
                        for row in rows(self.output, 'frames.csv') if row['difference'] == name] for name in features}
        self.assertEqual(len(found['orb']), 3)
        self.assertGreater(int(found['orb'][0]['features_a']), 20)
        self.assertEqual(found['mine'], found['orb'])
        self.assertNotEqual(found['usual'], found['orb'])
        self.assertNotEqual(found['equal'], found['usual'])
        settings = yaml.safe_load(read(self.output, 'run.yaml'))['settings']
        self.assertEqual((settings['features/mine/type'], settings['features/mine/threshold']), (CORNERS, '10'))

    def test_what_it_throws_is_said_by_its_name_and_ends_nothing(self):
        status, output = self.run_with({'mine': {'type': CORNERS}}, ['boolean_rgb', 'mine'], size=(8, 6))
        self.assertEqual(status, 3, output)
        said = 'detector %s: a picture must have at least 16 px along each side' % CORNERS
        problems = rows(self.output, 'problems.csv')
        self.assertEqual(len(problems), 3, problems)
        for problem in problems:
            self.assertIn(said, str(problem))

    def test_what_cannot_be_loaded_or_is_not_allowed_is_refused(self):
        for features, words in (({'mine': {'type': 'example_detectors/Corner'}},
                                 ['features/mine/type', '"example_detectors/Corner"', CORNERS]),
                                ({'mine': {'type': CORNERS, 'n_features': 0}}, ['features/mine/n_features', '0', 'from 1']),
                                ({'mine': {'type': CORNERS, 'sigma': 1}}, ['features/mine/sigma', 'unknown'])):
            line = self.refused(features)
            for word in words:
                self.assertIn(word, line)


if __name__ == '__main__':
    rospy.init_node('test_evaluator_plugins')
    rostest.rosrun('sunlit', 'test_evaluator_plugins', TestPlugins)
