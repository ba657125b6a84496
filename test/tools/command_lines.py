#!/usr/bin/env python3
"""What the tools' command lines take, refuse and explain."""
import collections
import pathlib
import re
import shlex
import shutil
import struct
import sys
import tempfile
import unittest

import rosunit

from evaluate_pair import detectors
from timelapse import WORLD, run

ROOT = pathlib.Path(__file__).resolve().parents[2]
# A word of each group of options, and what its row says of it.
CAMERA = {"--size": "(default 640x480)", "--fov": "0.1 … 175 deg, default 90", "--calibration": "camera_info_manager",
          "--supersampling": "1 … 4, default 2",
          "--final-gather": "0 … 16, default 0", "--rasterizer": "osmesa|egl|builtin"}
WORLDS = {"--world": "default race_track", "--model-path": "may be repeated", "--missing": "stop|warn"}
BOUNCED = {"--bounced": "off|on", "--cache": "SUNLIT_CACHE_DIR"}
LAMPS = {"--lamps": "default auto", "--lamps-dusk": "0 … 100000 lx, default 30", "--lamps-off": "may be repeated",
         "--lamps-colour": "0 … 1000000 lx, default 50"}
WEATHER = {"--cover": "0 … 8 oktas, default 0", "--optical-depth": "0.1 … 200, default auto", "--overcast": "layer|cie",
           "--visibility": "50 … 100000 m, default clear", "--fog-top": "10 … 3000 m, default 300",
           "--rain": "0 … 200 mm/h, default 0",
           "--cloud-base": "100 … 12000 m, default 1500", "--wind": "0 … 100 m/s, default 0",
           "--wind-from": "-360 … 360 deg, default 270", "--cloud-seed": "0 … 2147483647, default 0",
           "--wet": "0 … 1, default 0", "--puddles": "0 … 0.9, default 0", "--snow": "0 … 0.5 m, default 0",
           "--ground-seed": "0 … 2147483647, default 0"}
PLACE = {**WEATHER, "--site": "latitude (geodetic, positive north, -90 … 90 deg)", "--date": "default 2024-07-01",
         "--timezone": "-18 … 18 h, default 3", "--turbidity": "1 … 10, default 2", "--ozone": "0 … 600 DU, default 300",
         "--ground-albedo": "0 … 1, default auto"}
SENSOR = {"--ev": "-16 … 24 EV, default auto", "--compensation": "-8 … 8 EV, default 0", "--noise": "0 … 2147483647",
          "--vignetting": "none|cos4", "--falloff": "a3 (-10 … 10) (default 0,0,0)", "--glare": "0 … 0.2, default 0",
          "--glare-wings": "0 … 1, default 0.5", "--hood": "0 … 90 deg, default 60", "--blur": "0 … 10 px, default 0",
          "--mosaic": "none|rggb|bggr|grbg|gbrg", "--demosaic": "bilinear|vng|edge_aware"}
SHUTTER = {"--line-delay": "0 … 1000 us, default 0", "--exposure-time": "0 … 1000 ms, default 0", "--exposures": "2 … 64, default 16"}
VIEW = {**SENSOR, **SHUTTER, "--speed": "-1000 … 1000 m/s, default 0", "--turning": "-3600 … 3600 deg/s, default 0", "--pose": "(default 0,0,1,0,0)", "--look-at": "towards a point", "--path-pose": "≥ 0",
        "--path": "CSV or TUM", "--height": "-1000 … 1000 m, default 1", "--top-down": "> 0 … 200000 m"}
# By detector, behind its name.
SIFT = {"n-features": "0 … 1000000, default 0", "n-octave-layers": "1 … 10, default 3",
        "contrast-threshold": "0 … 1, default 0.04", "edge-threshold": "0.001 … 1000000, default 10",
        "sigma": "0.1 … 10 px, default 1.6"}
