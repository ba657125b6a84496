"""Reads the files of an output folder. Only frames.csv or localisation.csv must be there; what is absent stays None or empty."""

import dataclasses
import glob
import math
import os
import re

import numpy as np
import yaml

from . import choice, comparison_rows, lost_rows, names, queries, verified_rows
from .csv_rows import ReportError, by_pose, number, opened, optional_whole, rows, whole

DIFFERENCES = ["boolean_rgb", "boolean_grey", "euclidean_rgb", "euclidean_grey", "sift", "surf", "brisk", "orb"]

# Older runs lack the columns from `symmetric` and `symmetric_mean` on.
OLD_FRAMES = "pose,stamp,a,b,difference,value,features_a,features_b,matches,zero_second"
FRAMES = OLD_FRAMES + ",symmetric,one_to_one,matches_back,matches_one_to_one"
OLD_SUMMARY = "a,b,difference,n,undefined,mean,sd,ci_low,ci_high"
SUMMARY = OLD_SUMMARY + ",symmetric_mean,symmetric_sd,one_to_one_mean,one_to_one_sd,overmatched"
_SKY = "sun_azimuth_deg,sun_elevation_deg,moon_azimuth_deg,moon_elevation_deg,moon_illuminated_fraction,scene_illuminance"
# Older captures do not tell the time of their sky, the oldest not how their exposure was chosen either.
OLD_CAPTURES = (f"stream,pose,stamp,ev100,{_SKY}", f"stream,pose,stamp,ev100,exposure_mode,{_SKY}")
CAPTURES = OLD_CAPTURES[1] + ",utc,utc_s"
PATH = "pose,stamp,x,y,z,yaw_deg"
PROBLEMS = "kind,pose,stamp,where,reason"
LOCALISATION_PROBLEMS = "stream,role,stamp,fault"
TIMING = "stage,what,count,seconds"


@dataclasses.dataclass
class Series:
    """One difference of one pair along the path, by rising pose. `value` is NaN where it is undefined."""

    pose: np.ndarray
    value: np.ndarray
    features_a: np.ndarray
    features_b: np.ndarray
    matches: np.ndarray
    zero_second: np.ndarray
    symmetric: np.ndarray  # NaN, as the next, where an older run did not compute it
    one_to_one: np.ndarray

    @property
    def overmatched(self):
        """Poses with more matches than b has features: several features of a share one."""
        return int((self.matches > self.features_b).sum())


@dataclasses.dataclass
class Summary:
    """Statistics of a series; NaN where there is none."""

    n: int
    undefined: int
    mean: float
    sd: float
    ci_low: float = math.nan
    ci_high: float = math.nan
    symmetric_mean: float = math.nan
    one_to_one_mean: float = math.nan


@dataclasses.dataclass
class Output:
    """All that an output folder holds. Keys of `series` and `summary` are (a, b, difference)."""

    folder: str
    series: dict
    queries: dict  # of localisation: (map, query, detector) -> Queries
    positions: dict  # (map, query, detector) -> Positions
    shares: dict  # (map, query, detector) -> 95 % intervals of its shares
    comparisons: list  # of Comparison
    summary: dict
    has_summary_file: bool
    run: dict
    rasterizer: str  # what drew, and on what; None: unknown
    ground_albedo: float  # of the land around the world; None: unknown
    inputs: dict  # name -> fingerprint of what the pictures were made from
    captures: dict  # stream -> {column: array}
    path: dict  # column -> array
    map_picture: str
    map_extent: dict
    images: dict  # condition -> {pose: file}
    verified: verified_rows.Verified
    matches: dict  # drawn, a-b/detector -> {pose: file}
    lost: dict  # (a, b, detector) -> lost_rows.Lost
    problems: list
    timing: list

    @property
    def settings(self):
        """Those of run.yaml; empty where it tells none."""
        found = self.run.get("settings")
        return found if isinstance(found, dict) else {}

    @property
    def pairs(self):
        """Pairs of different conditions, in the order of the file."""
        return [pair for pair in self.all_pairs if not is_self_test(*pair)]

    @property
    def self_pairs(self):
        return [pair for pair in self.all_pairs if is_self_test(*pair)]

    @property
    def all_pairs(self):
        return list(dict.fromkeys((a, b) for a, b, _ in self.summary))

    @property
    def shown_pairs(self):
        """Those of different conditions that tables and figures have; the self-tests where there is nothing else."""
        return choice.shown_pairs(self.pairs or self.self_pairs, self.mapped)

    @property
    def mapped(self):
        """Conditions that maps are made of."""
        return {part for key in self.queries for part in names.parts_of_map(key[0])}

    @property
    def differences(self):
        """Those evaluated: the known ones in the paper's order, then others."""
        found = list(dict.fromkeys(difference for _, _, difference in self.summary))
        return [d for d in DIFFERENCES if d in found] + [d for d in found if d not in DIFFERENCES]

    @property
    def conditions(self):
        if self.pairs:
            return list(dict.fromkeys(name for pair in self.pairs for name in pair))
        if self.self_pairs:
            return list(dict.fromkeys(a for a, _ in self.self_pairs))
        return list(dict.fromkeys(name for key in self.queries for name in [*names.parts_of_map(key[0]), key[1]]))

    @property
    def poses(self):
        """All that anything is known of, rising."""
        return np.unique(np.concatenate([one.pose for one in [*self.series.values(), *self.queries.values()]]))


