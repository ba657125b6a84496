#!/usr/bin/env python3
"""evaluate_pair, as people type it, also on photographs with published homographies."""
import csv
import math
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

DATA = pathlib.Path(__file__).resolve().parents[3] / "shared" / "data"
COLUMNS = (["a", "b", "detector", "features_a", "features_b", "repeatability", "matching_score_3px"] +
           ["mma_%dpx" % t for t in range(1, 11)] +
           ["mutual_matches", "ratio_matches", "precision_3px", "recall_3px", "average_precision_3px", "d", "d_symmetric",
            "d_one_to_one"])
HALF_A_DIGIT = 0.5e-3  # figures of the table have three digits
HALF_A_DIGIT_OF_D = 0.5e-4
# The table's SURF is OpenCV's own. Ours finds the same points within 0.002 px, but descriptors differ by up to 0.05 of
# their length, so that some two of a thousand decisions between nearly equal neighbours fall otherwise.
SURF_MATCHES, SURF_SHARE = 0.01, 0.002


def detectors():
    """Those that are compared unless others are asked for: those of the paper that this build has."""
    return re.search(r"--detectors LIST .*?\(default ([a-z,]+)\)", run("evaluate_pair", "--help").stdout,
                     re.DOTALL).group(1).split(",")


def rows_of(folder):
    with open(os.path.join(folder, "verified.csv"), newline="") as file:
        reader = csv.DictReader(file)
        assert reader.fieldnames == COLUMNS, reader.fieldnames
        return list(reader)


