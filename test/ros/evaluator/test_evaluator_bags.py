#!/usr/bin/env python3
"""Live topics, a played bag and evaluate_bags give the same bytes in all result files."""
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import cv2
import rosbag
import rospkg
import rospy
import rostest
import yaml
from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import CameraInfo, CompressedImage
from std_msgs.msg import String
from sunlit.msg import Capture

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from evaluator_runs import Evaluator, Streams, image_message, located, picture, read, rows, stamp_of  # noqa: E402

POSES = 60
NETWORK = os.path.join(rospkg.RosPack().get_path('sunlit'), 'test', 'golden', 'bright_pixel.onnx')
STREAMS = ['h04', 'h12', 'h20']
RESULTS = ['summary.csv', 'verified_summary.csv', 'frames.csv', 'verified.csv',
           'comparisons.csv']
DIFFERENCES = ['boolean_rgb', 'euclidean_grey', 'sift', 'orb']
CONFIG = '''# of the test
streams: [h04, h12, h20]
pairs:
  - [h04, h12]
  - {a: h12, b: h20, every: 10}
differences: [boolean_rgb, euclidean_grey, sift, orb]
ratio: 0.5
output_dir: unused
inclusive: false
report: false
'''


class TestBags(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.config = self.path('config.yaml')
        with open(self.config, 'w') as file:
            file.write(CONFIG)

    def tearDown(self):
        self.folder.cleanup()

    def path(self, name):
        return self.folder.name + '/' + name

    def write_bags(self, names, poses=range(POSES), begin=0.0, frame='', root='/', without_captures=()):
        for name, streams in names.items():
            with rosbag.Bag(self.path(name), 'w') as bag:
                for pose in poses:
                    place = PoseStamped()
                    place.header.stamp = stamp_of(pose)
                    place.header.frame_id = frame
                    place.pose.position.x = begin + pose
                    place.pose.orientation.w = 1.0
                    bag.write(root + 'camera/pose', place, stamp_of(pose))
                    for stream in streams:
                        capture = Capture(pose_index=pose, ev100=14.5, moon_azimuth=math.nan, moon_elevation=0.5)
                        capture.header.stamp = stamp_of(pose)
                        topic = root + '%s/camera/' % STREAMS[stream]
                        bag.write(topic + 'image_raw', image_message(stamp_of(pose), picture(pose, stream, 160, 120)),
                                  stamp_of(pose))
                        if pose not in without_captures:
                            bag.write(topic + 'capture', capture, stamp_of(pose))

    def evaluate_bags(self, *arguments, **environment):
        return subprocess.run([located('evaluate_bags')] + list(arguments), stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=100, env={**os.environ, **environment})

    def evaluator(self, name):
        return Evaluator({'streams': STREAMS, 'pairs': [['h04', 'h12'], {'a': 'h12', 'b': 'h20', 'every': 10}],
                          'differences': DIFFERENCES, 'output_dir': self.path(name), 'poses': POSES,
                          'exit_when_done': True})

    def test_bags_give_the_same_bytes_as_live(self):
        self.write_bags({'all.bag': [0, 1, 2], 'two.bag': [0, 1], 'one.bag': [2]})

        streams = Streams(STREAMS)
        live = self.evaluator('live')
        streams.wait_for(live)
        for pose in range(POSES):
            for stream in range(3):
                streams.send_capture(stream, stamp_of(pose), pose)
                streams.send(stream, stamp_of(pose), picture(pose, stream, 160, 120))
        status, output = live.wait()
        self.assertEqual(status, 0, output)
        streams.close()
        expected = {name: read(self.path('live'), name) for name in RESULTS}
        counts = {(row['a'], row['b']): int(row['n']) for row in rows(self.path('live'), 'summary.csv')}
        self.assertEqual(counts, {('h04', 'h12'): POSES, ('h12', 'h20'): POSES // 10})
        verified = [tuple(row[name] for name in ('pose', 'a', 'b', 'detector')) for row in rows(self.path('live'), 'verified.csv')]
        self.assertEqual(verified, [(str(pose), *pair, detector) for pose in range(POSES)
                                    for pair in [('h04', 'h12')] + ([('h12', 'h20')] if pose % 10 == 0 else [])
                                    for detector in ('sift', 'orb')])
        self.assertGreater(sum(int(row['mutual_matches']) for row in rows(self.path('live'), 'verified.csv')), 10 * POSES)

        played = self.evaluator('played')
        player = subprocess.Popen(['rosbag', 'play', '--wait-for-subscribers', '--rate=20', '--quiet', '--topics'] +
                                  ['/%s/camera/%s' % (s, t) for s in STREAMS for t in ('image_raw', 'capture')] +
                                  ['--bags', self.path('all.bag')], stdout=subprocess.DEVNULL)
        status, output = played.wait()
        player.wait(timeout=100)
        self.assertEqual(status, 0, output)
        self.assertEqual({name: read(self.path('played'), name) for name in RESULTS}, expected)

        for out, bags in {'offline': ['all.bag'], 'offline_two': ['one.bag', 'two.bag']}.items():
            done = self.evaluate_bags('--config', self.config, '--out', self.path(out), *[self.path(b) for b in bags])
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertEqual({name: read(self.path(out), name) for name in RESULTS}, expected)
            self.assertEqual(rows(self.path(out), 'path.csv')[59]['x'], '59')
        captures = rows(self.path('offline'), 'captures.csv')
        self.assertEqual(len(captures), 3 * POSES)
        self.assertEqual(captures[0]['moon_azimuth_deg'], 'nan')
        self.assertAlmostEqual(float(captures[0]['moon_elevation_deg']), math.degrees(0.5), 9)

        self.write_bags({'start.bag': [0, 1, 2]}, range(23))
        self.write_bags({'end.bag': [0, 1, 2]}, range(23, POSES))
        for shard in ('start', 'end'):
            done = self.evaluate_bags('--config', self.config, '--out', self.path(shard), self.path(shard + '.bag'))
            self.assertEqual(done.returncode, 0, done.stdout)
        done = self.evaluate_bags('--config', self.config, '--out', self.path('merged'), '--merge', self.path('end'),
                                  '--merge', self.path('start'))
        self.assertEqual(done.returncode, 0, done.stdout)
        for name in RESULTS + ['captures.csv', 'path.csv']:
            self.assertEqual(read(self.path('merged'), name), read(self.path('offline'), name))

    def test_images_before_the_first_capture_have_no_pose_of_their_own_making(self):
        self.write_bags({'cut.bag': [0, 1]}, range(20, 26), without_captures=(20, 21))
        with open(self.path('two.yaml'), 'w') as file:
            yaml.safe_dump({'streams': ['h04', 'h12'], 'output_dir': 'unused', 'differences': ['euclidean_grey'],
                            'report': False}, file)
        done = self.evaluate_bags('--config', self.path('two.yaml'), '--out', self.path('out'), self.path('cut.bag'))
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertIn('2 unplaced (h04-h12)', done.stdout)
        self.assertIn('path.csv: 2 poses of stamps of which no capture says which pose they are left out', done.stdout)
        self.assertNotIn('without an image', done.stdout)
        for name in ('frames.csv', 'path.csv'):
            self.assertEqual([row['pose'] for row in rows(self.path('out'), name)], ['22', '23', '24', '25'], name)
        self.assertEqual([(row['kind'], row['pose'], row['stamp']) for row in rows(self.path('out'), 'problems.csv')],
                         [('unplaced', '', '%.9f' % stamp_of(pose).to_sec()) for pose in (20, 21)])

    def test_detectors_of_ones_own_look_at_pictures_that_were_made_for_them(self):
        self.write_bags({'all.bag': [0, 1]}, range(2))
        features = {'as_it_is': {'type': 'orb', 'preprocessing': 'none'},
                    'straight': {'type': 'orb', 'preprocessing': 'gamma', 'gamma': {'exponent': 1.0}},
                    'curved': {'type': 'orb', 'preprocessing': 'gamma', 'gamma': {'exponent': 0.3}},
                    'equal': {'type': 'orb', 'preprocessing': 'clahe', 'clahe': {'clip_limit': 8, 'tiles': 2}},
                    'unlit': {'type': 'orb', 'preprocessing': 'illumination_invariant'}}
        names = ['orb'] + list(features)
        with open(self.path('own.yaml'), 'w') as file:
            yaml.safe_dump({'streams': ['h04', 'h12'], 'output_dir': 'unused', 'differences': names, 'features': features}, file)
        done = self.evaluate_bags('--config', self.path('own.yaml'), '--out', self.path('out'), self.path('all.bag'))
        self.assertEqual(done.returncode, 0, done.stdout)
        found = {name: [{key: row[key] for key in ('value', 'features_a', 'features_b', 'matches')}
                        for row in rows(self.path('out'), 'frames.csv') if row['difference'] == name] for name in names}
        self.assertEqual(len(found['orb']), 2)
        self.assertEqual(found['as_it_is'], found['orb'])
        self.assertEqual(found['straight'], found['orb'])  # v^1 is v
        for name in ('curved', 'equal', 'unlit'):
            self.assertNotEqual(found[name], found['orb'], name)
        settings = yaml.safe_load(read(self.path('out'), 'run.yaml'))['settings']
        self.assertEqual((settings['features/unlit/type'], settings['features/unlit/preprocessing'],
                          settings['features/unlit/illumination_invariant/peak_red']), ('orb', 'illumination_invariant', '611.4'))
        self.assertEqual(settings['features/equal/clahe/clip_limit'], '8')
        self.assertNotIn('features/as_it_is/preprocessing', settings)

    def test_recordings_of_two_cameras_at_one_stamp_are_refused_and_a_bag_that_brings_nothing_is_named(self):
        self.write_bags({'wide.bag': [0, 1], 'fisheye.bag': [0, 1]}, range(2))
        for name, model, width in (('wide', 'plumb_bob', 160), ('fisheye', 'equidistant', 160)):
            with rosbag.Bag(self.path(name + '.bag'), 'a') as bag:
                for pose in range(2):
                    camera = CameraInfo(width=width, height=120, distortion_model=model)
                    camera.header.stamp = stamp_of(pose)
                    bag.write('/h12/camera/camera_info', camera, stamp_of(pose))
        with rosbag.Bag(self.path('other.bag'), 'w') as bag:
            bag.write('/robot/note', String('none of theirs'), stamp_of(0))
        with open(self.path('two.yaml'), 'w') as file:
            yaml.safe_dump({'streams': ['h04', 'h12'], 'output_dir': 'unused', 'differences': ['euclidean_grey'],
                            'report': False}, file)

        def evaluate(*bags):
            return self.evaluate_bags('--config', self.path('two.yaml'), '--out', self.path('two'), *map(self.path, bags))
        done = evaluate('wide.bag', 'fisheye.bag')
        self.assertNotEqual(done.returncode, 0, done.stdout)
        for word in ('wide.bag', 'fisheye.bag are of two cameras: /h12/camera/camera_info differs at stamp ', '--query'):
            self.assertIn(word, done.stdout)
        self.assertFalse(os.path.exists(self.path('two/frames.csv')))
        done = evaluate('wide.bag', 'other.bag')
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn('warning: %s brings nothing: it holds none of ' % self.path('other.bag'), done.stdout)
        self.assertIn('it holds: /robot/note', done.stdout)

    def test_a_network_is_a_detector_and_another_one_under_its_name_is_noticed(self):
        self.write_bags({'all.bag': [0, 1]}, range(2))
        model = self.path('tiny.onnx')
        shutil.copy(NETWORK, model)
        with open(self.path('net.yaml'), 'w') as file:
            yaml.safe_dump({'streams': ['h04', 'h12'], 'output_dir': 'unused', 'differences': ['net'],
                            'features': {'net': {'type': 'onnx', 'model': model, 'nms_radius': 2}}}, file)
        evaluate = ['--config', self.path('net.yaml'), '--out', self.path('out'), self.path('all.bag')]
        done = self.evaluate_bags(*evaluate)
        self.assertEqual(done.returncode, 0, done.stdout)
        for row in rows(self.path('out'), 'frames.csv'):
            self.assertGreater(int(row['features_a']), 10, row)
        settings = yaml.safe_load(read(self.path('out'), 'run.yaml'))['settings']
        self.assertEqual((settings['features/net/model'], len(settings['features/net/model_hash'])), (model, 32))
        with open(model, 'r+b') as file:
            file.seek(2000)
            file.write(b'1')
        done = self.evaluate_bags(*evaluate)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn('with another setting: features/net/model_hash was ', done.stdout)

    def test_features_that_another_run_found_give_the_same_bytes(self):
        self.write_bags({'all.bag': [0, 1, 2]}, range(3))
        kept = self.path('kept/features')

        def run(out, *more, **environment):
            done = self.evaluate_bags('--config', self.config, '--out', self.path(out), *more, self.path('all.bag'),
                                      **{'SUNLIT_CACHE_DIR': self.path('kept'), **environment})
            self.assertEqual(done.returncode, 0, done.stdout)
            return done.stdout, [read(self.path(out), name) for name in RESULTS]

        _, expected = run('none', '--features-cache-limit', '0')
        self.assertFalse(os.path.exists(kept))
        output, found = run('cold')
        self.assertEqual(found, expected)
        files = sorted(os.listdir(kept))
        self.assertEqual(len(files), 14)  # of 3 x 2 pictures, and of h20 that of pose 0, by two detectors
        # Each damaged file is read, counted and mended.
        for name in files:
            with open(os.path.join(kept, name), 'r+b') as file:
                whole = file.read()
                file.seek(-1, os.SEEK_END)
                file.write(bytes([whole[-1] ^ 1]))
        output, found = run('mended')
        self.assertEqual((found, output.count('features are found anew: ')), (expected, 2))
        self.assertIn('so far 10 files of them', output)
        output, found = run('warm')
        self.assertEqual((found, output.count('features are')), (expected, 0))
        self.assertEqual(sorted(os.listdir(kept)), files)
        # A file where the folder should be.
        output, found = run('nowhere', SUNLIT_CACHE_DIR=self.path('all.bag'))
        self.assertEqual((found, output.count('features are not kept for other runs: ')), (expected, 1))

    def test_about_may_be_any_text(self):
        self.write_bags({'all.bag': [0, 1]}, range(1))
        about = {'weather': 'rain,\nthen: sun # and "wind"\n', "it's": 'Казань\u2028\x1b[0m', 'a: b #c': '- x', 'two\nlines': '',
                 '"': '\\n'}
        with open(self.path('about.yaml'), 'w') as file:
            yaml.safe_dump({'streams': ['h04', 'h12'], 'output_dir': 'unused', 'differences': ['boolean_rgb'], 'about': about},
                           file)
        for _ in ('made', 'taken up again, with the same settings'):
            done = self.evaluate_bags('--config', self.path('about.yaml'), '--out', self.path('out'), self.path('all.bag'))
            self.assertEqual(done.returncode, 0, done.stdout)
            settings = yaml.safe_load(read(self.path('out'), 'run.yaml'))['settings']
            self.assertEqual({key[len('about/'):]: value for key, value in settings.items() if key.startswith('about/')}, about)
        about['weather'] = 'rain,\nthen: sun # and "wind"'  # without the last line break
        with open(self.path('about.yaml'), 'w') as file:
            yaml.safe_dump({'streams': ['h04', 'h12'], 'output_dir': 'unused', 'differences': ['boolean_rgb'], 'about': about},
                           file)
        done = self.evaluate_bags('--config', self.path('about.yaml'), '--out', self.path('out'), self.path('all.bag'))
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn('another setting: about/weather was "rain,\\nthen: sun # and \\"wind\\"\\n", now "rain,', done.stdout)

    def test_a_report_stands_beside_the_results_unless_it_is_not_wanted(self):
        self.write_bags({'all.bag': [0, 1, 2]}, range(2))
        with open(self.path('reported.yaml'), 'w') as file:
            file.write(CONFIG.replace('report: false', 'report: true').replace('[boolean_rgb, euclidean_grey, sift, orb]', '[orb]'))
        for config, is_there in ((self.config, False), (self.path('reported.yaml'), True)):
            out = self.path('out_%d' % is_there)
            done = self.evaluate_bags('--config', config, '--out', out, self.path('all.bag'))
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertEqual(os.path.exists(out + '/report.html'), is_there, done.stdout)
        self.assertTrue(read(out, 'report.html').startswith(b'<!DOCTYPE html>'))
        streams = Streams(STREAMS[:2])
        live = Evaluator({'streams': STREAMS[:2], 'differences': ['orb'], 'output_dir': self.path('live'), 'poses': 1, 'report': True,
                          'exit_when_done': True})
        streams.wait_for(live)
        for stream in range(2):
            streams.send_capture(stream, stamp_of(0), 0)
            streams.send(stream, stamp_of(0), picture(0, stream, 160, 120))
        status, output = live.wait()
        streams.close()
        self.assertEqual(status, 0, output)
        self.assertTrue(read(self.path('live'), 'report.html').startswith(b'<!DOCTYPE html>'), output)

    def test_a_folder_of_one_bag_is_not_gone_on_with_by_another(self):
        self.write_bags({'all.bag': [0, 1]}, range(2))
        self.write_bags({'other.bag': [0, 1, 2]}, range(2))  # of the same stamps
        with open(self.path('both.yaml'), 'w') as file:
            file.write('{streams: [h04, h12], output_dir: unused, differences: [boolean_rgb], report: false}')
        evaluate = ['--config', self.path('both.yaml'), '--out', self.path('out')]
        self.assertEqual(self.evaluate_bags(*evaluate, self.path('all.bag')).returncode, 0)
        whole = read(self.path('out'), 'frames.csv')
        done = self.evaluate_bags(*evaluate, self.path('other.bag'))
        self.assertEqual(done.returncode, 1)
        self.assertIn('out: this folder holds results of another bag, all.bag, which would be taken for those of one run',
                      done.stdout)
        os.rename(self.path('all.bag'), self.path('moved.bag'))
        self.assertEqual(self.evaluate_bags(*evaluate, self.path('moved.bag')).returncode, 0)
        self.assertEqual(read(self.path('out'), 'frames.csv'), whole)

    def test_two_recordings_of_one_stamp_are_not_taken_for_one_place(self):
        self.write_bags({'morning.bag': [0]}, range(3))
        self.write_bags({'noon.bag': [1]}, range(3), begin=2.0)
        with open(self.path('both.yaml'), 'w') as file:
            file.write('{streams: [h04, h12], output_dir: unused, differences: [boolean_rgb], report: false}')
        done = self.evaluate_bags('--config', self.path('both.yaml'), '--out', self.path('out'), self.path('morning.bag'),
                                  self.path('noon.bag'))
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertIn('3 two_places (h04-h12)', done.stdout)
        self.assertEqual([row['reason'] for row in rows(self.path('out'), 'problems.csv')],
                         3 * ['two poses of this stamp are 2 m and 0 deg apart: are these two recordings?'])
        self.assertIn('path.csv: 3 poses of stamps of two places left out', done.stdout)
        self.assertFalse(os.path.exists(self.path('out/path.csv')))

    def test_poses_of_bags_in_other_frames_are_warned_of(self):
        self.write_bags({'morning.bag': [0]}, range(2), frame='/map')
        self.write_bags({'same.bag': [1]}, range(2), frame='map')
        self.write_bags({'noon.bag': [1]}, range(2), frame='odom')
        with open(self.path('both.yaml'), 'w') as file:
            file.write('{streams: [h04, h12], output_dir: unused, differences: [boolean_rgb], report: false}')
        both = ['--config', self.path('both.yaml'), '--out']
        done = self.evaluate_bags(*both, self.path('one'), self.path('morning.bag'), self.path('same.bag'))
        self.assertEqual((done.returncode, 'warning: ' in done.stdout), (0, False), done.stdout)
        done = self.evaluate_bags(*both, self.path('two'), self.path('morning.bag'), self.path('noon.bag'))
        self.assertEqual((done.returncode, done.stdout.count('warning: ')), (0, 1), done.stdout)
        told = [row for row in rows(self.path('two'), 'problems.csv') if row['kind'] == 'other_frame']
        self.assertEqual([(row['stamp'], row['where']) for row in told], [('1000.000000000', 'pose')])
        reason = told[0]['reason'].strip('"')
        self.assertIn('warning: %s\n' % reason, done.stdout)
        for part in ('/camera/pose of ' + self.path('morning.bag'), '/camera/pose of ' + self.path('noon.bag'), 'in the frame ',
                     'map', 'odom', ': errors mean nothing unless these are one frame'):
            self.assertIn(part, reason)

    def test_topics_may_lack_their_slash(self):
        self.write_bags({'usual.bag': [0, 1, 2]}, range(11))
        self.write_bags({'bare.bag': [0, 1, 2]}, range(11), root='')
        for name in ('usual', 'bare'):
            done = self.evaluate_bags('--config', self.config, '--out', self.path(name), self.path(name + '.bag'))
            self.assertEqual(done.returncode, 0, done.stdout)
        for name in RESULTS + ['captures.csv', 'path.csv']:
            self.assertEqual(read(self.path('bare'), name), read(self.path('usual'), name))
        done = self.evaluate_bags('--out', self.path('all'), self.path('bare.bag'))
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_without_a_config_all_streams_of_the_bags_are_compared_by_all_differences(self):
        self.write_bags({'all.bag': [2, 0, 1]}, range(2))
        done = self.evaluate_bags('--out', self.path('out'), self.path('all.bag'))
        self.assertEqual(done.returncode, 0, done.stdout)
        summary = rows(self.path('out'), 'summary.csv')
        self.assertEqual(sorted({(r['a'], r['b']) for r in summary}), [('h04', 'h12'), ('h04', 'h20'), ('h12', 'h20')])
        self.assertTrue({'boolean_rgb', 'boolean_grey', 'euclidean_rgb', 'euclidean_grey', 'sift', 'orb', 'brisk'} <=
                        {r['difference'] for r in summary})

    def test_a_config_without_streams_is_of_all_that_the_bags_hold(self):
        self.write_bags({'all.bag': [2, 0]}, range(2))
        with open(self.path('short.yaml'), 'w') as file:
            file.write('differences: [boolean_rgb]\n')
        done = self.evaluate_bags('--config', self.path('short.yaml'), '--out', self.path('out'), self.path('all.bag'))
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual([(r['a'], r['b'], r['difference']) for r in rows(self.path('out'), 'summary.csv')],
                         [('h04', 'h20', 'boolean_rgb')])

    def test_the_shipped_file_is_accepted_and_states_the_defaults(self):
        self.write_bags({'all.bag': [0, 1, 2]}, range(2))
        shipped = os.path.join(rospkg.RosPack().get_path('sunlit'), 'config', 'evaluator.yaml')
        with open(self.path('plain.yaml'), 'w') as file:
            file.write('streams: [h04, h12, h20]  # text that nobody quotes\noutput_dir: unused  # too\n')
        settings = []
        for name, config in (('shipped', shipped), ('plain', self.path('plain.yaml'))):
            done = self.evaluate_bags('--config', config, '--out', self.path(name), self.path('all.bag'))
            self.assertEqual(done.returncode, 0, done.stdout)
            settings.append(yaml.safe_load(read(self.path(name), 'run.yaml'))['settings'])
        self.assertEqual(settings[0], settings[1])

    def test_a_file_means_what_rosparam_reads_in_it(self):
        self.write_bags({'all.bag': [0, 1]}, range(2))
        text = """streams: [h04, 'h12']
output_dir: unused
images: none      # a comment
inclusive: yes    # as true
ratio: 1
pairs:
  - {a: h04, b: "h12"}
about:
  number: 12
  text: "12 # no comment"
  list: [1, two, 3.5, off]
"""
        with open(self.path('mixed.yaml'), 'w') as file:
            file.write(text)
        done = self.evaluate_bags('--config', self.path('mixed.yaml'), '--out', self.path('out'), self.path('all.bag'))
        self.assertEqual(done.returncode, 0, done.stdout)
        settings = yaml.safe_load(read(self.path('out'), 'run.yaml'))['settings']
        expected = {'inclusive': 'true', 'ratio': '1', 'about/number': '12', 'about/text': '12 # no comment',
                    'about/list': '[1, two, 3.5, false]'}
        self.assertEqual({key: settings[key] for key in expected}, expected)
        self.assertFalse(os.path.exists(self.path('out/images')))

    def write_image_bag(self, name, messages):
        with rosbag.Bag(self.path(name), 'w') as bag:
            for topic, message in messages:
                bag.write(topic, message, message.header.stamp)

    def test_no_topic_leads_out_of_the_output_folder(self):
        for topic in ('/../../x', '/a/../../../x', '/..', '/a b', '/h12/'):
            self.write_image_bag('evil.bag', [('/h04/camera/image_raw', image_message(stamp_of(0), picture(0, 0))),
                                              (topic + '/camera/image_raw', image_message(stamp_of(0), picture(0, 1)))])
            before = sorted(os.listdir(self.folder.name))
            done = self.evaluate_bags('--out', self.path('out'), self.path('evil.bag'))
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn('topic %s/camera/image_raw' % topic, done.stdout)
            self.assertIn('but must be the name of a stream', done.stdout)
            self.assertEqual(sorted(os.listdir(self.folder.name)), before)

    def test_compressed_images_of_bags_are_taken_where_there_are_no_raw_ones(self):
        messages = []
        for pose in range(4):
            for stream in range(2):
                pixels = picture(pose, stream)
                # Of h12 the raw images are other ones, so that it shows which were taken.
                raw = image_message(stamp_of(pose), pixels if stream == 0 else picture(pose, 7))
                packed = CompressedImage(format='png', data=cv2.imencode('.png', pixels[:, :, ::-1])[1].tobytes())
                packed.header.stamp = stamp_of(pose)
                if stream == 1:
                    messages.append(('/h12/camera/image_raw', raw))
                    messages.append(('/h12/camera/image_raw/compressed', packed))
                else:
                    messages.append(('/h04/camera/image_raw/compressed', packed))
                    messages.append(('/other/h04/camera/image_raw', raw))
        self.write_image_bag('mixed.bag', messages)
        values = {}
        for transport in ('raw', 'compressed'):
            with open(self.path('mixed.yaml'), 'w') as file:
                file.write('streams: [h04, h12]\noutput_dir: unused\nimages: all\ndifferences: [boolean_rgb]\n'
                           'image_transport: %s\n' % transport)
            done = self.evaluate_bags('--config', self.path('mixed.yaml'), '--out', self.path(transport),
                                      self.path('mixed.bag'))
            self.assertEqual(done.returncode, 0, done.stdout)
            chosen = '/h12/camera/image_raw' + ('/compressed' if transport == 'compressed' else '')
            self.assertIn('h12: the bags hold raw and compressed images; those of %s count' % chosen, done.stdout)
            self.assertNotIn('h04: the bags hold', done.stdout)
            shown = cv2.imread(self.path(transport + '/images/h12/000002.png'))[:, :, ::-1]
            self.assertTrue((shown == picture(2, 7 if transport == 'raw' else 1)).all())
            shown = cv2.imread(self.path(transport + '/images/h04/000002.png'))[:, :, ::-1]
            self.assertTrue((shown == picture(2, 0)).all())
        # Without a config all streams are found, however they travelled.
        done = self.evaluate_bags('--out', self.path('all'), self.path('mixed.bag'))
        self.assertEqual({(r['a'], r['b']) for r in rows(self.path('all'), 'summary.csv')},
                         {('h04', 'h12'), ('h04', 'other/h04'), ('h12', 'other/h04')}, done.stdout)
        frames = rows(self.path('all'), 'frames.csv')
        self.assertEqual({r['value'] for r in frames if r['a'] == 'h04' and r['b'] == 'other/h04' and
                          r['difference'] == 'boolean_rgb'}, {'0'})

    def test_images_without_stamps_are_no_success(self):
        def write(name, stamps):
            with rosbag.Bag(self.path(name), 'w') as bag:
                for image in range(7):
                    for stream in range(2):
                        bag.write('/%s/camera/image_raw' % STREAMS[stream],
                                  image_message(rospy.Time(stamps[image]), picture(image, stream)), stamp_of(image))

        write('unstamped.bag', 7 * [0])
        done = self.evaluate_bags('--out', self.path('unstamped'), self.path('unstamped.bag'))
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertIn('h04: all 7 images have stamp 0.000000000, so that one counts: does the driver set header.stamp?; '
                      'h12: all 7 images', done.stdout)
        kinds = [row['kind'] for row in rows(self.path('unstamped'), 'problems.csv')]
        self.assertEqual(kinds.count('duplicate'), 2)  # of one stamp, a line each stream
        self.assertEqual(set(kinds), {'duplicate', 'no_features'})  # pictures too small for some detector
        self.assertFalse(yaml.safe_load(read(self.path('unstamped'), 'run.yaml'))['outcome']['whole'])
        write('slow.bag', [1, 2, 2, 2, 3, 3, 3])
        done = self.evaluate_bags('--out', self.path('slow'), self.path('slow.bag'))
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertIn('h04: 4 of 7 images have a stamp that had come before, and were left out; h12: 4 of', done.stdout)
        write('few.bag', [1, 2, 3, 4, 5, 6, 6])
        done = self.evaluate_bags('--out', self.path('few'), self.path('few.bag'))
        self.assertEqual(done.returncode, 0, done.stdout)
        for stream in STREAMS[:2]:
            self.assertIn(stream + ': 1 images of a stamp that had come before, left out', done.stdout)
            self.assertIn(stream + ': 6 times a detector found nothing in an image (no_features)', done.stdout)

    def test_bad_bags_and_arguments_are_one_clear_line(self):
        self.write_bags({'one.bag': [2], 'all.bag': [0, 1, 2]}, range(2))
        with open(self.path('no.bag'), 'w') as file:
            file.write('not a bag')
        with open(self.path('wrong.yaml'), 'w') as file:
            file.write(CONFIG + 'ratoi: 0.4\n')
        with open(self.path('broken.yaml'), 'w') as file:
            file.write(CONFIG + 'ratio: [0.4\nimages: all\n')
        with open(self.path('streamless.yaml'), 'w') as file:
            file.write('ratio: 0.4\n')
        with open(self.path('list.yaml'), 'w') as file:
            file.write('- h04\n')
        with open(self.path('twice.yaml'), 'w') as file:
            file.write(CONFIG + 'features: {orb: {count: 100}}\nfeatures: {sift: {count: 100}}\n')
        with open(self.path('two.yaml'), 'w') as file:
            file.write(CONFIG + '---\nratio: 0.4\n')
        with open(self.path('itself.yaml'), 'w') as file:
            file.write(CONFIG + 'features: &all {orb: *all}\n')
        with open(self.path('endless.yaml'), 'w') as file:
            file.write(',]')  # of which yaml-cpp makes documents without end
        with open(self.path('many.yaml'), 'w') as file:
            file.write(CONFIG + 'a: &a [1]\n')
            for letter, before in zip('bcdefghi', 'abcdefgh'):  # ten times as many each
                file.write('%s: &%s [%s]\n' % (letter, letter, ', '.join(10 * ['*' + before])))
        for name, topic in (('capture.bag', '/h04/camera/capture'), ('pose.bag', '/camera/pose')):
            shutil.copy(self.path('all.bag'), self.path(name))
            with rosbag.Bag(self.path(name), 'a') as bag:
                bag.write(topic, String(data='by somebody else'), stamp_of(0))
        self.write_image_bag('plain.bag', [('/%s/camera/image_raw' % stream, image_message(stamp_of(0), picture(0, 0)))
                                           for stream in STREAMS])
        self.write_image_bag('robot.bag', [('/front/image', image_message(stamp_of(0), picture(0, 0)))])
        os.mkdir(self.path('full'))
        with open(self.path('full/images'), 'w') as file:
            file.write('where the folder of the pictures should be')
        broken_line = CONFIG.count('\n') + 2  # where the list should have ended
        start = ['--config', self.config, '--out', self.path('out')]
        cases = [(start + [self.path('no.bag')], 'no.bag: is not a bag'),
                 (start + [self.path('absent.bag')], 'absent.bag'),
                 (start + [self.path('one.bag')], 'the bags hold neither /h04/camera/image_raw nor'),
                 (start + [self.path('plain.bag')], 'every of the pair h12-h20 is 10, but must be 1 for bags without '),
                 (['--config', self.path('wrong.yaml'), '--out', self.path('out'), self.path('one.bag')], 'ratoi'),
                 (['--config', self.path('broken.yaml'), '--out', self.path('out'), self.path('one.bag')],
                  'broken.yaml:%d: ' % broken_line),
                 (['--config', self.path('list.yaml'), '--out', self.path('out'), self.path('one.bag')],
                  'list.yaml:1: is not a YAML map of parameters'),
                 (['--config', self.path('twice.yaml'), '--out', self.path('out'), self.path('one.bag')],
                  'twice.yaml:%d: is not a YAML map of parameters: features is given twice' % broken_line),
                 (['--config', self.path('two.yaml'), '--out', self.path('out'), self.path('one.bag')],
                  'there are several documents'),
                 (['--config', self.path('itself.yaml'), '--out', self.path('out'), self.path('one.bag')],
                  'more than 50 values within each other; does an anchor (&) hold itself?'),
                 (['--config', self.path('endless.yaml'), '--out', self.path('out'), self.path('one.bag')],
                  'endless.yaml:1: is not a YAML map of parameters: there are no keys'),
                 (['--config', self.path('many.yaml'), '--out', self.path('out'), self.path('one.bag')],
                  'more than 1000000 values'),
                 (start + [self.path('capture.bag')], '/h04/camera/capture is std_msgs/String, not sunlit/Capture'),
                 (start + [self.path('pose.bag')], '/camera/pose is std_msgs/String, not geometry_msgs/PoseStamped'),
                 (['--config', self.path('no.yaml'), '--out', self.path('out'), self.path('one.bag')], 'no.yaml'),
                 (['--config', self.config, '--out', '/proc/out', self.path('all.bag')], '/proc/out'),
                 (['--config', self.config, '--out', self.path('full'), self.path('all.bag')],
                  'full/images/h04: the folder cannot be made'),
                 (start, 'no bag given'),
                 (start + ['--detectors', 'orb', self.path('all.bag')], '--detectors needs --map or --odometry too'),
                 (start + ['--depth', '/depth', self.path('all.bag')], '--depth needs --map or --odometry too'),
                 (start + ['--merge', self.folder.name, '--ratio', '0.7'], '--ratio needs --map or --odometry too'),
                 (['--config', self.path('streamless.yaml'), '--out', self.path('out'), '--merge', self.folder.name],
                  'streamless.yaml/streams is missing, but must be a list of names'),
                 (start + ['--merge', self.folder.name], 'holds no run'),
                 (['--out', self.path('out'), self.path('robot.bag')],
                  'the bags hold neither /<stream>/camera/image_raw nor that with /compressed; they hold: /front/image; '
                  'say what stands before <stream> by --namespace, or record a bag anew under such names: rosbag play '
                  'BAG TOPIC:=/STREAM/camera/image_raw while rosbag record -a runs'),
                 (['--namespace', 'h08', '--out', self.path('out'), self.path('robot.bag')],
                  'the bags hold neither /h08/<stream>/camera/image_raw nor'),
                 (['--colour'], '--colour')]
        for arguments, expected in cases:
            done = self.evaluate_bags(*arguments)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn(expected, done.stdout)


if __name__ == '__main__':
    rospy.init_node('test_evaluator_bags')
    rostest.rosrun('sunlit', 'test_evaluator_bags', TestBags)
