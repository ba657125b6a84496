"""Localisation: until which hour a map serves, and by which method; how far off along the path."""

import math

import matplotlib.pyplot as plt
import numpy as np

from . import names
from .figures import STYLE, by_powers_of_ten, colour_of, grid_of, legend_above, panels_over_path, svg
from .queries import WITHIN

USABLE_WITHIN = WITHIN[1]  # what a band is green by
USABLE_SHARE = 0.9
SOME_SHARE = 0.5
# Okabe and Ito's green, light orange and vermilion: told apart by colour-blind readers and in grey.
USABLE, PARTLY, LOST = "#009E73", "#F2C879", "#B5473C"
LEAST_ELEVATIONS_DEG = 0.1  # from the lowest to the highest sun of a figure over its elevation
WIDEST_CELL_H = 1.0  # either side of an hour that was measured; what lies further is not known


def maps(queries):
    return list(dict.fromkeys(key[0] for key in queries))


def detectors(queries):
    return list(dict.fromkeys(key[2] for key in queries))


def conditions(queries, map_name):
    """Those asked of the map, by their hour where they are hours."""
    return names.by_hour(list(dict.fromkeys(key[1] for key in queries if key[0] == map_name)))


def _colour_of(share):
    return USABLE if share >= USABLE_SHARE else PARTLY if share >= SOME_SHARE else LOST


def _cells(places):
    """Left and right edge of each place's cell: to the middle between neighbours, but no further than is known."""
    edges = []
    for index, place in enumerate(places):
        gaps = [abs(place - places[other]) / 2 for other in (index - 1, index + 1) if 0 <= other < len(places)]
        before = gaps[0] if gaps else WIDEST_CELL_H  # the first cell is as wide to the left as to the right
        after = gaps[-1] if gaps else WIDEST_CELL_H
        edges.append((place - min(before, WIDEST_CELL_H), place + min(after, WIDEST_CELL_H)))
    return edges


def _draw_bands(axis, queries, map_name, asked, places):
    methods = detectors(queries)
    for row, detector in enumerate(methods):
        for name, place, (left, right) in zip(asked, places, _cells(places)):
            found = queries.get((map_name, name, detector))
            if found is None:
                continue
            share = found.share_within(*USABLE_WITHIN)
            axis.barh(row, right - left, left=left, height=0.8, color=_colour_of(share), edgecolor="white", linewidth=0.8)
            if right - left >= 1.0:
                axis.text(place, row, f"{100 * share:.0f} %", ha="center", va="center", fontsize=7,
                          color="black" if _colour_of(share) == PARTLY else "white")
    axis.set_yticks(range(len(methods)))
    axis.set_yticklabels([names.difference(name) for name in methods])
    axis.invert_yaxis()
    axis.set_title(f"With a map of {names.condition_of_map(map_name)}", loc="left")
    axis.grid(False)


def _draw_hours(axis, output, map_name, asked):
    for part in names.parts_of_map(map_name):
        axis.axvline(names.hour_of(part), color="black", linewidth=1, linestyle=(0, (2, 2)))
    axis.set_xlim(0, 24)
    axis.set_xticks(range(0, 25, 2))
    axis.set_xlabel("hour of the day; dashed: when the map was made")
    shown = []
    for name in asked:
        capture = output.captures.get(name)
        if capture is not None:
            shown.append((names.hour_of(name), np.nanmedian(capture["sun_elevation_deg"])))
    if not shown:
        return
    top = axis.secondary_xaxis("top")
    top.set_xticks([hour for hour, _ in shown])
    top.set_xticklabels([f"{elevation:+.0f}°" for _, elevation in shown], fontsize=6.5)
    top.set_xlabel("elevation of the sun", fontsize=7)
    axis.title.set_position((0.0, 1.0))
    axis.set_title(axis.get_title(loc="left"), loc="left", pad=22)


def _draw_names(axis, asked):
    axis.set_xlim(-0.6, len(asked) - 0.4)
    axis.set_xticks(range(len(asked)))
    axis.set_xticklabels([names.condition(name) for name in asked])


def usable_hours(output):
    """The day as a band for each method, a panel for each map: green where the map serves."""
    queries = output.queries
    with plt.rc_context(STYLE):
        rows = len(detectors(queries))
        figure, axes = grid_of(len(maps(queries)), 1, (9.2, 1.0 + 0.34 * rows))
        for axis, map_name in zip(axes, maps(queries)):
            asked = conditions(queries, map_name)
            is_day = all(names.hour_of(name) is not None for name in asked + names.parts_of_map(map_name))
            places = [names.hour_of(name) for name in asked] if is_day else list(range(len(asked)))
            _draw_bands(axis, queries, map_name, asked, places)
            if is_day:
                _draw_hours(axis, output, map_name, asked)
            else:
                _draw_names(axis, asked)
        _explain_colours(figure)
        return svg(figure)


def _explain_colours(figure):
    some = f"{100 * SOME_SHARE:.0f} to {100 * USABLE_SHARE:.0f} %"
    patches = [(USABLE, f"at least {100 * USABLE_SHARE:.0f} % of the places found"), (PARTLY, some),
               (LOST, f"fewer than {100 * SOME_SHARE:.0f} %")]
    figure.legend([plt.Rectangle((0, 0), 1, 1, color=colour) for colour, _ in patches], [text for _, text in patches],
                  loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=3)


def pairs(queries):
    """Map and query."""
    return list(dict.fromkeys(key[:2] for key in queries))


