#!/usr/bin/env python3
"""atlas, as people type it: whole, in shards, broken off, and as jobs of a cluster."""
import csv
import fcntl
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import rosunit

from timelapse import WORLD, located, run

SMALL = ["--size", "160x120", "--bounced", "off", "--supersampling", "1", "--pictures", "false"]
# On the built-in track, from 4 h, when the sun has just risen there, to noon.
TRACK = [*SMALL, "--count", "24", "--stride", "4", "--hours", "4,8,12", "--unit-poses", "2"]
# Loads in a moment; its two boxes have few features.
BOXES = [*SMALL, "--world", WORLD, "--count", "4", "--hours", "8,16", "--detectors", "orb", "--unit-poses", "1"]


def content(folder):
    """All that lasts, by its path below the folder."""
    root = pathlib.Path(folder)
    return {str(path.relative_to(root)): path.read_bytes() for path in root.rglob("*")
            if path.is_file() and "slurm" not in path.relative_to(root).parts}


def table(folder, name):
    with open(os.path.join(folder, name), newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Atlas(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        pathlib.Path(cls.path("boxes.csv")).write_text("0,-2\n4,-2.5\n8,-5\n", encoding="utf-8")
        cls.said = cls.make("whole", *TRACK)

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder, name)

    @classmethod
    def make(cls, out, *arguments, **more):
        done = run("atlas", "--out", cls.path(out), *arguments, **more)
        assert done.returncode == 0, done.stderr
        return done.stdout

    @classmethod
    def boxes(cls):
        return [*BOXES, "--path", cls.path("boxes.csv")]

    def refused(self, out, *arguments, **more):
        done = run("atlas", "--out", self.path(out), *arguments, **more)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
        return done.stderr

    def test_more_units_than_files_can_be_open_are_refused_before_the_work(self):
        limited = lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (103, 103))
        self.assertIn("would be 4 units of observations, but a process may have no more than 103 files open here",
                      self.refused("many", *self.boxes(), preexec_fn=limited))
        self.assertFalse(os.path.exists(self.path("many")))

    def test_tells_what_it_will_take_and_writes_a_row_a_cell(self):
        self.assertRegex(self.said, r"km of path, 6 poses, 3 lights, 2 methods: 18 pictures, 18 cells\n")
        self.assertRegex(self.said, r"observe .* in 3 units, compare .* in 6 units\n")
        self.assertRegex(self.said, r"\ndisk: .* of features and .* of cells, of which 0 B are there; free: ")
        cells = table(self.path("whole"), "atlas.csv")
        hours = ("h04", "h08", "h12")
        self.assertEqual([(row["method"], row["map"], row["query"]) for row in cells],
                         [(method, a, b) for method in ("sift", "orb") for a in hours for b in hours])
        for row in cells:
            rows = table(self.path("whole"), "cells/%s/%s/%s.csv" % (row["method"], row["map"], row["query"]))
            self.assertEqual([int(one["pose"]) for one in rows], list(range(0, 24, 4)))
            self.assertEqual((int(row["n"]), int(row["failures"])),
                             (6, sum(one["status"] != "localised" for one in rows)))
            within = [float(one["error_m"]) <= 0.5 and float(one["error_deg"]) <= 5 for one in rows]
            self.assertAlmostEqual(float(row["within_0.5m_5deg"]), sum(within) / 6, delta=1e-12)
            self.assertAlmostEqual(float(row["d"]), sum(float(one["d"]) for one in rows) / 6, delta=1e-12)
            if row["map"] == row["query"]:
                self.assertEqual(float(row["matching_score_3px"]), 1)
        # Every second pose is a place of the map, and found there to the rounding; of those 4 m from one most are
        # found by so small pictures, not all within half a metre.
        noon = table(self.path("whole"), "cells/sift/h12/h12.csv")
        self.assertTrue(all(float(row["error_m"]) < 1e-9 for row in noon[::2]), noon)
        self.assertGreaterEqual(sum(row["status"] == "localised" for row in noon[1::2]), 2, noon)

    def test_conditions_tell_sun_light_and_exposure(self):
        rows = table(self.path("whole"), "conditions.csv")
        self.assertEqual([(row["condition"], row["date"], row["time"]) for row in rows],
                         [("h04", "2024-07-01", "04:00"), ("h08", "2024-07-01", "08:00"), ("h12", "2024-07-01", "12:00")])
        # Site and day of the paper: solar noon is at about 11:48 by its clock, declination 23.1 deg, latitude 55.79 deg.
        self.assertAlmostEqual(float(rows[2]["sun_elevation_deg"]), 90 - 55.79 + 23.1, delta=0.3)
        self.assertAlmostEqual(float(rows[2]["sun_azimuth_deg"]), 185, delta=3)
        lux = [float(row["illuminance_lx"]) for row in rows]
        ev100 = [float(row["ev100_mean"]) for row in rows]
        self.assertTrue(lux[0] < lux[1] < lux[2] and 50000 < lux[2] < 120000, lux)
        self.assertTrue(ev100[0] < ev100[1], ev100)
        self.assertTrue(8 < ev100[0] and ev100[1] < 17, ev100)

    def test_shards_make_the_same_bytes_even_if_one_was_killed(self):
        for shard in ("2/3", "3/3"):
            self.make("sharded", *TRACK, "--stage", "observe", "--shard", shard)
        self.assertRegex(self.refused("sharded", *TRACK, "--stage", "compare"), "1 of 3 units are not observed yet")
        self.killed(*TRACK, "--stage", "observe", "--shard", "1/3")
        self.make("sharded", *TRACK, "--stage", "observe", "--shard", "1/3")
        self.make("sharded", *TRACK, "--stage", "compare", "--shard", "1/3")
        self.assertRegex(self.refused("sharded", *TRACK, "--merge"), "12 cells are missing; --stage compare makes them")
        for shard in ("2/3", "3/3"):
            self.assertEqual(self.make("sharded", *TRACK, "--stage", "compare", "--shard", shard), "")
        self.make("sharded", *TRACK, "--merge")
        self.assertEqual(content(self.path("sharded")), content(self.path("whole")))
        # Nothing is left to do, and nothing is drawn anew.
        self.assertEqual(self.make("sharded", *TRACK), self.path("sharded") + "/atlas.csv\n")
        os.remove(self.path("sharded/cells/orb/h08/h12.csv"))
        os.remove(self.path("sharded/atlas.csv"))
        self.make("sharded", *TRACK)
        self.assertEqual(content(self.path("sharded")), content(self.path("whole")))

    def killed(self, *arguments):
        """As a power cut leaves it: in the midst of a unit, with a torn record."""
        process = subprocess.Popen([located("atlas"), "--out", self.path("sharded"), *arguments],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        growing = pathlib.Path(self.path("sharded/observations/poses_0000000.bin.growing"))
        deadline = time.monotonic() + 60
        while process.poll() is None and not (growing.exists() and growing.stat().st_size > 0):
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.001)
        process.send_signal(signal.SIGKILL)
        process.wait()
        whole = pathlib.Path(self.path("whole/observations/poses_0000000.bin")).read_bytes()
        done = growing if growing.exists() else growing.with_suffix("")
        self.assertTrue(whole.startswith(done.read_bytes()))
        done.rename(growing)  # it may have been faster than the signal
        growing.write_bytes(whole[:len(whole) // 2 + 7])

    def test_one_thread_makes_the_same_bytes(self):
        self.make("one", *TRACK, preexec_fn=lambda: os.sched_setaffinity(0, {min(os.sched_getaffinity(0))}))
        self.assertEqual(content(self.path("one")), content(self.path("whole")))

    def test_other_settings_and_strangers_are_named(self):
        said = self.refused("whole", *TRACK, "--map-every", "2")
        self.assertIn("its pictures were made with other options (without --map-every 2)", said)
        os.mkdir(self.path("mine"))
        pathlib.Path(self.path("mine/thesis.tex")).write_text("years", encoding="utf-8")
        self.assertIn("holds thesis.tex, but no atlas.txt", self.refused("mine", *TRACK))
        network = str(pathlib.Path(__file__).resolve().parents[1] / "golden" / "bright_pixel.onnx")
        os.mkdir(self.path("of_network"))
        made_by = pathlib.Path(self.path("whole/atlas.txt")).read_text(encoding="utf-8").splitlines()[1]
        pathlib.Path(self.path("of_network/atlas.txt")).write_text(
            "%s\n--detectors onnx\n--onnx-model %s\n" % (made_by, network), encoding="utf-8")
        self.assertIn("made with other options (without content of the onnx-model ",
                      self.refused("of_network", "--detectors", "onnx", "--onnx-model", network))

    def test_estimate_leaves_nothing_and_names_both_numbers_where_there_is_no_room(self):
        said = self.make("estimated", *self.boxes(), "--estimate")
        self.assertRegex(said, "4 poses, 2 lights, 1 methods: 8 pictures, 4 cells\n")
        self.assertFalse(os.path.exists(self.path("estimated")))
        # Some 100 TB of cells.
        many = [*self.boxes()[:-2], "--path", self.path("boxes.csv"), "--count", "0", "--spacing", "0.001",
                "--step", "5min"]
        many[many.index("--hours"):many.index("--hours") + 2] = []
        done = run("atlas", "--out", self.path("estimated"), *many)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "estimated: the atlas needs [0-9.]+ [GTP]B more, but the disk has [0-9.]+ [kMGTP]B free\n")
        self.assertFalse(os.path.exists(self.path("estimated")))

    def test_days_and_times_are_the_lights(self):
        said = self.make("days", *self.boxes()[:-2], "--path", self.path("boxes.csv"), "--dates", "2024-03-20,2024-06-21",
                         "--count", "1", "--hours", "12", "--timezone", "3")
        self.assertIn("2 lights", said)
        rows = table(self.path("days"), "conditions.csv")
        self.assertEqual([row["condition"] for row in rows], ["2024-03-20_h12", "2024-06-21_h12"])
        # The sun stands 23.4 deg higher at the solstice than at the equinox.
        self.assertAlmostEqual(float(rows[1]["sun_elevation_deg"]) - float(rows[0]["sun_elevation_deg"]), 23.4, delta=0.5)

    def test_a_second_drive_is_looked_for_in_the_maps_of_the_first(self):
        noon = [*SMALL, "--count", "4", "--stride", "3", "--hours", "12", "--detectors", "sift", "--map-every", "0"]
        self.make("beside", *noon, "--query-offset", "0.5")
        rows = table(self.path("beside"), "cells/sift/h12/h12.csv")
        self.assertEqual(len(rows), 2)
        for row in rows:
            # Equal poses are compared, which have equal pictures here; but no query is in the map itself.
            self.assertEqual(float(row["matching_score_3px"]), 1)
            self.assertTrue(row["status"] != "localised" or float(row["error_m"]) > 1e-4)

    def test_the_second_drive_has_grain_of_its_own(self):
        # A micrometre beside the first, where nothing but the grain differs: a clean query is the map's own picture.
        noon = [*SMALL, "--count", "1", "--hours", "12", "--detectors", "sift", "--map-every", "0", "--query-offset", "1e-6"]
        self.make("clean", *noon)
        self.make("grainy", *noon, "--noise", "3")
        (clean,), (grainy,) = (table(self.path(name), "cells/sift/h12/h12.csv") for name in ("clean", "grainy"))
        self.assertLess(float(clean["error_m"]), 1e-4)  # measured 1e-6, and of equal grain too
        self.assertGreater(float(grainy["error_m"]), 1e-4)  # measured 8e-3

    def test_slurm_jobs_make_the_same_atlas(self):
        self.make("alone", *self.boxes())
        binaries = pathlib.Path(self.path("bin"))
        binaries.mkdir()
        sbatch = binaries / "sbatch"
        sbatch.write_text(STAND_IN, encoding="utf-8")
        sbatch.chmod(0o755)
        log = self.path("sbatch.log")
        environment = {**os.environ, "PATH": str(binaries) + ":" + os.environ["PATH"], "SBATCH_LOG": log}
        said = self.make("jobs", *self.boxes(), "--slurm", "--slurm-tasks", "3", "--slurm-option=--time=1:00:00",
                         env=environment)
        scripts = [self.path("jobs/slurm/%s.sh" % name) for name in ("observe", "compare", "merge")]
        self.assertEqual(said.splitlines()[-3:], [scripts[0] + ": job 101, 3 tasks", scripts[1] + ": job 102, 2 tasks",
                                                  scripts[2] + ": job 103"])
        self.assertEqual(pathlib.Path(log).read_text(encoding="utf-8").splitlines(),
                         ["--parsable " + scripts[0], "--parsable --dependency=afterok:101 " + scripts[1],
                          "--parsable --dependency=afterok:102 " + scripts[2]])
        for script in scripts:
            self.assertIn("#SBATCH --time=1:00:00\n", pathlib.Path(script).read_text(encoding="utf-8"))
        self.assertEqual(content(self.path("jobs")), content(self.path("alone")))

    def test_a_refusal_of_sbatch_is_told(self):
        binaries = pathlib.Path(self.path("refusing"))
        binaries.mkdir()
        (binaries / "sbatch").write_text("#!/bin/sh\necho 'sbatch: error: no such partition' >&2\nexit 1\n", encoding="utf-8")
        (binaries / "sbatch").chmod(0o755)
        environment = {**os.environ, "PATH": str(binaries) + ":" + os.environ["PATH"]}
        done = run("atlas", "--out", self.path("none"), *self.boxes(), "--slurm", env=environment)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "sbatch: error: no such partition\natlas: .*observe.sh: sbatch did not take it\n")
        said = self.make("written", *self.boxes(), "--slurm", "--submit", "false")
        self.assertRegex(said, r"observe.sh, 4 tasks\n.*compare.sh, 2 tasks\n.*merge.sh\n$")
        # No two processes work at one unit.
        os.mkdir(self.path("written/observations"))
        with open(self.path("written/observations/poses_0000002.bin.growing"), "wb") as growing:
            fcntl.flock(growing, fcntl.LOCK_EX)
            self.assertIn("poses_0000002.bin.growing: another process is at it", self.refused("written", *self.boxes()))

    def test_bad_arguments_are_one_line(self):
        for arguments, part in (
                (["--hours", "4,4"], "--hours names h04 twice"), (["--hours", "24"], "--hours is 24, but must be"),
                (["--hours", "4", "--from", "3"], "--hours and --from are both given"),
                (["--from", "5", "--to", "5"], "--to must be later than --from"),
                (["--step", "0"], "--step is 0, but must be above 0"), (["--step", "25h"], "--step is 1500, but must be from"),
                (["--step", "soon"], '--step is "soon"'), (["--step", "1s"], "--step would make more than 5000 times"),
                (["--dates", "2024-02-30"], "--dates is"), (["--dates", "2024-03-20,"], "--dates is"),
                (["--dates", "2024-03-20,2024-03-20", "--from", "23.99999"], "the light 2024-03-20_h23_59_59 is asked for twice"),
                (["--dates", "2024-03-20,2024-03-20"], "the light 2024-03-20_h00 is asked for twice"),
                (["--dates", "2024-03-20", "--date", "2024-03-20"], "--dates and --date are both given"),
                (["--shard", "1/2"], "--shard needs --stage too"),
                (["--stage", "observe", "--shard", "3/2"], "--shard's I is 3, but must be from 1 to 2"),
                (["--stage", "observe", "--shard", "1"], '--shard is "1", but must be I/N'),
                (["--stage", "observe", "--merge"], "only one goes at a time"), (["--submit", "false"], "--submit needs --slurm"),
                (["--merge=3"], "--merge takes no value"), (["--detectors", "sift,,orb"], "--detectors"),
                (["--detectors", "swift"], "--detectors is [swift]"), (["--min-inliers", "3"], "--min-inliers is 3")):
            self.assertIn(part, self.refused("x", *arguments), arguments)
            self.assertFalse(os.path.exists(self.path("x")), arguments)


STAND_IN = """#!/usr/bin/env python3
# Does a job at once, the tasks of an array one after another, and tells its number.
import os, re, subprocess, sys
log = os.environ["SBATCH_LOG"]
with open(log, "a", encoding="utf-8") as file:
    print(*sys.argv[1:], file=file)
with open(log, encoding="utf-8") as file:
    number = 100 + len(file.readlines())
script = sys.argv[-1]
options = re.findall("^#SBATCH --([a-z-]+)=(.*)$", open(script, encoding="utf-8").read(), re.MULTILINE)
options = {name: value.strip('"') for name, value in options}
first, last = (int(word) for word in options["array"].split("-")) if "array" in options else (1, 1)
for task in range(first, last + 1):
    with open(options["output"].replace("%a", str(task)), "w", encoding="utf-8") as out:
        subprocess.run(["bash", script], check=True, stdout=out, stderr=out, cwd=options["chdir"],
                       env={**os.environ, "SLURM_ARRAY_TASK_ID": str(task)})
print(f"{number};cluster")
"""

if __name__ == "__main__":
    rosunit.unitrun("sunlit", "tools_atlas", Atlas, sysargs=sys.argv)
