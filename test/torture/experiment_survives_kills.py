#!/usr/bin/python3
"""An experiment that is killed at each of its stages completes, started again, with the bytes of an undisturbed one.

scripts/torture does the same at random moments, as often as one likes.
"""
import os
import random
import shutil
import subprocess
import sys
import tempfile
import unittest
from types import SimpleNamespace
from unittest import mock

import rosunit

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import kills  # noqa: E402  pylint: disable=wrong-import-position
import soak  # noqa: E402  pylint: disable=wrong-import-position
from trial import Trial, kill_leftovers  # noqa: E402  pylint: disable=wrong-import-position

FEW = dict(poses=20)
# Stage -> who is killed there.
CHOSEN = (("planning", "everything"), ("loading", "master"), ("baking", "render"), ("caching", "everything"),
          ("rendering", "evaluator"), ("localising", "evaluator"), ("reporting", "experiment"))


class ExperimentSurvivesKills(unittest.TestCase):

    def setUp(self):
        self.folder = tempfile.mkdtemp()

    def tearDown(self):
        kill_leftovers()
        shutil.rmtree(self.folder)

    def test_killed_at_each_stage_it_completes_with_the_same_bytes_and_leaves_nothing(self):
        reference = kills.undisturbed(os.path.join(self.folder, "undisturbed"), **FEW)
        killer = kills.Killer(random.Random(1), Trial(os.path.join(self.folder, "killed"), **FEW), reference)
        for stage, target in CHOSEN:
            killer.wanted = (target,)
            done = killer.kill_once(next(moment for moment in kills.MOMENTS if moment.stage == stage))
            print(done)
            self.assertFalse(done.is_hole(), done)
        self.assertEqual(killer.complete(), "")

    def test_a_soak_whose_master_does_not_start_ends(self):
        start = lambda nodes, *_: nodes.processes.append(subprocess.Popen(["false"], start_new_session=True))
        asked = SimpleNamespace(csv=os.path.join(self.folder, "soak.csv"))
        with mock.patch.dict(os.environ), mock.patch.object(soak.Nodes, "_start", start):
            with self.assertRaisesRegex(SystemExit, "soak: there is no master"), soak.Nodes(asked):
                pass


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "experiment_survives_kills", ExperimentSurvivesKills)
