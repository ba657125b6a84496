#!/usr/bin/env python3
"""evaluate_places, as people type it."""
import csv
import os
import pathlib
import re
import sys
import tempfile
import unittest

import cv2
import numpy
import rosunit

from timelapse import run

PICTURES = 13
METHODS = ["sad", "seqslam", "vlad:sift", "vlad:orb"]


def view(place, darker=False):
    """Discs, and the same in another light: darker, flatter, with a bright sky."""
    generator = numpy.random.RandomState(place)
    picture = numpy.full((120, 160), 128, numpy.uint8)
    for x, y, radius, level in zip(generator.randint(0, 160, 120), generator.randint(0, 120, 120),
                                   generator.randint(2, 12, 120), generator.randint(0, 256, 120)):
        cv2.circle(picture, (int(x), int(y)), int(radius), int(level), -1)
    return (picture * 0.5 + 20).astype(numpy.uint8) if darker else picture


def content(folder):
    return {name: pathlib.Path(folder, name).read_bytes() for name in sorted(os.listdir(folder))}


class Places(unittest.TestCase):

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.map, self.query, self.out = (os.path.join(self.folder.name, name) for name in ("map", "query", "out"))
        for folder, darker in ((self.map, False), (self.query, True)):
            os.mkdir(folder)
            for i in range(PICTURES):
                cv2.imwrite(os.path.join(folder, "%d.png" % i), view(i, darker))

    def tearDown(self):
        self.folder.cleanup()

    def evaluate(self, *more, out=None):
        return run("evaluate_places", "--map", self.map, "--query", self.query, "--out", out or self.out, *more)

    def rows(self):
        with open(os.path.join(self.out, "places.csv")) as file:
            return list(csv.DictReader(file))

    def test_one_row_a_method_and_a_matrix_of_each(self):
        done = self.evaluate("--method", "sad, seqslam", "--method", "vlad:sift,vlad:orb", "--tolerance", "0")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        rows = self.rows()
        self.assertEqual(list(rows[0]), ["method", "queries", "recall_1", "recall_5", "recall_10", "pr_auc",
                                         "recall_at_100_precision", "without_truth"])
        self.assertEqual([row["method"] for row in rows], METHODS)
        for row in rows:
            self.assertEqual((row["queries"], float(row["recall_1"])), (str(PICTURES), 1.0), row)
        matrices = ["difference_" + method.replace(":", "_") for method in METHODS]
        self.assertEqual(sorted(os.listdir(self.out)),
                         sorted([name + ending for name in matrices for ending in (".csv", ".png")] + ["places.csv"]))
        table = [line.split() for line in done.stdout.splitlines()]
        self.assertEqual([words[0] for words in table], ["method"] + METHODS)
        for words, row in zip(table[1:], rows):
            self.assertEqual(words[2:], ["%.3f" % float(row[column]) for column in list(row)[2:7]])

    def test_vlad_takes_a_detector_behind_a_preprocessing(self):
        done = self.evaluate("--method", "vlad:orb+clahe,vlad:orb+gamma", "--tolerance", "0")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual([(row["method"], float(row["recall_1"])) for row in self.rows()],
                         [("vlad:orb+clahe", 1.0), ("vlad:orb+gamma", 1.0)])
        self.assertNotEqual(*[pathlib.Path(self.out, "difference_vlad_orb+%s.csv" % name).read_bytes()
                              for name in ("clahe", "gamma")])

    def test_recalls_follow_from_the_matrix(self):
        """Another hand's count of what the definitions in the README say, of places hard to tell apart."""
        for i in range(PICTURES):
            cv2.imwrite(os.path.join(self.query, "%d.png" % i), cv2.GaussianBlur(view(i // 3, True), (0, 0), 3))
        self.assertEqual(self.evaluate("--method", "sad", "--tolerance", "1").returncode, 0)
        with open(os.path.join(self.out, "difference_sad.csv")) as file:
            lines = list(csv.reader(file))
        names = ["%d.png" % i for i in range(PICTURES)]
        self.assertEqual((lines[0], [line[0] for line in lines[1:]]), (["query"] + names, names))
        matrix = numpy.array([[float(value) for value in line[1:]] for line in lines[1:]])
        row = self.rows()[0]
        order = matrix.argsort(axis=1, kind="stable")
        right = abs(order - numpy.arange(PICTURES)[:, None]) <= 1
        for column, first in (("recall_1", 1), ("recall_5", 5), ("recall_10", 10)):
            self.assertEqual(float(row[column]), right[:, :first].any(axis=1).mean())
        self.assertTrue(0 < float(row["recall_1"]) < 1)
        best = matrix.min(axis=1)
        recall, precision = [0.0], [1.0]
        for threshold in numpy.unique(best):
            accepted = best <= threshold
            recall.append((right[:, 0] & accepted).sum() / PICTURES)
            precision.append((right[:, 0] & accepted).sum() / accepted.sum())
        self.assertAlmostEqual(float(row["pr_auc"]), numpy.trapz(precision, recall), delta=1e-12)
        self.assertEqual(float(row["recall_at_100_precision"]),
                         max(r for r, p in zip(recall, precision) if p == 1.0))
        drawn = cv2.imread(os.path.join(self.out, "difference_sad.png"), cv2.IMREAD_UNCHANGED)
        scaled = (matrix - matrix.min()) / (matrix.max() - matrix.min()) * 255
        self.assertEqual((drawn.dtype, drawn.shape), (numpy.uint8, matrix.shape))
        self.assertLessEqual(abs(drawn - scaled).max(), 0.5 + 1e-9)

    def test_two_runs_leave_the_same_bytes(self):
        again = self.out + "_again"
        for out in (self.out, again):
            self.assertEqual(self.evaluate("--method", ",".join(METHODS), out=out).returncode, 0)
        self.assertEqual(content(self.out), content(again))

    def test_says_what_does_not_count(self):
        cv2.imwrite(os.path.join(self.query, "%d.png" % PICTURES), numpy.full((120, 160), 70, numpy.uint8))
        pathlib.Path(self.map, "readme.txt").write_text("")
        done = self.evaluate("--method", "vlad:sift", "--tolerance", "0")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for said in ("map: 1 files are no pictures and are not used",
                     "vlad:sift: 0 of 13 pictures of the map and 1 of 14 queries have no features: such a place is never",
                     "vlad:sift: 1 queries found no place", "1 queries have no true place within 0 frames: missed by every recall@N, not in PR's recall, "
                     "but their guesses count against its precision"):
            self.assertIn(said, done.stdout)
        row = self.rows()[0]
        self.assertEqual((row["queries"], float(row["recall_1"]), float(row["pr_auc"])), ("14", 13 / 14, 1.0))

    def refused(self, *arguments):
        done = self.evaluate(*arguments)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1), done.stderr)
        self.assertFalse(os.path.exists(self.out))
        return done.stderr

    def test_refuses_what_it_cannot_work_with_before_the_work(self):
        self.assertIn("--method NAME is missing", self.refused())
        os.remove(os.path.join(self.query, "12.png"))
        os.remove(os.path.join(self.query, "11.png"))
        os.remove(os.path.join(self.query, "10.png"))
        self.assertRegex(self.refused("--method", "sad,seqslam"),
                         re.escape(self.query) + ": holds 10 pictures, but a sequence of seqslam needs at least 11")
        pathlib.Path(self.query, "3.png").write_bytes(b"none")
        self.assertIn(self.query + "/3.png: cannot decode this picture", self.refused("--method", "sad"))
        self.query = self.query + "/none"
        self.assertIn(self.query + ": there is no such folder", self.refused("--method", "sad"))
        os.mkdir(os.path.join(self.folder.name, "empty"))
        self.query = os.path.join(self.folder.name, "empty")
        self.assertIn(self.query + ": holds no pictures", self.refused("--method", "sad"))

    def test_does_not_draw_among_the_pictures_that_it_reads(self):
        link = os.path.join(self.folder.name, "link")
        os.symlink(self.query, link)
        before = content(self.map), content(self.query)
        for out, option in ((self.map, "--map"), (os.path.join(self.map, "..", "query"), "--query"), (link, "--query")):
            done = self.evaluate("--method", "sad", out=out)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1), done.stderr)
            self.assertIn('--out is "%s", but must be another folder than that of %s, ' % (out, option), done.stderr)
            self.assertEqual((content(self.map), content(self.query)), before)
        below = os.path.join(self.map, "results")  # only what lies in a folder itself is read
        for _ in range(2):
            done = self.evaluate("--method", "sad", out=below)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            with open(os.path.join(below, "difference_sad.csv")) as file:
                self.assertEqual(len(next(csv.reader(file))), 1 + PICTURES)


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "tools_evaluate_places", Places, sysargs=sys.argv)
