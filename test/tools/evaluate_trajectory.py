#!/usr/bin/env python3
"""evaluate_trajectory, as people type it."""
import csv
import math
import os
import re
import sys
import tempfile
import unittest

import rosbag
import rospy
import rosunit
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, TransformStamped
from nav_msgs.msg import Odometry, Path
from std_msgs.msg import Header

from timelapse import run

HEADER = "metric,unit,n,unmatched,rmse,mean,median,std,min,max,sse".split(",")


def tum(poses):
    return "# timestamp tx ty tz qx qy qz qw\n" + "".join("%.9f %.9f %.9f %.9f 0 0 0 1\n" % pose for pose in poses)


def bend(n):
    """A quarter of a circle of 20 m about the origin, ten poses a second."""
    angles = [0.5 * math.pi * i / (n - 1) for i in range(n)]
    return [(1e9 + 0.1 * i, 20 * math.cos(a), 20 * math.sin(a), 0.0) for i, a in enumerate(angles)]


class EvaluateTrajectory(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.truth = self.write("truth.txt", tum(bend(50)))

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)
        return self.path(name)

    def evaluate(self, estimate, *more):
        return run("evaluate_trajectory", "--truth", self.truth, "--estimate", estimate, "--out", self.path("out"), *more)

    def table(self):
        with open(self.path("out/trajectory.csv")) as file:
            rows = list(csv.reader(file))
        self.assertEqual(rows[0], HEADER)
        return {row[0]: dict(zip(HEADER, row)) for row in rows[1:]}

    def test_a_scaled_and_moved_estimate_is_found_again_by_sim3_alone(self):
        estimate = self.write("estimate.txt", tum([(t, 0.5 * y + 3, -0.5 * x, z + 4) for t, x, y, z in bend(50)]))
        rmse = {}
        for align in ("none", "se3", "sim3", "yaw"):
            done = self.evaluate(estimate, "--align", align)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            table = self.table()
            self.assertEqual([table["ate"][key] for key in ("unit", "n", "unmatched")], ["m", "50", "0"])
            rmse[align] = float(table["ate"]["rmse"])
            self.assertRegex(done.stdout, "\\nate +m +50 +%s " % re.escape("%.6g" % rmse[align]))
        self.assertLess(rmse["sim3"], 1e-8)  # nine digits after the point in the files
        self.assertGreater(rmse["none"], 10)
        # In a plane, turning about z is all that se3 can do.
        self.assertAlmostEqual(rmse["se3"], rmse["yaw"], 9)
        self.assertGreater(rmse["se3"], 1)

    def test_a_turn_that_errors_decide_is_warned_of(self):
        # 30 m straight ahead, and an estimate 5 mm beside it to and fro, where one 8 m beside it would decide the roll.
        straight = [(1e9 + 0.1 * i, 0.6 * i, 0.001 * math.sin(i), 0.0) for i in range(50)]
        self.truth = self.write("straight.txt", tum(straight))
        estimate = self.write("estimate.txt", tum([(t, x, y, 0.005 * math.cos(2.3 * x)) for t, x, y, _ in straight]))
        for align, is_doubtful in (("none", False), ("yaw", False), ("se3", True), ("sim3", True)):
            done = self.evaluate(estimate, "--align", align)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual("ate_deg may tell of that alone" in done.stderr, is_doubtful, align)
            self.assertEqual(len(done.stderr.splitlines()), int(is_doubtful))

    def test_rows_are_there_for_every_delta(self):
        done = self.evaluate(self.truth)
        self.assertEqual(done.returncode, 0)
        names = ["ate", "rpe_1m", "rpe_10m", "rpe_1frame"]
        self.assertEqual(list(self.table()), [name + end for name in names for end in ("", "_deg")])
        self.assertEqual(self.evaluate(self.truth, "--delta", "5m,20frames").returncode, 0)
        self.assertEqual(list(self.table())[2:], ["rpe_5m", "rpe_5m_deg", "rpe_20frame", "rpe_20frame_deg"])

    def test_what_has_no_partner_is_counted_said_and_listed(self):
        poses = bend(50)
        poses[7] = (poses[7][0] + 0.05,) + poses[7][1:]
        done = self.evaluate(self.write("estimate.txt", tum(poses[:40])))
        self.assertEqual(done.returncode, 0)
        self.assertEqual((self.table()["ate"]["n"], self.table()["ate"]["unmatched"]), ("39", "1"))
        self.assertRegex(done.stdout, "truth .* 50 poses, .*; 11 without a partner\n")
        self.assertRegex(done.stdout, "estimate .* 40 poses, .*; 1 without a partner\n")
        with open(self.path("out/trajectory_poses.csv")) as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["stamp"] for row in rows if row["stamp"] and not row["truth_stamp"]],
                         ["1000000000.750000000"])
        self.assertEqual(len([row for row in rows if not row["stamp"]]), 11)
        self.assertEqual(self.evaluate(self.path("estimate.txt"), "--max-difference", "0.06").returncode, 0)
        self.assertEqual(self.table()["ate"]["unmatched"], "0")

    def test_what_cannot_be_evaluated_is_one_line_and_no_file(self):
        straight = [(t, x, 0.0, 0.0) for t, x, y, z in bend(50)]
        bad = self.write("bad.txt", "1 2 3\n")
        late = self.write("late.txt", tum([(t + 100, x, y, z) for t, x, y, z in bend(50)]))
        for estimate, more, said in (
                (bad, [], bad + ":1: has 3 columns, but must have 8: timestamp tx ty tz qx qy qz qw (s, m)"),
                (self.path("none"), [], self.path("none") + ": cannot be opened: No such file or directory"),
                (late, [], "no pose of the estimate has one of the truth within 0.01 s: the nearest are 95.1"),
                (self.write("line.txt", tum(straight)), ["--align", "se3"], "all on one line"),
                (self.write("two.txt", tum(bend(50)[:2])), ["--align", "sim3"], "needs 3 pairs of poses, but has 2"),
                (self.truth, ["--align", "best"], "--align is \"best\", but must be one of none, se3, sim3, yaw"),
                (self.truth, ["--max-difference", "-1"], "--max-difference is -1, but must be from 0 to 1000000 s"),
                (self.truth, ["--delta", "1m,2km"], "delta is \"2km\", but must be metres"),
                (self.truth, ["--delta", "1m,5m,1m"], "delta is 1m,5m,1m, but must be each once")):
            done = self.evaluate(estimate, *more)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1), done.stderr)
            self.assertTrue(done.stderr.startswith("evaluate_trajectory: "), done.stderr)
            self.assertIn(said, done.stderr)
            self.assertFalse(os.path.exists(self.path("out")))
        for missing in ("--truth", "--estimate", "--out"):
            words = ["--truth", self.truth, "--estimate", self.truth, "--out", self.path("out")]
            at = words.index(missing)
            self.assertIn(missing + " is missing", run("evaluate_trajectory", *words[:at], *words[at + 2:]).stderr)

    def test_of_repeated_stamps_the_first_counts_unless_none_may_be(self):
        poses = bend(50)
        estimate = self.write("estimate.txt", tum(poses[:8] + [poses[7][:3] + (9.0,)] + poses[8:]))
        self.assertIn(estimate + ":10: timestamp is 1000000000.700000048, but must be above that of the pose before",
                      self.evaluate(estimate, "--repeated-stamps", "refuse").stderr)
        done = self.evaluate(estimate)
        self.assertEqual((done.returncode, self.table()["ate"]["max"]), (0, "0"))
        self.assertRegex(done.stdout, "estimate .*; 1 more left out, whose stamps repeat\n")

    def test_how_many_stamps_repeat_is_said_also_where_nothing_can_be_evaluated(self):
        first, second = bend(50)[:2]
        estimate = self.write("estimate.txt", tum([first] * 40 + [second]))
        said = "; %s has 2 poses; 39 more left out, whose stamps repeat\n" % estimate
        for more, wrong in ((["--align", "se3"], "needs 3 pairs of poses, but has 2"), ([], "no pose of the estimate")):
            done = self.evaluate(estimate, *more)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1))
            self.assertIn(wrong, done.stderr)
            self.assertTrue(done.stderr.endswith(said), done.stderr)
            self.truth = self.write("late.txt", tum([(t + 100, x, y, z) for t, x, y, z in bend(50)]))

    def test_nanoseconds_and_optical_frames_are_taken_for_what_they_are(self):
        """What ORB-SLAM3 makes of EuRoC's form: truth of the link, estimate of the optical frame, z forward, in ns."""
        turned = self.write("f_run.txt", "".join("%.6f %.9f %.9f %.9f -0.5 0.5 -0.5 0.5\n" % (round(t * 10) * 1e8, x, y, z)
                                                 for t, x, y, z in bend(50)))
        found = {}
        for of in ("link", "optical"):
            done = self.evaluate(turned, "--estimate-of", of)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            found[of] = self.table()
            self.assertLess(float(found[of]["ate"]["max"]), 1e-8)
        self.assertAlmostEqual(float(found["link"]["ate_deg"]["min"]), 120, 6)
        self.assertLess(float(found["optical"]["ate_deg"]["max"]), 1e-5)
        straight, self.truth = self.truth, turned
        self.assertEqual(self.evaluate(straight, "--truth-of", "optical").returncode, 0)
        self.assertLess(float(self.table()["ate_deg"]["max"]), 1e-5)
        self.assertIn('--truth-of is "base", but must be one of link, optical', self.evaluate(straight, "--truth-of", "base").stderr)

    def test_the_map_is_read_before_anything_is_written(self):
        self.assertIn(self.path("map.yaml") + ": cannot be opened", self.evaluate(self.truth, "--map", self.folder).stderr)
        self.assertFalse(os.path.exists(self.path("out")))

    def write_bag(self, name, topics, spoil=lambda i, pose: None, frame_of=lambda i: ""):
        """`topics`: the class of the messages by topic; all tell of the bend, but for what `spoil` does to those of poses."""
        with rosbag.Bag(self.path(name), "w") as bag:
            paths = {topic: Path() for topic, kind in topics.items() if kind is Path}
            for i, (t, x, y, z) in enumerate(bend(50)):
                stamp = rospy.Time.from_sec(t)
                for topic, kind in topics.items():
                    message = PoseStamped() if kind is Path else kind()
                    message.header.stamp, message.header.frame_id = stamp, frame_of(i)
                    place = {PoseStamped: lambda: message.pose, Path: lambda: message.pose,
                             TransformStamped: lambda: message.transform}.get(kind, lambda: message.pose.pose)()
                    where, turn = (place.translation, place.rotation) if kind is TransformStamped else (
                        place.position, place.orientation)
                    where.x, where.y, where.z, turn.w = x, y, z, 1.0
                    spoil(i, place)
                    if kind is Path:  # sent anew as it grows
                        paths[topic].poses.append(message)
                        message = paths[topic]
                    bag.write(topic, message, stamp)
        return self.path(name)

    def test_poses_of_any_message_are_taken_from_bags(self):
        kinds = {"/truth": PoseStamped, "/fused": PoseWithCovarianceStamped, "/vicon": TransformStamped, "/odom": Odometry,
                 "/path": Path}
        bag = self.write_bag("run.bag", kinds)
        for topic in kinds:
            done = self.evaluate(bag + ":" + topic)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(self.table()["ate"]["n"], "50")
            self.assertLess(float(self.table()["ate"]["max"]), 1e-8)  # nine digits in the file of the truth
        done = run("evaluate_trajectory", "--truth", bag + ":/truth", "--estimate", bag + ":/odom", "--out", self.path("out"))
        self.assertEqual((done.returncode, self.table()["ate"]["max"]), (0, "0"))

    def test_topics_may_lack_their_slash(self):
        bag = self.write_bag("run.bag", {"odom": Odometry, "/truth": PoseStamped})
        for named in ("odom", "/odom", "truth"):
            done = self.evaluate(bag + ":" + named)
            self.assertEqual((done.returncode, done.stderr, self.table()["ate"]["n"]), (0, "", "50"))
        self.assertIn("topics of poses are: /odom (nav_msgs/Odometry), /truth", self.evaluate(bag).stderr)
        self.assertEqual(self.evaluate(self.write_bag("one.bag", {"odom": Odometry})).returncode, 0)

    def test_poses_that_cannot_be_used_are_left_out_and_told_of(self):
        def spoil(i, pose):
            if i < 2:  # before it knows where it is
                pose.orientation.w = 0.0
            elif i == 30:
                pose.position.y = float("nan")

        bag = self.write_bag("run.bag", {"/odom": Odometry}, spoil)
        said = ("; 3 more left out, which cannot be used, the first is /odom at 1000000000.000000000: pose.orientation has the "
                "length 0.000000, but must be a quaternion of length 1\n")
        done = self.evaluate(bag)
        self.assertEqual((done.returncode, done.stderr, self.table()["ate"]["n"]), (0, "", "47"))
        self.assertRegex(done.stdout, "estimate .* 47 poses, .* m" + re.escape(said))
        done = run("evaluate_trajectory", "--truth", bag, "--estimate", self.truth, "--out", self.path("out"))
        self.assertEqual((done.returncode, done.stderr, self.table()["ate"]["n"]), (0, "", "47"))
        self.assertRegex(done.stdout, "truth .* 47 poses, .* m" + re.escape(said))
        self.truth = self.write("late.txt", tum([(t + 100, x, y, z) for t, x, y, z in bend(50)]))
        self.assertTrue(self.evaluate(bag).stderr.endswith("; %s has 47 poses%s" % (bag, said)))

    def test_poses_of_several_frames_in_one_topic_are_warned_of(self):
        said = ("warning: poses of %s of %s are in the frame odom, others in map: errors mean nothing unless these are one frame\n")
        for topic, kind in (("/odom", Odometry), ("/path", Path)):
            bag = self.write_bag("run.bag", {topic: kind}, frame_of=lambda i: ["map", "/map", "", "odom"][i % 4])
            done = self.evaluate(bag)
            self.assertEqual((done.returncode, done.stderr, self.table()["ate"]["n"]), (0, said % (topic, bag), "50"))
            done = run("evaluate_trajectory", "--truth", bag, "--estimate", self.truth, "--out", self.path("out"))
            self.assertEqual((done.returncode, done.stderr), (0, said % (topic, bag)))

    def test_which_topic_of_a_bag_is_said_or_there_is_but_one(self):
        bag = self.write_bag("run.bag", {"/truth": PoseStamped, "/odom": Odometry})
        topics = "topics of poses are: /odom (nav_msgs/Odometry), /truth (geometry_msgs/PoseStamped)\n"
        for named, said in ((bag, ": say which topic, as in %s:/odom; " % bag), (bag + ":/odometry", ": holds no topic /odometry; ")):
            done = self.evaluate(named)
            self.assertEqual((done.returncode, done.stderr), (1, "evaluate_trajectory: " + bag + said + topics))
        self.assertEqual(self.evaluate(self.write_bag("one.bag", {"/odom": Odometry})).returncode, 0)
        with rosbag.Bag(self.path("none.bag"), "w") as none:
            none.write("/chatter", Header(), rospy.Time(5))
        self.assertIn("none.bag: holds no topic of poses", self.evaluate(self.path("none.bag")).stderr)
        with rosbag.Bag(self.path("bad.bag"), "w") as bad:
            bad.write("/pose", PoseStamped(), rospy.Time(5))
            bad.write("/chatter", Header(), rospy.Time(5))
        self.assertEqual("evaluate_trajectory: %s: holds no usable pose; 1 cannot be used, the first is /pose at 0.000000000: "
                         "pose.orientation has the length 0.000000, but must be a quaternion of length 1\n" %
                         self.path("bad.bag"), self.evaluate(self.path("bad.bag:/pose")).stderr)
        self.assertIn("/chatter is std_msgs/Header, not geometry_msgs/PoseStamped",
                      self.evaluate(self.path("bad.bag:/chatter")).stderr)
        self.assertIn("is not a bag that can be read", self.evaluate(self.path("gone.bag")).stderr)

    def test_two_runs_write_the_same_bytes(self):
        written = []
        for _ in range(2):
            self.assertEqual(self.evaluate(self.truth, "--align", "se3").returncode, 0)
            written.append([open(self.path("out/" + name), "rb").read() for name in sorted(os.listdir(self.path("out")))])
        self.assertEqual(written[0], written[1])


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "tools_evaluate_trajectory", EvaluateTrajectory, sysargs=sys.argv)
