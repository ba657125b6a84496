"""What a reader must know before the numbers; stands on the page and in the terminal."""

import math

import numpy as np

from . import circumstances, names, tables
from .files import is_self_test, summarise


USED_ALL_THE_SAME = ("no_features", "other_frame", "duplicate")  # pictures that such a problem is told of


def _same(a, b):
    return (math.isnan(a) and math.isnan(b)) or math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-12)


def warnings(output):
    """Sentences."""
    found = []
    if output.series and not output.has_summary_file:
        found.append("summary.csv is missing: E and s were computed from frames.csv and have no confidence intervals.")
    for key, row in output.summary.items():
        series = output.series.get(key)
        again = summarise(series) if series else None
        if again is None:
            if row.n or row.undefined:
                found.append(f"summary.csv has {names.pair(*key[:2])}, {names.difference(key[2])}, frames.csv has not.")
        elif (again.n, again.undefined) != (row.n, row.undefined) or not (
                _same(again.mean, row.mean) and _same(again.sd, row.sd)):
            found.append(f"summary.csv disagrees with frames.csv on {names.pair(*key[:2])}, "
                         f"{names.difference(key[2])}: n {row.n} and {again.n}, E {row.mean:.6f} and "
                         f"{again.mean:.6f}. It was made from other frames.")
    for key in output.series:
        if key not in output.summary:
            found.append(f"frames.csv has {names.pair(*key[:2])}, {names.difference(key[2])}, summary.csv has not.")
    found += circumstances.warnings(output)
    found += _without_features(output)
    found += _under_other_suns(output)
    outcome = tables.mapping(output.run, "outcome")
    if outcome.get("whole") is False:
        found.append(f"The run is not whole: {_lacking(output.run, outcome)}. See counters and problems.")
    found += _unplaced(outcome)
    found += _not_looked_for(outcome)
    found += _not_used(output.problems)
    frames = [row["reason"] for row in output.problems if row["kind"] == "other_frame"]
    return found + [f"Poses are of several frames: {reason}." for reason in frames[:1]]


def _lacking(run, outcome):
    left_out = sum(count for pair in tables.mapping(tables.mapping(run, "counters"), "pairs").values() if isinstance(pair, dict)
                   for kind, count in pair.items() if kind not in ("evaluated", "resumed") and isinstance(count, int))
    lacks = [(outcome.get("absent_poses"), "poses are absent"), (left_out, "pairs could not be evaluated"),
             (outcome.get("not_mended"), "pairs or pictures were left out by earlier or merged runs")]
    return (f"{outcome.get('completed_poses', '?')} poses came, "
            + (", ".join(f"{count} {what}" for count, what in lacks if count) or "but no stream of them is what was sent"))


def _unplaced(outcome):
    """Their queries all fail, which looks as if the light had done it."""
    detectors = outcome.get("unplaced")
    if not isinstance(detectors, list) or not detectors:
        return []
    return [f"Depth tells the place of none of the features that {', '.join(names.difference(str(one)) for one in detectors)} found in "
            "the map, so that no query can be found by them: is it of the map's camera, in m or mm, and not 0?"]


def _not_looked_for(outcome):
    """They stand in no share, which may look the better for it."""
    count = outcome.get("not_localised")
    if not isinstance(count, int) or count <= 0:
        return []
    queries = "query was" if count == 1 else "queries were"
    return [f"{count} {queries} not looked for, for want of a pose or camera_info: all shares are of the others. See problems."]


def _not_used(problems):
    """Pictures of bags, of which no run.yaml tells: those of queries stand in no share, those of the map cannot be found again."""
    pictures = {role: {(row["where"], row["stamp"]) for row in problems if row.get("role") == role and row["kind"] not in USED_ALL_THE_SAME}
                for role in ("query", "map")}
    return [(f"{len(of_role)} {'picture' if len(of_role) == 1 else 'pictures'} of {what} could not be used, or not by each detector: {so}. "
             "See problems.")
            for of_role, what, so in ((pictures["query"], "the queries", "all shares are of the others"),
                                      (pictures["map"], "the map", "it is of the others")) if of_role]


def _compares_features(series):
    """A difference of pixels counts none, and is defined all the same."""
    return bool((series.features_a + series.features_b).any()) or bool(np.isnan(series.value).all())


def _without_features(output):
    """At most one. Streams of the self-test are as those that they repeat."""
    counts = {}
    for (a, b, _), series in output.series.items():
        if _compares_features(series):
            counts.setdefault(a, []).append(series.features_a.sum())
            if not is_self_test(a, b):
                counts.setdefault(b, []).append(series.features_b.sum())
    streams = [stream for stream, found in counts.items() if not any(found)]
    if not streams:
        return []
    said = (names.conditions(streams) if len(streams) > names.LISTED
            else ", ".join(names.condition(stream) + _exposed(output, stream) for stream in streams))
    return [f"No detector found a single feature in any picture of {said}: they are black, white or plain, or nothing of the world is "
            f"in view: look at images/ (images:=true) or matches/.{_equal(output, streams)}{_fixed(output, streams)}"]


def _equal(output, streams):
    """Of black or white pictures, which looks like a perfect result."""
    if any(a in streams and b in streams and not _compares_features(series) and not series.value.any()
           for (a, b, _), series in output.series.items()):
        return " Such pictures equal each other in every pixel, which says nothing about localisation."
    return ""


def _fixed(output, streams):
    captures = [output.captures[stream] for stream in streams if stream in output.captures]
    if any("fixed" in capture["exposure_mode"] for capture in captures):
        return " Their exposure is fixed: with exposure:=auto the night is seen."
    return ""


def _exposed(output, stream):
    capture = output.captures.get(stream)
    if capture is None:
        return ""
    return (f" ({np.nanmedian(capture['scene_illuminance']):.3g} lx, exposed at EV100 "
            f"{np.nanmedian(capture['ev100']):.1f})")


def _under_other_suns(output):
    """Whose number is that of captures, since their pairs may be many."""
    poses, reasons = {}, {}
    for row in output.problems:
        if row["kind"] == "other_sun":
            poses.setdefault(row["where"], []).append(row["pose"])
            reasons.setdefault(row["where"], row["reason"])
    return [f"{len(found)} pictures of {names.condition(stream)} were taken under another sun than its first{_spread(found)}, and are "
            f"left out of all numbers. Of the first of them: {reasons[stream]}." for stream, found in poses.items()]


def _spread(poses):
    known = [pose for pose in poses if pose is not None]
    return f", at poses from {min(known)} to {max(known)}" if known else ""
