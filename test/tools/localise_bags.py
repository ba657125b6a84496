#!/usr/bin/env python3
"""evaluate_bags --map --query, as people type it, on bags of a wall whose every pixel is known."""
import csv
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import cv2
import numpy
import rosbag
import rospy
import rosunit
from geometry_msgs.msg import PoseStamped, PoseWithCovariance, TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CameraInfo, CompressedImage, Image
from sunlit.msg import Capture
from tf2_msgs.msg import TFMessage

from timelapse import located, run

WIDTH, HEIGHT, FOCAL = 320, 240, 277.0
WALL_M = 8.0      # from the camera's line; the wall stands along it, seen by a camera that looks to its left
PX_A_METRE = 60.0  # of the wall's texture
COLUMNS = "pose,stamp,map,query,detector,error_m,error_deg,inliers,retrieved,status".split(",")
FILES = ["estimate_%s_orb.tum", "estimate_%s_sift.tum", "truth_%s.tum"]


def texture():
    generator = numpy.random.RandomState(7)
    pixels = numpy.full((900, 2400), 128, numpy.uint8)
    for _ in range(4000):
        centre = (int(generator.randint(0, 2400)), int(generator.randint(0, 900)))
        cv2.circle(pixels, centre, int(generator.randint(3, 20)), int(generator.randint(0, 256)), -1)
    return cv2.GaussianBlur(pixels, (0, 0), 1.5)


def wall_picture(pixels, x, yaw=0.0):
    """What a camera at (x, 0, 0) sees that looks along +y and, by `yaw`, to the left; and its depth."""
    u, v = numpy.meshgrid((numpy.arange(WIDTH) - (WIDTH - 1) / 2) / FOCAL, (numpy.arange(HEIGHT) - (HEIGHT - 1) / 2) / FOCAL)
    # Per metre of depth: right is +x of the map, and forward +y, both turned.
    along = u * math.cos(yaw) - math.sin(yaw)
    forward = u * math.sin(yaw) + math.cos(yaw)
    depth = WALL_M / forward
    columns = (x + depth * along) * PX_A_METRE + 400
    rows = depth * v * PX_A_METRE + 450
    picture = cv2.remap(pixels, columns.astype(numpy.float32), rows.astype(numpy.float32), cv2.INTER_LINEAR)
    return picture, depth.astype(numpy.float32)


def message(array, encoding, stamp):
    image = Image(height=array.shape[0], width=array.shape[1], encoding=encoding,
                  step=array.shape[1] * array.itemsize, data=array.tobytes())
    image.header.stamp = stamp
    return image


