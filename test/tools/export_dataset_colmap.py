#!/usr/bin/env python3
"""COLMAP, from exported pictures alone, finds the camera and its path again. Needs COLMAP (Debian: colmap), else skipped.

Takes two minutes of processor time, one and a half of them COLMAP's."""
import csv
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import rosunit

from export_dataset import lines_of, read_poses
from timelapse import run

CURVE = ["--first", "850", "--count", "79", "--stride", "2", "--fov", "60", "--hours", "12"]  # 40 poses over 77 m


@unittest.skipUnless(shutil.which("colmap"), "needs COLMAP: apt-get install colmap")
class Colmap(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        done = run("export_dataset", "--format", "colmap", str(cls.folder / "set"), *CURVE)
        assert (done.returncode, done.stderr.count("error")) == (0, 0), done.stderr
        cls.images = str(cls.folder / "set/images")
        cls.database = str(cls.folder / "database.db")
        cls.colmap("feature_extractor", "--image_path", cls.images, "--ImageReader.single_camera", "1",
                   "--ImageReader.camera_model", "SIMPLE_PINHOLE", "--SiftExtraction.use_gpu", "0",
                   "--SiftExtraction.num_threads", "1")  # which numbers the pictures as images.txt does
        # In their order: fences and trees of this world are like one another, and pictures far apart match wrongly.
        cls.colmap("sequential_matcher", "--SiftMatching.use_gpu", "0", "--SequentialMatching.overlap", "8")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def colmap(cls, command, *arguments):
        done = subprocess.run(["colmap", command, "--database_path", cls.database, *arguments], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              env={**os.environ, "QT_QPA_PLATFORM": "offscreen"})
        assert done.returncode == 0, "colmap %s: %s" % (command, done.stdout[-2000:])

    def as_text(self, model):
        subprocess.run(["colmap", "model_converter", "--input_path", str(model), "--output_path", str(model), "--output_type",
                        "TXT"], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, check=True,
                       env={**os.environ, "QT_QPA_PLATFORM": "offscreen"})

    def trajectory(self, images, name):
        """images.txt as a TUM file, with a picture's number for its stamp."""
        path = self.folder / name
        path.write_text("".join("%s %s\n" % (picture[:-4], " ".join("%.9f" % number for number in tum))
                                for picture, tum in sorted(read_poses(images).items())))
        return str(path)

    def test_the_camera_and_its_path_are_found_again(self):
        model = self.folder / "model"
        model.mkdir()
        self.colmap("mapper", "--image_path", self.images, "--output_path", str(model))
        self.assertEqual(os.listdir(model), ["0"])  # not in pieces
        self.as_text(model / "0")
        truth = self.trajectory(self.folder / "set/sparse/0/images.txt", "truth.txt")
        done = run("evaluate_trajectory", "--truth", truth, "--estimate", self.trajectory(model / "0/images.txt", "estimate.txt"),
                   "--align", "sim3", "--out", str(self.folder / "errors"))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        places = np.array([line.split()[1:4] for line in lines_of(truth)], float)
        length = np.linalg.norm(np.diff(places, axis=0), axis=1).sum()
        self.assertAlmostEqual(length, 77, delta=1)
        with open(self.folder / "errors/trajectory.csv") as file:
            ate, = [row for row in csv.DictReader(file) if row["metric"] == "ate"]
        self.assertEqual((ate["n"], ate["unmatched"]), ("40", "0"))
        self.assertLess(float(ate["rmse"]), 0.001 * length)
        focal = [float(line.split()[4]) for line in lines_of(model / "0/cameras.txt")]
        written = [float(line.split()[4]) for line in lines_of(self.folder / "set/sparse/0/cameras.txt")]
        self.assertEqual((len(focal), len(written)), (1, 1))
        self.assertAlmostEqual(focal[0] / written[0], 1.0, delta=0.002)

    def test_points_come_from_the_poses_that_are_known(self):
        points = self.folder / "points"
        points.mkdir()
        self.colmap("point_triangulator", "--image_path", self.images, "--input_path", str(self.folder / "set/sparse/0"),
                    "--output_path", str(points))
        self.as_text(points)
        errors = np.array([float(line.split()[7]) for line in lines_of(points / "points3D.txt")])
        self.assertGreater(len(errors), 2000)
        self.assertLess(np.median(errors), 0.5)  # px; 0.32 of features that are found that well
        # The poses stay what they were.
        known, kept = read_poses(self.folder / "set/sparse/0/images.txt"), read_poses(points / "images.txt")
        self.assertEqual(set(known), set(kept))
        for name, pose in known.items():
            np.testing.assert_allclose(kept[name], pose, rtol=0, atol=1e-6)


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "tools_export_dataset_colmap", Colmap, sysargs=sys.argv)