def is_self_test(a, b):
    """The experiment calls the second rendering of a condition self_test/<condition>."""
    return a == b or b == f"self_test/{a}"


def read_output(folder):
    """Raises ReportError naming the file, and the line where it is one."""
    if not os.path.isdir(folder):
        raise ReportError(f"{folder}: no such folder")
    frames = os.path.join(folder, "frames.csv")
    localised = queries.read(os.path.join(folder, "localisation.csv"))
    if not os.path.isfile(frames) and not localised:
        raise ReportError(f"{frames}: no such file, nor localisation.csv; is {folder} the output of an evaluation?")
    series = read_frames(frames) if os.path.isfile(frames) else {}
    summary = read_summary(os.path.join(folder, "summary.csv"))
    return Output(
        folder=os.path.abspath(folder),
        series=series,
        queries=localised,
        shares=queries.read_intervals(os.path.join(folder, "localisation_summary.csv")),
        comparisons=comparison_rows.read(os.path.join(folder, "comparisons.csv")),
        summary=summary or {key: summarise(one) for key, one in series.items()},
        has_summary_file=bool(summary),
        run=read_yaml(os.path.join(folder, "run.yaml")),
        inputs=read_yaml(os.path.join(folder, "inputs.yaml")),
        rasterizer=read_yaml(os.path.join(folder, "rasterizer.yaml")).get("rasterizer"),
        ground_albedo=read_yaml(os.path.join(folder, "ground.yaml")).get("ground_albedo"),
        captures=read_captures(os.path.join(folder, "captures.csv")),
        path=read_path(os.path.join(folder, "path.csv")),
        map_picture=existing(os.path.join(folder, "map.png")),
        map_extent=read_extent(os.path.join(folder, "map.yaml")),
        images=find_images(os.path.join(folder, "images")),
        verified=verified_rows.read(folder),
        matches=find_images(os.path.join(folder, "matches")),
        lost=lost_rows.read(os.path.join(folder, "lost_features.csv")),
        positions=queries.read_positions(os.path.join(folder, "localisation_poses.csv")),
        problems=read_problems(folder),
        timing=[row for file in sorted(glob.glob(os.path.join(glob.escape(folder), "timing*.csv")))
                for row in rows(file, TIMING, {"count": whole, "seconds": number})],
    )


def read_problems(folder):
    """As problems.csv has them; those of localisation.csv's pictures, whose kind stands before the rest where it has one, as well."""
    problems = list(rows(os.path.join(folder, "problems.csv"), PROBLEMS, {"pose": optional_whole}))
    for row in rows(os.path.join(folder, "localisation_problems.csv"), LOCALISATION_PROBLEMS, {}):
        kind, _, reason = row["fault"].partition(": ")
        if not reason or not re.fullmatch("[a-z]+_[a-z]+|duplicate", kind):
            kind, reason = "unlocalised", row["fault"]
        problems.append({"kind": kind, "pose": None, "stamp": row["stamp"], "where": f"{row['stream']} ({row['role']})",
                         "reason": reason, "role": row["role"]})
    return problems