DETECTORS = {
    "sift": SIFT, "rootsift": SIFT,
    "surf": {"hessian-threshold": "default 100", "n-octaves": "default 4", "n-octave-layers": "default 3",
             "extended": "default false", "upright": "default false"},
    "orb": {"n-features": "default 500", "scale-factor": "default 1.2", "n-levels": "default 8", "edge-threshold": "default 31",
            "first-level": "default 0", "wta-k": "2 … 4, default 2", "patch-size": "default 31", "fast-threshold": "default 20"},
    "brisk": {"threshold": "default 30", "n-octaves": "default 3", "pattern-scale": "default 1"},
    "akaze": {"descriptor-type": "default mldb", "descriptor-size": "default 0", "descriptor-channels": "default 3",
              "threshold": "default 0.001", "n-octaves": "default 4", "n-octave-layers": "default 4",
              "diffusivity": "default pm_g2"},
    "onnx": {"model": "file of the network", "threshold": "0 … 1, default 0.015", "nms-radius": "0 … 100 px, default 4",
             "border": "0 … 1000 px, default 4", "max-features": "0 … 1000000, default 0"},
    "kaze": {"extended": "default false", "upright": "default false", "threshold": "default 0.001", "n-octaves": "default 4",
             "n-octave-layers": "default 4", "diffusivity": "default pm_g2"}}
PREPROCESSING = {"--clahe-clip-limit": "1 … 256, default 2", "--clahe-tiles": "1 … 64, default 8",
                 "--gamma-exponent": "0.1 … 10, default 0.5",
                 "--illumination-invariant-peak-red": "560 … 780 nm, default 611.4",
                 "--illumination-invariant-peak-green": "500 … 560 nm, default 549.1",
                 "--illumination-invariant-peak-blue": "380 … 500 nm, default 464.2"}
OPTIONS = {
    "snapshot": {**CAMERA, **WORLDS, **BOUNCED, **LAMPS, **PLACE, **VIEW, "--out": "FILE.png", "--depth": "portable float map",
                 "--sun": "(default 180,40)", "--time": "minute (of the hour, 0 … 59 min)"},
    "timelapse": {**CAMERA, **WORLDS, **BOUNCED, **LAMPS, **PLACE, **VIEW, "--out": "FOLDER", "--caption": "none|hour|full",
                  "--video": "H.264", "--fps": "1 … 120 Hz, default 25", "--contact-sheet": "16384 px",
                  "--columns": "1 … 100, default 6", "--thumbnail": "16 … 8192 px, default 320",
                  "--from": "-24 … 48 h, default 0", "--to": "-24 … 72 h, default 24",
                  "--step": "0.001 … 1440 min, default 30", "--frames": "1 … 100000"},
    "compare_light": {**CAMERA, **WORLDS, **BOUNCED, **LAMPS, **WEATHER, "--out": "table.csv", "--path": "CSV or TUM",
                      "--views": "1 … 1000, default 10", "--height": "-1000 … 1000 m, default 1",
                      "--view": "may be repeated", "--sun": "elevation (-90 … 90 deg)", "--moon": "0 … 180 deg",
                      "--every": "1 … 64 px, default 8", "--samples": "2 … 65536, default 256",
                      "--bounces": "0 … 64, default 16"},
    "export_dataset": {**CAMERA, **WORLDS, **BOUNCED, **LAMPS, **PLACE, **SENSOR, **SHUTTER, "--speed": "0 … 1000 m/s, default auto",
                       "--format": "tum (TUM RGB-D), euroc",
                       "--hours": "0 … < 24 h, default 12", "--rate": "0.001 … 1000 Hz, default 10",
                       "--depth-scale": "0.1 … 1000000 1/m, default 5000", "--baseline": "0 … 100 m, default 0", "--path": "CSV or TUM",
                       "--spacing": "0.001 … 1000 m, default 1", "--height": "-1000 … 1000 m, default 1",
                       "--first": "0 … 1000000000, default 0", "--count": "0: to the end",
                       "--stride": "1 … 1000000000, default 1"},
    "export_world": {**WORLDS, "--out": "FILE.glb", "--lamps-colour": "default 50", "--texel": "0.001 … 10 m", "--path": "CSV or TUM"},
    "evaluate_trajectory": {"--truth": "timestamp tx ty tz qx qy qz qw", "--estimate": "of the same body",
                            "--out": "trajectory.csv", "--align": "none|se3|sim3|yaw",
                            "--max-difference": "0 … 1000000 s, default 0.01", "--delta": "default 1m,10m,1frame",
                            "--map": "map.png", "--repeated-stamps": "refuse|first", "--pairs-from": "estimate|truth",
                            "--truth-of": "link|optical the body", "--estimate-of": "link|optical the body"},
    "evaluate_places": {"--out": "places.csv", "--map": "in the order of their names", "--query": "found in the map",
                        "--tolerance": "0 … 1000000000 frames, default 5",
                        "--features-cache-limit": "0 … 1000000 GB, default 2",
                        "--method": "one or more of sad, seqslam, vlad:sift, "},
    "evaluate_bags": {"--out": "folder for the results", "--features-cache-limit": "default 2", "--config": "list_parameters prints all",
                      "--namespace": "(default /)", "--merge": "may be repeated",
                      "--map": "noon.bag:h12; may be repeated", "--query": "all but those of the map",
                      "--odometry": "by its own images and depth alone",
                      "--detectors": "default sift,orb", "--map-every": "0 … 1000000 m, default 5",
                      "--retrieval": "truth|vlad|all", "--retrieved": "default 5", "--ratio": "default 0.8",
                      "--inclusive": "default false", "--reprojection": "> 0 … 1000 px, default 4",
                      "--iterations": "default 10000", "--confidence": "default 0.9999",
                      "--min-inliers": "4 … 1000000, default 12", "--seed": "default 1",
                      "--images": "such a bag", "--camera-info": "beside --images",
                      "--depth": "instead of camera/depth/image_raw", "--poses": "TransformStamped",
                      "--poses-of": "link|optical the body", "--stamp-tolerance": "0 … 10 s, default 0"},
}
OPTIONS["evaluate_pair"] = {
    "--out": "verified.csv", "--homography": "three lines of three numbers", "--detectors": "default " + ",".join(detectors()),
    "--ratio": "> 0 … 1, default 0.5", "--inclusive": "default false", "--features-cache-limit": "default 2", **PREPROCESSING,
    **{"--%s-%s" % (name, option): part for name, options in DETECTORS.items() if name != "surf" or name in detectors()
       for option, part in options.items()}}
