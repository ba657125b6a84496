"""Every hour against every other, a triangle for each difference."""

import matplotlib.pyplot as plt
import numpy as np

from . import names
from .figures import STYLE, grid_of, svg
from .files import is_self_test

LEAST_CONDITIONS = 4  # with fewer the tables show as much
MOST_NUMBERED = 7  # conditions whose cells have room for a number


def worth_showing(output):
    return len(output.pairs) > 0 and len(output.conditions) >= LEAST_CONDITIONS


def matrix(output, difference):
    """(conditions, mean differences by row and column): row a, column b of the pair a, b; NaN where none was measured,
    and on the diagonal what the self-test found."""
    conditions = names.by_hour(output.conditions)
    values = np.full((len(conditions), len(conditions)), np.nan)
    for (a, b, kind), row in output.summary.items():
        if kind != difference or a not in conditions:
            continue
        if is_self_test(a, b):
            values[conditions.index(a), conditions.index(a)] = row.mean
        elif b in conditions:
            values[conditions.index(a), conditions.index(b)] = row.mean
    return conditions, values


def _draw(axis, output, difference):
    conditions, values = matrix(output, difference)
    largest = max(np.nanmax(np.append(values, 0.0)), 1e-12)  # Euclidean ones are a tenth of the others
    image = axis.imshow(values, cmap="viridis", vmin=0.0, vmax=largest, origin="lower")
    axis.figure.colorbar(image, ax=axis, shrink=0.75).ax.tick_params(labelsize=6)
    shown = [names.condition(name) for name in conditions]
    axis.set_xticks(range(len(shown)))
    axis.set_xticklabels(shown, fontsize=6, rotation=90)
    axis.set_yticks(range(len(shown)))
    axis.set_yticklabels(shown, fontsize=6)
    axis.grid(False)
    axis.set_title(names.difference(difference), loc="left")
    if len(conditions) <= MOST_NUMBERED:
        for row, column in zip(*np.nonzero(np.isfinite(values))):
            value = values[row, column]
            axis.text(column, row, f"{value:.2f}", ha="center", va="center", fontsize=5.5,
                      color="black" if value > 0.6 * largest else "white")


def of_all_pairs(output):
    with plt.rc_context(STYLE):
        shown = output.differences
        figure, axes = grid_of(len(shown), 4, (2.4, 2.1))
        for axis, difference in zip(axes, shown):
            _draw(axis, output, difference)
        return svg(figure)
