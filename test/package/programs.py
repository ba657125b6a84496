#!/usr/bin/env python3
"""rosrun finds every program that people type."""
import subprocess
import sys
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


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "package_programs", Programs, sysargs=sys.argv)
