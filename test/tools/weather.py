#!/usr/bin/env python3
"""Weather by every tool that takes pictures: it reaches them, and clouds drift from frame to frame."""
import csv
import pathlib
import sys
import tempfile
import unittest

import cv2
import rosunit
from timelapse import VIEW, WORLD, run

GREY = ["--cover", "8", "--overcast", "cie"]
EXPOSED = ["--ev", "14"]
CAMERA = ["--world", WORLD, "--size", "160x120", "--bounced", "off", "--supersampling", "1"]
# Fixed exposures here, so that the standard overcast sky, a fifth of the clear hour's light, is darker.
DARKER = 0.8


class Weather(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.path = str(self.folder / "path.csv")
        pathlib.Path(self.path).write_text("0,-2\n4,-2.5\n", encoding="utf-8")

    def files(self, program, *arguments, out="--out"):
        """What the tool leaves, by name, in clear and in grey weather."""
        found = []
        for name, weather in (("clear", []), ("grey", GREY)):
            folder = self.folder / program / name
            folder.mkdir(parents=True)
            where = str(folder / "it") + (".png" if program == "snapshot" else "")
            done = run(program, *([out] if out else []), where, *arguments, *weather)
            self.assertEqual(done.returncode, 0, done.stderr)
            found.append({str(file.relative_to(folder)): file for file in sorted(folder.rglob("*")) if file.is_file()})
        self.assertEqual(list(found[0]), list(found[1]))
        return found

    def assert_darker(self, clear, grey, pattern, count):
        """So many pictures."""
        names = [name for name in clear if pathlib.PurePath(name).match(pattern)]
        self.assertEqual(len(names), count, sorted(clear))
        for name in names:
            bright, dark = (cv2.imread(str(files[name])).mean() for files in (clear, grey))
            self.assertLess(dark, DARKER * bright, name)

    def test_snapshot(self):
        clear, grey = self.files("snapshot", *VIEW, *EXPOSED)
        self.assert_darker(clear, grey, "*.png", 1)

    def test_eclipses_are_told_of(self):
        dallas = ["--site", "32.78,-96.8", "--date", "2024-04-08", "--timezone", "-5"]
        for time, told in (("12:00", None), ("13:22", "sun 71."), ("13:42", "sun 100.0 % covered")):
            done = run("snapshot", "--out", str(self.folder / "it.png"), *CAMERA, *dallas, "--time", time)
            self.assertEqual(done.returncode, 0, done.stderr)
            (self.assertIn if told else self.assertNotIn)(told or "covered", done.stdout)
        moon = ["--site", "32.78,-96.8", "--date", "2025-03-14", "--timezone", "0", "--time", "06:59"]
        done = run("snapshot", "--out", str(self.folder / "it.png"), *CAMERA, *moon)
        self.assertIn("moon dimmed by 100.0 %", done.stdout)

    def test_weather_that_cannot_be_is_refused_before_anything_is_made(self):
        for program, out, of_its_own in (("snapshot", "it.png", []), ("timelapse", "it", ["--frames", "2"])):
            for weather, told in ((["--visibility", "90000"], "visibility is 90000 m, but must be less than the "),
                                  (["--cover", "4", "--overcast", "cie"], "cover is 4, but must be 8 where overcast is cie")):
                done = run(program, "--out", str(self.folder / out), *VIEW, *of_its_own, *weather)
                self.assertEqual((done.returncode, done.stdout), (1, ""), done.stderr)
                self.assertIn(told, done.stderr)

    def test_timelapse(self):
        clear, grey = self.files("timelapse", *VIEW, *EXPOSED, "--from", "11", "--to", "12", "--frames", "2")
        self.assert_darker(clear, grey, "frame_*.png", 2)

    def test_broken_clouds_drift_through_a_timelapse_and_stand_without_wind(self):
        # Ten seconds a frame: the sun turns by less than a thirtieth of a degree, and clouds go 1000 m.
        def frames(*wind):
            out = self.folder / ("timelapse" + "".join(wind))
            done = run("timelapse", "--out", str(out), *VIEW, *EXPOSED, "--from", "12", "--to", str(12 + 50 / 3600), "--frames", "5",
                       "--cover", "4", "--cloud-seed", "3", *wind)
            self.assertEqual(done.returncode, 0, done.stderr)
            return [cv2.imread(str(file)).astype(float) for file in sorted(out.glob("frame_*.png"))]
        moving, standing = frames("--wind", "100"), frames()
        steps = [[abs(a - b).mean() for a, b in zip(one, one[1:])] for one in (moving, standing)]
        self.assertEqual([len(of_run) for of_run in steps], [4, 4])
        print("weather: frames differ by", steps)
        self.assertGreater(min(steps[0]), 10.0 * max(steps[1]) + 0.5, steps)

    def test_export_dataset(self):
        clear, grey = self.files("export_dataset", "--format", "tum", *CAMERA, *EXPOSED, "--path", self.path, "--count", "2",
                                 out=None)
        self.assert_darker(clear, grey, "rgb/*.png", 2)
        # The same truth.
        for name in clear:
            if "depth" in name or name.endswith("groundtruth.txt"):
                self.assertEqual(clear[name].read_bytes(), grey[name].read_bytes(), name)

    def test_broken_clouds_drift_through_a_data_set_by_its_stamps(self):
        # Ten seconds and a millimetre from pose to pose.
        def pictures(name, *more):
            out = self.folder / name
            done = run("export_dataset", "--format", "tum", str(out), *CAMERA, *EXPOSED, "--path", self.path, "--spacing", "0.001",
                       "--rate", "0.1", "--cover", "4", "--cloud-seed", "3", *more)
            self.assertEqual(done.returncode, 0, done.stderr)
            return [cv2.imread(str(file)).astype(float) for file in sorted(out.glob("rgb/*.png"))]
        moving, standing = pictures("moving", "--wind", "100", "--count", "5"), pictures("standing", "--count", "5")
        steps = [[abs(a - b).mean() for a, b in zip(one, one[1:])] for one in (moving, standing)]
        self.assertEqual([len(of_run) for of_run in steps], [4, 4])
        self.assertGreater(min(steps[0]), 10.0 * max(steps[1]) + 0.5, steps)
        (third,) = pictures("third", "--wind", "100", "--first", "2", "--count", "1")
        self.assertEqual(abs(third - moving[2]).max(), 0)

    def test_atlas(self):
        clear, grey = self.files("atlas", *CAMERA, *EXPOSED, "--pictures", "false", "--path", self.path, "--count", "2", "--hours",
                                 "8,16", "--detectors", "orb", "--unit-poses", "2")
        lux = []
        for files in (clear, grey):
            with open(files["it/conditions.csv"], newline="", encoding="utf-8") as file:
                lux.append([float(row["illuminance_lx"]) for row in csv.DictReader(file)])
        self.assertEqual([len(of_hours) for of_hours in lux], [2, 2])
        for bright, dark in zip(*lux):
            self.assertLess(dark, 0.5 * bright)

    def test_compare_light(self):
        clear, grey = self.files("compare_light", "--world", WORLD, "--size", "160x120", "--bounced", "off", "--supersampling", "1",
                                 "--view", "0,-2,1", "--sun", "180,40", "--every", "16", "--samples", "4")
        self.assertNotEqual(*(files["it/table.csv"].read_bytes() for files in (clear, grey)))


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "tools_weather", Weather, sysargs=sys.argv)
