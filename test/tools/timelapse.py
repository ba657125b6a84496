#!/usr/bin/env python3
"""The tools, as people type them; above all timelapse."""
import csv
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest

import cv2
import rosunit

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from programs import located  # noqa: E402

WORLD = str(pathlib.Path(__file__).resolve().parents[1] / "support" / "worlds" / "two_boxes.urdf")
INTERIOR = str(pathlib.Path(WORLD).with_name("interior.gltf"))
VIEW = ["--world", WORLD, "--pose", "0,0,1", "--size", "96x64", "--fov", "60", "--bounced", "off"]
# From moonlight over dusk into day.
DAY = ["--date", "2024-12-16", "--from", "4", "--to", "12", "--frames", "4", "--caption", "hour", "--noise", "3"]


def run(program, *arguments, **more):
    return subprocess.run([located(program), *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, **more)


class Timelapse(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.first = tempfile.TemporaryDirectory()
        cls.make(os.path.join(cls.first.name, "a"))

    @classmethod
    def tearDownClass(cls):
        cls.first.cleanup()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        shutil.copytree(os.path.join(self.first.name, "a"), self.path("a"))

    def path(self, name):
        return os.path.join(self.folder, name)

    @staticmethod
    def make(out, *more):
        done = run("timelapse", "--out", out, *VIEW, *DAY, *more)
        assert done.returncode == 0, done.stderr
        return done.stdout

    def frames(self, out):
        files = sorted(pathlib.Path(self.path(out)).glob("frame_*.png"))
        self.assertEqual([file.name for file in files], ["frame_%05d.png" % i for i in range(4)])
        return [file.read_bytes() for file in files]

    def test_two_runs_give_the_same_bytes(self):
        self.make(self.path("b"))
        self.assertEqual(self.frames("a"), self.frames("b"))
        self.assertEqual(len(set(self.frames("a"))), 4)

    def test_goes_on_with_a_broken_off_run(self):
        whole = self.frames("a")
        os.remove(os.path.join(self.path("a"), "frame_00003.png"))
        with open(os.path.join(self.path("a"), "frame_00001.png"), "wb") as broken:
            broken.write(whole[1][:100])
        kept = os.path.join(self.path("a"), "frame_00002.png")
        os.utime(kept, (1, 1))
        film = self.path("film.avi")
        # What a kill left; no process has so high a number.
        killed = [os.path.join(self.path("a"), "frame_00003.png.99999999.0.part"), film + ".99999999.1.part.avi"]
        for file in killed:
            pathlib.Path(file).write_bytes(b"half")
        self.assertIn("2 frames are there already", self.make(self.path("a"), "--video", film))
        self.assertEqual([os.path.exists(file) for file in [*killed, film]], [False, False, True])
        self.assertEqual(self.frames("a"), whole)
        self.assertEqual(os.stat(kept).st_mtime, 1)
        self.assertNotIn("frame 1 of", self.make(self.path("a")))  # nothing is left to do

    def test_does_not_mix_frames_of_other_options(self):
        self.assertIn("--ev 9", self.refused("--out", self.path("a"), *VIEW, *DAY, "--ev", "9"))

    def test_takes_no_frames_of_another_sunlit(self):
        recipe = pathlib.Path(self.path("a"), "timelapse.txt")
        text = recipe.read_text(encoding="utf-8")
        ours = re.search("^sunlit [0-9.]+, pictures [0-9]+$", text, re.MULTILINE).group()
        for other, told in ((ours + "0", ours + "0"), ("#", "an older sunlit")):
            recipe.write_text(text.replace(ours, other), encoding="utf-8")
            self.assertIn("were made by %s, and %s may make others" % (told, ours), self.refused("--out", self.path("a"), *VIEW, *DAY))

    def refused(self, *arguments):
        """The one line that timelapse gives up with."""
        done = run("timelapse", *arguments)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
        return done.stderr

    def test_takes_no_frames_of_unknown_origin(self):
        os.remove(os.path.join(self.path("a"), "timelapse.txt"))
        before = sorted(os.listdir(self.path("a")))
        self.assertIn("holds frame_00000.png, but no timelapse.txt", self.refused("--out", self.path("a"), *VIEW, *DAY))
        self.assertEqual(sorted(os.listdir(self.path("a"))), before)

    def test_takes_no_frames_of_a_world_that_has_changed(self):
        world = self.path("own.urdf")
        shutil.copy(WORLD, world)
        arguments = ["--out", self.path("b"), *VIEW, *DAY, "--world", world, "--frames", "1"]
        self.assertEqual(run("timelapse", *arguments).returncode, 0)
        with open(world, "r+b") as file:  # as long as before
            text = file.read()
            file.seek(0)
            file.write(text.replace(b"1", b"2", 1))
        self.assertIn("content of the world", self.refused(*arguments))

    def test_takes_no_frames_of_a_world_whose_looks_have_changed_in_a_file_beside_it(self):
        world = self.path("own.obj")
        pathlib.Path(world).write_text("mtllib own.mtl\nv -9 -9 0\nv 9 -9 0\nv 9 9 0\nusemtl floor\nf 1 2 3\n", encoding="ascii")
        looks = pathlib.Path(self.path("own.mtl"))
        looks.write_text("newmtl floor\nKd 0.2 0.2 0.2\n", encoding="ascii")
        arguments = ["--out", self.path("b"), *VIEW, *DAY, "--world", world, "--frames"]
        self.assertEqual(run("timelapse", *arguments, "1").returncode, 0)
        frame = pathlib.Path(self.path("b"), "frame_00000.png")
        frame.unlink()
        looks.write_text("newmtl floor\nKd 0.2 0.2 0.3\n", encoding="ascii")
        self.assertIn("its pictures show another world", self.refused(*arguments, "1"))
        self.assertFalse(frame.exists())
        looks.write_text("newmtl floor\nKd 0.2 0.2 0.2\n", encoding="ascii")
        self.assertEqual(run("timelapse", *arguments, "1").returncode, 0)

    def test_a_film_that_does_not_fit_on_the_disk_leaves_the_old_one(self):
        def little_room():
            resource.setrlimit(resource.RLIMIT_FSIZE, (300, 300))

        for ending in ("mp4", "avi", "mkv"):
            film = pathlib.Path(self.path("film." + ending))
            film.write_bytes(b"old")
            done = run("timelapse", "--out", self.path("a"), *VIEW, *DAY, "--video", str(film), preexec_fn=little_room)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("%s: cannot be written: of 4 frames only " % film, done.stderr)
            self.assertEqual(film.read_bytes(), b"old")
            self.assertEqual([name for name in os.listdir(self.folder) if "part" in name], [])

    def test_a_picture_beyond_the_limit_of_files_is_an_error_with_a_name_and_leaves_nothing(self):
        picture = self.path("view.png")
        done = run("snapshot", "--out", picture, *VIEW,
                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (300, 300)))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("snapshot: %s: " % picture, done.stderr)
        self.assertIn("raise the limit (ulimit -f)", done.stderr)
        self.assertEqual([name for name in os.listdir(self.folder) if name != "a"], [])

    def test_memory_that_ends_is_told_by_what_was_made_then(self):
        def limited(megabytes):
            return lambda: resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))

        least = next(size for size in range(256, 1 << 16, 64)
                     if run("snapshot", "--help", preexec_fn=limited(size)).returncode == 0)
        for size in (least + 64, least + 256):
            done = run("snapshot", "--out", self.path("view.png"), "--size", "96x64", "--bounced", "off",
                       preexec_fn=limited(size), env={**os.environ, "SUNLIT_CACHE_DIR": self.folder})
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("snapshot: not enough memory: loading the world race_track", done.stderr)
            self.assertNotIn("bad_alloc", done.stderr)

    def test_writes_films_and_a_sheet(self):
        for ending in ("mp4", "avi", "mkv"):
            film = self.path("film." + ending)
            self.make(self.path("a"), "--video", film, "--fps", "5")
            reader = cv2.VideoCapture(film)
            count = 0
            while True:
                good, picture = reader.read()
                if not good:
                    break
                self.assertEqual(picture.shape, (64, 96, 3))
                count += 1
            self.assertEqual(count, 4, film)
        sheet = self.path("sheet.png")
        self.make(self.path("a"), "--contact-sheet", sheet, "--columns", "3", "--thumbnail", "48")
        self.assertEqual(cv2.imread(sheet).shape, (2 * 32 + 2, 3 * 48 + 4, 3))  # gaps of 2 px

    def test_films_and_sheets_may_lie_in_the_folder_that_is_yet_to_be_made(self):
        out = self.path("new")
        done = run("timelapse", "--video", out + "/film.avi", "--contact-sheet", self.path("a/../new/sheet.png"), "--out", out + "/",
                   *VIEW, *DAY, "--frames", "1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(os.listdir(out)), ["film.avi", "frame_00000.png", "sheet.png", "timelapse.txt"])
        self.assertIn("in a folder that exists", self.refused("--out", self.path("x"), "--video", self.path("x/y/film.avi")))

    def test_bad_arguments_are_one_line(self):
        out = ["--out", self.path("x")]
        for arguments, parts in (([], ["--out FOLDER is missing"]),
                                 (out + ["--steps", "3"], ["--steps", "--help"]),
                                 (out + ["--step"], ["--step", "needs a value"]),
                                 (out + ["--step", ""], ["--step", "needs a value"]),
                                 (out + ["--last"], ["no option --last"]),
                                 (["--out", WORLD + "/x"], [WORLD + "/x: the folder cannot be made"]),
                                 (out + ["--step", "0"], ["--step is 0, but must be from 0.001 to 1440 min"]),
                                 (out + ["--to", "-3"], ["--to", "later than --from"]),
                                 (out + ["--frames", "3", "--step", "3"], ["--frames", "--step"]),
                                 (out + ["--frames", "1.5"], ["--frames", "1.5", "whole number"]),
                                 (out + ["--date", "2024-02-30"], ["--date", "2024-02-30"]),
                                 (out + ["--date", "today"], ["--date", "today", "2024-07-01"]),
                                 (out + ["--date", "4294969320-07-01"], ["--date", "4294969320", "2024-07-01"]),
                                 (out + ["--date", "2024- 7-1"], ["--date", "2024- 7-1", "2024-07-01"]),
                                 (out + ["--date", "9999999-07-01"], ["--date", "9999999", "year", "6000"]),
                                 (out + ["--site", "91,0"], ["--site", "91", "latitude"]),
                                 (out + ["--video", "film.gif"], ["--video", "film.gif", ".mp4"]),
                                 (out + ["--contact-sheet", "day.jpg"], ["--contact-sheet", "day.jpg", ".png"]),
                                 (out + ["--contact-sheet", out[1] + "/frame_00002.png"],
                                  ["--contact-sheet", "frame_00002.png", "another file than the frames"]),
                                 (out + ["--contact-sheet", "day.png", "--step", "0.1"],
                                  ["--contact-sheet", "1930 x ", "16384"]),
                                 (out + ["--video", self.path("none/film.mp4")], ["--video", "none", "folder that exists"]),
                                 (out + ["--columns", "3"], ["--columns needs --contact-sheet"]),
                                 (out + ["--fps", "3"], ["--fps needs --video"]),
                                 (out + ["--caption", "big"], ["--caption", "big", "hour"]),
                                 (out + ["--path-pose", "100000"], ["--path-pose", "100000", "991"]),
                                 (out + ["--world", self.path("none.world")], ["none.world"])):
            said = self.refused(*arguments)
            for part in ["timelapse: "] + parts:
                self.assertIn(part, said)
            self.assertFalse(os.path.exists(self.path("x")))

    def test_snapshot_is_the_frame_of_its_hour(self):
        place = ["--date", "2024-12-16", "--timezone", "3", "--site", "55.8,49.1"]
        done = run("timelapse", "--out", self.path("c"), *VIEW, *place, "--from", "18.5", "--frames", "1")
        self.assertEqual(done.returncode, 0, done.stderr)
        picture = self.path("picture.png")
        done = run("snapshot", *VIEW, *place, "--time", "18:30", "--out", picture)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(pathlib.Path(picture).read_bytes(),
                         pathlib.Path(self.path("c"), "frame_00000.png").read_bytes())
        for arguments, part in ((["--time", "18:30", "--sun", "180,30"], "--sun and --time"),
                                (["--date", "2024-12-16"], "needs --time"), (["--time", "25:00"], "25:00"),
                                (["--top-down", "0,0,9"], "leave out --pose"),
                                (["--height", "0"], "--height needs --path-pose"),
                                (["--look-at", "1,2,3", "--pose", "0,0,1,90"], "leave YAW and PITCH out"),
                                (["--compensation", "1", "--ev", "9"], "--compensation needs --ev auto"),
                                (["--hood", "50"], "--hood needs --glare too"), (["--demosaic", "vng"], "--demosaic needs --mosaic too"),
                                (["--fov", "wide"], "must be a number"), (["--sun", "4"], "must be 2 numbers"),
                                (["--final-gather", "17"], "--final-gather is 17, but must be from 0 to 16"),
                                (["--final-gather", "2"], "leave out --bounced off"),
                                (["--depth", "depth.png"], "must be a name that ends in .pfm"),
                                (["--out", "picture.jpg"], "must be a name that ends in .png")):
            done = run("snapshot", *VIEW, "--out", picture, *arguments)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
            self.assertIn(part, done.stderr)
        done = run("snapshot", "--out", picture, "--top-down", "0,0,9", "--fov", "60")
        self.assertIn("leave out --fov", done.stderr)

    def test_a_recorded_trajectory_is_a_path_by_its_own_height(self):
        still = ["%d %s 0 1 0 0 0 1\n" % (i, x) for i, x in enumerate(("0", "0", "0.0005", "5", "5"))]
        path = self.path("recorded.txt")
        pathlib.Path(path).write_text("".join(still))
        there, low, high = (self.path(name + ".png") for name in ("there", "low", "high"))
        self.assertEqual(run("snapshot", *VIEW, "--out", there).returncode, 0)
        on_path = ["snapshot", *VIEW[:2], *VIEW[4:], "--path", path, "--path-pose", "0"]
        for picture, more in ((low, ["--height", "0"]), (high, [])):
            done = run(*on_path, *more, "--out", picture)
            self.assertEqual((done.returncode, done.stderr),
                             (0, path + ": 3 poses left out, less than 1 mm in plan view from the one before\n"))
        there, low, high = (pathlib.Path(picture).read_bytes() for picture in (there, low, high))
        self.assertEqual(low, there)
        self.assertNotEqual(high, there)

    def test_a_room_by_its_lamps_looks_as_by_traced_paths(self):
        # Polished floor, mirror, window pane, a panel in the ceiling and a lamp on the table.
        views = ["--view", "2.7,-2.2,1.6,140,-5", "--view", "-2.5,-2,1.6,40,-5"]
        done = run("compare_light", "--out", self.path("room"), "--world", INTERIOR, *views, "--sun", "120,-20", "--lamps",
                   "on", "--size", "160x120", "--every", "4", "--samples", "2048")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(os.path.join(self.path("room"), "table.csv"), newline="") as table:
            rows = [row for row in csv.DictReader(table) if row["view"] != "all"]
        self.assertEqual(len(rows), 2)
        for row in rows:
            # Measured 7 and 7, 5 and 6 %, with 3 % of noise in the reference, which also has the lamp's light that the
            # mirror throws on the walls; with what surfaces pass on left out, most of the walls were dark. No bound for
            # the sum: the lamp in the mirror is a pixel or two of most of it.
            self.assertLess(float(row["mean_pct"]), 11.0)
            self.assertLess(float(row["median_pct"]), 7.0)

    def test_compare_light_leaves_tables_and_pictures(self):
        view = ["--view", "0,0,1", "--size", "32x24", "--every", "1", "--sun", "170,40", "--bounced", "off"]
        done = run("compare_light", "--out", self.path("light"), "--world", WORLD, *view, "--samples", "4", "--bounces", "1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(os.listdir(self.path("light"))), ["materials.md", "table.csv", "table.md", "view_0_sun_40.png"])
        for arguments, part in ((["--views", "2"], "--views and --view are both given"), (["--samples", "1"], "from 2 to 65536"),
                                (["--final-gather", "2"], "leave out --bounced off"),
                                (["--bake", "no"], "no option --bake")):
            done = run("compare_light", "--out", self.path("other"), *view, *arguments)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
            self.assertIn(part, done.stderr)
        self.assertFalse(os.path.exists(self.path("other")))

    def test_compare_light_tells_no_error_of_views_that_see_no_surface(self):
        few = ["--world", WORLD, "--size", "32x24", "--every", "1", "--sun", "170,40", "--bounced", "off", "--samples", "4",
               "--bounces", "1"]
        ground, up = ["--view", "0,0,1"], ["--view", "0,0,1,0,89"]
        done = run("compare_light", "--out", self.path("both"), *few, *ground, *up)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("warning: view 1 has no pixel that is compared and sees a surface\n", done.stderr)
        with open(os.path.join(self.path("both"), "table.csv"), newline="") as table:
            rows = list(csv.DictReader(table))
        self.assertGreater(float(rows[0]["mean_pct"]), 0.0)
        self.assertEqual([rows[1][name] for name in ("pixels", "mean_pct", "noise_pct", "hdr_flip")], ["0", "", "", ""])
        told = [line.split(" | ") for line in pathlib.Path(self.path("both"), "table.md").read_text(encoding="utf-8").splitlines()]
        first, second, of_sky, of_all = told[-4:]
        self.assertEqual(second[3:], ["–"] * 5 + ["– |"])
        for mean in (of_sky, of_all):  # of the one that there is
            self.assertEqual(mean[3:], first[3:])
        done = run("compare_light", "--out", self.path("sky"), *few, *up)
        self.assertEqual(done.returncode, 1)
        self.assertIn("no view has a pixel that is compared and sees a surface", done.stderr)

    def test_export_world_finds_models_as_the_others_do(self):
        done = run("export_world", "--world", "model://sun_less", "--model-path", self.folder, "--model-path", "elsewhere",
                   "--out", self.path("world.glb"))
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
        for folder in (self.folder, "elsewhere"):
            self.assertIn(folder, done.stderr)
        done = run("export_world", "--world", WORLD, "--out", self.path("world.glb"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(pathlib.Path(self.path("world.glb")).read_bytes()[:4], b"glTF")

    def test_export_world_bakes_vertex_colours_into_textures(self):
        world = self.path("colours.obj")
        pathlib.Path(world).write_text("v 0 0 0 1 0 0\nv 50 0 0 0 1 0\nv 0 50 0 0 0 1\nvn 0 0 1\nf 1//1 2//1 3//1\n",
                                       encoding="ascii")
        done = run("export_world", "--world", world, "--texel", "0.1", "--out", self.path("baked.glb"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"^1 textures of \d")
        glb = pathlib.Path(self.path("baked.glb")).read_bytes()
        self.assertIn(b"TEXCOORD_0", glb)
        self.assertNotIn(b"COLOR_0", glb)
        done = run("export_world", "--world", world, "--texel", "0.001", "--out", self.path("baked.glb"))
        self.assertEqual(done.returncode, 0, done.stderr)  # as fine as a page allows
        self.assertIn("too large for a page", done.stderr)


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "tools_timelapse", Timelapse, sysargs=sys.argv)
