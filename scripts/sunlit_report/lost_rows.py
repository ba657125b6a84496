"""lost_features.csv: where in the picture features have no right match."""

import dataclasses

import numpy as np

from .csv_rows import ReportError, rows, whole

HEADER = "a,b,detector,poses,column,row,features,lost"
COLUMNS, ROWS = 16, 12
LEAST_FEATURES = 10  # of fewer in all poses together a share says nothing


@dataclasses.dataclass
class Lost:
    """Of one pair and detector, summed over the poses; arrays of ROWS by COLUMNS."""

    poses: int
    features: np.ndarray
    lost: np.ndarray

    @property
    def share(self):
        """NaN where there are too few features."""
        return np.where(self.features >= LEAST_FEATURES, self.lost / np.maximum(self.features, 1), np.nan)

    @property
    def share_of_all(self):
        """NaN where there are no features, as in black pictures."""
        features = self.features.sum()
        return float(self.lost.sum() / features) if features else np.nan


def read(path):
    """{(a, b, detector): Lost}; empty where there is no file. Raises ReportError naming file and line."""
    found = {}
    kinds = {name: whole for name in ("poses", "column", "row", "features", "lost")}
    for line, row in enumerate(rows(path, HEADER, kinds), start=2):
        if not (0 <= row["column"] < COLUMNS and 0 <= row["row"] < ROWS and 0 <= row["lost"] <= row["features"]):
            raise ReportError(f"{path}:{line}: column, row and lost must be below {COLUMNS}, {ROWS} and features")
        key = (row["a"], row["b"], row["detector"])
        one = found.get(key)
        if one is None:
            one = found[key] = Lost(row["poses"], np.zeros((ROWS, COLUMNS)), np.zeros((ROWS, COLUMNS)))
        one.features[row["row"], row["column"]] = row["features"]
        one.lost[row["row"], row["column"]] = row["lost"]
    return found
