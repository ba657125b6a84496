"""Where in the picture features are lost: a table, and maps over what the camera saw."""

import matplotlib.pyplot as plt
import numpy as np

from . import names
from .figures import STYLE, grid_of, svg
from .lost_rows import COLUMNS, ROWS
from .pictures import picture_of
from .tables import MISSING

SHOWN_PAIRS = 6
BACKGROUND_WIDTH = 320  # px
TABLE_HEADER = ["pair", "detector", "poses", "features", "lost", "lost / %"]


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
