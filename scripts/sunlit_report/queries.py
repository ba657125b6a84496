"""localisation.csv and localisation_summary.csv: where each query was found, and how sure the shares are."""

import dataclasses

import numpy as np

from .csv_rows import by_pose, number, rows, whole

WITHIN = [(0.25, 2.0), (0.5, 5.0), (5.0, 10.0)]  # m and deg: those of visuallocalization.net and hloc
BOUNDS = [f"within_{metres:g}m_{degrees:g}deg" for metres, degrees in WITHIN]
SUMMARY = ("map,query,detector,n,failures," + ",".join(f"{name},{name}_low,{name}_high" for name in BOUNDS)
           + ",median_error_m,median_error_deg,n_relative,auc_5deg,auc_10deg,auc_20deg")
KEYS = ("map", "query", "detector")
HEADER = "pose,stamp,map,query,detector,error_m,error_deg,inliers,retrieved,status"

POSITIONS = "pose,stamp,map,query,detector,x,y,z,qx,qy,qz,qw,true_x,true_y,true_z"


@dataclasses.dataclass
class Queries:
    """Queries of one condition against one map by one detector, by rising pose. Errors of a query that found no pose
    are NaN: it is a failure and counts as one."""

    pose: np.ndarray
    error_m: np.ndarray
    error_deg: np.ndarray
    inliers: np.ndarray

    def share_within(self, metres, degrees):
        """Of all queries."""
        return float(np.mean((self.error_m <= metres) & (self.error_deg <= degrees)))

    @property
    def failures(self):
        return int(np.isnan(self.error_m).sum())


def read(path):
    """{(map, query, detector): Queries}; empty where there is no file. Raises ReportError naming file and line."""
    kinds = {"pose": whole, "error_m": number, "error_deg": number, "inliers": whole}
    return {key: Queries(**columns) for key, columns in by_pose(path, HEADER, KEYS, kinds).items()}


@dataclasses.dataclass
class Positions:
    """Where queries were found and where they were, x, y and z in columns; NaN where they were not found."""

    found: np.ndarray
    truth: np.ndarray


def read_positions(path):
    """{(map, query, detector): Positions}, by rising pose; empty where there is no file."""
    kinds = {"pose": whole, **{name: number for name in POSITIONS.split(",")[5:]}}
    return {key: Positions(np.column_stack([one[axis] for axis in "xyz"]), np.column_stack([one["true_" + axis] for axis in "xyz"]))
            for key, one in by_pose(path, POSITIONS, KEYS, kinds).items()}


def read_intervals(path):
    """{(map, query, detector): 95 % intervals of the shares within each bound}; empty where there is no file."""
    kinds = {f"{name}_{end}": number for name in BOUNDS for end in ("low", "high")}
    return {(row["map"], row["query"], row["detector"]): [(row[f"{name}_low"], row[f"{name}_high"]) for name in BOUNDS]
            for row in rows(path, SUMMARY, kinds)}