def read_frames(path):
    counts = ("features_a", "features_b", "matches", "zero_second")
    forms = ("symmetric", "one_to_one")
    kinds = {"pose": whole, "value": number, **{name: whole for name in counts}, **{name: number for name in forms}}
    found = by_pose(path, FRAMES, ("a", "b", "difference"), kinds, older=(OLD_FRAMES,))
    if not found:
        raise ReportError(f"{path}: holds no results")
    return {key: Series(**columns) for key, columns in found.items()}


def summarise(series):
    """Equations (1) and (2) of the paper, without an interval."""
    defined = series.value[~np.isnan(series.value)]
    mean = float(np.mean(defined)) if len(defined) else math.nan
    sd = float(np.std(defined, ddof=1)) if len(defined) > 1 else math.nan
    forms = (float(np.mean(one[~np.isnan(one)])) if not np.isnan(one).all() else math.nan
             for one in (series.symmetric, series.one_to_one))
    return Summary(len(defined), len(series.value) - len(defined), mean, sd, math.nan, math.nan, *forms)


def read_summary(path):
    kinds = {"n": whole, "undefined": whole, "mean": number, "sd": number, "ci_low": number, "ci_high": number,
             "symmetric_mean": number, "one_to_one_mean": number}
    return {(row["a"], row["b"], row["difference"]): Summary(**{name: row[name] for name in kinds if name in row})
            for row in rows(path, SUMMARY, kinds, older=(OLD_SUMMARY,))}


def columns(found, names):
    return {name: np.array([row[name] for row in found]) for name in names}


def read_captures(path):
    names = ["pose", "ev100", "sun_azimuth_deg", "sun_elevation_deg", "moon_azimuth_deg", "moon_elevation_deg",
             "moon_illuminated_fraction", "scene_illuminance"]
    streams = {}
    for row in rows(path, CAPTURES, {name: whole if name == "pose" else number for name in names}, older=OLD_CAPTURES):
        streams.setdefault(row["stream"], []).append({"exposure_mode": "", **row})
    return {stream: columns(found, [*names, "exposure_mode"]) for stream, found in streams.items()}


def read_path(path):
    names = ["pose", "x", "y", "z", "yaw_deg"]
    found = list(rows(path, PATH, {name: whole if name == "pose" else number for name in names}))
    found.sort(key=lambda row: row["pose"])
    return columns(found, names) if found else {}


def read_yaml(path):
    if not os.path.exists(path):
        return {}
    try:
        with opened(path) as file:
            content = yaml.safe_load(file)
    except UnicodeDecodeError as error:
        raise ReportError(f"{path}: byte {error.start} is no UTF-8") from None
    except ValueError as error:  # a date that is none
        raise ReportError(f"{path}: {error}") from None
    except RecursionError:
        raise ReportError(f"{path}: lists lie within each other on too many levels") from None
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        raise ReportError(f"{path}:{mark.line + 1 if mark else 1}: {getattr(error, 'problem', 'is no YAML')}") from None
    if not isinstance(content, dict):
        raise ReportError(f"{path}:1: must hold keys and values")
    return content


def read_extent(path):
    extent = read_yaml(path)
    if not extent:
        return {}
    for key in ("x_min", "x_max", "y_min", "y_max"):
        if not isinstance(extent.get(key), (int, float)):
            raise ReportError(f"{path}: {key} is {extent.get(key)!r}, but must be a number of metres")
    if not (extent["x_min"] < extent["x_max"] and extent["y_min"] < extent["y_max"]):
        raise ReportError(f"{path}: x_min must be below x_max, and y_min below y_max")
    return extent


def existing(path):
    return path if os.path.exists(path) else ""


def find_images(folder):
    """Pictures by condition, whose name may hold a slash."""
    found = {}
    for file in sorted(glob.glob(os.path.join(glob.escape(folder), "**", "*.png"), recursive=True)):
        if re.fullmatch(r"\d{6,}\.png", os.path.basename(file)):
            condition = os.path.relpath(os.path.dirname(file), folder)
            found.setdefault(condition, {})[int(os.path.basename(file)[:-4])] = file
    return found
