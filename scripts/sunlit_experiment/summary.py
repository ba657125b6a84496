"""summary.csv, judged and as a table."""

import csv
import os

import yaml

from sunlit_experiment.launch import Failure

WRITTEN = ("summary", "comparisons")  # of an evaluator at its end the first and the last
DIRECT = ("boolean_rgb", "boolean_grey", "euclidean_rgb", "euclidean_grey")


def identity(path):
    """Of the file that is there now, another after each time that it is written; empty where there is none. By no clock:
    that may be set back meanwhile."""
    try:
        found = os.stat(path)
    except FileNotFoundError:
        return ""
    return f"{found.st_ino} {found.st_mtime_ns}"


def identities(folder):
    """Of what an earlier run wrote at its end."""
    return {name: identity(os.path.join(folder, name + ".csv")) for name in WRITTEN}


def inputs_in(folder):
    """The file in which the renderer keeps what its pictures are made from. Written anew once it has compared them with those of
    the run that it goes on with."""
    return os.path.join(folder, "inputs.yaml")


def read(folder, earlier):
    """The rows of summary.csv. Each of `earlier`, identities by name, has to be another file by now: an evaluator that is
    killed between the two is not told from one that has ended."""
    for name, before in earlier.items():
        if identity(os.path.join(folder, name + ".csv")) in ("", before):
            raise Failure(f"evaluator ended before it had written {name}.csv; its reason stands above")
    path = os.path.join(folder, "summary.csv")
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    if not rows:
        raise Failure(f"{path} has no rows")
    return rows


def check(rows, poses, self_test_every):
    """Every pair has all its poses, and two renderers of one sun agree to the bit."""
    for row in rows:
        name = f"{row['difference']} of {row['a']} and {row['b']}"
        expected = -(-poses // self_test_every) if is_self_test(row) else poses
        found = int(row["n"]) + int(row["undefined"])
        if found != expected:
            raise Failure(f"{name} has {found} of {expected} poses; the reason stands above and in problems.csv")
        if is_self_test(row) and row["difference"] in DIRECT and float(row["mean"]) != 0.0:
            raise Failure(f"{name} is {row['mean']}, but two renderers of one sun must agree to the bit")


def check_localised(folder):
    """Every query was looked for, where any were to be."""
    path = os.path.join(folder, "run.yaml")
    with open(path, encoding="utf-8") as file:
        outcome = yaml.safe_load(file)["outcome"]
    if outcome.get("key_frames") == 0:
        raise Failure(f"nothing was localised: the map has no key frame ({path}); the reason stands above and in problems.csv")
    if outcome.get("not_localised"):
        raise Failure(f"{outcome['not_localised']} queries were not looked for ({path}); the reason stands above and in "
                      "problems.csv")
    if outcome.get("unplaced"):
        raise Failure(f"no query can be found by {', '.join(outcome['unplaced'])}: depth tells the place of none of the features in the "
                      f"map ({path}); the reason stands above")


def is_self_test(row):
    return row["b"].startswith("self_test/")


def tables(rows):
    """The means of all pairs of hours, and of each hour with itself."""
    named = (("mean difference", "{a}-{b}", [row for row in rows if not is_self_test(row)]),
             ("with itself", "{a}", [row for row in rows if is_self_test(row)]))
    return "\n\n".join(_table(heading, name, of_kind) for heading, name, of_kind in named if of_kind)


def _table(heading, name, rows):
    """A line for each difference and a column for each pair, called `name`."""
    pairs = list(dict.fromkeys(name.format(**row) for row in rows))
    means = {(row["difference"], name.format(**row)): row["mean"] for row in rows}
    cells = [[heading] + pairs]
    for difference in dict.fromkeys(row["difference"] for row in rows):
        cells.append([difference] + [_rounded(means.get((difference, pair), "")) for pair in pairs])
    widths = [max(len(line[k]) for line in cells) for k in range(len(cells[0]))]
    return "\n".join("  ".join([line[0].ljust(widths[0])] + [cell.rjust(width) for cell, width in zip(line[1:], widths[1:])])
                     for line in cells)


def _rounded(text):
    try:
        return f"{float(text):.5f}"
    except ValueError:
        return "-"
