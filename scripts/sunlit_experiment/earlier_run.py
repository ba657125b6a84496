"""What an earlier run left in an output folder."""

import collections
import itertools
import os

import yaml

from sunlit_experiment import arguments as read


def _differences(folder, text):
    """Which differences each pair has. What `all` are, only its evaluator knows: one that was built without SURF has no
    surf."""
    try:
        with open(os.path.join(folder, "run.yaml"), encoding="utf-8") as run:
            return yaml.safe_load(yaml.safe_load(run)["settings"]["differences"])
    except (OSError, yaml.YAMLError, KeyError, TypeError):  # no run of ours; the evaluator will say so, if need be
        return read.differences(text)


def first_not_evaluated(folder, pairs, differences):
    """The first pose that frames.csv does not have whole; 0 where there is none. `pairs`: as the evaluator gets them;
    `differences`: as typed."""
    expected = len(_differences(folder, differences))
    rows = collections.Counter()
    try:
        with open(os.path.join(folder, "frames.csv"), encoding="utf-8", errors="replace") as frames:
            for line in frames:
                fields = line.split(",")
                if line.endswith("\n") and fields[0].isdigit() and len(fields) > 4:
                    rows[int(fields[0]), fields[2], fields[3]] += 1
    except FileNotFoundError:
        return 0
    for pose in itertools.count():
        here = [pair for pair in pairs if pose % pair.get("every", 1) == 0]
        if any(rows[pose, pair["a"], pair["b"]] < expected for pair in here):
            return pose
