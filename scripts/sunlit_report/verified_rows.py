"""verified.csv and verified_summary.csv: which matches are right."""

import dataclasses
import math
import os

import numpy as np

from .csv_rows import by_pose, number, rows, whole

ACCURACY_PX = list(range(1, 11))
MEASURES = (["repeatability", "matching_score_3px"] + [f"mma_{t}px" for t in ACCURACY_PX]
            + ["mutual_matches", "ratio_matches", "precision_3px", "recall_3px", "average_precision_3px", "d",
               "d_symmetric", "d_one_to_one"])
COUNTS = ("features_a", "features_b", "mutual_matches", "ratio_matches")
HEADER = "pose,stamp,a,b,detector,features_a,features_b," + ",".join(MEASURES)
SUMMARY = "a,b,detector,measure,n,undefined,mean,sd,ci_low,ci_high"


@dataclasses.dataclass
class Mean:
    """Of one measure along the path; NaN where there is none."""

    n: int
    undefined: int
    mean: float
    ci_low: float = math.nan
    ci_high: float = math.nan


@dataclasses.dataclass
class Verified:
    """Keys are (a, b, detector)."""

    poses: dict  # -> {pose: number of right matches, of those that pass the ratio test}
    means: dict  # -> {measure: Mean}

    @property
    def pairs(self):
        return list(dict.fromkeys((a, b) for a, b, _ in self.means))

    @property
    def detectors(self):
        return list(dict.fromkeys(detector for _, _, detector in self.means))


def read(folder):
    """Empty where there is no verified.csv. Raises ReportError naming file and line."""
    path = os.path.join(folder, "verified.csv")
    kinds = {"pose": whole, **{name: whole if name in COUNTS else number for name in HEADER.split(",")[5:]}}
    series = by_pose(path, HEADER, ("a", "b", "detector"), kinds)
    poses = {}
    for key, one in series.items():
        right = np.rint(np.nan_to_num(one["precision_3px"] * one["ratio_matches"])).astype(int)  # none of no matches
        poses[key] = dict(zip(one["pose"].tolist(), right.tolist()))
    told = _read_summary(os.path.join(folder, "verified_summary.csv"))
    # Without that file, as while a run goes on, means have no intervals.
    return Verified(poses, {key: told.get(key) or _means(one) for key, one in series.items()})


def _read_summary(path):
    kinds = {"n": whole, "undefined": whole, "mean": number, "sd": number, "ci_low": number, "ci_high": number}
    means = {}
    for row in rows(path, SUMMARY, kinds):
        means.setdefault((row["a"], row["b"], row["detector"]), {})[row["measure"]] = Mean(
            row["n"], row["undefined"], row["mean"], row["ci_low"], row["ci_high"])
    return means


def _means(columns):
    means = {}
    for measure in MEASURES:
        column = columns[measure]
        defined = column[~np.isnan(column)]
        means[measure] = Mean(len(defined), len(column) - len(defined), float(defined.mean()) if len(defined) else math.nan)
    return means
