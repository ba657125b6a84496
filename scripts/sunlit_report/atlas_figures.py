"""Heat maps of an atlas: a map a row, a query a column, the sun's elevation and the illuminance along both axes."""

import copy
import io
import math

import matplotlib.pyplot as plt
import numpy as np
from matplotlib import colors, ticker

from . import names
from .figures import STYLE
from .localisation import LOST, PARTLY, SOME_SHARE, USABLE, USABLE_SHARE, USABLE_WITHIN
from .queries import BOUNDS, WITHIN

DOTS_PER_INCH = 200
DAY, TWILIGHT, NIGHT = "#FFF3CF", "#B9C6DE", "#5E6C8C"
SUN, LUX = "#C1440E", "#1B3A5C"
DARKEST_LX = 1e-3  # a moonless night; the axis begins there
NO_POSE = "#D6D6D6"
LEAST_ERROR_M = 1e-3  # a query that finds its own picture in the map errs by rounding alone
TICKS_H = (1, 2, 3, 4, 6, 12)
MOST_TICKS = 13
MOST_HOURS = 26  # of several days, whose names stand below


def _percent(matrix):
    return 100.0 * matrix


def _same(matrix):
    return matrix


# Column, name of the file, title, what the colour bar says, how a number is shown, least and greatest, colours.
METRICS = [
    *((bound, f"recall_{bound[len('within_'):]}", f"queries found within {metres:g} m and {degrees:g}°", "queries / %", _percent,
       0.0, 100.0, "viridis") for bound, (metres, degrees) in zip(BOUNDS, WITHIN)),
    ("median_error_m", "median_error", "median error of the position", "error / m", _same, None, None, "plasma_r"),
    ("d", "difference", "difference of features, D", "D", _same, None, 1.0, "magma_r"),
    ("matching_score_3px", "matching_score", "matching score (3 px)", "features / %", _percent, 0.0, 100.0, "viridis"),
]


def png(figure):
    content = io.BytesIO()
    figure.savefig(content, format="png", dpi=DOTS_PER_INCH, bbox_inches="tight", pad_inches=0.06, metadata={"Software": None})
    plt.close(figure)
    return content.getvalue()


