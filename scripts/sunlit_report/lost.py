"""lost_features.csv: where in the picture features have no right match."""

import dataclasses

import matplotlib.pyplot as plt
import numpy as np

from . import names
from .csv_rows import ReportError, rows, whole
from .figures import STYLE, grid_of, svg
from .pictures import picture_of
from .tables import MISSING

HEADER = "a,b,detector,poses,column,row,features,lost"
COLUMNS, ROWS = 16, 12
SHOWN_PAIRS = 6
LEAST_FEATURES = 10  # of fewer in all poses together a share says nothing
BACKGROUND_WIDTH = 320  # px
TABLE_HEADER = ["pair", "detector", "poses", "features", "lost", "lost / %"]


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


def shown_pairs(lost):
    """Those that lose most, in the order of the file."""
    shares = {}
    for (a, b, _), one in lost.items():
        shares[a, b] = np.fmax(shares.get((a, b), 0.0), one.share_of_all)
    most = sorted(shares, key=lambda pair: -shares[pair])[:SHOWN_PAIRS]
    return [pair for pair in shares if pair in most]


def table_rows(output):
    shown = set(shown_pairs(output.lost))
    return [[names.pair(a, b), names.difference(detector), str(one.poses), f"{one.features.sum():.0f}", f"{one.lost.sum():.0f}",
             MISSING if np.isnan(one.share_of_all) else f"{100 * one.share_of_all:.1f}"]
            for (a, b, detector), one in output.lost.items() if (a, b) in shown]


def _background(output, stream):
    """Mean of the kept pictures, grey and pale; None where there are none."""
    total, count = None, 0
    for file in output.images.get(stream, {}).values():
        picture = picture_of(file, "L")
        picture = picture.resize((BACKGROUND_WIDTH, round(BACKGROUND_WIDTH * picture.height / picture.width)))
        values = np.asarray(picture, dtype=float)
        if total is None or total.shape == values.shape:
            total, count = values if total is None else total + values, count + 1
        if count == 20:  # more make it no clearer
            break
    return None if total is None else np.rint(total / count).astype(np.uint8)


def heat_maps(output):
    """A panel for each pair and detector: the share that is lost, over what the camera saw on the whole."""
    pairs = shown_pairs(output.lost)
    detectors = list(dict.fromkeys(key[2] for key in output.lost))
    wanted = [(a, b, detector) for a, b in pairs for detector in detectors if (a, b, detector) in output.lost]
    backgrounds = {a: _background(output, a) for a, _ in pairs}
    columns = min(len(wanted), 4 if len(detectors) % 2 == 0 else 3)
    with plt.rc_context({**STYLE, "axes.grid": False, "axes.titlesize": 7.5}):
        heights = [ROWS / COLUMNS if one is None else one.shape[0] / one.shape[1] for one in backgrounds.values()]
        width = 9.2 / max(columns, 3)
        figure, axes = grid_of(len(wanted), columns, (width, width * max(heights) + 0.3))
        for axis, (a, b, detector) in zip(axes, wanted):
            heat = _draw_heat(axis, output.lost[a, b, detector], backgrounds[a])
            share = output.lost[a, b, detector].share_of_all
            told = "no features" if np.isnan(share) else f"{100 * share:.0f} % lost"
            axis.set_title(f"{names.pair(a, b)}, {names.difference(detector)}: {told}", loc="left")
        bar = figure.colorbar(heat, ax=list(axes), location="top", fraction=0.12, aspect=60, shrink=0.6, pad=0.02)
        bar.set_label("share of features without a right match", fontsize=7)
        bar.ax.tick_params(labelsize=6.5)
        bar.solids.set_alpha(1)
        return svg(figure)


def _draw_heat(axis, one, behind):
    height = ROWS / COLUMNS if behind is None else behind.shape[0] / behind.shape[1]
    extent = (0, 1, height, 0)
    if behind is not None:
        axis.imshow(behind, cmap="gray", vmin=-160, vmax=255, extent=extent)  # pale, so that colours stand out
    axis.set_xticks([])
    axis.set_yticks([])
    for side in axis.spines.values():
        side.set_visible(False)
    return axis.imshow(one.share, cmap="YlOrRd", vmin=0, vmax=1, alpha=0.6, extent=extent, interpolation="nearest")
