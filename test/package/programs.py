#!/usr/bin/env python3
"""rosrun finds every program that people type."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import rosunit

PROGRAMS = ("snapshot", "timelapse", "export_dataset", "atlas", "export_world", "compare_light", "evaluate_bags", "evaluate_pair",
            "evaluate_places", "evaluate_trajectory", "report", "list_parameters", "render_node",
            "evaluator_node", "sun_position_node")


class Programs(unittest.TestCase):
    def test_rosrun_finds_them_and_they_explain_themselves(self):
        for program in PROGRAMS:
            done = subprocess.run(["rosrun", "sunlit", program, "--help"], stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            self.assertEqual(done.returncode, 0, f"{program}: {done.stdout}")
            self.assertIn(program, done.stdout.splitlines()[0])

    def test_none_loads_as_it_starts_what_reads_pictures(self):
        """Which takes most of a start: see image/codecs.h."""
        folder = pathlib.Path(os.environ["SUNLIT_DEVEL_DIR"], "lib", "sunlit")
        compiled = [program for program in PROGRAMS if program != "report"]
        for program in compiled:
            loaded = subprocess.run(["ldd", str(folder / program)], stdout=subprocess.PIPE, text=True, check=True).stdout
            self.assertIn("libsunlit_quantity.so", loaded)
            if program != "timelapse":  # which writes films, too
                self.assertNotIn("libopencv_imgcodecs", loaded, program)

    def test_scripts_refuse_no_folder_and_know_their_build_from_everywhere(self):
        scripts = pathlib.Path(os.environ["SUNLIT_SOURCE_DIR"], "scripts")
        # The last word stops it before it does anything.
        done = subprocess.run([str(scripts / "demo"), "--output", "", "--stop"], stderr=subprocess.PIPE, text=True)
        self.assertEqual((done.returncode, done.stderr), (2, "demo: --output needs a folder\n"))
        told = [line for script in scripts.iterdir() if script.is_file()
                for line in re.findall(r"^build_dir=.*\$\{(?:1|SUNLIT_BUILD_DIR):.*$", script.read_text(), re.MULTILINE)]
        self.assertGreaterEqual(len(told), 5)
        self.assertEqual([line for line in told if not line.startswith('build_dir=$(realpath -m "')], [])

    def test_a_build_knows_its_checkout_whatever_signs_are_in_its_path(self):
        with tempfile.TemporaryDirectory() as folder:
            checkout = pathlib.Path(folder, "it's [1.0] $HOME & #2 \\ ^")
            (checkout / "scripts").mkdir(parents=True)
            shutil.copy(pathlib.Path(os.environ["SUNLIT_SOURCE_DIR"], "scripts", "build"), checkout / "scripts")
            subprocess.run([str(checkout / "scripts/build")], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # nothing to configure
            hook = checkout / "build/devel/etc/catkin/profile.d/50.rosrun.sh"
            path = "/opt/one:%s/build/devel:/opt/two"
            found = subprocess.run(["sh", "-c", '. "$0"; printf %s "$CMAKE_PREFIX_PATH"', str(hook)], stdout=subprocess.PIPE,
                                   env={**os.environ, "CMAKE_PREFIX_PATH": path % checkout}, text=True, check=True).stdout
            self.assertEqual(found, path % (str(checkout) + "/"))


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "package_programs", Programs, sysargs=sys.argv)