def errors_along_path(output, shown_pairs):
    """Error of the position over the path, a panel for each detector; ticks on the upper edge are failures."""
    queries = output.queries

    def draw(axis, detector, to_x):
        for number, pair in enumerate(shown_pairs):
            if (*pair, detector) in queries:
                _draw_errors(axis, to_x, queries[(*pair, detector)], colour_of(number),
                             f"{names.condition(pair[1])} in the map of {names.condition_of_map(pair[0])}")
        by_powers_of_ten(axis)
        axis.set_ylabel("error / m")

    return panels_over_path(output, queries.values(), detectors(queries), draw)


def _pair_of(output, map_name, query, detector):
    """D of a query and the map, either way round, and of a map of several hours the least; None where they were not compared."""
    compared = [output.summary[a, b, detector] for part in names.parts_of_map(map_name) for a, b in ((query, part), (part, query))
                if (a, b, detector) in output.summary]
    return min(compared, key=lambda one: (math.isnan(one.mean), one.mean), default=None)


def _elevation_of(output, stream):
    capture = output.captures.get(stream)
    return math.nan if capture is None else float(np.nanmedian(capture["sun_elevation_deg"]))


def judged_twice(output):
    """{(map, detector): [(elevation, query, share within reach and its interval, summary of D)]}, by rising elevation, of those
    that have all of it."""
    found = {}
    for (map_name, query, detector), one in output.queries.items():
        elevation, difference = _elevation_of(output, query), _pair_of(output, map_name, query, detector)
        if difference is None or math.isnan(elevation) or math.isnan(difference.mean):
            continue
        share = one.share_within(*USABLE_WITHIN)
        interval = output.shares.get((map_name, query, detector), [(math.nan, math.nan)] * 2)[WITHIN.index(USABLE_WITHIN)]
        found.setdefault((map_name, detector), []).append((elevation, query, (share, *interval), difference))
    return {key: sorted(values, key=lambda value: value[:2]) for key, values in found.items()}


def _over_elevations(output):
    """As judged_twice(), of those whose hours differ in elevation: weathers of one hour would stand on top of each other."""
    return {key: values for key, values in judged_twice(output).items()
            if values[-1][0] - values[0][0] >= LEAST_ELEVATIONS_DEG}


def over_elevation(output):
    """What localisation says and what D says, over the elevation of the sun: the shaded gap is where they disagree. None where
    all stood at one elevation."""
    judged = _over_elevations(output)
    if not judged:
        return None
    with plt.rc_context(STYLE):
        figure, axes = grid_of(len(judged), min(len(judged), 2), (4.6, 2.5))
        for axis, ((map_name, detector), values) in zip(axes, judged.items()):
            _draw_judged(axis, values)
            axis.set_title(f"{names.difference(detector)}, map of {names.condition_of_map(map_name)}", loc="left")
            axis.set_xlabel("elevation of the sun / °")
            axis.set_ylim(-0.02, 1.08)
        legend_above(figure, axes)
        return svg(figure)


def _draw_judged(axis, values):
    x = np.array([value[0] for value in values])
    recall = np.array([value[2] for value in values])
    matched = 1.0 - np.array([(value[3].mean, value[3].ci_high, value[3].ci_low) for value in values])
    axis.fill_between(x, matched[:, 0], recall[:, 0], color="#888888", alpha=0.15, linewidth=0, label="where they disagree")
    for series, colour, style, label in ((recall, USABLE, "o-", "queries found within 0.5 m, 5°"),
                                         (matched, "#0072B2", "s--", "features matched, 1 − D")):
        axis.plot(x, series[:, 0], style, color=colour, markersize=3.5, linewidth=1.2, label=label)
        axis.vlines(x, series[:, 1], series[:, 2], color=colour, linewidth=1)
    for elevation, query, (share, *_), difference in values:
        axis.annotate(names.condition(query), (elevation, max(share, 1.0 - difference.mean)), textcoords="offset points",
                      xytext=(4, 4), ha="left", fontsize=6.5)
    axis.margins(x=0.12)


def _draw_errors(axis, to_x, found, colour, label):
    x = to_x(found.pose)
    # A logarithmic axis has no place for 0, which a query that equals its key frame can reach.
    axis.plot(x, np.maximum(found.error_m, 1e-6), color=colour, linewidth=0.8, label=label)
    failed = np.isnan(found.error_m)
    if failed.any():
        axis.plot(x[failed], np.ones(failed.sum()), "|", color=colour, markersize=7, clip_on=False,
                  transform=axis.get_xaxis_transform())


def _median(errors):
    """Of all queries: one without a pose is further off than any."""
    middle = float(np.median(np.where(np.isnan(errors), np.inf, errors)))
    return f"{middle:.3f}" if math.isfinite(middle) else "no pose"


def _shares(found, intervals):
    """In per cent, with their intervals where these are known."""
    shares = [f"{100 * found.share_within(*bound):.0f}" for bound in WITHIN]
    if not intervals:
        return shares
    return [f"{share}\u00a0[{100 * max(low, 0.0):.0f},\u00a0{100 * high:.0f}]" if low <= high else share
            for share, (low, high) in zip(shares, intervals)]


def table_rows(output):
    """Per map, query and detector: what is counted and found, as text."""
    rows = []
    for key, found in output.queries.items():
        map_name, query, detector = key
        rows.append([names.condition_of_map(map_name), names.condition(query), names.difference(detector), str(len(found.pose)),
                     str(found.failures)]
                    + _shares(found, output.shares.get(key))
                    + [_median(found.error_m), _median(found.error_deg), f"{np.median(found.inliers):.0f}"])
    return rows


TABLE_HEADER = ["map", "query", "detector", "queries", "without a pose", "0.25 m, 2° / %", "0.5 m, 5° / %", "5 m, 10° / %",
                "median / m", "median / °", "inliers"]
