"""Which matches are right: the table, matching accuracy over its threshold, and drawn matches of the best and worst."""

import math

import matplotlib.pyplot as plt

from . import choice, names, pictures
from .files import is_self_test
from .figures import COLOURS, STYLE, colour_of, grid_of, legend_above, svg
from .tables import MISSING
from .verified_rows import ACCURACY_PX

COLUMNS = [("precision_3px", "precision"), ("recall_3px", "recall"), ("average_precision_3px", "average precision"),
           ("matching_score_3px", "matching score"), ("mma_3px", "MMA@3 px"), ("repeatability", "repeatability"),
           ("d", "D")]
TABLE_HEADER = ["pair", "detector", "poses"] + [name for _, name in COLUMNS]
DRAWN_WIDTH = 960  # px on the page, of two pictures side by side
PAIRS_DRAWN = 3  # of more only the extremes of all are shown


def pairs(output):
    """Of different conditions; the self-tests where there is nothing else."""
    found = output.verified.pairs
    return [pair for pair in found if not is_self_test(*pair)] or found


def shown_pairs(output):
    """Of which tables and figures tell."""
    return choice.shown_pairs(pairs(output), output.mapped)


def _keys(output):
    return [(a, b, detector) for a, b in shown_pairs(output) for detector in output.verified.detectors
            if (a, b, detector) in output.verified.means]


def _shown(value):
    return MISSING if math.isnan(value) else f"{value:.3f}"


def _interval(mean):
    return "" if math.isnan(mean.ci_low) else f"[{mean.ci_low:.3f}, {mean.ci_high:.3f}]"


def table_rows(output):
    """Of text, in the order of TABLE_HEADER, and behind it the intervals of the measures."""
    rows = []
    for a, b, detector in _keys(output):
        means = output.verified.means[a, b, detector]
        told = [means[measure] for measure, _ in COLUMNS]
        undefined = [f"{name}: {mean.undefined}" for mean, (_, name) in zip(told, COLUMNS) if mean.undefined]
        rows.append(([names.pair(a, b), names.difference(detector), str(len(output.verified.poses[a, b, detector]))]
                     + [_shown(mean.mean) for mean in told], [_interval(mean) for mean in told], ", ".join(undefined)))
    return rows


MARKERS = ("o-", "s--", "^:", "x-.")  # where colours begin anew


def accuracy(output):
    """MMA over its threshold, one panel a pair, one line a detector with its interval."""
    shown = shown_pairs(output)
    with plt.rc_context(STYLE):
        figure, axes = grid_of(len(shown), min(len(shown), 3), (3.1, 2.3))
        for axis, (a, b) in zip(axes, shown):
            for index, detector in enumerate(output.verified.detectors):
                means = output.verified.means.get((a, b, detector))
                if means is None:
                    continue
                steps = [means[f"mma_{t}px"] for t in ACCURACY_PX]
                axis.plot(ACCURACY_PX, [step.mean for step in steps], MARKERS[index // len(COLOURS) % len(MARKERS)], markersize=2.5, linewidth=1.2,
                          color=colour_of(index), label=names.difference(detector))
                axis.fill_between(ACCURACY_PX, [step.ci_low for step in steps], [step.ci_high for step in steps],
                                  color=colour_of(index), alpha=0.18, linewidth=0)
            axis.set_title(names.pair(a, b), loc="left")
            axis.set_xlabel("within / px")
            axis.set_ylabel("MMA")
            axis.set_ylim(0.0, 1.02)
            axis.set_xticks(ACCURACY_PX)
        legend_above(figure, axes)
        return svg(figure)


def _extreme(right, files, sign):
    """The pose with the fewest (sign 1) or most (-1) right matches of all, the lowest of equals, and whether it is drawn; of those
    drawn where it is not. None without any."""
    ranked = sorted((sign * count, pose) for pose, count in right.items())
    drawn_ones = [pose for _, pose in ranked if pose in files]
    return (drawn_ones[0], drawn_ones[0] == ranked[0][1]) if drawn_ones else None


def drawn(output):
    """Of each detector the poses with the fewest and the most right matches: of each pair where these are few, else of all pairs
    together. Rows of one or two (caption, picture)."""
    shown = []
    for detector in output.verified.detectors:
        found = []
        for a, b in pairs(output):
            files = output.matches.get(f"{a}-{b}/{detector}", {})
            right = output.verified.poses.get((a, b, detector), {})
            found.append([(right[one[0]], names.pair(a, b), *one, files[one[0]], sign)
                          for sign in (1, -1) if (one := _extreme(right, files, sign))])
        found = [row for row in found if row]
        if len(found) > PAIRS_DRAWN:
            ends = [one for row in found for one in row]
            found = [[min(one for one in ends if one[-1] > 0), max(one for one in ends if one[-1] < 0)]]
        # Where all poses have as many right matches, one picture is both.
        shown += [[_captioned(detector, one) for one in (row if row[0][:-1] != row[-1][:-1] else row[:1])] for row in found]
    return shown


def _captioned(detector, one):
    count, pair, pose, is_of_all, file, sign = one
    scope = "" if is_of_all else " of the poses drawn"
    return (f"{'Fewest' if sign > 0 else 'Most'} right matches of {names.difference(detector)}{scope}: {count}, {pair}, pose {pose}.",
            pictures.embedded(file, DRAWN_WIDTH))
