"""Whether a run was made as the paper's was. Its hours are told by their names alone; all else is in run.yaml. Another world,
path or robot is what one would compare, and none of this."""

import re

import yaml

from . import paper
from .files import is_self_test


def _value(text):
    """As YAML has it, so that 3 and 3.0 are equal."""
    try:
        return yaml.safe_load(str(text))
    except (yaml.YAMLError, ValueError, RecursionError):  # of a date that is none; of very many brackets
        return text


def _of_conditions(text):
    """(what, as it is, the paper's) of its hours among conditions that tell of themselves by what differs."""
    conditions = _value(text)
    for name, hour in paper.HOUR_OF.items():
        one = conditions.get(name) if isinstance(conditions, dict) else None
        usual = {**paper.CAMERA, **paper.LIGHT, "hour": hour,
                 "year": paper.DATE.year, "month": paper.DATE.month, "day": paper.DATE.day}
        for key, value in (one.items() if isinstance(one, dict) else ()):
            theirs = usual.get(key, 0)  # no weather, and no exposure of its own
            if _value(value) != theirs:
                yield f"{key} of {name}", value, theirs if key in usual else "none"


def _differences(output):
    """(what, as it is, the paper's) of all that is told and not as in the paper."""
    settings = output.settings
    usual = {**{f"about/{key}": value for key, value in {**paper.LIGHT, **paper.CAMERA}.items()}, **paper.MATCHING}
    found = [(key.replace("about/", ""), settings[key], theirs) for key, theirs in usual.items()
             if key in settings and _value(settings[key]) != theirs]
    pixels = re.match(r"\d+ x \d+", str(settings.get("about/camera", "")))  # of a calibration nothing is told
    if pixels and pixels.group() != paper.PIXELS:
        found.append(("size of the images", pixels.group(), paper.PIXELS))
    return found + list(_of_conditions(settings.get("about/conditions", "")))


def _unknown(output):
    """What should be told, and is not."""
    wanted = [f"about/{key}" for key in paper.LIGHT] + ["ratio", "inclusive"]
    return [key.replace("about/", "") for key in wanted if key not in output.settings]


def _shown(value):
    return {True: "true", False: "false"}[value] if isinstance(value, bool) else str(value)


def warnings(output):
    """At most one, where anything of the paper stands beside what it may not be compared with."""
    if not any(is_self_test(a, b) or (a, b) in paper.PAIRS or (b, a) in paper.PAIRS for a, b in output.all_pairs):
        return []
    sentences = []
    if differences := _differences(output):
        sentences.append("Not as in the paper: " + "; ".join(
            f"{what} is {_shown(ours)}, the paper's {_shown(theirs)}" for what, ours, theirs in differences) + ".")
    if unknown := _unknown(output):
        sentences.append(f"By what these pictures were taken and compared is not known: run.yaml tells nothing of {', '.join(unknown)}.")
    if not sentences:
        return []
    return [" ".join([*sentences, "The paper's numbers below, and the verdicts on its findings, compare what "
                      + ("differs in that, too." if differences else "may differ in that, too.")])]


def reserve(output):
    """What a count of findings that hold may not be told without; empty where there is nothing."""
    parts = []
    if differences := [what for what, _, _ in _differences(output)]:
        parts.append(f"not as in the paper: {', '.join(differences)}")
    if unknown := _unknown(output):
        parts.append(f"not known: {', '.join(unknown)}")
    return "".join(f"; {part}" for part in parts)