class LocaliseBags(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.texture = texture()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, stream, xs, brightness=1.0, yaw=0.0, without=(), **changes):
        """A drive past the wall. `without`: (topic's end, index) of messages that are left out."""
        with rosbag.Bag(self.path(name), "w") as bag:
            for index, x in enumerate(xs):
                stamp = rospy.Time(100 + index)
                picture, depth = wall_picture(self.texture, x, yaw)
                picture = cv2.convertScaleAbs(picture, alpha=brightness)
                width, height = changes.get("size", (WIDTH, HEIGHT))  # of its middle
                left, top = (WIDTH - width) // 2, (HEIGHT - height) // 2
                picture, depth = (array[top:top + height, left:left + width] for array in (picture, depth))
                info = CameraInfo(width=width, height=height, distortion_model="plumb_bob",
                                  K=[FOCAL, 0, (width - 1) / 2, 0, FOCAL, (height - 1) / 2, 0, 0, 1],
                                  D=changes.get("distortion", [0.0] * 5))
                pose = PoseStamped()
                pose.pose.position.x = x
                heading = math.pi / 2 + yaw  # camera_link looks along its x
                pose.pose.orientation.z, pose.pose.orientation.w = math.sin(heading / 2), math.cos(heading / 2)
                for other in (info, pose):
                    other.header.stamp = stamp
                pose.header.frame_id = changes.get("frame", "")
                depth_message = message(depth, "32FC1", stamp)
                if changes.get("millimetres"):
                    depth_message = message(numpy.round(depth * 1000).astype(numpy.uint16), "16UC1", stamp)
                image = message(picture, "mono8", stamp)
                topics = {stream + "camera/image_raw": image, stream + "camera/camera_info": info,
                          "camera/depth/image_raw": depth_message, "camera/pose": pose}
                if "suns" in changes:
                    utc, azimuth = changes["suns"][index]
                    capture = Capture(utc=utc, pose_index=index, sun_azimuth=azimuth, sun_elevation=0.5)
                    capture.header.stamp = stamp
                    topics[stream + "camera/capture"] = capture
                if changes.get("png"):
                    image = CompressedImage(format="png", data=cv2.imencode(".png", picture)[1].tobytes())
                    image.header.stamp = stamp
                    del topics[stream + "camera/image_raw"]
                    topics[stream + "camera/image_raw/compressed"] = image
                for topic, one in topics.items():
                    if (topic.split("camera/")[-1], index) not in without:
                        bag.write("/" + topic, one, stamp)
        return self.path(name)

    def localise(self, out, *arguments, status=0, **more):
        done = run("evaluate_bags", "--out", self.path(out), *arguments, **more)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return self.rows(out, "localisation.csv"), done

    def rows(self, out, name):
        with open(os.path.join(self.path(out), name), newline="") as file:
            return list(csv.DictReader(file))

    def refused(self, *arguments):
        done = run("evaluate_bags", "--out", self.path("out"), *arguments)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), (arguments, done.stderr))
        self.assertFalse(os.path.exists(os.path.join(self.path("out"), "localisation.csv")))
        return done.stderr

    def bags(self):
        """A map of a key frame a metre, and a darker drive between them that looks elsewhere."""
        noon = self.write("noon.bag", "h12/", [float(x) for x in range(11)])
        dusk = self.write("dusk.bag", "h20/", [0.5 + 2 * k for k in range(5)], brightness=0.5, yaw=0.1)
        return noon, dusk

    def test_detectors_of_a_file_localise_too(self):
        noon, dusk = self.bags()
        with open(self.path("own.yaml"), "w") as file:
            file.write("{features: {many: {type: orb, n_features: 1000}}}")
        drives = ["--map", noon, "--query", dusk, "--detectors", "many,orb"]
        rows, _ = self.localise("found", *drives, "--config", self.path("own.yaml"))
        inliers = {name: sum(int(row["inliers"]) for row in rows if row["detector"] == name) for name in ("many", "orb")}
        self.assertGreater(inliers["many"], 1.2 * inliers["orb"])
        self.assertIn("--detectors is [many, orb], but must be", self.refused(*drives))

    def piped(self, text):
        """A file that can be read once."""
        reader, writer = os.pipe()
        self.addCleanup(os.close, reader)
        with os.fdopen(writer, "w") as file:
            file.write(text)
        return {"word": "/dev/fd/%d" % reader, "pass_fds": (reader,)}

    def test_parameters_may_come_by_a_pipe(self):
        noon, dusk = self.bags()
        pipe = self.piped("{features: {many: {type: orb, n_features: 1000}}}")
        rows, _ = self.localise("found", "--map", noon, "--query", dusk, "--detectors", "many", "--config", pipe.pop("word"), **pipe)
        self.assertEqual(len(rows), 5)
        with rosbag.Bag(noon, "a") as bag, rosbag.Bag(dusk) as other:
            for topic, one, stamp in other.read_messages(["/h20/camera/image_raw"]):
                bag.write(topic, one, stamp)
        pipe = self.piped("{differences: [boolean_rgb], memory_limit: 1e1, about: {as_rosparam: [1e1, y, 08, 1.5e+1, 0x10, on, '7']}}")
        run("evaluate_bags", "--out", self.path("read"), "--config", pipe.pop("word"), noon, **pipe)
        with open(self.path("read/run.yaml")) as file:
            self.assertIn("about/as_rosparam: '[1e1, y, 08, 15, 16, true, 7]'\n", file.read())
        for text in ("{differences: [boolean_rgb]}", "{differences: [boolean_rgb], streams: [h12, h20]}"):
            pipe, out = self.piped(text), "of_%d_letters" % len(text)
            done = run("evaluate_bags", "--out", self.path(out), "--config", pipe.pop("word"), noon, **pipe)
            self.assertEqual(done.returncode, 3, done.stderr)  # h12 goes on alone
            self.assertEqual([(row["a"], row["difference"], row["n"]) for row in self.rows(out, "summary.csv")], [("h12", "boolean_rgb", "5")])

    def test_a_drive_is_found_in_the_map_of_another(self):
        noon, dusk = self.bags()
        rows, done = self.localise("out", "--map", noon, "--query", dusk, "--map-every", "2")
        self.assertEqual(list(rows[0]), COLUMNS)
        self.assertEqual([(row["pose"], row["detector"]) for row in rows],
                         [(str(pose), detector) for pose in range(5) for detector in ("sift", "orb")])
        for row in rows:
            self.assertEqual((row["map"], row["query"], row["status"], row["retrieved"]), ("h12", "h20", "localised", "5"))
            # A tenth of a pixel (SIFT), or half of one (ORB), is 3 or 15 mm at 8 m; dozens of points are averaged, but on
            # one plane turning and moving sideways look nearly alike.
            self.assertLess(float(row["error_m"]), 0.03 if row["detector"] == "sift" else 0.2)
            self.assertLess(float(row["error_deg"]), 0.2 if row["detector"] == "sift" else 1.5)
        self.assertEqual(rows[2]["stamp"], "101.000000000")
        self.assertIn("6 key frames", done.stdout)
        summary = self.rows("out", "localisation_summary.csv")
        self.assertEqual([(row["detector"], row["n"], row["failures"]) for row in summary],
                         [("sift", "5", "0"), ("orb", "5", "0")])
        self.assertEqual(summary[0]["within_0.25m_2deg"], "1")
        self.assertEqual(self.rows("out", "localisation_problems.csv"), [])
        for name in FILES:
            self.assertTrue(os.path.exists(os.path.join(self.path("out"), name % "h20")))

    def test_its_trajectories_are_what_evaluate_trajectory_takes(self):
        noon, dusk = self.bags()
        rows, _ = self.localise("out", "--map", noon, "--query", dusk, "--detectors", "sift")
        done = run("evaluate_trajectory", "--truth", self.path("out/truth_h20.tum"), "--estimate",
                   self.path("out/estimate_h20_sift.tum"), "--out", self.path("trajectory"))
        self.assertEqual(done.returncode, 0, done.stderr)
        ate = next(row for row in self.rows("trajectory", "trajectory.csv") if row["metric"] == "ate")
        self.assertAlmostEqual(float(ate["max"]), max(float(row["error_m"]) for row in rows), places=9)

    def test_the_same_bytes_on_one_core_and_on_all(self):
        noon, dusk = self.bags()
        files = []
        for out, cores in (("all", None), ("again", None), ("one", 0)):
            self.localise(out, "--map", noon, "--query", dusk,
                          preexec_fn=None if cores is None else lambda: os.sched_setaffinity(0, {min(os.sched_getaffinity(0))}))
            files.append({file.name: file.read_bytes() for file in sorted(pathlib.Path(self.path(out)).iterdir())
                          if file.suffix in (".csv", ".tum")})
        self.assertLess({"localisation.csv", "localisation_poses.csv", "comparisons.csv", "estimate_h20_sift.tum"}, set(files[0]))
        self.assertEqual(files[0], files[1])
        self.assertEqual(files[0], files[2])

    def test_other_forms_of_image_and_depth_and_topics_without_a_stream(self):
        noon = self.write("noon.bag", "", [0.0, 1.0, 2.0], png=True, millimetres=True)
        dusk = self.write("dusk.bag", "", [0.5, 1.5])
        rows, _ = self.localise("out", "--map", noon, "--query", dusk, "--detectors", "sift", "--map-every", "0")
        for row in rows:
            self.assertEqual((row["map"], row["query"], row["status"]), ("noon", "dusk", "localised"))
            self.assertLess(float(row["error_m"]), 0.03)

    def write_foreign(self, name, xs):
        """A robot's bag: a drive at 1 m/s with topics of its own, one camera_info, poses of the optical frame at 100 Hz, and depth
        7 ms behind the images."""
        with rosbag.Bag(self.path(name), "w") as bag:
            info = CameraInfo(width=WIDTH, height=HEIGHT, distortion_model="plumb_bob", D=[0.0] * 5,
                              K=[FOCAL, 0, (WIDTH - 1) / 2, 0, FOCAL, (HEIGHT - 1) / 2, 0, 0, 1])
            info.header.stamp = rospy.Time(99)
            bag.write("/rs/color/camera_info", info, info.header.stamp)
            for x in xs:
                picture, depth = wall_picture(self.texture, x)
                stamp = rospy.Time.from_sec(100.0 + x)
                bag.write("/rs/color/image_raw", message(picture, "mono8", stamp), stamp)
                late = stamp + rospy.Duration.from_sec(0.007)
                bag.write("/rs/aligned/image_raw", message(numpy.round(depth * 1000).astype(numpy.uint16), "16UC1", late), late)
            for tick in range(int(100 * max(xs)) + 2):
                pose = TransformStamped()
                pose.header.stamp = rospy.Time.from_sec(100.0 + 0.01 * tick)
                pose.transform.translation.x = 0.01 * tick
                # Optical: x right is the map's x, y down its −z, z forward its y: a quarter turn about x.
                pose.transform.rotation.x, pose.transform.rotation.w = -math.sqrt(0.5), math.sqrt(0.5)
                bag.write("/vicon/camera", pose, pose.header.stamp)
        return self.path(name)

    FOREIGN = ("--images", "/rs/color/image_raw", "--depth", "/rs/aligned/image_raw", "--poses", "/vicon/camera",
               "--poses-of", "optical", "--detectors", "sift", "--map-every", "0")

    def test_a_robots_bag_with_topics_and_stamps_of_its_own(self):
        theirs = self.write_foreign("theirs.bag", [0.0032, 1.0047, 2.0061])
        other = self.write_foreign("other.bag", [0.5013, 1.4988])
        self.assertIn("no /vicon/camera of this stamp; the one before is 0.0032 s away, the one behind 0.0068 s; each may be ",
                      self.refused("--map", theirs, "--query", other, *self.FOREIGN))
        rows, _ = self.localise("out", "--map", theirs, "--query", other, "--stamp-tolerance", "0.01", *self.FOREIGN)
        self.assertEqual([(row["map"], row["query"], row["status"]) for row in rows], [("theirs", "other", "localised")] * 2)
        for row in rows:  # as for bags of one stamp; a pose of a neighbouring stamp would be 5 mm off in the mean
            self.assertLess(float(row["error_m"]), 0.03)
        with open(os.path.join(self.path("out"), "truth_other.tum")) as file:
            positions = [float(line.split()[1]) for line in file if not line.startswith("#")]
        numpy.testing.assert_allclose(positions, [0.5013, 1.4988], atol=1e-6)  # stamps are whole microseconds

    def test_images_of_a_robot_that_are_compressed_alone_need_not_be_called_so(self):
        ours = self.write("ours.bag", "", [0.0, 1.0, 2.0])
        rows = {}
        for name, word in (("short", "/camera/image_raw"), ("whole", "/camera/image_raw/compressed")):
            theirs = self.write(name + ".bag", "", [0.5, 1.5], png=True)
            rows[name], _ = self.localise(name, "--map", ours, "--query", theirs, "--detectors", "sift", "--images", word)
            self.assertEqual([row["status"] for row in rows[name]], ["localised"] * 2)
        self.assertEqual([row["error_m"] for row in rows["short"]], [row["error_m"] for row in rows["whole"]])
        png = self.write("png.bag", "drone/", [0.5, 1.5], png=True)
        rows, _ = self.localise("drone", "--map", ours, "--query", png, "--detectors", "sift", "--images", "drone/camera/image_raw")
        self.assertEqual([row["query"] for row in rows], ["png"] * 2, "with the camera_info beside it")

    def test_a_robots_bag_in_a_map_of_ours(self):
        ours = self.write("ours.bag", "", [0.0, 1.0, 2.0])
        theirs = self.write_foreign("theirs.bag", [0.5013, 1.4988])
        topics = [word for word in self.FOREIGN if word not in ("--poses-of", "optical")]
        said = self.refused("--map", ours, "--query", theirs, "--poses-of", "optical", "--detectors", "sift")
        self.assertIn("holds no image below /", said)
        self.assertIn("/rs/color/image_raw", said)
        self.assertIn("--depth is /rs/depth, but must be a topic that a bag holds; they hold: /camera/camera_info",
                      self.refused("--map", ours, "--query", theirs, "--images", "/rs/color/image_raw", "--depth", "/rs/depth"))
        # Their poses taken as a link's, x forward: the wall shows where it truly is, which is nowhere near.
        rows, _ = self.localise("link", "--map", ours, "--query", theirs, "--stamp-tolerance", "0.01", "--retrieval", "all",
                                *topics)
        self.assertEqual([row["status"] for row in rows], ["localised"] * 2)
        self.assertTrue(all(float(row["error_deg"]) > 80 for row in rows), rows)

    def test_streams_are_chosen_by_name(self):
        both = self.write("noon.bag", "h12/", [0.0, 1.0, 2.0])
        with rosbag.Bag(both, "a") as bag, rosbag.Bag(self.write("dusk.bag", "h20/", [0.0, 1.0, 2.0])) as dusk:
            for topic, one, stamp in dusk.read_messages():
                if topic.startswith("/h20"):
                    bag.write(topic, one, stamp)
        for query in (both, both + ":h20"):
            rows, _ = self.localise("out" + query[-3:], "--map", both + ":h12", "--query", query, "--detectors", "sift")
            self.assertEqual({(row["map"], row["query"]) for row in rows}, {("h12", "h20")})
        rows, _ = self.localise("words", "--map", both + ":h12,h20", "--query", both + ":h12", self.path("dusk.bag"),
                                "--detectors", "sift")
        self.assertEqual([row["query"] for row in rows], ["h12"] * 3 + ["dusk_h20"] * 3)
        self.assertEqual(rows[0]["map"], "h12+noon_h20")
        self.assertIn("holds the streams h12, h20: say which the map is made of, as in --map",
                      self.refused("--map", both, "--query", both))
        self.assertIn("holds no stream h04; it holds: h12, h20", self.refused("--map", both + ":h04", "--query", both))
        self.assertIn("a second stream would be called h20",
                      self.refused("--map", both + ":h12", "--query", both + ":h20,h20"))
        self.assertIn("holds no stream but the map's", self.refused("--map", both + ":h12,h20", "--query", both))

    def test_bags_of_one_name_are_told_apart_by_their_folders(self):
        for folder in ("monday/rainy", "tuesday/rainy", "dry"):
            os.makedirs(self.path(folder))
        unnamed = [self.write(folder + "/run.bag", "", [0.0, 1.0]) for folder in ("monday/rainy", "tuesday/rainy", "dry")]
        rows, _ = self.localise("unnamed", "--map", unnamed[0], "--query", *unnamed[1:], "--detectors", "sift", "--map-every", "0")
        self.assertEqual({(row["map"], row["query"]) for row in rows},
                         {("monday_rainy_run", "tuesday_rainy_run"), ("monday_rainy_run", "dry_run")})
        self.assertTrue(os.path.exists(self.path("unnamed/truth_tuesday_rainy_run.tum")))
        named = [self.write(folder + "/run.bag", "h12/", [0.0, 1.0]) for folder in ("monday/rainy", "dry")]
        named.append(self.write("else.bag", "h12/", [0.5]))
        rows, _ = self.localise("named", "--map", named[0], "--query", *named[1:], "--detectors", "sift", "--map-every", "0")
        self.assertEqual({(row["map"], row["query"]) for row in rows}, {("rainy_run_h12", "dry_run_h12"), ("rainy_run_h12", "else_h12")})

    def test_streams_of_a_bag_that_nobody_numbered_are_compared_where_they_were_taken(self):
        noon, _ = self.bags()
        xs = [0.5 + 2 * k for k in range(5)]
        both = self.write("both.bag", "h16/", xs, without={("image_raw", 0)})
        with rosbag.Bag(both, "a") as bag, rosbag.Bag(self.write("other.bag", "h18/", xs, brightness=0.5)) as other:
            for topic, one, stamp in other.read_messages():
                if topic.startswith("/h18"):
                    bag.write(topic, one, stamp)
        _, done = self.localise("out", "--map", noon, "--query", both, "--detectors", "sift", "--map-every", "0")
        compared = [row for row in self.rows("out", "comparisons.csv") if row["metric"] == "error_m" and row["family"] == "hours"]
        # By rank the first of one would have stood against the second of the other.
        self.assertEqual([(row["n"], row["unpaired"]) for row in compared], [("4", "1")])
        self.assertIn("have no common numbers of poses, and were paired by place: 4 pairs, 1 queries without one",
                      done.stdout + done.stderr)

    def test_streams_of_names_in_parts_have_files_and_none_writes_over_another(self):
        drive = [0.4 * k for k in range(40)]
        noon = self.write("noon.bag", "stereo/noon/", [0.0, 1.0, 2.0])
        dusk = self.write("dusk.bag", "stereo/dusk/", drive)
        rows, _ = self.localise("found", "--map", noon, "--query", dusk, "--detectors", "sift")
        self.assertEqual({(row["map"], row["query"]) for row in rows}, {("stereo/noon", "stereo/dusk")})
        for name in ("truth_stereo_dusk.tum", "estimate_stereo_dusk_sift.tum"):
            self.assertTrue(os.path.exists(self.path("found/" + name)), name)
        done = run("evaluate_bags", "--odometry", dusk, "--detectors", "sift", "--out", self.path("followed"))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual([row["stream"] for row in self.rows("followed", "odometry.csv")], ["stereo/dusk"])
        for name in ("truth_stereo_dusk.tum", "odometry_stereo_dusk_sift.tum"):
            self.assertTrue(os.path.exists(self.path("followed/" + name)), name)
        other = self.write("other.bag", "stereo_dusk/", [0.5])
        for arguments in (["--map", noon, "--query", dusk, other], ["--odometry", dusk, other]):
            self.assertIn("stereo/dusk and stereo_dusk are both stereo_dusk in names of files", self.refused(*arguments))

    def test_results_of_two_runs_are_not_mixed(self):
        noon, dusk = self.bags()
        drives = ["--map", noon, "--query", dusk, "--detectors"]
        self.localise("out", *drives, "sift,orb")
        before = {file.name: file.read_bytes() for file in pathlib.Path(self.path("out")).iterdir()}
        mixed = "%s: this folder holds results of another run (%s), which would be mixed with those of this one; choose another, or remove them\n"
        for arguments, others in (([*drives, "sift"], "estimate_h20_orb.tum"),
                                  (["--map", dusk, "--query", noon, "--detectors", "sift,orb"], "estimate_h20_orb.tum, …"),
                                  (["--odometry", noon, "--detectors", "sift"], "estimate_h20_orb.tum, …")):
            done = run("evaluate_bags", "--out", self.path("out"), *arguments)
            self.assertEqual((done.returncode, done.stderr), (1, "evaluate_bags: " + mixed % (self.path("out"), others)))
        self.localise("out", *drives, "sift,orb")
        self.assertEqual({file.name: file.read_bytes() for file in pathlib.Path(self.path("out")).iterdir()}, before)
        followed = ["evaluate_bags", "--odometry", noon, "--detectors", "sift", "--out", self.path("followed")]
        for _ in range(2):
            self.assertEqual(run(*followed).returncode, 0)
        done = run("evaluate_bags", *drives, "sift", "--out", self.path("followed"))
        self.assertEqual((done.returncode, done.stderr), (1, "evaluate_bags: " + mixed % (self.path("followed"), "odometry.csv, …")))

    def test_images_without_stamps_are_no_success(self):
        noon, dusk = self.bags()
        with rosbag.Bag(dusk) as bag, rosbag.Bag(self.path("unstamped.bag"), "w") as unstamped:
            for topic, one, stamp in bag.read_messages():
                one.header.stamp = rospy.Time(0)
                unstamped.write(topic, one, stamp)
        said = "h20 at 0.000000000: all 5 images have stamp 0.000000000, so that one counts: does the driver set"
        self.assertIn(said, self.refused("--map", noon, "--query", self.path("unstamped.bag"), "--detectors", "sift"))
        rows, done = self.localise("out", "--map", noon, "--query", self.path("unstamped.bag"), dusk, "--detectors", "sift", status=3)
        self.assertEqual({row["query"] for row in rows}, {"dusk_h20"}, "whose poses are of one place")
        self.assertIn("unstamped_" + said, done.stderr)
        with rosbag.Bag(self.path("unstamped.bag")) as bag, rosbag.Bag(self.path("still.bag"), "w") as still:
            for topic, one, stamp in bag.read_messages():
                if topic != "/camera/pose" or stamp == rospy.Time(100):
                    still.write(topic, one, stamp)
        _, done = self.localise("still", "--map", noon, "--query", self.path("still.bag"), "--detectors", "sift", status=3)
        self.assertIn(said, done.stderr)

    def test_what_lacks_a_part_is_named_and_the_rest_goes_on(self):
        noon = self.write("noon.bag", "h12/", [0.0, 1.0, 2.0, 3.0], without={("depth/image_raw", 1), ("pose", 2)})
        dusk = self.write("dusk.bag", "h20/", [0.5, 1.5, 2.5], without={("camera_info", 0), ("pose", 2)})
        rows, done = self.localise("out", "--map", noon, "--query", dusk, "--detectors", "sift", "--map-every", "1", status=3)
        self.assertEqual([(row["pose"], row["status"]) for row in rows], [("1", "localised")])
        self.assertEqual([tuple(row.values()) for row in self.rows("out", "localisation_problems.csv")],
                         [("h12", "map", "101.000000000", "no camera/depth/image_raw of this stamp"),
                          ("h12", "map", "102.000000000", "no camera/pose of this stamp"),
                          ("h20", "query", "100.000000000", "no camera_info of this stamp"),
                          ("h20", "query", "102.000000000", "no camera/pose of this stamp")])
        self.assertIn("4 images could not be used", done.stderr)
        self.assertIn("h12 at 101.000000000: no camera/depth", done.stderr)

    def test_a_bag_without_a_topic_says_which_could_take_its_place(self):
        _, dusk = self.bags()
        for lacks, others, told in (
                ("depth/image_raw", {"/rs/depth": Image(), "/camera/depth/image_raw/compressedDepth": CompressedImage()},
                 "the bag holds no /camera/depth/image_raw, see --depth; /camera/depth/image_raw/compressedDepth is not read: "
                 "rosrun image_transport republish compressedDepth makes it raw; of this kind it holds /rs/depth\n"),
                ("pose", {"/tf/optical": TransformStamped()},
                 "the bag holds no /camera/pose, see --poses; of this kind it holds /tf/optical\n"),
                ("pose", {"/tf": TFMessage()},
                 "h12 at 100.000000000 and 1 more: the bag holds no /camera/pose, see --poses; /tf is not read: record the "
                 "camera's pose of it as geometry_msgs/PoseStamped\n"),
                ("camera_info", {}, "the bag holds no /h12/camera/camera_info, see --camera-info\n")):
            noon = self.write("noon.bag", "h12/", [0.0, 1.0], without={(lacks, k) for k in range(2)})
            with rosbag.Bag(noon, "a") as bag:
                for topic, one in others.items():
                    bag.write(topic, one, rospy.Time(101))
            done = run("evaluate_bags", "--out", self.path("out"), "--map", noon, "--query", dusk, "--detectors", "sift")
            self.assertEqual(done.returncode, 1)
            self.assertIn(told, done.stderr)

    def test_depth_and_poses_of_other_frames_than_the_images_are_told_of(self):
        _, dusk = self.bags()
        told = {"other": ("/camera/depth/image_raw is of depth_optical, images of color_optical (%s): taken as registered to the "
                          "images; depth_image_proc/register makes it so", "poses of /camera/pose are of base_link, images of "
                          "color_optical (%s): taken as those of the camera, x forward unless --poses-of says otherwise; tf "
                          "tells where it sits on base_link"), "same": ()}
        for kind, warnings in told.items():
            noon, frames = self.write("noon.bag", "h12/", [0.0, 1.0, 2.0]), self.path(kind + ".bag")
            with rosbag.Bag(noon) as bag, rosbag.Bag(frames, "w") as tagged:
                for topic, one, stamp in bag.read_messages():
                    if topic == "/camera/pose":
                        one = Odometry(header=one.header, child_frame_id="camera_link" if kind == "same" else "base_link",
                                       pose=PoseWithCovariance(pose=one.pose))
                    else:
                        is_depth = topic == "/camera/depth/image_raw"
                        one.header.frame_id = "/color_optical" if kind == "same" or not is_depth else "depth_optical"
                    tagged.write(topic, one, stamp)
            _, done = self.localise(kind, "--map", frames, "--query", dusk, "--detectors", "sift")
            self.assertEqual(re.findall("^warning: (.*)$", done.stderr, re.MULTILINE), [line % frames for line in warnings])
            self.assertEqual([row["fault"] for row in self.rows(kind, "localisation_problems.csv")],
                             ["other_frame: " + line % frames for line in warnings])

    def test_an_output_that_is_a_file_is_refused_before_the_work(self):
        noon, dusk = self.bags()
        file = pathlib.Path(self.path("out"))
        file.write_text("mine", encoding="utf-8")
        for drives in (["--map", noon, "--query", dusk], ["--odometry", dusk]):
            self.assertRegex(self.refused(*drives), "out: is no folder that can be written: Not a directory\n$")
        self.assertEqual(file.read_text(encoding="utf-8"), "mine")

    def processor_seconds(self, process):
        with open("/proc/%d/stat" % process.pid) as file:
            fields = file.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def test_an_output_that_is_taken_away_ends_the_work(self):
        drive = [0.1 * pose for pose in range(100)]
        long, other = (self.write(stream + ".bag", stream + "/", drive, suns=[("2024-07-01T09:00:00.000Z", 1.0)] * len(drive))
                       for stream in ("h12", "h20"))
        for arguments in (["--map", long, "--query", other], ["--odometry", long], [long, other]):
            out = self.path("out")
            work = subprocess.Popen([located("evaluate_bags"), "--out", out, *arguments], stdout=subprocess.DEVNULL,
                                    stderr=subprocess.PIPE, text=True)
            while not os.path.isdir(out) and work.poll() is None:
                time.sleep(0.001)
            # The folder is looked at once more before the work begins, which takes seconds.
            begun_s = self.processor_seconds(work) + 0.1
            while work.poll() is None and self.processor_seconds(work) < begun_s:
                time.sleep(0.001)
            os.rename(out, out + "_moved")
            _, said = work.communicate()
            self.assertEqual(work.returncode, 1, said)
            self.assertIn(out + ": this folder was removed, moved or replaced while results were written into it", said)
            for folder in (out, out + "_moved"):  # the former where something had still to be written at once
                shutil.rmtree(folder, ignore_errors=True)

    def test_poses_of_two_bodies_on_one_topic_are_refused(self):
        noon, dusk = self.bags()
        with rosbag.Bag(dusk, "a") as bag:
            for index, body in enumerate(("/rover", "rover", "", "crane")):
                pose = TransformStamped(child_frame_id=body)
                pose.header.stamp = rospy.Time(100 + index)
                pose.transform.rotation.w = 1
                bag.write("/vicon", pose, pose.header.stamp)
        done = run("evaluate_bags", "--out", self.path("out"), "--map", noon, "--query", dusk, "--poses", "/vicon")
        self.assertEqual((done.returncode, done.stderr.splitlines()[-1]), (
            1, "evaluate_bags: %s: /vicon has poses of rover and of crane (child_frame_id), which make no trajectory; rosbag "
               "filter %s ONE.bag \"topic != '/vicon' or m.child_frame_id == 'rover'\" keeps those of one" % (dusk, dusk)))
        done = run("evaluate_trajectory", "--out", self.path("out"), "--truth", dusk + ":/camera/pose", "--estimate", dusk + ":/vicon")
        self.assertEqual(done.returncode, 1)
        self.assertIn("/vicon has poses of rover and of crane", done.stderr)

    def test_a_bag_that_is_damaged_inside_is_named(self):
        noon, dusk = self.bags()
        content = pathlib.Path(dusk).read_bytes()
        pathlib.Path(dusk).write_bytes(content.replace(b"op=\x02", bytes(4)))  # of every message
        told = "%s: is damaged inside (" % dusk
        for arguments in (["--map", dusk, "--query", noon], ["--odometry", dusk], [noon, dusk]):
            done = run("evaluate_bags", "--out", self.path("out"), *arguments)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(told, done.stderr, arguments)

    def append_pose(self, bag, at, x, received=None, frame=""):
        """Another pose of stamp `at` that looks as those of write() do, in the bag where `received` puts it."""
        pose = PoseStamped()
        pose.header.stamp, pose.header.frame_id = rospy.Time(at), frame
        pose.pose.position.x = x
        pose.pose.orientation.z, pose.pose.orientation.w = math.sin(math.pi / 4), math.cos(math.pi / 4)
        with rosbag.Bag(bag, "a") as opened:
            opened.write("/camera/pose", pose, rospy.Time.from_sec(received or at))

    def test_an_image_of_whose_stamp_two_poses_differ_is_of_neither_in_whatever_order_they_stand(self):
        fault = "two_places: two poses of this stamp are 50 m and 0 deg apart: are these two recordings?"
        for received in (99.0, 200.0):
            noon = self.write("noon.bag", "h12/", [0.0, 1.0, 2.0, 3.0])
            dusk = self.write("dusk.bag", "h20/", [0.5, 1.5, 2.5])
            self.append_pose(noon, 102, 52.0, received)
            self.append_pose(dusk, 101, 51.5, received)
            self.append_pose(dusk, 100, 0.509, received)  # sent twice
            rows, done = self.localise("out%d" % received, "--map", noon, "--query", dusk, "--detectors", "sift", "--map-every",
                                       "0", status=3)
            self.assertEqual([(row["pose"], row["status"]) for row in rows], [("0", "localised"), ("2", "localised")])
            self.assertTrue(all(float(row["error_m"]) < 0.05 for row in rows), rows)
            self.assertEqual([tuple(row.values()) for row in self.rows("out%d" % received, "localisation_problems.csv")],
                             [("h12", "map", "102.000000000", fault), ("h20", "query", "101.000000000", fault)])
            self.assertIn("3 key frames", done.stdout)
            self.assertIn("2 images could not be used", done.stderr)

    def test_nor_is_a_pose_taken_between_others_of_which_one_is_two(self):
        theirs = self.write_foreign("theirs.bag", [0.0032, 1.0047, 2.0061])
        other = self.write_foreign("other.bag", [0.5013, 1.4988])
        with rosbag.Bag(other, "a") as bag:
            pose = TransformStamped()
            pose.header.stamp = rospy.Time.from_sec(100.51)
            pose.transform.translation.y, pose.transform.rotation.w = 3.0, 1.0
            bag.write("/vicon/camera", pose, rospy.Time(300))
        self.localise("out", "--map", theirs, "--query", other, "--stamp-tolerance", "0.01", *self.FOREIGN, status=3)
        self.assertEqual([row["fault"] for row in self.rows("out", "localisation_problems.csv")],
                         ["two_places: beside it, at 100.510000000: two poses of this stamp are 3.04 m and 90 deg apart: are these "
                          "two recordings?"])

    def test_images_under_another_sun_than_the_first_are_left_out_and_named(self):
        by_clock = [("2024-07-01T12:00:0%d.000Z" % second, 3.0) for second in range(4)]
        set_anew = [*by_clock[:2], ("2024-07-01T20:00:02.000Z", 5.0), by_clock[3]]
        moved = [*by_clock[:3], (by_clock[3][0], 2.0)]
        noon = self.write("noon.bag", "h12/", [0.0, 1.0, 2.0, 3.0], suns=set_anew)
        dusk = self.write("dusk.bag", "h20/", [0.5, 1.5, 2.5, 2.7], suns=moved)
        rows, done = self.localise("out", "--map", noon, "--query", dusk, "--detectors", "sift", "--map-every", "0", status=3)
        self.assertEqual([(row["pose"], row["status"]) for row in rows], [(str(pose), "localised") for pose in range(3)])
        self.assertIn("3 key frames", done.stdout)
        self.assertEqual([tuple(row.values()) for row in self.rows("out", "localisation_problems.csv")],
                         [("h12", "map", "102.000000000",
                           "other_sun: its sky is of 2024-07-01T20:00:02.000Z, not of 2024-07-01T12:00:00.000Z + 2 s as by the "
                           "first capture: was the sun set meanwhile (set_date_time)?"),
                          ("h20", "query", "103.000000000",
                           "other_sun: its sun stands 49.8 deg from that of the captures before, farther than it turns meanwhile: "
                           "was the site set (set_site)?")])
        alone = self.write("alone.bag", "h16/", [0.5, 1.5, 2.5, 2.7], suns=by_clock)
        self.localise("alone", "--map", alone, "--query", self.write("same.bag", "h18/", [0.6], suns=by_clock), "--detectors", "sift")

    def test_depth_that_comes_twice_is_counted(self):
        noon, dusk = self.bags()
        with rosbag.Bag(noon, "a") as bag:
            bag.write("/camera/depth/image_raw", message(numpy.ones((HEIGHT, WIDTH), numpy.float32), "32FC1", rospy.Time(103)),
                      rospy.Time(300))
        _, done = self.localise("out", "--map", noon, "--query", dusk, "--detectors", "sift")
        self.assertIn("h12: 1 pictures of depth left out, whose stamps repeat\n", done.stdout)

    def test_poses_of_other_frames_are_warned_of(self):
        means = ": errors mean nothing unless these are one frame"
        noon = self.write("noon.bag", "h12/", [0.0, 1.0, 2.0], frame="map")
        dusk = self.write("dusk.bag", "h20/", [0.5, 1.5], frame="/odom")
        same = self.write("same.bag", "h16/", [0.5, 1.5], frame="/map")
        none = self.write("none.bag", "h18/", [0.5, 1.5])
        _, done = self.localise("told", "--map", noon, "--query", dusk, same, none, "--detectors", "sift", "--map-every", "0")
        said = "poses of /camera/pose of %s are in the frame odom, those of /camera/pose of %s in map%s" % (dusk, noon, means)
        self.assertEqual(done.stderr, "warning: %s\n" % said)
        self.assertEqual([tuple(row.values()) for row in self.rows("told", "localisation_problems.csv")],
                         [("h20", "query", "100.000000000", "other_frame: " + said)])
        self.append_pose(same, 101, 1.5, frame="world")  # in one topic
        _, done = self.localise("mixed", "--map", noon, "--query", same, "--detectors", "sift", "--map-every", "0")
        self.assertIn("poses of /camera/pose of %s are in the frame world" % same, done.stderr)
        # Each drive is followed in a frame of its own.
        follow = ["evaluate_bags", "--detectors", "sift", "--out", self.path("followed"), "--odometry", noon, dusk]
        done = run(*follow)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        done = run(*follow, same)
        self.assertEqual((done.returncode, done.stderr), (0, "warning: poses of /camera/pose of %s are in the frame world, others "
                                                             "in map%s\n" % (same, means)))

    def without_slashes(self, name):
        """As rosbag.Bag.write("h12/camera/image_raw", …) calls topics."""
        bare = self.path("bare_" + os.path.basename(name))
        with rosbag.Bag(bare, "w") as written, rosbag.Bag(name) as bag:
            for topic, one, stamp in bag.read_messages():
                written.write(topic[1:], one, stamp)
        return bare

    def test_topics_may_lack_their_slash(self):
        noon, dusk = self.bags()
        self.localise("usual", "--map", noon, "--query", dusk, "--detectors", "sift")
        self.localise("bare", "--map", self.without_slashes(noon), "--query", self.without_slashes(dusk) + ":h20", "--detectors",
                      "sift")
        name = os.path.join("%s", "localisation.csv")
        usual, bare = (pathlib.Path(self.path(name % out)).read_bytes() for out in ("usual", "bare"))
        self.assertEqual(bare, usual)
        theirs = self.without_slashes(self.write_foreign("theirs.bag", [0.0032, 1.0047, 2.0061]))
        other = self.without_slashes(self.write_foreign("other.bag", [0.5013, 1.4988]))
        for out, topics in (("slash", self.FOREIGN), ("none", [word.lstrip("/") for word in self.FOREIGN])):
            rows, _ = self.localise(out, "--map", theirs, "--query", other, "--stamp-tolerance", "0.01", *topics)
            self.assertEqual([row["status"] for row in rows], ["localised"] * 2)

    def test_a_detector_that_throws_at_pictures_ends_nothing(self):
        noon, _ = self.bags()
        tiny = self.write("tiny.bag", "h20/", [0.5, 1.5], size=(16, 16))  # too small for six octaves of BRISK
        with open(self.path("own.yaml"), "w") as file:
            file.write("{streams: [h12], output_dir: unused, features: {brisk: {n_octaves: 6}}}")
        by = ["--detectors", "brisk,orb", "--config", self.path("own.yaml")]
        drive = self.write("drive.bag", "h22/", [0.5])
        rows, done = self.localise("out", "--map", noon, "--query", drive, tiny, *by, status=3)
        self.assertEqual([(row["query"], row["detector"], row["status"]) for row in rows],
                         [("h22", "brisk", "localised"), ("h22", "orb", "localised"),
                          ("h20", "orb", "no_features"), ("h20", "orb", "no_features")])
        problems = self.rows("out", "localisation_problems.csv")
        self.assertEqual([(row["stream"], row["role"], row["stamp"], row["fault"][:7]) for row in problems],
                         [("h20", "query", "100.000000000", "no_feat"), ("h20", "query", "101.000000000", "no_feat"),
                          ("h20", "query", "100.000000000", "brisk: "), ("h20", "query", "101.000000000", "brisk: ")])
        self.assertEqual(problems[0]["fault"], "no_features: orb found nothing in it")
        self.assertIn("2 images could not be used", done.stderr)
        self.assertIn("2 times a detector found nothing in an image", done.stderr)
        rows, _ = self.localise("other", "--map", tiny, "--query", drive, *by, status=3)
        self.assertEqual([(row["detector"], row["status"]) for row in rows],
                         [("brisk", "not_retrieved"), ("orb", "too_few_matches")])
        self.assertEqual(self.rows("other", "localisation_problems.csv")[0],
                         {"stream": "h20", "role": "map", "stamp": "100.000000000",
                          "fault": "no_features: orb found nothing in it whose place its depth tells"})
        rows, done = self.localise("blind", "--map", noon, "--query", tiny, "--detectors", "orb")
        self.assertEqual([row["status"] for row in rows], ["no_features", "no_features"], "which is no fault of the bags")
        self.assertEqual(len(self.rows("blind", "localisation_problems.csv")), 2)
        done = run("evaluate_bags", "--odometry", tiny, *by, "--out", self.path("followed"))
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertEqual([(row["detector"], row["n"], row["lost"]) for row in self.rows("followed", "odometry.csv")],
                         [("brisk", "2", "1"), ("orb", "2", "1")])
        self.assertEqual(len(self.rows("followed", "localisation_problems.csv")), 2)

    def test_a_drive_is_followed_by_its_own_pictures(self):
        self.write("dusk.bag", "h20/", [0.4 * k for k in range(61)])
        self.write("noon.bag", "h12/", [0.4 * k for k in range(61)], without={("depth/image_raw", 3)})
        done = run("evaluate_bags", "--odometry", self.path("dusk.bag"), self.path("noon.bag"), "--detectors", "sift",
                   "--out", self.path("out"))
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIn("1 images could not be used", done.stderr)
        rows = self.rows("out", "odometry.csv")
        self.assertEqual([(row["stream"], row["detector"], row["n"], row["lost"]) for row in rows],
                         [("h20", "sift", "61", "0"), ("h12", "sift", "60", "0")])
        for row in rows:
            self.assertAlmostEqual(float(row["length_m"]), 24.0, places=6)
            # The wall's picture is 9 m wide, so at least two key frames; each may be off by 30 mm, as a query is.
            self.assertGreaterEqual(int(row["key_frames"]), 2)
            self.assertLess(float(row["end_error_m"]), 0.03 * int(row["key_frames"]))
            self.assertLess(float(row["rpe_10m_m"]), 0.03 * int(row["key_frames"]))
        self.write("bent.bag", "bent/", [0.5, 1.5], distortion=[0.1, 0, 0])
        done = run("evaluate_bags", "--odometry", self.path("dusk.bag"), self.path("bent.bag"), "--detectors", "sift",
                   "--out", self.path("half"))
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIn("bent: nothing to follow\n2 images could not be used", done.stderr)
        self.assertEqual(self.rows("half", "odometry.csv"), rows[:1], "what was followed stays")
        refused = run("evaluate_bags", "--odometry", self.path("bent.bag"), "--detectors", "sift", "--out", self.path("none"))
        self.assertEqual((refused.returncode, refused.stderr.count("\n")), (1, 1), refused.stderr)
        self.assertIn("no stream can be followed: 2 images could not be used", refused.stderr)
        self.assertEqual(len(self.rows("none", "localisation_problems.csv")), 2)
        done = run("evaluate_trajectory", "--truth", self.path("out/truth_h20.tum"), "--estimate",
                   self.path("out/odometry_h20_sift.tum"), "--out", self.path("trajectory"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("--odometry goes without --map and --query",
                      self.refused("--odometry", self.path("dusk.bag"), "--map", self.path("noon.bag")))

    def test_what_cannot_be_used_at_all_is_refused(self):
        noon, dusk = self.bags()
        bent = self.write("bent.bag", "h20/", [0.5], distortion=[0.1, 0, 0])
        self.assertIn("no query can be used: 1 images could not be used", self.refused("--map", noon, "--query", bent))
        self.assertIn("camera_info/D is 3 numbers, but must be 4 or 5, k1 k2 p1 p2 [k3], for plumb_bob",
                      self.refused("--map", noon, "--query", bent))
        named = [("h20", "query", "100.000000000")]  # in the file that the line speaks of
        told = self.rows("out", "localisation_problems.csv")
        self.assertEqual([(row["stream"], row["role"], row["stamp"]) for row in told], named)
        self.assertIn("the map has no key frame", self.refused("--map", bent, "--query", noon))
        self.assertEqual([row["role"] for row in self.rows("out", "localisation_problems.csv")], ["map"])
        os.mkdir(self.path("run"))
        pathlib.Path(self.path("run/run.yaml")).write_text("settings:\n  ratio: '0.5'\n")
        pathlib.Path(self.path("run/frames.csv")).write_text("header\nrow\n")
        for arguments in (["--map", noon, "--query", dusk], ["--odometry", noon]):
            done = run("evaluate_bags", "--out", self.path("run"), *arguments)
            self.assertEqual(done.returncode, 1)
            self.assertIn("run: this folder holds the results of an evaluation (run.yaml)", done.stderr)
            self.assertEqual(sorted(os.listdir(self.path("run"))), ["frames.csv", "run.yaml"])
        for arguments in (["--map", noon], ["--query", dusk]):
            self.assertIn("--map and --query need each other", self.refused(*arguments))
        self.assertIn("absent.bag: is not a bag that can be read", self.refused("--map", self.path("absent.bag"), "--query", dusk))
        pathlib.Path(self.path("text.bag")).write_text("no bag")
        self.assertIn("text.bag: is not a bag: it does not begin with #ROSBAG V2.0",
                      self.refused("--map", noon, "--query", self.path("text.bag")))
        for name, begin in (("ros2.db3", b"SQLite format 3\0"), ("ros2.mcap", b"\x89MCAP0\r\n")):
            pathlib.Path(self.path(name)).write_bytes(begin + b"0" * 500)
            self.assertIn(name + ": is a bag of ROS 2, but must be one of ROS 1", self.refused("--odometry", self.path(name)))
        whole = pathlib.Path(noon).read_bytes()
        pathlib.Path(self.path("cut.bag")).write_bytes(whole[:-50])  # within the index, which is the end
        pathlib.Path(self.path("half.bag")).write_bytes(whole[:len(whole) // 2])
        with rosbag.Bag(self.path("recorded.bag"), "w") as bag:
            bag.write("/h20/camera/pose", PoseStamped(), rospy.Time(1))
            bag.flush()
            shutil.copy(self.path("recorded.bag"), self.path("left.bag.active"))
        for name, reason in (("cut.bag", "Error reading from file"), ("half.bag", "Error reading from file"),
                             ("left.bag.active", "Bag unindexed")):
            for arguments in (["--map", noon, "--query", self.path(name)], [self.path(name)]):
                told = self.refused(*arguments)
                self.assertIn(name + ": is not a bag that can be read: " + reason, told)
                self.assertIn("; its end is missing: it is still being recorded, or was cut off while it was recorded or "
                              "copied; copy it again, or mend what is there by rosbag reindex " + self.path(name), told)
        for name in ("absent.bag", "text.bag"):
            self.assertNotIn("reindex", self.refused(self.path(name)))
        with rosbag.Bag(self.path("empty.bag"), "w"):
            pass
        self.assertIn("empty.bag: holds no image below /", self.refused("--map", noon, "--query", self.path("empty.bag")))
        self.assertIn("--detectors is [fast], but must be", self.refused("--map", noon, "--query", dusk, "--detectors", "fast"))
        with rosbag.Bag(self.path("odd.bag"), "w") as bag:
            bag.write("/h20/camera/image_raw", PoseStamped(), rospy.Time(1))
        self.assertIn("/h20/camera/image_raw is geometry_msgs/PoseStamped, not sensor_msgs/Image",
                      self.refused("--map", noon, "--query", self.path("odd.bag")))
        self.assertIn("/h12/camera/camera_info is sensor_msgs/CameraInfo, not geometry_msgs/PoseStamped",
                      self.refused("--map", noon, "--query", dusk, "--poses", "/h12/camera/camera_info"))
        blind = self.write("blind.bag", "h20/", [0.5, 1.5], without={("camera_info", 0), ("camera_info", 1)})
        self.assertIn("h20 at 100.000000000 and 1 more: the bag holds no /h20/camera/camera_info, see --camera-info",
                      self.refused("--map", noon, "--query", blind))


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "tools_localise_bags", LocaliseBags, sysargs=sys.argv)
