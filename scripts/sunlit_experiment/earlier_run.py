"""What an earlier run left in an output folder."""

import collections
import itertools
import os

import yaml

from sunlit_experiment import arguments as read

ABOUT = "about/"
NO_RUN_OF_OURS = (OSError, yaml.YAMLError, AttributeError, KeyError, RecursionError, TypeError, ValueError)


def _settings(folder):
    """Texts by name; none where there is no run of ours: the evaluator will say so, if need be."""
    try:
        with open(os.path.join(folder, "run.yaml"), encoding="utf-8") as run:
            settings = yaml.safe_load(run)["settings"]
            return {name: text for name, text in settings.items() if isinstance(name, str) and isinstance(text, str)}
    except NO_RUN_OF_OURS:
        return {}


def about(folder):
    """What the earlier run was told about itself, as plan has it."""
    return {name[len(ABOUT):]: text for name, text in _settings(folder).items() if name.startswith(ABOUT)}


def _detectors(folder):
    """Of the earlier run: what `all` differences and `auto` verification are, only its evaluator knows; one that was built
    without SURF has no surf."""
    settings = _settings(folder)
    try:
        lists = {name: yaml.safe_load(settings[name]) for name in ("differences", "verify") if name in settings}
        return {name: names for name, names in lists.items() if isinstance(names, list)}
    except NO_RUN_OF_OURS:
        return {}


def _rows(folder, name):
    """How many whole lines a file has of each pose and pair; None where there is no such file."""
    rows = collections.Counter()
    try:
        with open(os.path.join(folder, name), encoding="utf-8", errors="replace") as lines:
            for line in lines:
                fields = line.split(",")
                if line.endswith("\n") and fields[0].isdecimal() and len(fields[0]) < 19 and len(fields) > 4:
                    rows[int(fields[0]), fields[2], fields[3]] += 1
    except FileNotFoundError:
        return None
    return rows


def _under_other_suns(folder):
    """(pose, stream) of pictures that an evaluator leaves out, and had no time to if it was killed."""
    try:
        with open(os.path.join(folder, "problems.csv"), encoding="utf-8", errors="replace") as lines:
            problems = [line.split(",") for line in lines if line.startswith("other_sun,")]
    except FileNotFoundError:
        return set()
    return {(int(fields[1]), fields[3]) for fields in problems if len(fields) > 4 and fields[1].isdecimal() and len(fields[1]) < 19}


def evaluated_beyond(folder, poses):
    """Why no run of so many poses can be made in this folder, since some beyond them are evaluated; empty where none are."""
    evaluated = {pose for pose, _, _ in _rows(folder, "frames.csv") or ()}
    beyond = {pose for pose in evaluated if pose >= poses}
    if not beyond:
        return ""
    return (f"{folder} holds {len(evaluated)} evaluated poses, and {len(beyond)} of them are not among the {poses} of this path: "
            f"choose another output, or poses:={max(beyond) + 1} at least")


def without_pictures(folder, streams, poses):
    """Of how many of the first poses, which are not rendered again, this folder lacks a picture of any of these streams; empty where
    of none."""
    lacking = sum(not all(os.path.exists(os.path.join(folder, "images", stream, f"{pose:06d}.png")) for stream in streams)
                  for pose in range(poses))
    if not lacking:
        return ""
    return (f"images: {folder} lacks pictures of {lacking} of the {poses} poses that are evaluated already, and pictures are kept of "
            "what is evaluated anew alone: choose another output to have all")


def first_not_evaluated(folder, pairs, differences, features="{}"):
    """The first pose that frames.csv, and verified.csv where matches are verified, do not have whole, or under another sun; 0 where
    there is none.
    `pairs`: as the evaluator gets them; `differences` and `features`: as typed."""
    settings = _detectors(folder)
    expected = [(_rows(folder, "frames.csv"), len(settings.get("differences") or read.differences(differences, features)))]
    if settings.get("verify"):
        expected.append((_rows(folder, "verified.csv"), len(settings["verify"])))
    if any(rows is None for rows, _ in expected):
        return 0
    others = _under_other_suns(folder)
    for pose in itertools.count():
        here = [pair for pair in pairs if pose % pair.get("every", 1) == 0]
        if any((pose, pair[side]) in others for pair in here for side in ("a", "b")):
            return pose
        if any(rows[pose, pair["a"], pair["b"]] < count for pair in here for rows, count in expected):
            return pose
