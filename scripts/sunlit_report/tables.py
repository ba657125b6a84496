"""Tables of the page, as rows of text: the page and the terminal show the same."""

import math

import numpy as np

from . import files, names, paper

MISSING = "–"
PAIRS_PER_TABLE = 3


def chunks(items, size):
    return [items[k:k + size] for k in range(0, len(items), size)]


def fixed(value, digits=5):
    return MISSING if math.isnan(value) else f"{value:.{digits}f}"


def small(value):
    """For values that are 0 or far below 1: exactly 0 is shown as 0."""
    if math.isnan(value):
        return MISSING
    return "0" if value == 0 else f"{value:.2e}" if abs(value) < 1e-3 else f"{value:.5f}"


def interval(row):
    return "" if math.isnan(row.ci_low) else f"[{row.ci_low:.5f}, {row.ci_high:.5f}]"


def main_tables(output):
    """In the paper's form, three pairs at a time: per algorithm E and s of each pair, and the paper's own."""
    return [_table(output, pairs, fixed, lambda a, b: (a, b)) for pairs in chunks([pair for pair in output.shown_pairs if pair in output.pairs], PAIRS_PER_TABLE)]


def self_tables(output):
    return [_table(output, pairs, small, lambda a, b: (a, a)) for pairs in chunks(output.self_pairs, PAIRS_PER_TABLE)]


def _table(output, pairs, shown, paper_pair):
    table = {"pairs": [names.pair(a, b) for a, b in pairs], "rows": []}
    for difference in output.differences:
        ours = [output.summary.get((a, b, difference)) for a, b in pairs]
        theirs = [paper.e_and_s(*paper_pair(a, b), difference) for a, b in pairs]
        table["rows"].append({
            "name": names.difference(difference),
            "e": [shown(row.mean) if row else MISSING for row in ours],
            "ci": [interval(row) if row else "" for row in ours],
            "s": [shown(row.sd) if row else MISSING for row in ours],
            "paper_e": [shown(value[0]) if value else "" for value in theirs],
            "paper_s": [shown(value[1]) if value else "" for value in theirs],
        })
    table["rests_on"] = _rests_on([output.summary[a, b, difference] for difference in output.differences for a, b in pairs
                                   if (a, b, difference) in output.summary])
    table["has_paper"] = any(any(row["paper_e"]) for row in table["rows"])
    # The interval of a self-test, of values that are 0 but for a few, says nothing.
    is_self_test = any(files.is_self_test(*pair) for pair in pairs)
    table["has_interval"] = not is_self_test and any(any(row["ci"]) for row in table["rows"])
    return table


def _rests_on(summaries):
    """'Of 991 poses each; 3 values are undefined.'"""
    n = sorted({row.n + row.undefined for row in summaries})
    undefined = sum(row.undefined for row in summaries)
    poses = f"{n[0]}" if len(n) == 1 else f"{n[0]} to {n[-1]}"
    return f"Of {poses} poses each; " + (f"{undefined} undefined values are left out." if undefined else "no value is undefined.")


def counts(output):
    """What each mean rests on."""
    rows = []
    shown = {*output.shown_pairs, *output.self_pairs}
    for (a, b, difference), row in ((key, row) for key, row in output.summary.items() if key[:2] in shown):
        series = output.series.get((a, b, difference))
        has_features = series is not None and bool((series.features_a + series.features_b).any())
        rows.append({
            "pair": names.pair(a, b), "name": names.difference(difference), "n": row.n, "undefined": row.undefined,
            "features": [f"{np.mean(one):.0f}" if has_features else "" for one in
                         ((series.features_a, series.features_b, series.matches) if series else ((), (), ()))],
            "twins": f"{int(series.zero_second.sum())}" if has_features else "",
            "forms": [fixed(one) if has_features else "" for one in (row.mean, row.symmetric_mean, row.one_to_one_mean)],
            "overmatched": f"{series.overmatched}" if has_features else "",
        })
    return rows


def significant(value):
    """Three digits that count, or all before the point: lux of nights and of noons alike."""
    if not value:
        return "0"
    digits = 2 - math.floor(math.log10(abs(float(f"{value:.2e}"))))
    return f"{value:.{max(digits, 0)}f}"


def _range(values, shown):
    values = values[~np.isnan(values)]
    if not len(values):
        return MISSING
    low, high = shown(values.min()), shown(values.max())
    return low if low == high else f"{low} to {high}"


def _two_decimals(value):
    return f"{value:.2f}"


def conditions(output):
    rows = []
    for stream in output.conditions:
        capture = output.captures.get(stream)
        if capture is not None:
            rows.append([names.condition(stream), str(len(capture["pose"])), _range(capture["sun_azimuth_deg"], _two_decimals),
                         _range(capture["sun_elevation_deg"], _two_decimals),
                         _range(capture["scene_illuminance"], significant), _range(capture["ev100"], _two_decimals),
                         ", ".join(sorted(set(capture["exposure_mode"]) - {""}))])
    return rows


def timing(output):
    """One row per stage and thing; the conditions of a stage are taken together."""
    merged = {}
    for row in output.timing:
        is_condition = row["what"] in output.conditions or row["what"] in output.captures
        sums = merged.setdefault((row["stage"], "conditions" if is_condition else row["what"]), [0, 0.0])
        sums[0] += row["count"]
        sums[1] += row["seconds"]
    # Stages may run at once, so the shares are of work, not of the clock.
    total = sum(seconds for _, seconds in merged.values())
    return [[stage, what, str(number), f"{seconds:.2f}", f"{1000 * seconds / number:.2f}" if number else MISSING,
             f"{100 * seconds / total:.1f}" if total else MISSING]
            for (stage, what), (number, seconds) in merged.items()]


def gravest_first(problems):
    """Those that took something from the results, and then what is no fault: pictures without features."""
    return sorted(problems, key=lambda row: row["kind"] == "no_features")


def problems(output):
    """Number of problems by kind."""
    kinds = {}
    for row in output.problems:
        kinds[row["kind"]] = kinds.get(row["kind"], 0) + 1
    return sorted(kinds.items())


def flattened(tree, prefix=""):
    """[(key, value)] of nested mappings, keys joined by slashes."""
    found = []
    for key, value in tree.items():
        name = f"{prefix}{key}"
        if isinstance(value, dict) and value:
            found += flattened(value, name + "/")
        else:
            found.append((name, str(value)))
    return found


def mapping(tree, key):
    """The mapping that a key holds; empty where there is none."""
    value = tree.get(key) if isinstance(tree, dict) else None
    return value if isinstance(value, dict) else {}


def counters(run):
    """Tables of the counters of run.yaml: one per kind of thing counted, (title, column names, rows)."""
    tables = []
    for kind, things in mapping(run, "counters").items():
        if isinstance(things, dict) and things and all(isinstance(v, dict) for v in things.values()):
            columns = list(dict.fromkeys(name for counts_of in things.values() for name in counts_of))
            rows = [[str(thing)] + [str(c.get(name, MISSING)) for name in columns] for thing, c in things.items()]
            tables.append((kind, columns, rows))
    return tables
