"""comparisons.csv: which differences between methods, and between hours, are more than chance."""

import math

from . import names
from .comparison_rows import SIGNIFICANT
from .tables import MISSING

SHOWN = 40  # rows
METRICS = {"d": "D", "matching_score_3px": "matching score", "precision_3px": "precision",
           "within_0.25m_2deg": "within 0.25 m, 2°", "within_0.5m_5deg": "within 0.5 m, 5°",
           "within_5m_10deg": "within 5 m, 10°", "error_m": "error / m"}
TABLE_HEADER = ["metric", "of", "a", "b", "n", "left out", "mean a − b", "95 % interval", "p", "p (Holm)"]
COUNTS_HEADER = ["between", "metric", "compared", "long enough", "more than chance", "n", "undefined", "failed", "least p (Holm)"]


def _hours(name, pairs):
    """'h04-h12' -> '4–12 h', 'h04 in h12' -> '4 h in 12 h'; stream names may hold a dash of their own."""
    query, is_in, map_name = name.partition(" in ")
    if is_in:
        return f"{names.condition(query)} in {names.condition_of_map(map_name)}"
    found = [pair for pair in pairs if "-".join(pair) == name]
    return names.pair(*found[0]) if found else name


def _p(value):
    return MISSING if math.isnan(value) else "< 0.0001" if value < 1e-4 else f"{value:.4f}"


def _left_out(row):
    told = [f"{count} {what}" for count, what in ((row.undefined, "undefined"), (row.failed, "failed"),
                                                  (row.unpaired, "alone")) if count]
    return ", ".join(told) or "0"


def _signed(row, difference):
    """Errors are of millimetres or of metres."""
    return f"{difference:+.3g}" if row.metric == "error_m" else f"{difference:+.3f}"


def _row(row, pairs):
    is_of_methods = row.family == "methods"
    hours = [_hours(name, pairs) for name in ((row.same,) if is_of_methods else (row.a, row.b))]
    methods = [names.difference(name) for name in ((row.a, row.b) if is_of_methods else (row.same,))]
    same, (a, b) = (hours[0], methods) if is_of_methods else (methods[0], hours)
    has_interval = not math.isnan(row.low)
    return [METRICS.get(row.metric, row.metric), same, a, b, str(row.n), _left_out(row),
            MISSING if math.isnan(row.mean_difference) else _signed(row, row.mean_difference),
            f"[{_signed(row, row.low)}, {_signed(row, row.high)}]" if has_interval else MISSING, _p(row.p), _p(row.p_holm)]


FAMILIES = ("methods", "hours")
DRAWN_P = 1e-5  # the least of drawn signs


def _least_p(row):
    """That the signs of its blocks can have; NaN where there is no p, or where signs change nothing: all is 0."""
    is_nothing = math.isnan(row.p) or row.mean_difference == row.low == row.high == 0.0
    blocks = -(-row.n // row.block_length) if row.block_length and not is_nothing else 0
    return max(2.0 ** (1 - blocks), DRAWN_P) if blocks else math.nan


def _holm(rising, tested):
    """Corrected, of so many that were tested."""
    corrected = []
    for index, p in enumerate(rising):
        corrected.append(max([min(1.0, (tested - index) * p)] + corrected[-1:]))
    return corrected


def _between(counts):
    low, high = min(counts), max(counts)
    return str(low) if low == high else f"{low} to {high}"


def counts(output):
    """(family, metric, rows) of all that was compared."""
    groups = {}
    for row in output.comparisons:
        groups.setdefault((row.family, row.metric), []).append(row)
    return [(family, METRICS.get(metric, metric), groups[family, metric])
            for family in FAMILIES for metric in dict.fromkeys(metric for of, metric in groups if of == family)]


def count_rows(output):
    """Of text, in the order of COUNTS_HEADER. Where even the least p is no less than 5 % the path is too short to tell."""
    rows = []
    for family, metric, group in counts(output):
        tested = sum(not math.isnan(row.p) for row in group)
        reachable = _holm(sorted(least for least in map(_least_p, group) if not math.isnan(least)), tested)
        rows.append([family, metric, str(len(group)), str(sum(p < SIGNIFICANT for p in reachable)),
                     str(sum(row.is_significant for row in group)),
                     _between([row.n for row in group]), _between([row.undefined for row in group]),
                     _between([row.failed for row in group]), _p(reachable[0] if reachable else math.nan)])
    return rows


def significant_rows(output):
    """Of text, in the order of TABLE_HEADER: of each family and metric the surest, up to SHOWN in all, and how many there are."""
    found = [row for _, _, group in counts(output) for row in sorted(group, key=lambda row: row.p_holm) if row.is_significant]
    shown = sorted(found, key=lambda row: row.p_holm)[:SHOWN]
    return [_row(row, output.all_pairs) for row in found if row in shown], len(found)