OPTIONS["atlas"] = {
    **CAMERA, **WORLDS, **BOUNCED, **LAMPS, **PLACE, **SENSOR, "--out": "goes on there with the same options", "--path": "CSV or TUM",
    **{option: OPTIONS["export_dataset"][option] for option in ("--spacing", "--height", "--first", "--count", "--stride")},
    "--from": "0 … < 24 h, default 0", "--to": "> 0 … 24 h, default 24", "--step": "30min, 2h, 90s, or minutes (default 30min)",
    "--hours": "0 … < 24 h", "--dates": "each with all these times", "--detectors": "default sift,orb",
    "--ratio": "> 0 … 1, default 0.5", "--inclusive": "default false", "--map-every": "0 … 1000000 m, default 5",
    "--query-offset": "-1000 … 1000 m, default 0",
    **{option: OPTIONS["evaluate_bags"][option] for option in ("--retrieval", "--retrieved", "--reprojection", "--iterations",
                                                               "--confidence", "--min-inliers", "--seed")},
    "--localise-ratio": "> 0 … 1, default 0.8", "--localise-inclusive": "default false", "--estimate": "and ends",
    "--stage": "observe|compare", "--shard": "I from 1", "--merge": "puts together", "--unit-poses": "default 0",
    "--unit-conditions": "0: all", "--slurm": "FOLDER/slurm", "--slurm-tasks": "1 … 100000, default 32",
    "--slurm-option": "may be repeated", "--submit": "default true", "--pictures": "default true",
    **{option: part for option, part in OPTIONS["evaluate_pair"].items()
       if option in PREPROCESSING or any(option.startswith("--%s-" % name) for name in DETECTORS)}}
