"""Plots as SVG text: D over the path, box plots and the map."""

import io

import matplotlib

matplotlib.rcdefaults()  # not by a matplotlibrc of the user's: LaTeX and other layouts break figures
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend must be chosen first)
import numpy as np  # noqa: E402
from matplotlib import ticker  # noqa: E402

from . import names  # noqa: E402

# Okabe and Ito's colours, told apart by colour-blind readers.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]
SMOOTHED_OVER = 25  # poses of the running median

STYLE = {
    "font.family": "DejaVu Sans", "font.size": 8, "axes.titlesize": 9, "axes.titleweight": "bold",
    "axes.linewidth": 0.6, "axes.spines.top": False, "axes.spines.right": False,
    "axes.edgecolor": "#555555", "xtick.color": "#333333", "ytick.color": "#333333", "xtick.major.width": 0.6,
    "ytick.major.width": 0.6, "axes.formatter.useoffset": False, "axes.grid": True, "grid.color": "#e4e4e4", "grid.linewidth": 0.6,
    "legend.frameon": False, "svg.fonttype": "path", "svg.hashsalt": "sunlit", "path.simplify": True,
}


def svg(figure):
    text = io.StringIO()
    figure.savefig(text, format="svg", bbox_inches="tight", pad_inches=0.03, metadata={"Date": None})
    plt.close(figure)
    return text.getvalue()


def colour_of(index):
    return COLOURS[index % len(COLOURS)]


def distance_along(path):
    """Metres driven until each pose of path.csv."""
    return np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(path["x"]), np.diff(path["y"])))])


def distance_driven(output):
    """Metres from the first evaluated pose to the last: path.csv also has poses that were left out."""
    evaluated = np.isin(output.path["pose"], output.poses)
    along = distance_along(output.path)[evaluated]
    return along[-1] - along[0] if len(along) else 0.0


def _abscissa(output, poses):
    """A function from these poses to where they stand on the axis, and the axis' name."""
    known = output.path.get("pose")
    if known is None or not np.isin(poses, known).all():
        return (lambda pose: pose.astype(float)), "pose"
    along = distance_along(output.path)
    return (lambda pose: along[np.searchsorted(known, pose)]), "distance along the path / m"


def running_median(values, width):
    """Median of the defined values within half a width on either side; NaN where there is none."""
    padded = np.concatenate([np.full(width // 2, np.nan), values, np.full(width - 1 - width // 2, np.nan)])
    windows = padded[np.arange(len(values))[:, None] + np.arange(width)]
    result = np.full(len(values), np.nan)
    defined = ~np.isnan(windows).all(axis=1)
    result[defined] = np.nanmedian(windows[defined], axis=1)
    return result


def grid_of(count, columns, panel_size):
    rows = -(-count // columns)
    figure, axes = plt.subplots(rows, columns, squeeze=False, constrained_layout=True,
                                figsize=(columns * panel_size[0], rows * panel_size[1]))
    for spare in axes.flat[count:]:
        spare.set_visible(False)
    return figure, axes.flat[:count]


def _draw_series(axis, x, series, colour, label):
    width = min(SMOOTHED_OVER, max(1, len(x) // 8))
    axis.plot(x, series.value, color=colour, linewidth=0.5, alpha=0.35)
    axis.plot(x, running_median(series.value, width), color=colour, linewidth=1.3, label=label)
    undefined = np.isnan(series.value)
    if undefined.any():
        axis.plot(x[undefined], np.zeros(undefined.sum()), "|", color=colour, markersize=7, clip_on=False,
                  transform=axis.get_xaxis_transform())


def panels_over_path(output, along, shown, draw):
    """A panel for each name that is shown, over the path of all that lies `along` it; draw(axis, name, to_x) fills one."""
    to_x, x_name = _abscissa(output, np.unique(np.concatenate([one.pose for one in along])))
    with plt.rc_context(STYLE):
        columns = 2 if len(shown) > 1 else 1
        figure, axes = grid_of(len(shown), columns, (4.6, 1.75))
        for index, (axis, name) in enumerate(zip(axes, shown)):
            draw(axis, name, to_x)
            axis.set_title(names.difference(name), loc="left")
            axis.margins(x=0.01)
            if index >= len(shown) - columns:
                axis.set_xlabel(x_name)
        legend_above(figure, axes)
        return svg(figure)


def by_powers_of_ten(axis):
    """A logarithmic y axis that names plain numbers, and 2 and 5 between the powers where these are few."""
    axis.set_yscale("log")
    plain = ticker.FuncFormatter(lambda value, _: f"{value:g}")
    lowest, highest = axis.get_ylim()
    between = (2.0, 5.0) if highest < 1e3 * lowest else ()
    axis.yaxis.set_major_formatter(plain)
    axis.yaxis.set_minor_locator(ticker.LogLocator(subs=between) if between else ticker.NullLocator())
    axis.yaxis.set_minor_formatter(plain)


def along_path(output, pairs):
    """D over the path, one panel per algorithm."""

    def draw(axis, difference, to_x):
        for number, (a, b) in enumerate(pairs):
            series = output.series.get((a, b, difference))
            if series is not None:
                _draw_series(axis, to_x(series.pose), series, colour_of(number), names.pair(a, b))
        axis.set_ylabel("D")

    return panels_over_path(output, output.series.values(), output.differences, draw)


def legend_above(figure, axes):
    found = {}
    for axis in axes:
        for handle, label in zip(*axis.get_legend_handles_labels()):
            found.setdefault(label, handle)
    if found:
        figure.legend(found.values(), found.keys(), loc="lower center", bbox_to_anchor=(0.5, 1.0),
                      ncol=min(len(found), 8))


def boxes(output, pairs):
    """Quartiles of D, one panel per algorithm."""
    with plt.rc_context(STYLE):
        differences = output.differences
        columns = min(len(differences), 4 if len(pairs) <= 6 else 2)
        figure, axes = grid_of(len(differences), columns, (9.2 / max(columns, 2), 1.9))
        for axis, difference in zip(axes, differences):
            drawn = []
            for number, (a, b) in enumerate(pairs):
                series = output.series.get((a, b, difference))
                values = series.value[~np.isnan(series.value)] if series is not None else np.array([])
                if len(values):
                    drawn.append((number, values))
            if drawn:
                _draw_boxes(axis, drawn, [names.pair(*pair) for pair in pairs])
            axis.set_title(names.difference(difference), loc="left")
            axis.grid(False, axis="x")
        for axis in list(axes)[::columns]:
            axis.set_ylabel("D")
        return svg(figure)


def _draw_boxes(axis, drawn, labels):
    line = {"linewidth": 0.8}
    plot = axis.boxplot([values for _, values in drawn], positions=[number for number, _ in drawn], widths=0.55,
                        patch_artist=True, boxprops=line, whiskerprops=line, capprops=line, showmeans=True,
                        medianprops={"color": "black", "linewidth": 1},
                        meanprops={"marker": "D", "markersize": 3, "markerfacecolor": "white",
                                   "markeredgecolor": "black", "markeredgewidth": 0.6},
                        flierprops={"marker": ".", "markersize": 1.5, "markeredgecolor": "#888888"})
    for box, (number, _) in zip(plot["boxes"], drawn):
        box.set_facecolor(colour_of(number) + "66")
    axis.set_xticks(range(len(labels)))
    crowded = len(labels) > 3 or any(len(label) > 9 for label in labels)
    axis.set_xticklabels(labels, rotation=35 if crowded else 0, ha="right" if crowded else "center",
                         fontsize=7)
