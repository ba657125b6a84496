"""The path on the world from above, like the paper's Fig. 2."""

import math

import matplotlib.pyplot as plt
import numpy as np
from matplotlib import patheffects
from matplotlib.collections import LineCollection
from PIL import Image

from . import names
from .choice import evenly_spread
from .figures import STYLE, distance_along, grid_of, legend_above, svg
from .localisation import LOST, USABLE
from .pictures import picture_of
from .queries import WITHIN

LARGEST_SIDE = 1400  # px of the picture of the world
SHOWN_HOURS = 6
NEAR_M = WITHIN[1][0]
PARTLY_DARK = "#D98C00"  # a line in the colour of partly usable hours would hardly be seen
HALO = [patheffects.withStroke(linewidth=2.5, foreground="white")]


def path_on_map(output):
    """SVG text; needs a path. Without a picture of the world the path stands on white."""
    x, y = output.path["x"], output.path["y"]
    with plt.rc_context({**STYLE, "axes.grid": False}):
        left, right, bottom, top = _extent(output, x, y)
        width, height = right - left, top - bottom
        scale = min(8.0 / width, 6.5 / height)
        figure, axis = plt.subplots(figsize=(width * scale + 0.5, height * scale + 0.5))
        if output.map_picture and output.map_extent:
            axis.imshow(_picture(output.map_picture), extent=(left, right, bottom, top), interpolation="none")
        axis.set_xlim(left, right)
        axis.set_ylim(bottom, top)
        _draw_path(axis, x, y, distance_along(output.path))
        axis.set_aspect("equal")
        axis.set_xlabel("x, east / m")
        axis.set_ylabel("y, north / m")
        _draw_scale_bar(axis, width)
        _draw_compass(axis, output)
        return svg(figure)


