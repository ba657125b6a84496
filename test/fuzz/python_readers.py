#!/usr/bin/env python3
"""What Python reads, under inputs that are slightly wrong, the same each time: arguments of experiment.launch, what an earlier
run left, and the folder that the report is made of. Each is read, or refused by the one error that is shown to people."""

import contextlib
import os
import random
import re
import sys
import tempfile
import unittest
import warnings
from xml.etree import ElementTree

import rosunit

sys.dont_write_bytecode = True
SOURCE = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
sys.path.insert(0, os.path.join(SOURCE, "scripts"))

from sunlit_experiment import arguments, earlier_run, plan  # noqa: E402
from sunlit_report import files  # noqa: E402
from sunlit_report.csv_rows import ReportError  # noqa: E402

NUMBERS = [b"nan", b"-1", b"0", b"1e308", b"1e999", b"9" * 30, b"0.5", "²".encode(), b"0x7f", b"", b"-inf"]
FRAMES = (files.FRAMES + "\n0,1000.000000000,h04,h12,boolean_rgb,0.5,0,0,0,0,0.5,0.5,0,0\n"
          "0,1000.000000000,h04,h12,orb,0.25,12,13,5,0,0.5,0.75,4,3\n").encode()
VERIFIED = b"pose,stamp,a,b,detector,features_a\n0,1000.000000000,h04,h12,orb,3\n"
RUN = b"settings:\n  differences: '[boolean_rgb, orb]'\n  verify: '[orb]'\nposes: 5\n"
FOLDER = {"frames.csv": FRAMES, "run.yaml": RUN, "ground.yaml": b"ground_albedo: 0.2\n",
          "captures.csv": (files.CAPTURES + "\nh04,0,1000.000000000,14,auto,90,20,nan,nan,nan,50000,2024-07-01T09:00:00.000Z,773139600\n").encode(),
          "path.csv": (files.PATH + "\n0,1000.000000000,0,0,1,90\n").encode(),
          "problems.csv": (files.PROBLEMS + "\nlost,3,,a,b\n").encode(),
          "map.yaml": b"x_min: 0\nx_max: 1\ny_min: 0\ny_max: 1\n",
          "summary.csv": (files.SUMMARY + "\nh04,h12,orb,1,0,0.5,nan,nan,nan,0.5,nan,0.5,nan,0\n").encode()}


def slipped(content, dice):
    """`content` after one to three slips."""
    for _ in range(dice.randint(1, 3)):
        words = [match.span() for match in re.finditer(rb"[\w.+-]+", content)]
        at = dice.randrange(len(content) + 1)
        kind = dice.randrange(6)
        if kind == 0:
            content = content[:at]
        elif kind == 1:
            content = content[:at] + bytes([dice.randrange(256)]) + content[at + 1:]
        elif kind == 2:
            content = content[:at] + content[at // 2:]
        elif words:
            begin, end = dice.choice(words)
            other = content[slice(*dice.choice(words))]
            content = content[:begin] + dice.choice(NUMBERS + [other, other + b"," + other, b"[" + other]) + content[end:]
    return content


class SlightlyWrongInputs(unittest.TestCase):

    def check(self, content, read, *errors):
        """Where `read` throws another error, the input is shown."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                with contextlib.suppress(*errors):
                    read()
            except Exception as error:  # pylint: disable=broad-except
                self.fail(f"{content!r}: {type(error).__name__}: {error}")

    def test_arguments_are_planned_with_or_refused(self):
        launch_file = os.path.join(SOURCE, "launch", "experiment.launch")
        defaults = {arg.get("name"): arg.get("default") for arg in ElementTree.parse(launch_file).iter("arg")
                    if "default" in arg.attrib}
        more = {"hours": "[4.5, {12: 3}]", "features": "{a: {type: sift}}", "map": "[4, 20]", "robot": "rover"}
        places = {"output": "/results", "robots": os.path.join(SOURCE, "worlds", "robots"), "report": "/report"}
        dice = random.Random(1)
        for _ in range(3000):
            name = dice.choice(list(defaults))
            text = slipped((more.get(name) or defaults[name] or "0").encode(), dice).decode(errors="replace")
            typed = dict(defaults, **{name: text})
            self.check((name, text), lambda typed=typed: (plan.check(typed), plan.parameters(
                typed, {}, places, plan.Beginning(5))), arguments.Unusable)

    def test_what_an_earlier_run_left_is_taken_up_or_done_again(self):
        dice = random.Random(2)
        pairs = arguments.pairs("[4, 12]", False, 1)
        for _ in range(1500):
            with tempfile.TemporaryDirectory() as folder:
                contents = {"frames.csv": FRAMES, "verified.csv": VERIFIED, "run.yaml": RUN}
                name = dice.choice(list(contents))
                contents[name] = slipped(contents[name], dice)
                for file, content in contents.items():
                    with open(os.path.join(folder, file), "wb") as out:
                        out.write(content)
                self.check(contents[name], lambda folder=folder: (earlier_run.evaluated_beyond(folder, 1),
                                                                  earlier_run.first_not_evaluated(folder, pairs, "[boolean_rgb, orb]")))

    def test_a_folder_of_results_is_read_or_refused(self):
        dice = random.Random(3)
        for _ in range(1500):
            with tempfile.TemporaryDirectory() as folder:
                name = dice.choice(list(FOLDER))
                changed = slipped(FOLDER[name], dice)
                for file, content in dict(FOLDER, **{name: changed}).items():
                    with open(os.path.join(folder, file), "wb") as out:
                        out.write(content)
                self.check((name, changed), lambda folder=folder: files.read_output(folder), ReportError)


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "python_readers", SlightlyWrongInputs, sysargs=sys.argv)
