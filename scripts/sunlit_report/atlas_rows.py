"""atlas.csv and conditions.csv: what a map of each light is worth under each other."""

import dataclasses
import functools
import os

import numpy as np

from .csv_rows import ReportError, number, rows, whole
from .queries import BOUNDS

MEASURES = ["d", "matching_score_3px", "precision_3px"]
HEADER = ("map,query,method,n,failures," + ",".join(f"{name},{name}_low,{name}_high" for name in BOUNDS)
          + ",median_error_m,median_error_deg," + ",".join(f"{name},{name}_low,{name}_high,{name}_undefined" for name in MEASURES))
CONDITIONS = "condition,date,time,sun_azimuth_deg,sun_elevation_deg,illuminance_lx,ev100_mean"
# Kept as matrices, a map a row and a query a column.
SHOWN = ["n", "failures", *BOUNDS, "median_error_m", "median_error_deg", *MEASURES]


def number_or_infinity(text):
    """Half of the queries of a cell may have no pose: then the median error is infinite."""
    return float(text)


@dataclasses.dataclass
class Conditions:
    """Lights, in the order of the file; a list or array each."""

    name: list
    date: list
    time: list  # "04:30"
    sun_elevation_deg: np.ndarray
    illuminance_lx: np.ndarray
    ev100_mean: np.ndarray

    def __len__(self):
        return len(self.name)

    @functools.cached_property
    def hours(self):
        """Of the day, as numbers."""
        return [sum(float(part) / 60**place for place, part in enumerate(text.split(":"))) for text in self.time]

    @functools.cached_property
    def dates(self):
        return list(dict.fromkeys(self.date))

    def called(self, index):
        """As short as can be told apart."""
        if len(self.dates) == 1:
            return self.time[index]
        return self.date[index] if len(self.dates) == len(self) else f"{self.date[index]} {self.time[index]}"


@dataclasses.dataclass
class Atlas:
    folder: str
    conditions: Conditions
    matrices: dict  # method -> {column of SHOWN: matrix[map][query]}
    settings: list  # lines of atlas.txt

    @property
    def methods(self):
        return list(self.matrices)


def is_atlas(folder):
    return os.path.exists(os.path.join(folder, "atlas.csv"))


def _conditions(path):
    kinds = {name: number for name in ("sun_azimuth_deg", "sun_elevation_deg", "illuminance_lx", "ev100_mean")}
    found = list(rows(path, CONDITIONS, kinds))
    if not found:
        raise ReportError(f"{path}: there are no conditions")
    texts = [[row[name] for row in found] for name in ("condition", "date", "time")]
    numbers = [np.array([row[name] for row in found]) for name in ("sun_elevation_deg", "illuminance_lx", "ev100_mean")]
    return Conditions(*texts, *numbers)


def read(folder):
    """Raises ReportError naming file and line, also for a cell that is missing or there twice."""
    conditions = _conditions(os.path.join(folder, "conditions.csv"))
    place = {name: index for index, name in enumerate(conditions.name)}
    path = os.path.join(folder, "atlas.csv")
    kinds = {name: number_or_infinity for name in SHOWN}
    kinds.update(n=whole, failures=whole)
    matrices = {}
    for line, row in enumerate(rows(path, HEADER, kinds), start=2):
        of_method = matrices.get(row["method"])
        if of_method is None:
            of_method = matrices[row["method"]] = {name: np.full((len(place),) * 2, np.nan) for name in SHOWN}
        if row["map"] not in place or row["query"] not in place:
            raise ReportError(f"{path}:{line}: {row['map']} or {row['query']} is not in conditions.csv")
        at = place[row["map"]], place[row["query"]]
        if not np.isnan(of_method["n"][at]):
            raise ReportError(f"{path}:{line}: {row['query']} in the map of {row['map']} by {row['method']} stands there twice")
        for name in SHOWN:
            of_method[name][at] = row[name]
    for method, of_method in matrices.items():
        if np.isnan(of_method["n"]).any():
            raise ReportError(f"{path}: cells of {method} are missing")
    if not matrices:
        raise ReportError(f"{path}: there are no cells")
    return Atlas(folder, conditions, matrices, _settings(os.path.join(folder, "atlas.txt")))


def _settings(path):
    if not os.path.exists(path):
        return []
    with open(path, encoding="utf-8", errors="replace") as file:
        return [line.rstrip("\n") for line in file if not line.startswith("#")]
