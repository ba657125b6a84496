#!/usr/bin/env python3
"""Wrong parameters stop the node with one line; topics and services beside the images."""
import concurrent.futures
import errno
import os
import signal
import subprocess
import sys
import tempfile
import unittest
import xmlrpc.client

import rospkg
import rospy
import rostest
import yaml
from sensor_msgs.msg import Image
from std_srvs.srv import Trigger
from sunlit.msg import Activity, PairDifference, Summary

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from evaluator_runs import LONGEST_WAIT_S, Evaluator, Streams, picture, rows, stamp_of, wait_until  # noqa: E402


class TestParameters(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.settings = {'streams': ['h04', 'h12'], 'output_dir': self.folder.name + '/out',
                         'differences': ['boolean_grey', 'orb']}

    def tearDown(self):
        self.folder.cleanup()

    def test_a_wrong_parameter_stops_the_node_with_key_value_and_what_is_allowed(self):
        cases = [({'ratoi': 0.4}, ['ratoi']),
                 ({'ratio': 'half'}, ['ratio', 'half']),
                 ({'ratio': 1.5}, ['ratio', '1.5', '1']),
                 ({'verify': ['boolean_rgb']}, ['verify', 'boolean_rgb', 'sift']),
                 ({'verify': 'sift'}, ['verify', 'sift', 'a list of some of']),
                 ({'differences': ['orb', 'brisk'], 'verify': ['sift']}, ['verify is [sift]', '[orb, brisk]']),
                 ({'streams': []}, ['streams', 'missing', '[h04, h12, h20]']),
                 ({'streams': ['h04']}, ['pairs']),
                 ({'pairs': [['h04', 'h05']]}, ['pairs', 'h05']),
                 ({'pairs': [['h04']]}, ['pairs', '[[h04]]', '[a, b]']),
                 ({'pairs': [{'a': 'h04', 'b': 'h12', 'evry': 3}]}, ['pairs', 'every']),
                 ({'differences': ['sfit']}, ['differences', 'sfit', 'boolean_rgb']),
                 ({'features': {'orb': {'n_features': 0}}}, ['features/orb/n_features', '0']),
                 ({'features': {'akaze': {'threshold': 2}}}, ['features/akaze/threshold', '2', 'from 0 to 1']),
                 ({'features': {'akaze': {'descriptor_size': 300, 'descriptor_channels': 1}},
                   'differences': ['akaze']}, ['descriptor_size of AKAZE', '300', 'to 162']),
                 ({'features': {'mine': {'threshold': 1}}}, ['features/mine/type', 'missing', 'sift', 'kaze']),
                 ({'features': {'mine': {'type': 'sfit'}}}, ['features/mine/type', 'sfit', 'sift']),
                 ({'features': {'mine': {'type': 'sift', 'threshold': 1}}}, ['features/mine/threshold', 'unknown']),
                 ({'features': {'mine': {'type': 'sift', 'preprocessing': 'clahee'}}},
                  ['features/mine/preprocessing', 'clahee', 'none', 'clahe', 'gamma', 'illumination_invariant']),
                 ({'features': {'mine': {'type': 'sift', 'preprocessing': 'clahe', 'clahe': {'clip_limit': 0.5}}}},
                  ['features/mine/clahe/clip_limit', '0.5', 'from 1 to 256']),
                 ({'features': {'mine': {'type': 'sift', 'preprocessing': 'illumination_invariant',
                                         'illumination_invariant': {'peak_green': 470}}}},
                  ['features/mine/illumination_invariant/peak_green', '470', 'from 500 to 560 nm']),
                 # Of another preprocessing, of none, and of a built-in detector, which has none.
                 ({'features': {'mine': {'type': 'sift', 'preprocessing': 'gamma', 'clahe': {'tiles': 8}}}},
                  ['features/mine/clahe', 'unknown']),
                 ({'features': {'mine': {'type': 'sift', 'gamma': {'exponent': 1}}}}, ['features/mine/gamma', 'unknown']),
                 ({'features': {'sift': {'preprocessing': 'clahe'}}}, ['features/sift/preprocessing', 'unknown']),
                 ({'features': {'net': {'type': 'onnx'}}, 'differences': ['net']},
                  ['model of onnx', '""', 'the file of a network in the ONNX format']),
                 ({'features': {'net': {'type': 'onnx', 'model': '/none.onnx'}}, 'differences': ['net']}, ['/none.onnx: ']),
                 ({'features': {'net': {'type': 'onnx', 'model': __file__}}, 'differences': ['net']},
                  [__file__ + ': OpenCV cannot use it as an ONNX network']),
                 ({'features': {'boolean_rgb': {'type': 'sift'}}}, ['"boolean_rgb"', 'none of']),
                 ({'differences': ['orb', 'orb']}, ['differences', '[orb, orb]', 'each once']),
                 ({'differences': []}, ['differences', '[]', 'boolean_rgb']),
                 ({'pairs': [['h04', 'h12'], ['h04', 'h12']]}, ['pairs', 'h04-h12', 'twice']),
                 ({'pairs': [{'a': 'h04', 'b': 'h12', 'every': 0}]}, ['every', 'h04-h12', 'is 0', 'at least 1']),
                 ({'pose_stride': 0}, ['pose_stride', 'is 0', 'from 1']),
                 ({'memory_limit': 0}, ['memory_limit', 'is 0', 'from 0.001']),
                 ({'max_pixels': 0.5}, ['max_pixels', 'is 0.5', 'from 1']),
                 ({'diagnostic_period': 0}, ['diagnostic_period', 'is 0', 'from 0.01']),
                 ({'stamp_start': '9999999999.5'}, ['stamp_start', 'to 4294967295']),
                 ({'images': 'some'}, ['images', 'some', 'samples']),
                 ({'stamp_start': 'noon'}, ['stamp_start', 'noon']),
                 ({'output_dir': '/proc/sunlit'}, ['/proc/sunlit'])]
        for change, expected in cases:
            evaluator = Evaluator(dict(self.settings, **change))
            status, output = evaluator.wait()
            self.assertEqual(status, 1, output)
            fatal = [line for line in output.splitlines() if 'FATAL' in line]
            self.assertEqual(len(fatal), 1, output)
            for text in expected:
                self.assertIn(text, fatal[0])

    def test_the_shipped_file_is_accepted_and_states_the_defaults(self):
        with open(os.path.join(rospkg.RosPack().get_path('sunlit'), 'config', 'evaluator.yaml')) as file:
            shipped = yaml.safe_load(file)
        streams = Streams(shipped['streams'])
        runs = []
        for name, parameters in (('shipped', shipped), ('plain', {'streams': shipped['streams']})):
            evaluator = Evaluator(dict(parameters, output_dir=self.folder.name + '/' + name))
            streams.wait_for(evaluator)
            evaluator.process.send_signal(signal.SIGINT)  # Ctrl-C
            status, output = evaluator.wait()
            self.assertEqual(status, 3, output)
            silent = ', '.join('/%s/camera/image_raw' % stream for stream in shipped['streams'])
            self.assertIn('no pair of images came at all; no image came of ' + silent, output)
            self.assertNotIn('nobody sends it', output)
            with open(self.folder.name + '/' + name + '/run.yaml') as file:
                runs.append(yaml.safe_load(file)['settings'])
        streams.close()
        self.assertEqual(runs[0], runs[1])

    def test_numbers_with_an_exponent_are_numbers(self):
        self.assertEqual(yaml.safe_load('1e-1'), '1e-1', 'a text, as which rosparam sends it')
        limits = {}
        for limit in ('1e-1', '1e-4'):
            evaluator = Evaluator(dict(self.settings, memory_limit=limit, exit_when_done=True, idle_timeout='1e-1'))
            _, limits[limit] = evaluator.wait()
        self.assertIn('no pair of images came at all; no image came of /h04/camera/image_raw (nobody sends it), '
                      '/h12/camera/image_raw (nobody sends it)', limits['1e-1'])
        self.assertIn('memory_limit is 0.0001, but must be from 0.001', limits['1e-4'])

    def test_ctrl_c_while_the_node_starts_still_writes_results(self):
        run_file = self.settings['output_dir'] + '/run.yaml'
        os.mkdir(self.settings['output_dir'])
        os.mkfifo(run_file)  # the node reads it as it starts, and waits for what is in it
        evaluator = Evaluator(self.settings)
        ends = []

        def is_being_read():
            try:
                ends.append(os.open(run_file, os.O_WRONLY | os.O_NONBLOCK))
            except OSError as error:
                self.assertEqual(error.errno, errno.ENXIO)  # nobody reads
            return ends
        wait_until(is_being_read, 'the evaluator to start')
        evaluator.process.send_signal(signal.SIGINT)
        os.close(ends[0])
        status, output = evaluator.wait()
        self.assertEqual(status, 3, output)
        self.assertIn('interrupted; writing results', output)
        self.assertEqual(len(rows(self.settings['output_dir'], 'summary.csv')), 2)

    def test_a_relative_folder_is_told_by_its_whole_name(self):
        evaluator = Evaluator(dict(self.settings, output_dir=os.path.relpath(self.settings['output_dir'])))
        finish = '/%s/finish' % evaluator.name
        rospy.wait_for_service(finish, LONGEST_WAIT_S)
        self.assertIn('results are in ' + self.settings['output_dir'], rospy.ServiceProxy(finish, Trigger)().message)
        evaluator.process.send_signal(signal.SIGINT)
        _, output = evaluator.wait()
        self.assertIn('0 poses in ' + self.settings['output_dir'], output)

    def test_a_folder_is_written_by_one_at_a_time(self):
        first = Evaluator(self.settings)
        rospy.wait_for_service('/%s/finish' % first.name, LONGEST_WAIT_S)
        status, output = Evaluator(self.settings).wait()
        self.assertEqual(status, 1, output)
        self.assertIn(self.settings['output_dir'] + ': another evaluation is writing into this folder', output)
        first.kill()  # which gives the folder back
        again = Evaluator(self.settings)
        rospy.wait_for_service('/%s/finish' % again.name, LONGEST_WAIT_S)
        again.kill()

    def test_the_launch_file_passes_its_arguments_and_ends_by_itself(self):
        out = self.folder.name + '/launched'
        launch = subprocess.Popen(['roslaunch', 'sunlit', 'evaluator.launch', 'streams:=[h04, h12]', 'output:=' + out,
                                   'pairs:=[[h12, h04]]', 'differences:=[orb, boolean_grey]', 'poses:=3', 'images:=all',
                                   'exit_when_done:=true'], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        streams = Streams(['h04', 'h12'])
        wait_until(lambda: all(p.get_num_connections() > 0 for p in streams.images), 'connections')
        for pose in range(3):
            for stream in range(2):
                streams.send(stream, stamp_of(pose), picture(pose, stream, 160, 120))
        output, _ = launch.communicate(timeout=LONGEST_WAIT_S)
        streams.close()
        self.assertIn('3 poses in ' + out, output)
        self.assertEqual([(r['a'], r['b'], r['difference'], r['n']) for r in rows(out, 'summary.csv')],
                         [('h12', 'h04', 'orb', '3'), ('h12', 'h04', 'boolean_grey', '3')])
        self.assertEqual(sorted(os.listdir(out + '/images/h04')), ['000000.png', '000001.png', '000002.png'])

    def test_values_summary_and_drawn_matches_are_published(self):
        streams = Streams(['h04', 'h12'])
        evaluator = Evaluator(self.settings)
        values, images = [], []
        subscribers = [rospy.Subscriber('/%s/pair_difference' % evaluator.name, PairDifference, values.append),
                       rospy.Subscriber('/%s/matches_image' % evaluator.name, Image, images.append)]
        streams.wait_for(evaluator)
        wait_until(lambda: all(s.get_num_connections() > 0 for s in subscribers), 'connections')
        for pose in range(10):
            for stream in range(2):
                streams.send(stream, stamp_of(pose), picture(pose // 2, 0, 160, 120))
        wait_until(lambda: evaluator.progress == 10 and len(values) == 10 and images, 'ten poses')
        finish = rospy.ServiceProxy('/%s/finish' % evaluator.name, Trigger)
        self.assertTrue(finish().success)
        summary = rospy.wait_for_message('/%s/summary' % evaluator.name, Summary, 60)
        self.assertEqual(summary.poses, 10)
        self.assertEqual([(r.a, r.b, r.difference, r.n) for r in summary.rows],
                         [('h04', 'h12', 'boolean_grey', 10), ('h04', 'h12', 'orb', 10)])
        by_pose = sorted(values, key=lambda v: v.pose)
        self.assertEqual([v.pose for v in by_pose], list(range(10)))
        self.assertEqual([v.header.stamp for v in by_pose], [stamp_of(p) for p in range(10)])
        self.assertEqual([d.difference for d in by_pose[0].differences], ['boolean_grey', 'orb'])
        self.assertEqual((images[0].width, images[0].height, images[0].encoding), (320, 120, 'rgb8'))
        frames = rows(self.folder.name + '/out', 'frames.csv')
        self.assertEqual([float(r['value']) for r in frames if r['difference'] == 'orb'],
                         [v.differences[1].value for v in by_pose])
        for subscriber in subscribers:
            subscriber.unregister()
        evaluator.process.send_signal(signal.SIGINT)  # Ctrl-C
        status, output = evaluator.wait()
        self.assertEqual(status, 0, output)
        streams.close()

    def test_after_rosnode_kill_it_says_what_is_missing_and_where_the_rest_is(self):
        streams = Streams(['h04', 'h12'])
        evaluator = Evaluator(dict(self.settings, poses=5))
        streams.wait_for(evaluator)
        for stream in range(2):
            streams.send(stream, stamp_of(0), picture(0, stream))
        wait_until(lambda: evaluator.progress == 1, 'a pose')
        _, _, api = rospy.get_master().lookupNode('/' + evaluator.name)
        xmlrpc.client.ServerProxy(api).shutdown(rospy.get_name(), 'as rosnode kill says')
        status, output = evaluator.wait()
        self.assertEqual(status, 3, output)
        self.assertIn('1 poses in ' + self.settings['output_dir'], output)
        self.assertIn('not evaluated: 4 expected poses never came', output)
        streams.close()

    def test_all_who_ask_it_to_finish_are_answered(self):
        evaluator = Evaluator(dict(self.settings, exit_when_done=True))
        name = '/%s/finish' % evaluator.name
        rospy.wait_for_service(name, LONGEST_WAIT_S)
        callers = [rospy.ServiceProxy(name, Trigger, persistent=True) for _ in range(5)]
        with concurrent.futures.ThreadPoolExecutor(len(callers)) as threads:
            answers = list(threads.map(lambda call: call().message, callers))
        self.assertEqual(len(set(answers)), 1, answers)
        self.assertIn('results are in ' + self.settings['output_dir'], answers[0])
        evaluator.wait()

    def test_rosnode_kill_is_heeded_while_the_report_is_drawn(self):
        streams = Streams(['h04', 'h12'])
        evaluator = Evaluator(dict(self.settings, report=True, poses=1, exit_when_done=True))
        doing = []
        subscriber = rospy.Subscriber('/%s/activity' % evaluator.name, Activity, lambda message: doing.append(message.doing))
        streams.wait_for(evaluator)
        wait_until(lambda: subscriber.get_num_connections() > 0, 'a connection')
        for stream in range(2):
            streams.send(stream, stamp_of(0), picture(0, stream))
        wait_until(lambda: 'reporting' in doing, 'the report')
        _, _, api = rospy.get_master().lookupNode('/' + evaluator.name)
        xmlrpc.client.ServerProxy(api).shutdown(rospy.get_name(), 'as rosnode kill says')
        status, output = evaluator.wait()
        self.assertEqual(status, 0, output)
        self.assertIn('interrupted before the report was drawn', output)
        self.assertFalse(os.path.exists(self.folder.name + '/out/report.html'))
        subscriber.unregister()
        streams.close()


if __name__ == '__main__':
    rospy.init_node('test_evaluator_parameters')
    rostest.rosrun('sunlit', 'test_evaluator_parameters', TestParameters)