def _evenly(conditions, places):
    """Those of `places` at full hours that divide the day evenly; all of them where no such hours are few enough."""
    for step in TICKS_H:
        found = [index for index in places if abs(conditions.hours[index] / step - round(conditions.hours[index] / step)) < 1e-9]
        if 2 <= len(found) <= MOST_TICKS:
            return found
    return places[::-(-len(places) // MOST_TICKS)]


def _ticks(conditions):
    """Places and labels: hours of a day; of several days with one time each the days; else hours of each day."""
    places = list(range(len(conditions)))
    if len(conditions.dates) == 1:
        places = _evenly(conditions, places)
    elif len(conditions.dates) == len(conditions):
        places = places[::-(-len(places) // MOST_TICKS)]
        return places, [conditions.date[index] for index in places]
    elif len(conditions) > MOST_HOURS:
        places = [first for first, _ in _days(conditions)]
    return places, [_hour(conditions, index) for index in places]


def _hour(conditions, index):
    return conditions.time[index] if conditions.hours[index] % 1 else f"{conditions.hours[index]:.0f}"


def _days(conditions):
    """First and last place of each day, where days have several times; else nothing."""
    if len(conditions.dates) in (1, len(conditions)):
        return []
    breaks = [0] + [round(place + 0.5) for place in _day_breaks(conditions)] + [len(conditions)]
    return [(first, end - 1) for first, end in zip(breaks, breaks[1:])]


def _axis_name(conditions, what):
    return f"day of the {what}" if len(conditions.dates) == len(conditions) > 1 else f"hour of the {what}"


def _day_breaks(conditions):
    """Places between two days."""
    return [index - 0.5 for index in range(1, len(conditions)) if conditions.date[index] != conditions.date[index - 1]]


def _shade(axis, elevations, along_x):
    span = axis.axvspan if along_x else axis.axhspan
    for index, elevation in enumerate(elevations):
        colour = DAY if elevation > 0 else TWILIGHT if elevation > -18 else NIGHT
        span(index - 0.5, index + 0.5, color=colour, linewidth=0, zorder=0)


def _draw_curve(axis, conditions, values, colour, along_x):
    """A line through a day; one of few times shows its points, and one for each of several days these alone."""
    for first, last in _days(conditions) or [(0, len(values) - 1)]:
        index = np.arange(first, last + 1)
        x, y = (index, values[index]) if along_x else (values[index], index)
        width = 0.0 if len(conditions.dates) == len(conditions) > 1 else 1.3
        axis.plot(x, y, color="white", linewidth=2 * width, zorder=2)
        axis.plot(x, y, color=colour, linewidth=width, zorder=3, marker="o" if last - first < 9 else None, markersize=2.2)


def _strip(axis, conditions, which, along_x):
    """Elevation or illuminance along one axis of the matrix."""
    _shade(axis, conditions.sun_elevation_deg, along_x)
    values_axis = axis.yaxis if along_x else axis.xaxis
    if which == "sun":
        _draw_curve(axis, conditions, conditions.sun_elevation_deg, SUN, along_x)
        (axis.axhline if along_x else axis.axvline)(0.0, color=SUN, linewidth=0.5, zorder=1)
        values_axis.set_major_locator(ticker.MultipleLocator(45))
        values_axis.set_major_formatter(ticker.FormatStrFormatter("%d°"))
    else:
        (axis.set_yscale if along_x else axis.set_xscale)("log")
        _draw_curve(axis, conditions, np.maximum(conditions.illuminance_lx, DARKEST_LX), LUX, along_x)
        (axis.set_ylim if along_x else axis.set_xlim)(DARKEST_LX / 2, 3e5)
        values_axis.set_major_locator(ticker.FixedLocator([1e-2, 1e1, 1e4]))
        values_axis.set_minor_locator(ticker.NullLocator())
    name = "sun" if which == "sun" else "light / lx"
    colour = SUN if which == "sun" else LUX
    if along_x:
        axis.set_ylabel(name, color=colour, fontsize=7)
    else:
        axis.set_xlabel(name, color=colour, fontsize=7)
    axis.tick_params(axis="both", length=0, labelsize=6)
    axis.tick_params(axis="x" if along_x else "y", labelbottom=False, labelleft=False)
    axis.tick_params(axis="y" if along_x else "x", length=2, labelcolor=colour)
    axis.grid(False)
    for side in ("top", "right", "left", "bottom"):
        axis.spines[side].set_visible(True)
        axis.spines[side].set_linewidth(0.4)
    if not along_x:
        for label in axis.get_xticklabels():
            label.set_rotation(90)


def _frame(conditions):
    """Figure, axis of the matrix, and that of the colour bar."""
    figure = plt.figure(figsize=(5.6, 5.1))
    grid = figure.add_gridspec(3, 4, width_ratios=[10, 1.15, 1.15, 0.42], height_ratios=[1.15, 1.15, 10], wspace=0.06, hspace=0.06)
    matrix = figure.add_subplot(grid[2, 0])
    for row, which in ((1, "sun"), (0, "light")):
        _strip(figure.add_subplot(grid[row, 0], sharex=matrix), conditions, which, along_x=True)
    for column, which in ((1, "sun"), (2, "light")):
        _strip(figure.add_subplot(grid[2, column], sharey=matrix), conditions, which, along_x=False)
    return figure, matrix, figure.add_subplot(grid[2, 3])


def _finish_matrix(axis, conditions):
    places, labels = _ticks(conditions)
    long = max(len(label) for label in labels) > 5
    axis.set_xticks(places)
    axis.set_xticklabels(labels, rotation=45 if long else 0, ha="right" if long else "center")
    axis.set_yticks(places)
    axis.set_yticklabels(labels)
    axis.set_xlabel(_axis_name(conditions, "query"), labelpad=16 if _days(conditions) else 4)
    axis.set_ylabel(_axis_name(conditions, "map"), labelpad=22 if _days(conditions) else 4)
    for first, last in _days(conditions):
        name = {"fontsize": 7, "color": "#333333", "annotation_clip": False, "textcoords": "offset points"}
        axis.annotate(conditions.date[first], ((first + last) / 2, 0), xycoords=("data", "axes fraction"), xytext=(0, -17),
                      ha="center", va="top", **name)
        axis.annotate(conditions.date[first], (0, (first + last) / 2), xycoords=("axes fraction", "data"), xytext=(-20, 0),
                      ha="right", va="center", rotation=90, **name)
    axis.set_xlim(-0.5, len(conditions) - 0.5)
    axis.set_ylim(-0.5, len(conditions) - 0.5)
    axis.grid(False)
    for place in _day_breaks(conditions):
        axis.axvline(place, color="white", linewidth=1.2)
        axis.axhline(place, color="white", linewidth=1.2)
    for side in ("top", "right"):
        axis.spines[side].set_visible(True)


def _title(figure, axis, method, what):
    box = axis.get_position()
    figure.text(box.x0, 0.925, names.method(method), fontsize=12, fontweight="bold", ha="left")
    figure.text(box.x0, 0.895, what, fontsize=8.5, color="#444444", ha="left")


def _least_between(matrices):
    """Of different lights, in tenths: on the diagonal pictures are the same, and D is about 0."""
    between = np.concatenate([matrix[~np.eye(len(matrix), dtype=bool)] for matrix in matrices])
    between = between[np.isfinite(between)]
    return min(0.9, math.floor(10 * between.min()) / 10) if len(between) else 0.0


def _norm(matrices, low, high):
    """The same for all methods. Errors go by the order of magnitude, over those that are there."""
    values = np.concatenate([matrix.ravel() for matrix in matrices])
    if high is not None:
        return colors.Normalize(low if low is not None else _least_between(matrices), high)
    finite = values[np.isfinite(values)]
    low = max(LEAST_ERROR_M, float(finite.min())) if len(finite) else LEAST_ERROR_M
    high = float(finite.max()) if len(finite) else 0.0
    return colors.LogNorm(low, max(high, 10 * low))


def heat_map(atlas, method, metric):
    """As PNG."""
    column, _, title, unit, shown, low, high, palette = metric
    values = shown(atlas.matrices[method][column])
    with plt.rc_context(STYLE):
        figure, axis, bar = _frame(atlas.conditions)
        norm = _norm([shown(of_method[column]) for of_method in atlas.matrices.values()], low, high)
        palette = copy.copy(plt.get_cmap(palette))  # before 3.4 they have no copy() of their own
        palette.set_bad(NO_POSE)
        axis.set_facecolor(NO_POSE)
        masked = np.ma.masked_invalid(values)
        picture = axis.imshow(masked, origin="lower", norm=norm, cmap=palette, aspect="auto", interpolation="nearest")
        if column == BOUNDS[WITHIN.index(USABLE_WITHIN)] and len(values) > 2:
            _outline(axis, values >= 100 * USABLE_SHARE)
            title += f"; outlined: at least {100 * USABLE_SHARE:.0f} %"
        _finish_matrix(axis, atlas.conditions)
        bar.grid(False)
        figure.colorbar(picture, cax=bar, extend="min" if low is None and (values < norm.vmin).any() else "neither")
        bar.set_ylabel(unit)
        if column == "median_error_m":
            bar.yaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
            bar.yaxis.set_minor_formatter(ticker.NullFormatter())
        if np.isinf(values).any():
            title += "; grey: half of them or more have no pose"
        elif np.isnan(values).any():
            title += "; grey: undefined"
        _title(figure, axis, method, title)
        return png(figure)


def _outline(axis, chosen):
    """A white line around cells, from edge to edge."""
    padded = np.pad(chosen, 1)
    for row, column in np.argwhere(padded[1:, :] != padded[:-1, :]):
        axis.plot([column - 1.5, column - 0.5], [row - 0.5] * 2, color="white", linewidth=1.4, solid_capstyle="projecting")
    for row, column in np.argwhere(padded[:, 1:] != padded[:, :-1]):
        axis.plot([column - 0.5] * 2, [row - 1.5, row - 0.5], color="white", linewidth=1.4, solid_capstyle="projecting")


def usable_shares(atlas, method):
    return atlas.matrices[method][BOUNDS[WITHIN.index(USABLE_WITHIN)]]


def usable_hours(atlas):
    """As PNG: a panel for each method, a band for each map, green where it serves."""
    methods, conditions = atlas.methods, atlas.conditions
    palette = colors.ListedColormap([LOST, PARTLY, USABLE])
    norm = colors.BoundaryNorm([0.0, SOME_SHARE, USABLE_SHARE, 1.0 + 1e-9], 3)
    with plt.rc_context(STYLE):
        columns = min(3, math.ceil(math.sqrt(len(methods)))) if len(methods) > 3 else len(methods)
        lines = -(-len(methods) // columns)
        figure, axes = plt.subplots(lines, columns, squeeze=False, sharex=True, sharey=True, constrained_layout=True,
                                    figsize=(0.6 + 3.3 * columns, 0.7 + 3.2 * lines))
        for spare in axes.flat[len(methods):]:
            spare.set_visible(False)
        for axis, method in zip(axes.flat, methods):
            axis.imshow(usable_shares(atlas, method), origin="lower", cmap=palette, norm=norm, aspect="equal",
                        interpolation="nearest")
            _finish_matrix(axis, conditions)
            axis.set_title(names.method(method), loc="left")
            for line in range(1, len(conditions)):
                axis.axhline(line - 0.5, color="white", linewidth=0.8 if len(conditions) <= 30 else 0.4)
        for number, axis in enumerate(axes.flat[:len(methods)]):
            below, beside = number + columns >= len(methods), number % columns == 0
            axis.tick_params(labelbottom=below, labelleft=beside)
            for text in axis.texts:
                text.set_visible(below if text.get_rotation() == 0 else beside)
            if not below:
                axis.set_xlabel("")
            if not beside:
                axis.set_ylabel("")
        some = f"{100 * SOME_SHARE:.0f} to {100 * USABLE_SHARE:.0f} %"
        patches = [(USABLE, f"at least {100 * USABLE_SHARE:.0f} % found within 0.5 m and 5°"), (PARTLY, some),
                   (LOST, f"fewer than {100 * SOME_SHARE:.0f} %")]
        figure.legend([plt.Rectangle((0, 0), 1, 1, color=colour) for colour, _ in patches], [text for _, text in patches],
                      loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=3 if columns > 1 else 1)
        return png(figure)