class EvaluatePair(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def picture(self, name, width=160, height=120, shift=0):
        """Blobs at fixed places, so that all detectors find some."""
        generator = numpy.random.RandomState(1)
        pixels = numpy.full((height, width), 128, numpy.uint8)
        for x, y, radius, grey in zip(generator.randint(0, 160, 200), generator.randint(0, 120, 200),
                                      generator.randint(2, 7, 200), generator.randint(0, 256, 200)):
            cv2.circle(pixels, (int(x) + shift, int(y)), int(radius), int(grey), -1)
        cv2.imwrite(self.path(name), cv2.merge([pixels] * 3))
        return self.path(name)

    def write(self, name, text):
        pathlib.Path(self.path(name)).write_text(text)
        return self.path(name)

    def evaluate(self, out, *arguments):
        done = run("evaluate_pair", "--out", self.path(out), *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return rows_of(self.path(out)), done.stdout

    def refused(self, *arguments):
        """The one line that it gives up with, having left nothing."""
        done = run("evaluate_pair", *arguments)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1), (arguments, done.stderr))
        self.assertTrue(done.stderr.startswith("evaluate_pair: "), done.stderr)
        self.assertFalse(os.path.exists(self.path("out")))
        return done.stderr

    def test_compares_the_detectors_of_the_paper_that_are_built_in(self):
        self.assertIn(detectors(), (["sift", "surf", "orb", "brisk"], ["sift", "orb", "brisk"]))

    def test_a_picture_is_found_again_whole_in_itself(self):
        picture = self.picture("a.png")
        rows, table = self.evaluate("out", picture, picture)
        self.assertEqual([row["detector"] for row in rows], detectors())
        for row in rows:
            self.assertEqual((row["a"], row["b"]), (picture, picture))
            self.assertGreater(int(row["features_a"]), 20)
            for column in ("repeatability", "mma_1px", "mma_10px", "precision_3px"):
                self.assertEqual(row[column], "1", (row["detector"], column))
            self.assertRegex(table, "(?m)^%s " % row["detector"])

    def test_pictures_of_different_sizes_are_compared_by_their_homography(self):
        a = self.picture("a.png")
        b = self.picture("b.ppm", width=200, shift=30)
        self.assertIn("a.png is 160x120 px, %s 200x120 px: pictures of different sizes need --homography FILE" % b,
                      self.refused("--out", self.path("out"), a, b))
        shift = self.write("H.txt", "1 0 30\n0 1 0\n0 0 1\n")
        rows, _ = self.evaluate("out", "--homography", shift, "--detectors", "brisk,sift", a, b)
        self.assertEqual([row["detector"] for row in rows], ["brisk", "sift"])
        for row in rows:
            self.assertGreater(float(row["repeatability"]), 0.8)
            self.assertGreater(float(row["precision_3px"]), 0.95)

    def test_options_of_detectors_and_of_the_ratio_count(self):
        picture = self.picture("a.png")
        (few,), _ = self.evaluate("few", picture, picture, "--detectors", "orb", "--orb-n-features", "30")
        self.assertLessEqual(int(few["features_a"]), 30)
        (strict,), _ = self.evaluate("strict", picture, self.picture("b.png", shift=1), "--detectors", "brisk", "--ratio",
                                     "0.1")
        (loose,), _ = self.evaluate("loose", picture, self.picture("b.png", shift=1), "--detectors", "brisk", "--ratio", "1")
        self.assertLess(int(strict["ratio_matches"]), int(loose["ratio_matches"]))
        self.assertEqual(strict["mma_3px"], loose["mma_3px"])

    def test_a_detector_may_look_through_a_preprocessing(self):
        picture, shifted = self.picture("a.png"), self.picture("b.png", shift=1)
        rows, table = self.evaluate("out", picture, shifted, "--detectors", "orb,orb+gamma,orb+illumination_invariant,sift+clahe",
                                    "--gamma-exponent", "1")
        orb, straight, unlit, equal = rows
        self.assertEqual([row["detector"] for row in rows], ["orb", "orb+gamma", "orb+illumination_invariant", "sift+clahe"])
        self.assertEqual({**straight, "detector": "orb"}, orb)  # v^1 is v
        self.assertEqual((unlit["features_a"], unlit["d"]), ("0", "nan"))  # a picture without colours
        self.assertGreater(int(equal["features_a"]), 20)
        self.assertEqual(len({len(line) for line in table.splitlines()[:-1]}), 1)  # columns stand below one another
        (curved,), _ = self.evaluate("curved", picture, shifted, "--detectors", "orb+gamma")
        self.assertNotEqual({**curved, "detector": "orb"}, orb)

    def test_a_network_is_a_detector_too(self):
        network = str(pathlib.Path(__file__).resolve().parents[1] / "golden" / "bright_pixel.onnx")
        picture = self.picture("a.png")
        (row,), _ = self.evaluate("net", "--detectors", "onnx", "--onnx-model", network, picture, picture)
        self.assertEqual((row["detector"], float(row["repeatability"])), ("onnx", 1.0))
        self.assertGreater(int(row["features_a"]), 10)
        self.assertIn("model of onnx is \"\", but must be the file of a network",
                      self.refused("--out", self.path("out"), "--detectors", "onnx", picture, picture))

    def test_no_features_are_undefined_and_no_matches_are_zero(self):
        grey = self.path("grey.png")
        cv2.imwrite(grey, numpy.full((120, 160), 128, numpy.uint8))
        (row,), _ = self.evaluate("none", grey, grey, "--detectors", "orb")
        for column in ("repeatability", "matching_score_3px", "precision_3px", "recall_3px", "average_precision_3px", "d"):
            self.assertEqual(row[column], "nan", column)
        self.assertEqual(row["mma_3px"], "0")
        (row,), _ = self.evaluate("one", self.picture("a.png"), grey, "--detectors", "orb")
        self.assertEqual((row["repeatability"], row["mma_3px"], row["d"]), ("0", "0", "1"))

    def test_an_experiment_keeps_its_verified_csv(self):
        picture = self.picture("a.png")
        verified = "pose,stamp,a,b,detector,features_a\n0,1,noon,dusk,orb,3\n"
        for name, files, said in (
                ("run", {"run.yaml": "settings:\n  metrics: 'all'\n", "frames.csv": "pose\n0\n", "verified.csv": "x\n"},
                 ": this folder holds the results of an evaluation (run.yaml), which would be mixed with those of others; "
                 "choose another\n"),
                ("rest", {"verified.csv": verified},
                 "/verified.csv: this is of an evaluation, which would lose it; choose another folder\n")):
            os.mkdir(self.path(name))
            for file, text in files.items():
                self.write(name + "/" + file, text)
            # Before anything is computed: there is no such picture.
            for b in (picture, self.path("absent.png")):
                self.assertEqual(self.refused("--out", self.path(name), picture, b),
                                 "evaluate_pair: " + self.path(name) + said)
            for file, text in files.items():
                self.assertEqual(pathlib.Path(self.path(name), file).read_text(), text)
        for _ in range(2):  # its own is made anew
            self.evaluate("out", "--detectors", "orb", picture, picture)

    def test_bad_input_is_refused_by_what_is_wrong_and_where(self):
        picture = self.picture("a.png")
        out = ["--out", self.path("out")]
        for name, text, said in (("few.txt", "1 0 0\n0 1\n0 0 1\n", "few.txt:2: numbers of this line: 2; a homography is "
                                  "three lines of three numbers"),
                                 ("word.txt", "1 0 0\n0 1 0\n0 0 x\n", 'word.txt:3: "x" is not a number'),
                                 ("flat.txt", "1 2 3\n2 4 6\n0 0 1\n", "flat.txt: this homography cannot be inverted")):
            self.assertIn(said, self.refused(*out, "--homography", self.write(name, text), picture, picture))
        self.assertIn("absent.txt: cannot be read", self.refused(*out, "--homography", self.path("absent.txt"), picture,
                                                                 picture))
        self.assertIn("absent.png", self.refused(*out, picture, self.path("absent.png")))
        self.assertIn("no.png: cannot decode this picture", self.refused(*out, self.write("no.png", "text"), picture))
        whole = pathlib.Path(picture).read_bytes()
        pathlib.Path(self.path("cut.png")).write_bytes(whole[:len(whole) // 2])
        self.assertIn("cut.png: read: the file is cut off", self.refused(*out, picture, self.path("cut.png")))
        for name in ("fast", "sift+", "sift+clahee", "+clahe", "sift+clahe+gamma"):
            self.assertIn("--detectors is [sift, %s], but must be a list of some of %s, akaze, kaze, rootsift, onnx, sift+clahe, " %
                          (name, ", ".join(detectors())), self.refused(*out, "--detectors", "sift," + name, picture, picture))
        self.assertIn("BRISK finds no features in a picture of 5×7 px: ",
                      self.refused(*out, "--detectors", "brisk+clahe", *[self.picture("tiny.png", 5, 7)] * 2))
        self.assertIn("--gamma-exponent is 0, but must be from 0.1 to 10",
                      self.refused(*out, "--gamma-exponent", "0", picture, picture))
        self.assertIn("each once", self.refused(*out, "--detectors", "sift,sift", picture, picture))
        self.assertIn("--ratio is 1.1, but must be", self.refused(*out, "--ratio", "1.1", picture, picture))
        self.assertIn("--orb-wta-k is 5, but must be from 2 to 4", self.refused(*out, "--orb-wta-k", "5", picture, picture))
        self.assertIn("pictures named: 1, but must be two", self.refused(*out, picture))
        self.assertIn("pictures named: 3, but must be two", self.refused(*out, picture, picture, picture))
        self.assertIn("--out DIR is missing", self.refused(picture, picture))
        self.assertIn("no option --homograph;", self.refused(*out, "--homograph", "H.txt", picture, picture))
        self.assertIn("the folder cannot be made", self.refused("--out", picture + "/below", picture, picture))

    def expected(self):
        """The table of the data's README: (detector, pair) -> its other cells."""
        table = {}
        for line in (DATA / "README.md").read_text().splitlines():
            cells = [cell.strip() for cell in line.strip("|").split("|")]
            if len(cells) == 10 and re.fullmatch(r"1-\d", cells[1]):
                table[cells[0].lower(), cells[1]] = cells[2:]
        return table

    @unittest.skipUnless((DATA / "leuven" / "img1.ppm").exists(), "needs ../shared/data/leuven")
    def test_real_photographs_give_the_published_values(self):
        found = {}
        for other in range(2, 7):
            rows, _ = self.evaluate("%d" % other, "--homography", str(DATA / "leuven" / ("H1to%dp" % other)),
                                    "--detectors", ",".join(detectors()), str(DATA / "leuven" / "img1.ppm"),
                                    str(DATA / "leuven" / ("img%d.ppm" % other)))
            found.update({(row["detector"], "1-%d" % other): row for row in rows})
        table = self.expected()
        self.assertEqual(len(table), 8)
        for key, cells in table.items():
            if key[0] not in detectors():
                continue
            with self.subTest(key):
                self.compare(found[key], cells, is_surf=key[0] == "surf")
        self.falls_with_the_light(found)

    def compare(self, row, cells, is_surf):
        counts, _, accuracies, score, matches, precision, d, d_back = cells
        more = SURF_SHARE if is_surf else 0.0
        self.assertEqual("%s/%s" % (row["features_a"], row["features_b"]), counts)
        for t, expected in zip((1, 3, 5), accuracies.split("/")):
            self.assertAlmostEqual(float(row["mma_%dpx" % t]), float(expected), delta=HALF_A_DIGIT + more)
        self.assertAlmostEqual(float(row["matching_score_3px"]), float(score), delta=HALF_A_DIGIT + more)
        self.assertAlmostEqual(int(row["ratio_matches"]), int(matches), delta=SURF_MATCHES * int(matches) if is_surf else 0)
        self.assertAlmostEqual(float(row["precision_3px"]), float(precision), delta=HALF_A_DIGIT + more)
        self.assertAlmostEqual(float(row["d"]), float(d), delta=HALF_A_DIGIT_OF_D + more)
        self.assertAlmostEqual(2 * float(row["d_symmetric"]) - float(row["d"]), float(d_back),
                               delta=HALF_A_DIGIT_OF_D + more)

    def falls_with_the_light(self, found):
        """Each picture is darker than the one before; so are all numbers, which are defined."""
        for detector in detectors():
            rows = [found[detector, "1-%d" % other] for other in range(2, 7)]
            for column in ("mma_3px", "matching_score_3px", "recall_3px", "average_precision_3px"):
                values = [float(row[column]) for row in rows]
                self.assertFalse(any(math.isnan(value) for value in values), (detector, column))
                self.assertGreater(values[0], values[-1], (detector, column))


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "tools_evaluate_pair", EvaluatePair, sysargs=sys.argv)
