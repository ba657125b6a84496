"""How conditions, pairs and differences are called on the page."""

import re

LISTED = 8

_DIFFERENCES = {
    "boolean_rgb": "Boolean RGB", "boolean_grey": "Boolean grey",
    "euclidean_rgb": "Euclidean RGB", "euclidean_grey": "Euclidean grey",
    "sift": "SIFT", "surf": "SURF", "orb": "ORB", "brisk": "BRISK",
    "akaze": "AKAZE", "kaze": "KAZE", "rootsift": "RootSIFT",
}

_PREPROCESSINGS = {"clahe": "CLAHE", "gamma": "gamma", "illumination_invariant": "illumination-invariant images"}


def difference(name):
    return _DIFFERENCES.get(name, name)


def method(name):
    """'sift+clahe' -> 'SIFT with CLAHE'."""
    detector, _, preprocessing = name.partition("+")
    return difference(detector) + (f" with {_PREPROCESSINGS.get(preprocessing, preprocessing)}" if preprocessing else "")


def _hour(name):
    """'h04' -> '4', 'h04_30' -> '4:30'; None for other names."""
    match = re.fullmatch(r"h(\d\d)(?:_(\d\d))?(?:_(\d\d))?", name)
    if not match:
        return None
    minutes = [part for part in match.groups()[1:] if part]
    return ":".join([str(int(match.group(1)))] + minutes)


def hour_of(name):
    """As a number, 4.5 of 'h04_30'; None for names that are no hours."""
    shown = _hour(name)
    return None if shown is None else sum(float(part) / 60**place for place, part in enumerate(shown.split(":")))


def by_hour(several):
    """In the order of the day where all are hours, else as they are."""
    return sorted(several, key=hour_of) if all(hour_of(name) is not None for name in several) else list(several)


def until_which(several):
    """How a title about maps begins."""
    return "Until which hour" if all(map(_hour, several)) else "Under which conditions"


def condition(name):
    hour = _hour(name)
    return f"{hour} h" if hour else name


def parts_of_map(name):
    """The conditions that a map is made of: 'h08+h16' of two."""
    return name.split("+")


def condition_of_map(name):
    """'12 h', '8 and 16 h'."""
    return conditions(parts_of_map(name))


def conditions(several):
    """'4, 12 and 20 h', or the names as they are; of many the first and the last."""
    if len(several) > LISTED:
        return f"{len(several)} conditions, {condition(several[0])} to {condition(several[-1])}"
    hours = [_hour(name) for name in several]
    shown = hours if all(hours) else list(several)
    listed = ", ".join(shown[:-1]) + " and " + shown[-1] if len(shown) > 1 else shown[0]
    return listed + " h" if all(hours) else listed


def pair(a, b):
    """'4–12 h', or the names with a dash where they are no hours. A self-test is called by its condition twice."""
    b = re.sub("^self_test/", "", b)
    hours = [_hour(a), _hour(b)]
    return f"{hours[0]}–{hours[1]} h" if all(hours) else f"{a} – {b}"