TAKES_WORDS = {"evaluate_bags", "evaluate_pair", "export_dataset"}
NEEDED = {program: "--out" for program in OPTIONS}  # the option that is missed first
NEEDED["export_dataset"] = "--format"
# Of all tools that have the option: a value, and what is said of it.
REFUSED = (("--size", "10x480", '--size is "10x480": width is 10, but must be from 16 to 8192 px'),
           ("--size", "640x480.5", "height is 480.5, but must be a whole number from 16 to 8192 px"),
           ("--size", "640", "must be 2 numbers separated by 'x': WxH"),
           ("--size", "640x480x", "must be 2 numbers separated by 'x': WxH"),
           ("--fov", "176", "--fov is 176, but must be from 0.1 to 175 deg"),
           ("--fov", "-4", "--fov is -4, but must be from 0.1 to 175 deg"),
           ("--fov", "nan", '--fov is "nan", but must be a number from 0.1 to 175 deg'),
           ("--supersampling", "5", "--supersampling is 5, but must be from 1 to 4"),
           ("--supersampling", "1.5", "a whole number from 1 to 4"),
           ("--rasterizer", "gpu", "must be one of osmesa, egl, builtin"),
           ("--bounced", "maybe", "must be one of off, on"), ("--missing", "skip", "must be one of stop, warn"),
           ("--lamps", "bright", "must be one of auto, on, off"),
           ("--lamps-dusk", "-1", "--lamps-dusk is -1, but must be from 0 to 100000 lx"),
           ("--pose", "1,2", "must be 3 to 5 numbers separated by ',': X,Y,Z[,YAW[,PITCH]]"),
           ("--pose", "2e18,0,1", "x is 2e+18, but must be from -10000000 to 10000000 m"),
           ("--pose", "0,0,1,0,135", "pitch is 135, but must be from -90 to 90 deg"),
           ("--pose", "1,,3", 'y is "", but must be a number from -10000000 to 10000000 m'),
           ("--view", "1,2,3,4,5,6", "must be 3 to 5 numbers"),
           ("--top-down", "0,0,0", "extent is 0, but must be above 0 and up to 200000 m"),
           ("--sun", "285,-91", '--sun is "285,-91": elevation is -91, but must be from -90 to 90 deg'),
           ("--moon", "0,0,181", "phase is 181, but must be from 0 to 180 deg"),
           ("--time", "24:00", "hour is 24, but must be from 0 to 23 h"),
           ("--time", "04:30:60", "second is 60, but must be from 0 to less than 60 s"),
           ("--date", "24-07-01", "must be year-month-day with a year of four digits"),
           ("--date", "2024-13-01", "month is 13, but must be from 1 to 12"),
           ("--site", "0,181", "longitude is 181, but must be from -180 to 180 deg"),
           ("--turbidity", "0", "--turbidity is 0, but must be from 1 to 10"),
           ("--ev", "dark", 'must be "auto" or a number from -16 to 24 EV'),
           ("--noise", "-1", "--noise is -1, but must be from 0 to 2147483647"),
           ("--glare", "0.3", "--glare is 0.3, but must be from 0 to 0.2"),
           ("--mosaic", "rgbg", '--mosaic is "rgbg", but must be one of none, rggb, bggr, grbg, gbrg'),
           ("--views", "0", "must be from 1 to 1000"), ("--every", "65", "must be from 1 to 64 px"),
           ("--ratio", "1.1", "--ratio is 1.1, but must be"),
           ("--inclusive", "perhaps", '--inclusive is "perhaps", but must be true or false'),
           ("--orb-wta-k", "5", "--orb-wta-k is 5, but must be from 2 to 4"),
           ("--tolerance", "-1", "--tolerance is -1, but must be from 0 to 1000000000 frames"),
           ("--method", "vlad", '--method is "vlad", but must be one of sad, seqslam, vlad:sift, '),
           ("--method", "vlad:sift+", '--method is "vlad:sift+", but must be one of'),
           ("--method", "sad,,seqslam", '--method is "", but must be one of'),
           ("--method", "sad,sad", "--method names sad twice"),
           ("--map-every", "-1", "--map-every is -1, but must be from 0 to 1000000 m"),
           ("--retrieval", "best", "must be one of truth, vlad, all"), ("--min-inliers", "3", "must be from 4 to 1000000"),
           ("--height", "-1001", "must be from -1000 to 1000 m"),
           ("--columns", "0", "must be from 1 to 100"), ("--fps", "121", "must be from 1 to 120 Hz"),
           ("--world", "", "--world needs a value"), ("--world", "--model-path", "--world needs a value"))


