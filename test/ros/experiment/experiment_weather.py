#!/usr/bin/python3
"""An experiment whose conditions differ in weather, from the arguments over both renderers to the results."""
import csv
import os
import sys
import tempfile
import unittest

import cv2
import rosunit
from launching import kill_leftovers, small_experiment

CONDITIONS = "{noon: {hour: 12}, fog: {hour: 12, visibility: 150}}"
POSES = 3


def table(folder, name):
    with open(os.path.join(folder, name), newline="") as file:
        return list(csv.DictReader(file))


def colour(picture):
    """From the least to the most of red, green and blue, in the mean."""
    return float((picture.max(axis=2).astype(int) - picture.min(axis=2)).mean())


class ExperimentWeather(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.output = folder.name
        # Hours as the launch file has them, which conditions stand for.
        run = small_experiment(cls.output, conditions=CONDITIONS, hours="[4, 12, 20]", poses=POSES, images="true", self_test_every=1,
                               exposure="fixed", ev100=14)
        status = run.end()  # not 0 where a self-test of a direct difference is not exactly 0: fog is the same in both renderers
        assert status == 0, run.said()

    @classmethod
    def tearDownClass(cls):
        kill_leftovers()

    def test_each_has_its_light_and_its_weather_in_the_results(self):
        rows = table(self.output, "captures.csv")
        noon, fog = ([row for row in rows if row["stream"] == name] for name in ("noon", "fog"))
        self.assertEqual((len(noon), len(fog)), (POSES, POSES))
        noon, fog = noon[0], fog[0]
        self.assertEqual(noon["sun_elevation_deg"], fog["sun_elevation_deg"])
        # 300 m of fog of 150 m visibility are an optical depth of 6: two fifths and more come through, but not all.
        self.assertLess(float(fog["scene_illuminance"]), 0.9 * float(noon["scene_illuminance"]))
        self.assertGreater(float(fog["scene_illuminance"]), 0.3 * float(noon["scene_illuminance"]))

    def test_the_pictures_differ_and_say_so_in_numbers(self):
        means = {(row["a"], row["b"], row["difference"]): float(row["mean"]) for row in table(self.output, "summary.csv")}
        self.assertGreater(means["noon", "fog", "euclidean_grey"], 0.02)
        for name in ("noon", "fog"):
            self.assertEqual(means[name, "self_test/" + name, "euclidean_grey"], 0.0)
        for pose in range(POSES):
            noon, fog = (cv2.imread(os.path.join(self.output, "images", name, "%06d.png" % pose)) for name in ("noon", "fog"))
            # Fog takes colour from what is seen through it, and has none itself, as the blue sky has.
            self.assertLess(colour(fog), 0.6 * colour(noon))

    def test_what_was_asked_for_is_written_down(self):
        with open(os.path.join(self.output, "run.yaml")) as file:
            self.assertIn(CONDITIONS, file.read())


if __name__ == "__main__":
    # Its launch has a master of its own.
    rosunit.unitrun("sunlit", "experiment_weather", ExperimentWeather, sysargs=sys.argv)