def found_on_map(output):
    """Where the queries of each hour were found, a panel for each hour and method: SVG text, and the hours shown."""
    hours = list(dict.fromkeys(key[:2] for key in output.positions))
    shown = evenly_spread(hours, SHOWN_HOURS)
    keys = [key for pair in shown for key in output.positions if key[:2] == pair]
    columns = min(len(keys), max(1, len({key[2] for key in output.positions if key[:2] in shown})), 3)
    truth = np.concatenate([one.truth[:, :2] for one in output.positions.values()])
    with plt.rc_context({**STYLE, "axes.grid": False}):
        left, right, bottom, top = _around(truth)
        shape = np.clip((top - bottom) / (right - left), 0.3, 1.2)
        width = 9.2 / max(columns, 2)
        figure, axes = grid_of(len(keys), columns, (width, width * shape + 0.35))
        picture = _picture(output.map_picture, 500) if output.map_picture and output.map_extent else None
        for index, (axis, key) in enumerate(zip(axes, keys)):
            if picture is not None:
                axis.imshow(255 - (255 - picture) // 3, extent=_extent(output, *truth.T), interpolation="none")
            _draw_found(axis, output.positions[key])
            axis.set_xlim(left, right)
            axis.set_ylim(bottom, top)
            axis.set_aspect("equal")
            axis.set_title(f"{names.condition(key[1])} in the map of {names.condition_of_map(key[0])}, {names.difference(key[2])}", loc="left")
            axis.tick_params(labelsize=6)
            if index % columns == 0:
                axis.set_ylabel("y, north / m")
            if index >= len(keys) - columns:
                axis.set_xlabel("x, east / m")
        legend_above(figure, axes)
        return svg(figure), len(shown), len(hours)


def _around(places):
    low, high = places.min(axis=0), places.max(axis=0)
    margin = 0.08 * max(*(high - low), 10.0)
    # At least a third as wide as high and the other way round, so that a straight path is no line.
    least = max(high - low) / 3
    grown = np.maximum(least - (high - low), 0) / 2 + margin
    return low[0] - grown[0], high[0] + grown[0], low[1] - grown[1], high[1] + grown[1]


def _draw_found(axis, positions):
    error = np.linalg.norm(positions.found - positions.truth, axis=1)  # as error_m, with the height
    truth, found = positions.truth[:, :2], positions.found[:, :2]
    lost = np.isnan(error)
    near = error <= NEAR_M
    axis.plot(*truth.T, color="#777777", linewidth=0.7, label="true path", zorder=1)
    far = ~lost & ~near
    if far.any():
        axis.add_collection(LineCollection(np.stack((truth[far], found[far]), axis=1), colors=PARTLY_DARK, linewidths=0.6, zorder=2,
                                           label="from the truth to an estimate further off"))
    axis.plot(*found[far].T, ".", color=PARTLY_DARK, markersize=3, zorder=3)
    axis.plot(*found[near].T, ".", color=USABLE, markersize=3, label=f"found within {NEAR_M:g} m", zorder=4)
    axis.plot(*truth[lost].T, "x", color=LOST, markersize=4, markeredgewidth=0.9, label="no pose found, at the true place", zorder=5)


def _picture(file, largest_side=LARGEST_SIDE):
    picture = picture_of(file, "RGB")
    picture.thumbnail((largest_side, largest_side), Image.LANCZOS)
    return np.asarray(picture)


def _extent(output, x, y):
    if output.map_picture and output.map_extent:
        return tuple(float(output.map_extent[key]) for key in ("x_min", "x_max", "y_min", "y_max"))
    margin = 0.08 * max(np.ptp(x), np.ptp(y), 10.0)
    return x.min() - margin, x.max() + margin, y.min() - margin, y.max() + margin


def _draw_path(axis, x, y, along):
    axis.plot(x, y, color="white", linewidth=3.2, alpha=0.9, solid_joinstyle="round")
    axis.plot(x, y, color="#C1121F", linewidth=1.5, solid_joinstyle="round")
    extent = max(np.ptp(axis.get_xlim()), np.ptp(axis.get_ylim()))
    arrows = min(12, int(along[-1] / (0.08 * extent)))
    for at in np.linspace(0, along[-1], arrows + 2)[1:-1]:
        k = min(max(int(np.searchsorted(along, at)), 1), len(x) - 1)
        heading = math.degrees(math.atan2(y[k] - y[k - 1], x[k] - x[k - 1]))
        axis.plot(x[k], y[k], marker=(3, 0, heading - 90), color="#C1121F", markersize=9, markeredgecolor="white",
                  markeredgewidth=0.8)
    middle = np.mean(axis.get_xlim())
    gap = math.hypot(x[-1] - x[0], y[-1] - y[0])
    if gap < 0.03 * max(np.ptp(x), np.ptp(y)):
        _mark(axis, (x[0], y[0]), "start and end", "o", x[0] > middle)
        return
    # Labels of near marks point away from each other, others towards the middle.
    is_near = gap < 0.15 * extent
    _mark(axis, (x[0], y[0]), "start", "o", x[0] < x[-1] if is_near else x[0] > middle)
    _mark(axis, (x[-1], y[-1]), "end", "s", x[0] >= x[-1] if is_near else x[-1] > middle)


def _mark(axis, at, label, marker, label_is_left):
    axis.plot(*at, marker, color="#C1121F", markeredgecolor="white", markersize=8, markeredgewidth=1.2)
    axis.annotate(label, at, textcoords="offset points", xytext=(-9 if label_is_left else 9, 0), fontsize=9,
                  fontweight="bold", ha="right" if label_is_left else "left", va="center", path_effects=HALO)


def round_length(limit):
    """The largest of 1, 2, 5 times a power of ten that does not exceed the limit."""
    power = 10.0 ** math.floor(math.log10(limit))
    return max(step * power for step in (1, 2, 5) if step * power <= limit)


def _draw_scale_bar(axis, width):
    length = round_length(width / 4)
    fraction = length / width
    at = axis.transAxes
    axis.plot([0.04, 0.04 + fraction], [0.05, 0.05], transform=at, color="black", linewidth=3, solid_capstyle="butt",
              path_effects=HALO)
    axis.text(0.04 + fraction / 2, 0.065, f"{length:g} m", transform=at, ha="center", va="bottom", path_effects=HALO)


def _draw_compass(axis, output):
    """North, and where the sun stood for each condition (solid above the horizon, dotted below)."""
    figure = axis.figure
    figure.canvas.draw()
    box = axis.get_window_extent()
    radius = 0.075 * min(box.width, box.height) + 12
    size = np.array([3 * radius / box.width, 3 * radius / box.height])
    inset = axis.inset_axes([*_emptiest_corner(axis, output, size), *size])
    inset.set_xlim(-1.5, 1.5)
    inset.set_ylim(-1.5, 1.5)
    inset.set_aspect("equal")
    inset.axis("off")
    inset.add_patch(plt.Circle((0, 0), 1.48, facecolor="white", edgecolor="none", alpha=0.78))
    inset.annotate("", xy=(0, 1.0), xytext=(0, -0.8),
                   arrowprops={"arrowstyle": "-|>,head_width=0.3,head_length=0.6", "color": "black", "lw": 1.1})
    inset.text(0, 1.2, "N", ha="center", va="center", fontsize=8, fontweight="bold")
    for index, stream in enumerate(output.conditions):
        capture = output.captures.get(stream)
        if capture is None or np.isnan(capture["sun_azimuth_deg"][0]):
            continue
        azimuth = math.radians(capture["sun_azimuth_deg"][0])
        end = np.array([math.sin(azimuth), math.cos(azimuth)])
        style = "-" if capture["sun_elevation_deg"][0] > 0 else ":"
        inset.plot([0, 0.8 * end[0]], [0, 0.8 * end[1]], style, color="#E69F00", linewidth=1.6, zorder=1)
        inset.plot(*(0.8 * end), "o", color="#E69F00", markersize=4)
        inset.text(*(1.18 * end), names.condition(stream), ha="center", va="center", fontsize=6.5)


def _emptiest_corner(axis, output, size):
    """Lower left corner, as a fraction of the axis, where a box of this size hides least of the path. The scale bar has
    the lower left one."""
    (left, right), (bottom, top) = axis.get_xlim(), axis.get_ylim()
    x = (output.path["x"] - left) / (right - left)
    y = (output.path["y"] - bottom) / (top - bottom)
    corners = [(0.99 - size[0], 0.99 - size[1]), (0.01, 0.99 - size[1]), (0.99 - size[0], 0.01)]

    def hidden(corner):
        return int(((np.abs(x - corner[0] - size[0] / 2) < size[0] / 2)
                    & (np.abs(y - corner[1] - size[1] / 2) < size[1] / 2)).sum())
    return min(corners, key=hidden)