class CommandLines(unittest.TestCase):

    def refused(self, program, *arguments):
        """The one line that the tool gives up with."""
        done = run(program, *arguments)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1), (arguments, done.stderr))
        self.assertTrue(done.stderr.startswith(program + ": "), done.stderr)
        return done.stderr

    def test_help_tells_every_option_with_its_range_and_default(self):
        for program, options in OPTIONS.items():
            done = run(program, "--help")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(run(program, "-h").stdout, done.stdout)
            lines = done.stdout.splitlines()
            self.assertRegex(lines[0], "^%s: .* Needs no ROS master.$" % program)
            self.assertRegex(lines[2], "^usage: %s %s .* \\[options\\]$" % (program, NEEDED[program]))
            told = {}
            for line in lines[3:]:
                option = re.match("  (--[a-z-]+) ", line)
                if option:
                    name = option.group(1)
                    self.assertNotIn(name, told)
                    told[name] = ""
                if told and line.startswith("  "):
                    told[name] += " " + " ".join(line.split())
            self.assertEqual(set(told), set(options), program)
            for name, part in options.items():
                self.assertIn(part, told[name])

    def test_count_poses_explains_itself(self):
        done = run("count_poses", "--help")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for part in ("usage: count_poses WORLD WAYPOINT_FILE SPACING_M POSES", "0.001 … 1000 m, default 1"):
            self.assertIn(part, done.stdout)
        self.assertEqual(run("count_poses", "race_track").returncode, 2)
        done = run("count_poses", "race_track", "", "1", "-1")
        self.assertEqual((done.returncode, done.stderr),
                         (1, "sunlit: argument poses is -1, but must be from 0 to 1000000000\n"))
        for path in ("", "nowhere.csv"):  # the world comes first
            self.assertIn("sunlit: there is no world nowhere.world; it was looked for as ",
                          run("count_poses", "nowhere.world", path, "1", "0").stderr)
        with tempfile.TemporaryDirectory() as folder:  # with models, as the renderer's model_path
            pathlib.Path(folder, "place").mkdir()
            pathlib.Path(folder, "place", "my.world").touch()
            pathlib.Path(folder, "path.csv").write_text("0,0\n3,0\n", encoding="utf-8")
            words = ("count_poses", "model://place/my.world", folder + "/path.csv", "1", "0")
            self.assertIn("there is no world model://place/my.world", run(*words).stderr)
            done = run(*words, "/nowhere", folder)
            self.assertEqual((done.returncode, done.stdout), (0, "3\n"), done.stderr)

    def test_what_is_out_of_range_is_refused(self):
        # Tools share their options' rows: one of those that have an option is asked, each tool in its turn, since to start one takes
        # longer than what it says.
        asked, able = collections.Counter(), set()
        for option, value, said in REFUSED:
            programs = [program for program, options in OPTIONS.items() if option in options]
            self.assertTrue(programs, option)
            able.update(programs)
            program = min(programs, key=lambda one: asked[one])
            asked[program] += 1
            self.assertIn(said, self.refused(program, option, value))
        self.assertEqual(set(asked), able)

    def test_weather_that_only_tells_more_of_another_needs_it(self):
        sky = ("--cover above 0 and below 8, or --rain above 0,", ["--cover=4", "--rain=3"], ["--cover=8", "--cover=0", "--rain=0"])
        ground = ("--puddles or --snow above 0", ["--puddles=0.1", "--snow=0.1"], ["--puddles=0", "--wet=1"])
        for option, (needs, enough, too_little) in (
                ("--optical-depth=20", ("--cover above 0", ["--cover=4"], ["--cover=0"])),
                ("--overcast=layer", ("--cover 8", ["--cover=8"], ["--cover=7"])), ("--overcast=cie", ("--cover 8", ["--cover=8"], [])),
                ("--fog-top=50", ("--visibility in m", ["--visibility=900"], ["--visibility=clear"])),
                ("--cloud-base=900", sky), ("--wind=3", sky), ("--cloud-seed=2", sky), ("--ground-seed=2", ground)):
            needed = "%s needs %s too" % (option.split("=")[0], needs)
            for other in ([], *([one] for one in too_little)):
                self.assertIn(needed, self.refused("snapshot", option, *other))
            for other in enough:  # and then something else is missed
                self.assertNotIn(needed, self.refused("snapshot", option, other))
        for program in [program for program, options in OPTIONS.items() if "--fog-top" in options]:
            self.assertIn("--fog-top needs --visibility in m too", self.refused(program, "--fog-top", "50"))
        self.assertIn("--wind-from needs --wind above 0 too", self.refused("snapshot", "--rain", "3", "--wind", "0", "--wind-from", "90"))

    def test_some_of_the_pixels_are_compared(self):
        self.assertIn("--every is 64, but must be from 1 to 31 px",
                      self.refused("compare_light", "--out", "nowhere", "--size", "640x16", "--every", "64"))

    def test_a_calibration_goes_with_nothing_that_it_contradicts(self):
        file = str(ROOT / "test/support/cameras/euroc.yaml")
        with tempfile.TemporaryDirectory() as folder:
            out = str(pathlib.Path(folder) / "picture.png")
            for program, options in (("snapshot", ["--out", out]), ("timelapse", ["--out", folder]),
                                     ("compare_light", ["--out", folder])):
                said = self.refused(program, *options, "--calibration", file, "--size", "640x480")
                self.assertIn("--size (width) is 640, but must be 752 px as in " + file, said)
                said = self.refused(program, *options, "--calibration", file, "--fov", "60")
                self.assertIn("--fov is 60, but must be 93.1", said)
                self.assertIn("/nowhere.yaml: cannot be opened", self.refused(program, *options, "--calibration", "/nowhere.yaml"))
            self.assertIn("--top-down has a camera of its own; leave out --calibration",
                          self.refused("snapshot", "--out", out, "--calibration", file, "--top-down", "0,0,10"))
            self.assertIn("--calibration is of a lens with distortion (plumb_bob), but data sets are of cameras without",
                          self.refused("export_dataset", "--format", "tum", folder + "/set", "--calibration", file))
            self.assertIn("but queries are localised with cameras without",
                          self.refused("atlas", "--out", folder + "/atlas", "--calibration", file))
            done = run("snapshot", "--world", WORLD, "--bounced", "off", "--calibration", file, "--out", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(out, "rb") as picture:
                self.assertEqual(struct.unpack(">II", picture.read(24)[16:]), (752, 480))

    def test_an_option_is_spelt_in_full(self):
        for program in OPTIONS:
            option = NEEDED[program]
            for arguments, said in (([option[:-1], "x"], "there is no option %s;" % option[:-1]),
                                    (["--last=3"], "no option --last=3;"), (["-4"], "no option -4;"),
                                    ([option], option + " needs a value"), ([option + "="], option + " needs a value"),
                                    ([option, "--help"], option + " needs a value"),
                                    (["--help=3"], "--help takes no value"), ([], option + " ")):
                self.assertIn(said, self.refused(program, *arguments))
            said = self.refused(program, "stray")
            self.assertRegex(said, option + " [A-Z]* is missing" if program in TAKES_WORDS else "no option stray;", said)

    def test_what_takes_time_and_what_moves_need_each_other(self):
        with tempfile.TemporaryDirectory() as folder:
            out = folder + "/picture.png"
            for arguments, said in ((["--line-delay", "30"], "give --speed or --turning"),
                                    (["--exposure-time", "auto", "--compensation", "1"], "give --speed or --turning"),
                                    (["--rain", "5", "--line-delay", "30", "--exposure-time", "1"], "give --speed or --turning"),
                                    (["--turning", "20"], "give --line-delay or --exposure-time"),
                                    (["--turning", "20", "--line-delay", "0", "--rain", "0"], "give --line-delay or --exposure-time"),
                                    (["--exposures", "4", "--line-delay", "30", "--speed", "1"], "--exposure-time")):
                self.assertIn(said, self.refused("snapshot", "--out", out, *arguments))
            for nothing in ([], ["--rain", "0"], ["--exposure-time", "0"]):
                self.assertIn("--speed shows in pictures that take time",
                              self.refused("export_dataset", "--format", "tum", folder + "/set", "--speed", "5", *nothing))
            pictures = []
            for arguments in ([], ["--speed", "10", "--turning", "40", "--line-delay", "200"], ["--turning", "-40", "--exposure-time", "40"],
                              ["--rain", "100", "--exposure-time", "1"], ["--rain", "100", "--exposure-time", "30"],
                              ["--rain", "100"], ["--rain", "100", "--speed", "10"]):
                done = run("snapshot", "--out", out, "--world", WORLD, "--bounced", "off", "--pose", "0,0,1", "--size", "64x48", *arguments)
                self.assertEqual(done.returncode, 0, done.stderr)
                with open(out, "rb") as picture:
                    pictures.append(picture.read())
            self.assertEqual(len(set(pictures)), len(pictures))

    def test_negative_numbers_are_values(self):
        with tempfile.TemporaryDirectory() as folder:
            pictures = []
            for number, sun in enumerate((["--sun", "285,-4"], ["--sun=285,-4"], ["--sun", "1,2", "--sun", "285,-4"])):
                pictures.append(pathlib.Path(folder, "%d with a space.png" % number))
                done = run("snapshot", "--world", WORLD, "--bounced", "off", "--size", "32x24", "--pose", "-1,0,1,-10", *sun,
                           "--compensation", "-1", "--out", str(pictures[-1]))
                self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(len({picture.read_bytes() for picture in pictures}), 1)

    def test_a_picture_of_nothing_says_where_the_world_is_and_how_large(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run("snapshot", "--world", WORLD, "--bounced", "off", "--size", "32x24", "--pose", "5000,0,1",
                       "--sun", "285,40", "--out", str(pathlib.Path(folder, "nothing.png")))
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stdout, r"nothing.png: \d+ triangles in 400 x 400 x [0-9.]+ m, EV100")
        self.assertIn("warning: nothing of the world is in view, which reaches from ", done.stderr)
        with tempfile.TemporaryDirectory() as folder:
            done = run("snapshot", "--world", WORLD, "--bounced", "off", "--size", "32x24", "--pose", "0,0,-3", "--sun", "285,40",
                       "--out", str(pathlib.Path(folder, "under.png")))
        self.assertRegex(done.stderr, "^warning: nothing of the world, .* but something is above: it is under the ground, .*\n$")

    def test_pictures_of_nothing_are_told_of_and_counted(self):
        camera = ["--world", WORLD, "--bounced", "off", "--size", "160x120", "--supersampling", "1"]
        nothing = "nothing of the world is in view, which reaches from "
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "away.csv")
            path.write_text("0,-2\n900,-2\n", encoding="utf-8")
            drive = ["--path", str(path), "--spacing", "400", *camera]
            done = run("timelapse", "--out", folder + "/day", *camera, "--pose", "5000,0,1", "--from", "12", "--frames", "1")
            self.assertRegex(done.stderr, "^warning: " + nothing + ".*\n$")
            done = run("export_dataset", "--format", "tum", folder + "/set", "--hours", "12", *drive)
            self.assertEqual(done.returncode, 0)
            self.assertRegex(done.stderr, f"^warning: from pose 1 {nothing}.*\nwarning: 2 poses see nothing of the world, "
                                          "from number 1 to 2\n$")
            done = run("atlas", "--out", folder + "/atlas", "--hours", "12", "--detectors", "orb", *drive)
            self.assertEqual(done.returncode, 0)
            for told in (f"warning: from pose 1 {nothing}", "warning: 2 poses see nothing of the world, from number 1 to 2\n"):
                self.assertEqual(done.stderr.count(told), 1, done.stderr)

    def test_hours_of_a_time_zone_that_nobody_gave_are_told_of_where_noon_is_elsewhere(self):
        told = "warning: hours are of UTC+3; the sun is highest there at about 20:00: --timezone gives another zone\n"
        with tempfile.TemporaryDirectory() as folder:
            clock = ["--world", WORLD, "--bounced", "off", "--size", "32x24", "--pose", "-1,0,1,-10"]
            beside = {"snapshot": ["--out", folder + "/it.png", *clock, "--time", "12:00"],
                      "timelapse": ["--out", folder + "/day", *clock, "--from", "12", "--frames", "1"]}
            for program, arguments in beside.items():
                for place, said in ((["--site", "40.7,-74"], told), (["--site", "40.7,-74", "--timezone", "3"], ""),
                                    (["--site", "90,0"], ""), ([], "")):
                    done = run(program, *arguments, *place)
                    self.assertEqual((done.returncode, done.stderr), (0, said))
                    shutil.rmtree(folder + "/day", ignore_errors=True)

    def test_tools_take_the_options_of_the_readme(self):
        examples = re.findall("^rosrun sunlit ((?:%s) .*)$" % "|".join(OPTIONS), (ROOT / "README.md").read_text(),
                              re.MULTILINE)
        self.assertEqual({example.split()[0] for example in examples}, set(OPTIONS))
        for example in examples:
            words = shlex.split(example, comments=True)
            with self.subTest(example):  # options are taken in their order
                self.assertIn("there is no option --behind-all", self.refused(*words, "--behind-all"))


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "tools_command_lines", CommandLines, sysargs=sys.argv)
