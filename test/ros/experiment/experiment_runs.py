#!/usr/bin/python3
"""experiment.launch from end to end: its results, its exit status, and that it leaves nothing behind."""
import csv
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

import rosbag
import rospy
import rostest
import yaml
from launching import DIFFERENCES, LONG, POSES, WORLD, WORLDS, Launched, Terminal, kill_leftovers, small_experiment
from std_srvs.srv import Trigger
from sunlit.srv import SetDateTime, SetSite

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "support"))
from screen import Screen  # noqa: E402

OTHER_INPUTS = "inputs.yaml: the run in this folder was made from something else"
BAKED = "Sky light and bounced light at"


class ExperimentRuns(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        """One undisturbed run, recorded, that others are compared with."""
        cls.folder = tempfile.mkdtemp()
        cls.output = os.path.join(cls.folder, "undisturbed")
        cls.undisturbed = small_experiment(cls.output, record="true", report="true", images="true")
        cls.status = cls.undisturbed.end()

    @classmethod
    def tearDownClass(cls):
        kill_leftovers()
        shutil.rmtree(cls.folder)

    def bytes_of(self, folder, name="summary.csv"):
        with open(os.path.join(folder, name), "rb") as file:
            return file.read()

    def test_ends_with_status_0_and_nothing_left_running(self):
        self.assertEqual(self.status, 0, self.undisturbed.said())
        self.assertEqual(self.undisturbed.left_running(), [])

    def test_results_are_whole(self):
        with open(os.path.join(self.output, "summary.csv")) as file:
            rows = list(csv.DictReader(file))
        self.assertEqual({(row["a"], row["b"]) for row in rows},
                         {("h10", "h12"), ("h10", "self_test/h10"), ("h12", "self_test/h12")})
        for row in rows:
            is_self_test = row["b"].startswith("self_test")
            self.assertEqual(int(row["n"]) + int(row["undefined"]), 4 if is_self_test else POSES)
            if row["difference"] in ("boolean_rgb", "euclidean_grey"):
                # Two processes, one sun: to the bit. Two suns: not.
                self.assertEqual(float(row["mean"]) == 0.0, is_self_test, row)
        for name in ("frames.csv", "captures.csv", "path.csv", "run.yaml", "map.png", "map.yaml", "timing.csv", "inputs.yaml", "rasterizer.yaml", "ground.yaml",
                     "report.html", "images/h10/000000.png", "images/h12/000019.png"):
            self.assertTrue(os.path.exists(os.path.join(self.output, name)), name)

    def bags(self):
        return [os.path.join(self.output, name) for name in os.listdir(self.output) if name.endswith(".bag")]

    def test_recording_holds_every_message(self):
        bags = self.bags()
        self.assertEqual(len(bags), 1)
        with rosbag.Bag(bags[0]) as bag:
            for topic in ("/h10/camera/image_raw", "/h12/camera/image_raw", "/h10/camera/camera_info", "/camera/pose",
                          "/h12/camera/capture", "/camera/depth/image_raw"):
                stamps = [message.header.stamp.to_nsec() for _, message, _ in bag.read_messages(topic)]
                self.assertEqual(stamps, [1000 * 10**9 + pose * 10**8 for pose in range(POSES)], topic)
            for topic in ("/h10/sun", "/h10/moon", "/h12/celestial"):
                self.assertGreaterEqual(bag.get_message_count(topic), 1, topic)

    def test_compressed_the_pictures_are_recorded_as_png_and_no_value_changes(self):
        output = os.path.join(self.folder, "compressed")
        run = small_experiment(output, record="true", compressed="true")
        self.assertEqual(run.end(), 0, run.said())
        self.assertEqual(self.bytes_of(output, "frames.csv"), self.bytes_of(self.output, "frames.csv"))
        bag, = [name for name in os.listdir(output) if name.endswith(".bag")]
        with rosbag.Bag(os.path.join(output, bag)) as recording:
            topics = recording.get_type_and_topic_info().topics
            for hour in ("h10", "h12"):
                raw = "/%s/camera/image_raw" % hour
                self.assertNotIn(raw, topics)
                self.assertEqual(topics[raw + "/compressed"].msg_type, "sensor_msgs/CompressedImage")
                stamps = [image.header.stamp.to_nsec() for _, image, _ in recording.read_messages(raw + "/compressed")]
                self.assertEqual(stamps, [1000 * 10**9 + pose * 10**8 for pose in range(POSES)])
            self.assertEqual(topics["/camera/depth/image_raw"].msg_type, "sensor_msgs/Image")

    def test_recording_is_listed(self):
        with open(os.path.join(self.output, "recording.csv")) as file:
            self.assertEqual([(row["first_pose"], row["last_pose"], row["poses"]) for row in csv.DictReader(file)],
                             [("0", "19", "20")])

    def test_it_says_where_it_is_in_lines_and_no_node_says_more_than_warnings(self):
        said = self.undisturbed.said()
        doing = [line.split(":")[1].strip() for line in said.splitlines() if line.startswith("experiment: ") and " poses (" in line]
        self.assertEqual(doing[-2:], ["checking the recording", "reporting"], said)
        self.assertEqual(said.count("what each node says is in "), 1)
        self.assertIn("experiment: done; results in " + self.output, said)
        for note in ("[ INFO]", "World ", "evaluated ", "Subscribing to"):
            self.assertNotIn(note, said)
        logs = said.split("what each node says is in ")[1].split("\n")[0]
        log_of_renderer, = [name for name in os.listdir(logs) if name.startswith("render-") and name.endswith("-stdout.log")]
        with open(os.path.join(logs, log_of_renderer)) as log:
            self.assertIn("World ", log.read())

    def world_with(self, content):
        """The boxes, and this."""
        with open(os.path.join(WORLDS, "two_boxes.world")) as file:
            boxes = file.read()
        world = os.path.join(self.folder, "with.world")
        with open(world, "w") as file:
            file.write(boxes.replace('<world name="two_boxes">', '<world name="two_boxes">' + content))
        return world

    def skip_without_sdf(self, run):
        """Once it has ended."""
        if "this build of sunlit reads no SDF" in run.said():
            self.skipTest("needs libsdformat 12 or 9: this build of sunlit reads no SDF")

    def test_what_the_world_has_amiss_is_said_once(self):
        site = "<latitude_deg>47.4</latitude_deg><longitude_deg>8.5</longitude_deg><elevation>400</elevation>"
        world = self.world_with("<scene><fog><type>linear</type></fog></scene><spherical_coordinates>%s</spherical_coordinates>" % site)
        for given, times in (({}, 1), ({"site": "[47.4, 8.5, 400]"}, 0)):
            run = small_experiment(os.path.join(self.folder, "amiss%d" % times), world=world, poses=6, **given)
            status = run.end()
            self.skip_without_sdf(run)
            self.assertEqual(status, 0, run.said())
            self.assertEqual(run.said().count("fog is a parameter of the weather"), 1, run.said())
            self.assertEqual(run.said().count("the sun is of another site"), times, run.said())

    def test_why_a_world_cannot_be_loaded_is_said_once(self):
        run = small_experiment(os.path.join(self.folder, "gone"), world=self.world_with("<include><uri>model://gone</uri></include>"))
        self.assertNotEqual(run.end(), 0)
        self.skip_without_sdf(run)
        self.assertEqual(run.said().count("there is no model://gone"), 1, run.said())
        self.assertEqual(run.left_running(), [])

    def test_replayed_recording_gives_the_same_bytes(self):
        output = os.path.join(self.folder, "replayed")
        evaluator = Launched("evaluator.launch", streams="[h10, h12]", differences=DIFFERENCES, poses=POSES, output=output,
                             exit_when_done="true")
        evaluator.wait_for(lambda: "/evaluator" in evaluator.subscribers("/h10/camera/image_raw"), "subscribed")
        # Only what the evaluator hears, since the player waits for subscribers of all that it plays.
        topics = ["/camera/pose"] + ["/%s/camera/%s" % (hour, topic) for hour in ("h10", "h12")
                                     for topic in ("image_raw", "capture")]
        played = evaluator.ros("rosbag", "play", "--quiet", "--wait-for-subscribers", *self.bags(), "--topics", *topics)
        self.assertEqual(played.returncode, 0, played.stdout)
        self.assertEqual(evaluator.end(), 0, evaluator.said())
        # The recording holds no self-test.
        expected = [line for line in self.bytes_of(self.output).splitlines() if b"self_test" not in line]
        self.assertEqual(self.bytes_of(output).splitlines(), expected)

    def killed(self, name, **changes):
        """The folder of a run that was killed after its first poses."""
        for attempt in range(5):  # on a machine that stalls, a run may be over before it is killed
            output = os.path.join(self.folder, "%s_%d" % (name, attempt))
            frames = os.path.join(output, "frames.csv")
            run = small_experiment(output, max_ahead=1, **changes)  # slowly
            rows = lambda: self.bytes_of(output, "frames.csv").count(b"\n") if os.path.exists(frames) else 0
            # The time sheet is written after the first pose.
            run.wait_for(lambda: rows() > 12 and b"geometry" in self.bytes_of(output, "timing.csv"), "evaluated poses")
            run.kill()
            self.assertEqual(run.left_running(), [])
            if not os.path.exists(os.path.join(output, "summary.csv")):
                return output
        raise AssertionError("always killed too late to be a test")

    def test_resumed_after_sigkill_it_gives_the_same_bytes(self):
        output = self.killed("killed")
        again = small_experiment(output, verbose="true")
        self.assertEqual(again.end(), 0, again.said())
        self.assertEqual(self.bytes_of(output), self.bytes_of(self.output))
        # The world was loaded by both runs.
        self.assertIn("Going on at pose", again.said())
        with open(os.path.join(output, "timing.csv")) as file:
            counts = {(row["stage"], row["what"]): int(row["count"]) for row in csv.DictReader(file)}
        self.assertEqual(counts["load", "world"], 2)

    def test_what_a_kill_left_of_a_recording_is_completed(self):
        output = self.killed("killed_recording", record="true")
        left = [name for name in os.listdir(output) if name.startswith("recording_")]
        self.assertTrue(left)
        ended = subprocess.Popen(["true"])
        ended.wait()
        with open(os.path.join(output, "frames.csv.%d.0.part" % ended.pid), "w"):
            pass  # as if killed in the midst of writing
        for name in left:  # the recorder has had its time to close it
            os.rename(os.path.join(output, name), os.path.join(output, name.replace(".bag.active", ".bag") + ".active"))
        again = small_experiment(output, record="true")
        self.assertEqual(again.end(), 0, again.said())
        self.assertEqual(self.bytes_of(output), self.bytes_of(self.output))
        self.assertIn("was left by a run that was killed: reindexing it", again.said())
        self.assertEqual([name for name in os.listdir(output) if name.endswith((".active", ".part"))], [])
        self.assertIn("experiment: recorded 20 poses in 2 bags", again.said())
        stamps = {topic: set() for topic in ("/h10/camera/image_raw", "/camera/depth/image_raw", "/h12/camera/capture")}
        for name in os.listdir(output):
            if name.endswith(".bag"):
                with rosbag.Bag(os.path.join(output, name)) as bag:
                    for topic, message, _ in bag.read_messages(list(stamps)):
                        stamps[topic].add(message.header.stamp.to_nsec())
        for topic, held in stamps.items():
            self.assertEqual(held, {1000 * 10**9 + pose * 10**8 for pose in range(POSES)}, topic)

    def test_a_run_that_is_evaluated_but_was_not_recorded_is_rendered_for_the_recorder_alone(self):
        output = os.path.join(self.folder, "recorded_later")
        shutil.copytree(self.output, output, ignore=shutil.ignore_patterns("*.bag"))
        again = small_experiment(output, images="true", record="true")
        self.assertEqual(again.end(), 0, again.said())
        self.assertIn("experiment: recorded 20 poses in 1 bag", again.said())
        self.assertIn("done; an earlier run had evaluated all; results in ", again.said())
        self.assertEqual(self.bytes_of(output, "frames.csv"), self.bytes_of(self.output, "frames.csv"))

    def set_meanwhile(self, output, service, kind, **request):
        """What an experiment says that fails since this is set once some poses are rendered, and rows of problems.csv: all of h12
        from then on are under another sun."""
        captures = os.path.join(output, "captures.csv")
        run = small_experiment(output, max_ahead=1)
        run.wait_for(lambda: os.path.exists(captures) and self.bytes_of(output, "captures.csv").count(b"\nh12,") > 2, "rendered poses")
        self.assertTrue(run.call("/render/pause", Trigger).success)
        self.assertTrue(run.call(service, kind, **request).success)
        self.assertTrue(run.call("/render/start", Trigger).success)
        self.assertNotEqual(run.end(), 0)
        with open(os.path.join(output, "problems.csv")) as file:
            others = [row for row in csv.DictReader(file) if row["kind"] == "other_sun"]
        of_h12 = [int(row["pose"]) for row in others if row["where"] == "h12"]
        self.assertEqual(of_h12, list(range(of_h12[0], POSES)))
        self.assertGreater(of_h12[0], 1)
        return run.said(), others

    def test_a_sun_that_is_set_meanwhile_is_a_failure_that_the_same_run_again_mends(self):
        output = os.path.join(self.folder, "set_meanwhile")
        said, others = self.set_meanwhile(output, "/h12/sun_position/set_date_time", SetDateTime, year=2024, month=7, day=1, hour=9,
                                          timezone=3)
        of_h12 = [int(row["pose"]) for row in others if row["where"] == "h12"]
        reason = ("its sky is of 2024-07-01T06:00:00.000Z, not of 2024-07-01T09:00:00.000Z as by the first capture: was the sun set "
                  "meanwhile (set_date_time)? ")
        self.assertTrue(all(row["reason"].startswith(reason) for row in others), others)
        self.assertEqual({row["where"] for row in others} - {"self_test/h12"}, {"h12"})
        self.assertEqual(said.count(" h12: %d images under another sun than the first, as of pose %d: %s"
                                    % (len(of_h12), of_h12[0], reason)), 1, said)
        self.assertIn("%d other_sun (h10-h12)" % len(of_h12), said)
        self.assertIn("experiment: FAILED: ", said)
        again = small_experiment(output)
        self.assertEqual(again.end(), 0, again.said())
        self.assertEqual(self.bytes_of(output), self.bytes_of(self.output))
        self.assertNotIn(b"other_sun", self.bytes_of(output, "problems.csv"))

    def test_so_is_a_site_that_is_set_meanwhile(self):
        output = os.path.join(self.folder, "moved_meanwhile")
        said, others = self.set_meanwhile(output, "/h12/sun_position/set_site", SetSite, latitude=-20.0, longitude=49.0, elevation=90.0,
                                          pressure=1000.0, temperature=20.0)
        others = [row for row in others if row["where"] == "h12"]
        self.assertTrue(all("from that of the captures before, farther than it turns meanwhile: was the site set (set_site)?"
                            in row["reason"] for row in others), others)
        self.assertIn("%d other_sun (h10-h12)" % len(others), said)
        again = small_experiment(output)
        self.assertEqual(again.end(), 0, again.said())
        self.assertEqual(self.bytes_of(output), self.bytes_of(self.output))

    def test_on_a_terminal_the_line_stays_in_place(self):
        terminal = Terminal(24, 100)
        run = small_experiment(os.path.join(self.folder, "terminal"), {"TERM": "xterm"}, terminal)
        self.assertEqual(run.end(), 0)
        screen = Screen(24, 100)
        feet = screen.feet(terminal.text())
        self.assertTrue(any("/20 poses" in foot for foot in feet), feet)
        above = [line for line in screen.above() if line]
        self.assertEqual([line for line in above if "/20 poses" in line], [])
        self.assertTrue(any(line.startswith("experiment: done; results in ") for line in above), above)
        self.assertTrue(any(line.startswith("mean difference") for line in above), above)
        self.assertEqual(screen.region, (0, 23))

    def test_a_warning_of_a_node_is_seen_once(self):
        robot = os.path.join(self.folder, "faulty.urdf")
        with open(robot, "w") as file:
            file.write("""<robot name="faulty"><link name="base_link"><visual><geometry><box size="0.1 0.1 0.1"/></geometry>
              <material name="of_nowhere"/></visual></link></robot>""")
        run = small_experiment(os.path.join(self.folder, "warned"), robot=robot, self_test="false", poses=2)
        self.assertEqual(run.end(), 0, run.said())
        warnings = [line for line in run.said().splitlines() if "materials do not exist" in line and "of_nowhere" in line]
        self.assertEqual(len(warnings), 1, run.said())
        self.assertIn("[ WARN]", warnings[0])

    def broken_off(self, whole, poses):
        """A folder that holds the first poses of a whole run, which keeps nothing of single features, as if it had been
        broken off there."""
        output = "%s_from_%d" % (whole, poses)
        shutil.copytree(whole, output)
        os.remove(os.path.join(output, "summary.csv"))
        frames = os.path.join(output, "frames.csv")
        with open(frames) as file:
            heading, *rows = file.readlines()
        with open(frames, "w") as file:
            file.writelines([heading] + [row for row in rows if int(row.split(",")[0]) < poses])
        return output

    def test_resumed_anywhere_between_two_poses_of_the_self_test(self):
        whole = os.path.join(self.folder, "plain")
        plain = dict(images="true", differences="[boolean_rgb, euclidean_grey]")
        first = small_experiment(whole, **plain)
        self.assertEqual(first.end(), 0, first.said())
        # The self-test, of every 5th of 20 poses, has none left; or its next is too far ahead for it to begin with.
        for poses, max_ahead in ((17, 12), (11, 2)):
            output = self.broken_off(whole, poses)
            again = small_experiment(output, max_ahead=max_ahead, verbose="true", **plain)
            self.assertEqual(again.end(), 0, again.said())
            self.assertIn("Going on at pose %d" % poses, again.said())
            self.assertEqual(self.bytes_of(output), self.bytes_of(whole))

    def test_a_whole_run_does_not_grow_and_stays_as_it_is(self):
        output = os.path.join(self.folder, "grown")
        world = self.own_world()
        first = small_experiment(output, self_test="false", poses=4, world=world)
        self.assertEqual(first.end(), 0, first.said())
        names = ("frames.csv", "run.yaml", "localisation.csv", "lost_features.csv")
        before = [self.bytes_of(output, name) for name in names]

        def started_again(**changes):
            # Of a cache of its own, in which there is no bake.
            again = small_experiment(output, {"SUNLIT_CACHE_DIR": os.path.join(self.folder, "cache")}, self_test="false",
                                     verbose="true", **dict(dict(poses=4, world=world), **changes))
            return again.end(), again.said(), [self.bytes_of(output, name) for name in names]

        status, said, after = started_again(poses=6)
        self.assertNotEqual(status, 0)
        self.assertIn("holds a run of 4 poses that has ended", said)
        self.assertEqual(after, before)
        moved = self.own_world("moved")
        status, said, after = started_again(spacing="0.50", hours="[ 10,12.0]", ev100="14", night="True",
                                            world=os.path.relpath(moved))
        self.assertEqual(status, 0, said)
        self.assertIn("done; an earlier run had evaluated all; results in ", said)
        self.assertIn("nothing is left to render", said)
        self.assertNotIn(BAKED, said)
        self.assertEqual(after[0], before[0])
        settings = lambda files: yaml.safe_load(files[1])["settings"]
        self.assertEqual(settings(after), settings(before))  # in the words of the run that made it
        self.change(moved)
        status, said, after = started_again(world=moved)
        self.assertNotEqual(status, 0, said)
        self.assertIn(OTHER_INPUTS, said)
        self.assertIn("experiment: FAILED: render ended before it had compared", said)
        self.assertNotIn(BAKED, said)
        self.assertEqual(after[0], before[0])
        self.assertEqual(settings(after), settings(before))

    def own_world(self, folder="."):
        world = os.path.join(self.folder, folder, "mine.urdf")
        os.makedirs(os.path.dirname(world), exist_ok=True)
        shutil.copy(WORLD, world)
        return world

    def change(self, world):
        with open(world) as file:
            text = file.read()
        self.assertIn('"2 4 2"', text)
        with open(world, "w") as file:
            file.write(text.replace('"2 4 2"', '"2 4 3"'))  # one box grows

    def test_a_world_that_changed_meanwhile_is_not_mixed_with_the_old_one(self):
        world = self.own_world()
        output = self.killed("changed", world=world)
        before = self.bytes_of(output, "frames.csv")
        self.change(world)
        again = small_experiment(output, world=world)
        self.assertNotEqual(again.end(), 0)
        self.assertIn(OTHER_INPUTS, again.said())
        self.assertEqual(self.bytes_of(output, "frames.csv"), before)

    def test_a_renderer_that_dies_is_a_failure_with_a_reason(self):
        run = small_experiment(os.path.join(self.folder, "dying"), self_test="false", **LONG)
        run.wait_for(lambda: any("render_node" in command for _, command in run.running()), "started the renderer")
        run.kill("render_node")
        self.assertNotEqual(run.end(), 0)
        self.assertIn("experiment: FAILED: render ended before everything was evaluated", run.said())
        self.assertEqual(run.left_running(), [])

    def watched(self, name, renderer="", evaluator="", watcher=""):
        """experiment_node with stand-ins for the other nodes; these are their parameters."""
        output = os.path.join(self.folder, name)
        os.mkdir(output)
        launch_file = os.path.join(self.folder, name + ".launch")
        with open(launch_file, "w") as file:
            file.write("""<launch>
              <node pkg="sunlit" type="experiment_node" name="experiment" output="screen" required="true"><rosparam>
                {output: "%(output)s", poses: 3, images_a_pose: 1, verbose: false, self_test_every: 1,
                 needed: [render, evaluator], %(watcher)s}
              </rosparam></node>
              <node pkg="sunlit" type="stand_in.py" name="render" args="render" output="screen"><rosparam>
                {%(renderer)s}</rosparam></node>
              <node pkg="sunlit" type="stand_in.py" name="evaluator" args="evaluator" output="screen"><rosparam>
                {output: "%(output)s", %(evaluator)s}</rosparam></node>
            </launch>""" % locals())
        return Launched(launch_file), output

    def test_the_renderer_may_leave_before_the_results_are_written(self):
        run, output = self.watched("slow_disk", evaluator="is_slow: true")
        run.wait_for(lambda: "evaluating: 3 of 3 poses" in run.said(), "missed the renderer")
        with open(os.path.join(output, "go"), "w"):
            pass
        self.assertEqual(run.end(), 0, run.said())

    def test_an_evaluator_that_dies_between_its_first_and_its_last_result_is_a_failure(self):
        run, _ = self.watched("half", watcher='earlier: {summary: "", comparisons: ""}')
        self.assertNotEqual(run.end(), 0)
        self.assertIn("experiment: FAILED: evaluator ended before it had written comparisons.csv", run.said())

    def test_what_the_renderer_sends_after_the_last_value_is_recorded(self):
        topics = "[/camera/depth/image_raw, /h10/camera/image_raw]"
        run, output = self.watched("late", "images: 3, topics: " + topics, watcher=self.recording(topics))
        self.assertEqual(run.end(), 0, run.said())
        bag, = [name for name in os.listdir(output) if name.endswith(".bag")]
        with rosbag.Bag(os.path.join(output, bag)) as recording:
            self.assertEqual(recording.get_message_count(), 6)

    def recording(self, topics, begin=0):
        return "recording: {topics: %s, start_stamp: 1000.0, frame_rate: 10.0, begin: %d}" % (topics, begin)

    def test_a_recording_that_lacks_a_pose_everywhere_is_a_failure(self):
        topics = "[/camera/depth/image_raw, /h10/camera/image_raw]"
        run, _ = self.watched("lacking", "images: 2, topics: " + topics, watcher=self.recording(topics))
        self.assertNotEqual(run.end(), 0)
        self.assertIn("lacks poses: /camera/depth/image_raw: 2; /h10/camera/image_raw: 2", run.said())

    def test_the_watcher_itself_dies_and_nothing_is_left_running(self):
        run = small_experiment(os.path.join(self.folder, "unwatched"), record="true", max_ahead=1, **LONG)
        run.wait_for(lambda: any("recorder" in command for _, command in run.running()), "started the recorder")
        guards = lambda: {pid for pid, command in run.running() if "sunlit_experiment.guard" in command}
        first = guards()
        self.assertEqual(len(first), 1)
        run.kill("sunlit_experiment.guard")
        run.wait_for(lambda: guards() - first, "given a new guard to its watcher")
        run.kill("experiment_node")
        self.assertNotEqual(run.end(), 0)
        self.assertIn("experiment: FAILED: the node that watches over it was killed", run.said())
        self.assertEqual(run.left_running(), [])

    def test_roslaunch_itself_dies_and_nothing_is_left_running(self):
        run = small_experiment(os.path.join(self.folder, "orphaned"), record="true", max_ahead=1, **LONG)
        run.wait_for(lambda: any("recorder" in command for _, command in run.running()), "started the recorder")
        run.process.kill()
        run.process.wait()
        self.assertEqual(run.left_running(), [])
        self.assertIn("experiment: FAILED: roslaunch has gone", run.said())

    def test_what_an_earlier_run_left_on_the_master_does_not_matter(self):
        # The master of this test. Each of these would change the run or end it.
        rospy.set_param("/experiment/record", ["/camera/pose"])
        rospy.set_param("/evaluator/ratio", 0.9)
        rospy.set_param("/render/camera/follow", "tf")
        rospy.set_param("/self_test/render/no_such_key", 1)
        output = os.path.join(self.folder, "second_on_a_master")
        run = small_experiment(output, {"ROS_MASTER_URI": os.environ["ROS_MASTER_URI"]})
        self.assertEqual(run.end(), 0, run.said())
        self.assertEqual(self.bytes_of(output), self.bytes_of(self.output))
        self.assertEqual([name for name in os.listdir(output) if name.endswith(".bag")], [])

    def test_a_namespace_of_the_user_does_not_matter(self):
        output = os.path.join(self.folder, "with space")
        run = small_experiment(output, {"ROS_NAMESPACE": "robot"})
        self.assertEqual(run.end(), 0, run.said())
        self.assertEqual(self.bytes_of(output), self.bytes_of(self.output))

    def test_a_robot_casts_its_shadow_in_both_renderers(self):
        output = os.path.join(self.folder, "with_robot")
        # The lidar on its bow is seen at the lower edge at every hour.
        run = small_experiment(output, robot="rover", poses=2, self_test_every=1, images="true")
        self.assertEqual(run.end(), 0, run.said())
        with open(os.path.join(output, "summary.csv")) as file:
            for row in csv.DictReader(file):
                if row["b"].startswith("self_test") and row["difference"] == "boolean_rgb":
                    self.assertEqual(float(row["mean"]), 0.0, row)
        name = "images/h10/000000.png"
        self.assertNotEqual(self.bytes_of(output, name), self.bytes_of(self.output, name))

    def test_noise_is_the_same_in_both_renderers(self):
        output = os.path.join(self.folder, "noise")
        run = small_experiment(output, poses=2, self_test_every=1, images="true", differences="[boolean_rgb]", noise="true",
                               noise_seed=7)
        self.assertEqual(run.end(), 0, run.said())  # not 0 where a self-test of a direct difference is not exactly 0
        name = "images/h10/000000.png"
        self.assertNotEqual(self.bytes_of(output, name), self.bytes_of(self.output, name))
        with open(os.path.join(output, "run.yaml")) as file:
            settings = yaml.safe_load(file)["settings"]
        self.assertEqual((settings["about/noise"], settings["about/noise_seed"]), ("true", "7"))

    def test_final_gathering_is_the_same_in_both_renderers(self):
        output = os.path.join(self.folder, "final_gather")
        run = small_experiment(output, poses=2, self_test_every=1, images="true", differences="[boolean_rgb]", final_gather=2)
        self.assertEqual(run.end(), 0, run.said())  # not 0 where a self-test of a direct difference is not exactly 0
        name = "images/h10/000000.png"
        self.assertNotEqual(self.bytes_of(output, name), self.bytes_of(self.output, name))  # a box of 1 m is in view
        with open(os.path.join(output, "run.yaml")) as file:
            self.assertEqual(yaml.safe_load(file)["settings"]["about/final_gather"], "2")

    def test_started_again_when_finished_it_only_says_so(self):
        before = self.bytes_of(self.output, "frames.csv")
        again = small_experiment(self.output)
        self.assertEqual(again.end(), 0, again.said())
        self.assertEqual(self.bytes_of(self.output, "frames.csv"), before)

    def test_letters_that_a_terminal_lacks_are_replaced(self):
        again = small_experiment(self.output, {"PYTHONIOENCODING": "ascii"}, report="true")
        self.assertEqual(again.end(), 0, again.said())
        self.assertIn("Report: ", again.said())

    def test_a_start_that_is_refused_leaves_the_finished_run_as_it_is(self):
        def files():
            return {os.path.join(folder, name): self.bytes_of(folder, name)
                    for folder, _, names in os.walk(self.output) for name in names}
        before = files()
        # A recorder begins before the evaluator has looked at the folder.
        for recorded in ("false", "true"):
            refused = small_experiment(self.output, hours="[10, 13]", record=recorded)
            self.assertNotEqual(refused.end(), 0)
            self.assertIn("this folder holds a run with another setting", refused.said())
            after = files()
            self.assertEqual([name for name in before.keys() | after.keys() if before.get(name) != after.get(name)], [])

    def test_ctrl_c_is_a_failure_too_and_leaves_nothing_running(self):
        run = small_experiment(os.path.join(self.folder, "interrupted"), verbose="true", **LONG)
        run.wait_for(lambda: "World " in run.said(), "loaded the world")
        self.assertNotEqual(run.interrupt(), 0)
        self.assertIn("experiment: FAILED: interrupted", run.said())
        self.assertEqual(run.left_running(), [])

    def test_ctrl_c_while_the_report_is_drawn_is_an_interruption(self):
        slow = os.path.join(self.folder, "slow_report")
        with open(slow, "w") as file:
            file.write("#!/bin/sh\ntouch \"$1/begun\"\nexec sleep 600\n")
        os.chmod(slow, 0o755)
        for name, to_all in (("all_interrupted", True), ("only_the_watcher_interrupted", False)):
            run, output = self.watched(name, watcher='report: "%s"' % slow)
            run.wait_for(lambda: os.path.exists(os.path.join(output, "begun")), "begun its report")
            if to_all:
                self.assertNotEqual(run.interrupt(), 0)
            else:
                for pid, command in run.running():
                    if "experiment_node" in command:
                        os.kill(pid, signal.SIGINT)
                self.assertNotEqual(run.end(), 0)
            self.assertIn("experiment: FAILED: interrupted", run.said())
            self.assertNotIn("no report", run.said())
            self.assertEqual(run.left_running(), [])

    def test_bad_arguments_stop_it_before_it_starts(self):
        """One of each kind; test/unit/experiment and experiment_arguments.py have the rest."""
        for arguments, part in ((dict(hours="[4, x]"), "argument hours is '[4, x]'"),
                                (dict(poses=1000), "argument poses is 1000, but the path has only 20"),
                                (dict(nosie="true"), "argument nosie is 'true', but must be one of the arguments of "
                                                     "experiment.launch; noise is one"),
                                (dict(output="/dev/null/x"), "argument output is '/dev/null/x', but must be a folder that "
                                                             "can be written (/dev/null/x: ")):
            run = small_experiment(**dict(dict(output=os.path.join(self.folder, "bad")), **arguments))
            self.assertEqual(run.end(), 1, run.said())
            self.assertIn("sunlit: ", run.said())
            self.assertIn(part, run.said())
            self.assertEqual(run.left_running(), [])

    def test_a_world_that_cannot_be_loaded_is_a_failure_with_a_reason(self):
        broken = os.path.join(self.folder, "broken.urdf")
        with open(broken, "w") as file:
            file.write("<robot name='w'>")
        run = small_experiment(os.path.join(self.folder, "worldless"), world=broken)
        self.assertNotEqual(run.end(), 0)
        self.assertTrue([line for line in run.said().splitlines() if "FATAL" in line and broken in line])
        self.assertEqual(run.left_running(), [])


if __name__ == "__main__":
    rospy.init_node("experiment_runs")
    rostest.rosrun("sunlit", "experiment_runs", ExperimentRuns)
