"""The arguments of our launch files: what was typed, what is wrong with it, and what it means."""

import calendar
import contextlib
import datetime
import difflib
import itertools
import math
import os
import re
import sys
import tempfile
from xml.etree import ElementTree

import psutil
import yaml

DIFFERENCES = ["boolean_rgb", "boolean_grey", "euclidean_rgb", "euclidean_grey", "sift", "surf", "orb", "brisk"]  # the paper's
MORE_DIFFERENCES = ["akaze", "kaze", "rootsift", "onnx"]
DETECTORS = ["sift", "surf", "orb", "brisk"] + MORE_DIFFERENCES


class Unusable(Exception):
    """What was typed and cannot be used, and why, in a line."""


class BadArgument(Unusable):
    """An argument of a launch file, by its name."""

    def __init__(self, name, value, allowed):
        super().__init__(f"argument {name} is {value!r}, but must be {allowed}")


class BadPath(Unusable):
    """A file or folder that nodes could not be told of."""

    def __init__(self, path, reason):
        super().__init__(f"{path}: {reason}")


class _Ambiguous(yaml.constructor.ConstructorError):
    """What YAML understands otherwise than who wrote it."""


class _Loader(yaml.SafeLoader):
    """YAML whose maps have each key once: of two, one would be lost without a word. Nor are 010 or 0b11 numbers."""

    def construct_yaml_int(self, node):
        if re.match(r"[-+]?0.", node.value):
            raise _Ambiguous(None, None, f"a zero before {node.value.lstrip('+-')[1:]}", node.start_mark)
        return super().construct_yaml_int(node)

    def construct_yaml_timestamp(self, node):
        try:
            return super().construct_yaml_timestamp(node)
        except ValueError as error:
            raise _Ambiguous(None, None, f"{node.value}, which is no date ({error})", node.start_mark) from None

    def construct_mapping(self, node, deep=False):
        keys = [self.construct_object(key, deep=True) for key, _ in node.value]
        twice = [key for i, key in enumerate(keys) if key in keys[:i]]
        if twice:
            raise _Ambiguous(None, None, f"{twice[0]} twice", node.start_mark)
        return super().construct_mapping(node, deep)


_Loader.add_constructor("tag:yaml.org,2002:int", _Loader.construct_yaml_int)
_Loader.add_constructor("tag:yaml.org,2002:timestamp", _Loader.construct_yaml_timestamp)


def parse(name, text, allowed):
    """`text` as YAML."""
    try:
        return yaml.load(text, Loader=_Loader)
    except _Ambiguous as error:
        raise BadArgument(name, text, f"without {error.problem}") from None
    except (yaml.YAMLError, ValueError, RecursionError):  # of very many brackets
        raise BadArgument(name, text, allowed) from None


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def flag(name, text):
    """As roslaunch reads its if=."""
    values = {"true": True, "1": True, "false": False, "0": False}
    if text.strip().lower() not in values:
        raise BadArgument(name, text, "true or false")
    return values[text.strip().lower()]


def number(name, text):
    """Its range is the business of the node that gets it."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise BadArgument(name, text, "a number")
    return value


def number_or_auto(name, text):
    """A number as above, or the word auto for what the node finds by itself."""
    if text == "auto":
        return text
    try:
        return number(name, text)
    except BadArgument:
        raise BadArgument(name, text, "auto or a number") from None


def whole(name, text, at_least=None):
    allowed = "a whole number" + ("" if at_least is None else f" of at least {at_least}")
    try:
        value = int(text)
    except ValueError:
        raise BadArgument(name, text, allowed) from None
    if at_least is not None and value < at_least:
        raise BadArgument(name, value, allowed)
    return value


# Words of which a parameter of the renderer is one; those of conditions too, by the same names.
CHOICES = {"missing": ("stop", "warn"), "exposure": ("fixed", "auto"), "rasterizer": ("osmesa", "egl", "builtin"),
           "lamps": ("auto", "on", "off"), "vignetting": ("none", "cos4"), "mosaic": ("none", "rggb", "bggr", "grbg", "gbrg"),
           "overcast": ("layer", "cie")}


def choice(name, text):
    if text not in CHOICES[name]:
        raise BadArgument(name, text, f"one of {', '.join(CHOICES[name])}")
    return text


def clock_times(text):
    """'[4, 4.5]' -> {'h04': {hour: 4, ...}, 'h04_30': {hour: 4, minute: 30, ...}}, in the order given."""
    allowed = "a list of different hours, at least 0 and below 24, such as [4, 12, 20]"
    hours = parse("hours", text, allowed)
    hours = hours if isinstance(hours, list) else [hours]
    times = {}
    for hour in hours:
        if not _is_hour(hour):
            raise BadArgument("hours", text, allowed)
        time = _clock_time(hour)
        h, m, s = time["hour"], time["minute"], int(time["second"])
        name = f"h{h:02d}" + (f"_{m:02d}" if m or s else "") + (f"_{s:02d}" if s else "")
        if name in times:
            raise BadArgument("hours", text, allowed)
        times[name] = time
    if not times:
        raise BadArgument("hours", text, allowed)
    return times


def _is_hour(value):
    return is_number(value) and 0 <= value < 24


def _clock_time(hour):
    seconds = min(round(hour * 3600), 24 * 3600 - 1)
    return {"hour": seconds // 3600, "minute": seconds // 60 % 60, "second": float(seconds % 60)}


def _a_date(instead):
    """What is wanted in place of what is no date, and what is wrong where its form is right."""
    form = re.fullmatch(r"([0-9]{4})-([0-9]{2})-[0-9]{2}", str(instead))
    year, month = (int(part) for part in form.groups()) if form else (0, 0)
    if year < 1:
        return A_DATE
    if not 1 <= month <= 12:
        return f"{A_DATE}, with a month from 1 to 12"
    return f"{A_DATE}, with a day from 1 to {calendar.monthrange(year, month)[1]} in month {month} of year {year}"


def _on_its_day(name, differs, text):
    """What differs in a condition, its date told as year, month and day."""
    if DATE not in differs:
        return differs
    for part in DAY:
        if part in differs:
            raise BadArgument("conditions", text, f"without {part} in {name}, which has a date")
    day = differs[DATE]
    try:  # YAML makes a date of most of them by itself
        day = day if type(day) is datetime.date else datetime.date.fromisoformat(day)  # pylint: disable=unidiomatic-typecheck
    except (TypeError, ValueError):
        raise BadArgument("conditions", text, f"with {_a_date(day)}, in {name}") from None
    return {**{key: value for key, value in differs.items() if key != DATE},
            "year": day.year, "month": day.month, "day": day.day}


def _at_clock_time(name, differs, text):
    """What differs in a condition, 12.5 told as half past twelve. What is no hour stays, for the node to refuse."""
    differs = _on_its_day(name, differs, text)
    hour = differs.get("hour")
    if not _is_hour(hour) or hour == int(hour):
        return differs
    for part in ("minute", "second"):
        if part in differs:
            raise BadArgument("conditions", text, f"without {part} in {name}, whose hour {hour} has a fraction")
    return {**differs, **_clock_time(hour)}


def _check_name(name, text):
    """Refuses what no topic or frame can be called."""
    if not isinstance(name, str) or not re.fullmatch("[A-Za-z][A-Za-z0-9_]*", name):
        raise BadArgument("conditions", text, f"with names of letters, digits and _, a letter first, not {name!r}")


def _check_clock(name, differs, text):
    """Refuses minutes and seconds that are none: the sun's node would as well, but by them hours are compared here."""
    for key, allowed in (("minute", "a whole number from 0 to 59"), ("second", "a number, at least 0 and below 60")):
        value = differs.get(key, 0)
        if not is_number(value) or not 0 <= value < 60 or (key == "minute" and value != int(value)):
            raise BadArgument("conditions", text, f"with {key} as {allowed} in {name}, not {value!r}")


def _check_choices(name, differs, text):
    """Refuses other words than those of a choice."""
    for key, words in CHOICES.items():
        if key in differs and not isinstance(differs[key], dict) and differs[key] not in words:
            raise BadArgument("conditions", text, f"with {key} as one of {', '.join(words)} in {name}, not {differs[key]!r}")


DAY = ("year", "month", "day")
DATE = "date"  # stands for these three
A_DATE = "a date, year-month-day, such as 2024-07-01"
TIMES = ("hour", "minute", "second", *DAY)
WEATHER = ("cover", "optical_depth", "overcast", "visibility", "fog_top", "rain", "cloud_base", "wind", "wind_from", "cloud_seed",
           "wet", "puddles", "snow", "ground_seed")
# What of its own a camera has in one of the conditions, by where the renderer has it.
CAMERA = {"vignetting": ("vignetting", "natural"), "glare": ("glare", "share"), "blur": ("blur", "sigma"),
          "line_delay": ("shutter", "line_delay"), "exposure_time": ("shutter", "exposure_time"),
          "adaptation": ("exposure", "adaptation"), "exposure": ("exposure", "mode"), "ev100": ("exposure", "ev100"),
          "noise": ("noise", "enabled"), "mosaic": ("mosaic", "pattern")}
# Parameters of the sun's node that may differ, by their last parts, and groups of them; and those groups of the renderer.
SUN = (*TIMES, "timezone", "rate", "start_stamp", "wait_for_subscriber", "latitude", "longitude", "elevation", "pressure",
       "temperature", "atmospheric_refraction", "delta_ut1", "delta_t", "publish_rate", "tf_distance", "date_time", "site",
       "atmosphere", "earth", "frames")
RENDERED = ("weather", *dict.fromkeys(group for group, _ in CAMERA.values()))
DIFFERING = (*SUN, *WEATHER, *CAMERA, *RENDERED)  # all that may
# What differs in nothing, for both nodes: a map without keys gets lost on its way through the parameter server.
NOTHING = ""


USUAL_HOURS = "[4, 12, 20]"  # of experiment.launch: roslaunch does not tell what was typed from what was not


def conditions(text, hours):
    """'{grey: {hour: 12.5, cover: 8}}' -> {'grey': {hour: 12, minute: 30, second: 0.0, cover: 8}}, in the order given; those
    of `hours` where there are none, and not both. The range of all but the clock is the business of the node that gets it."""
    allowed = "a map from names to what differs, such as {noon: {hour: 12}, grey: {hour: 12, cover: 8, overcast: cie}}"
    asked = parse("conditions", text, allowed) if text.strip() else {}
    if not isinstance(asked, dict):
        raise BadArgument("conditions", text, allowed)
    if not asked:
        return clock_times(hours)
    found = {}
    for name, differs in asked.items():
        _check_name(name, text)
        if not isinstance(differs, dict) or not _is_hour(differs.get("hour")):
            raise BadArgument("conditions", text, f"with an hour, at least 0 and below 24, for {name}: {allowed}")
        for key in differs:
            known = (*TIMES, DATE, *WEATHER, *CAMERA)
            if key not in known:
                raise _unknown(text, key, name, known)
            if differs[key] is None:
                raise BadArgument("conditions", text, f"with a value for {key} in {name}")
        _check_clock(name, differs, text)
        _check_choices(name, differs, text)
        _check_given_once(name, differs, text)
        found[name] = {**_clock_time(differs["hour"]), **_at_clock_time(name, differs, text)}
    instead = "left out beside conditions, which have hours of their own: " + ", ".join(found)
    if parse("hours", hours, instead) != parse("hours", USUAL_HOURS, instead):
        raise BadArgument("hours", hours, instead)
    return found


def _unknown(text, key, name, known):
    near = difflib.get_close_matches(str(key), known, 1)
    return BadArgument("conditions", text, f"without {key} in {name}"
                       + (f" (did you mean {near[0]}?)" if near else f"; known are {', '.join(dict.fromkeys(known))}"))


def times_of(asked):
    """What of the conditions is the business of the sun."""
    return {name: {key: value for key, value in one.items() if key in TIMES} for name, one in asked.items()}


def _check_given_once(name, differs, text):
    for key, (group, row) in CAMERA.items():
        is_alone = key in differs and not isinstance(differs[key], dict)
        if is_alone and isinstance(differs.get(group), dict) and row in differs[group]:
            raise BadArgument("conditions", text, f"without both {key} and {group}: {{{row}: …}} in {name}, which are the same")


def rendered_of(asked):
    """What is the business of the renderers, weather and camera: a list of names where there is none."""
    rendered = {}
    for name, one in asked.items():
        _check_given_once(name, one, asked)
        rendered[name] = {key: value for key, value in one.items() if key in WEATHER}
        for key, value in one.items():
            if key in RENDERED and isinstance(value, dict):
                rendered[name].setdefault(key, {}).update(value)
            elif key in CAMERA:
                group, row = CAMERA[key]
                rendered[name].setdefault(group, {})[row] = value
    return _sent(rendered)


def _sent(differing):
    """As a node gets it."""
    kept = {name: {key: value for key, value in one.items() if value != {}} for name, one in differing.items()}
    return {name: one or NOTHING for name, one in kept.items()} if any(kept.values()) else list(kept)


def date_time(date, timezone):
    try:
        day = datetime.date.fromisoformat(date)
    except ValueError:
        raise BadArgument("date", date, _a_date(date)) from None
    allowed = "hours east of UTC, from -18 to 18"
    zone = parse("timezone", timezone, allowed)
    if not is_number(zone) or not -18 <= zone <= 18:
        raise BadArgument("timezone", timezone, allowed)
    return {"year": day.year, "month": day.month, "day": day.day, "timezone": float(zone), "rate": 0.0}


def site(text):
    allowed = "[latitude in deg, longitude in deg, elevation in m], such as [55.792115, 49.122254, 90]"
    values = parse("site", text, allowed)
    if not isinstance(values, list) or len(values) != 3 or not all(is_number(value) for value in values):
        raise BadArgument("site", text, allowed)
    return dict(zip(("latitude", "longitude", "elevation"), map(float, values)))


def self_test_stream(name):
    return f"self_test/{name}"


def pairs(names, self_test, every):
    """All pairs of conditions, and each against itself by a second renderer."""
    both = [{"a": a, "b": b} for a, b in itertools.combinations(names, 2)]
    if self_test:
        both += [{"a": name, "b": self_test_stream(name), "every": every} for name in names]
    if not both:
        raise BadArgument("hours or conditions", ", ".join(names), "two or more, or one with self_test:=true")
    return both


def features(text):
    """Parameters of detectors by name; what they hold is the business of the evaluator."""
    allowed = "a map of detectors by name, such as {sift_clahe: {type: sift, preprocessing: clahe}}"
    detectors = parse("features", text, allowed)
    if not isinstance(detectors, dict) or not all(isinstance(name, str) and isinstance(detector, dict) and detector
                                                  for name, detector in detectors.items()):
        raise BadArgument("features", text, allowed)
    for detector in detectors.values():
        if isinstance(detector.get("model"), str):  # nodes have a folder of their own
            detector["model"] = folder(detector["model"])
    return detectors


def differences(text, features_text="{}"):
    """`all` are those that an evaluator with SURF has by default; others may be detectors among the features."""
    known = list(dict.fromkeys(DIFFERENCES + MORE_DIFFERENCES + list(features(features_text))))
    allowed = f"all, or a list of some of {', '.join(known)}"
    names = DIFFERENCES if text == "all" else parse("differences", text, allowed)
    if not isinstance(names, list) or not names or not set(map(str, names)) <= set(known):
        raise BadArgument("differences", text, allowed)
    twice = [name for i, name in enumerate(names) if name in names[:i]]
    if twice:
        raise BadArgument("differences", text, f"without {twice[0]} twice")
    return names


def unused_features(features_text, differences_text):
    """One line where detectors are set that nothing is measured by; nothing where all are used."""
    compared = differences(differences_text, features_text)
    unused = [name for name in features(features_text) if name not in compared]
    return f"argument features sets {', '.join(unused)}, which no difference uses: add to differences" if unused else ""


def _detectors(name, text, compared, features_text):
    """Names that are typed of detectors, among the differences as typed; None: auto."""
    detectors = DETECTORS + list(features(features_text))
    known = [one for one in differences(compared, features_text) if one in detectors]
    if text == "auto":
        return None, known
    allowed = f"auto, or a list of some of {', '.join(known) or 'none'}: the detectors among the differences; [] for none"
    names = parse(name, text, allowed)
    if not isinstance(names, list) or not set(map(str, names)) <= set(known):
        raise BadArgument(name, text, allowed)
    return names, known


def verified(text, compared, features_text="{}"):
    """The detectors whose matches are checked. `auto`: None, those that an evaluator takes by itself."""
    return _detectors("verify", text, compared, features_text)[0]


def localising(text, compared, features_text="{}"):
    """The detectors that localise. `auto`: sift and orb, where they are among the differences."""
    names, known = _detectors("localise", text, compared, features_text)
    return [name for name in ("sift", "orb") if name in known] if names is None else names


def map_streams(text, times):
    """The conditions whose pictures make the map: those of the hours typed, or that of the hour nearest to noon. `times`:
    as clock_times() gives them."""
    hours = {name: time["hour"] + time.get("minute", 0) / 60 + time.get("second", 0) / 3600 for name, time in times.items()}
    if text == "auto":
        return [min(hours, key=lambda name: abs(hours[name] - 12.0))]
    allowed = "auto (the hour nearest to noon), one of the hours or conditions, or a list of some but not all, each once"
    asked = parse("map", text, allowed)
    asked = asked if isinstance(asked, list) else [asked]
    found = [name for hour in asked for name, one in hours.items()
             if name == hour or (is_number(hour) and abs(one - hour) * 3600 < 0.5)]
    if not found or len(found) != len(asked) or len(set(found)) != len(found) or len(found) == len(hours) > 1:
        raise BadArgument("map", text, allowed)
    return found


def named_conditions(text, known=DIFFERING):
    """A list of names, [morning, noon], or a map from names to what differs, of what is `known`."""
    allowed = "a list of names, [morning, noon], or a map from names to what differs, {h04: {hour: 4}}"
    asked = parse("conditions", text, allowed)
    if not isinstance(asked, (list, dict)):
        raise BadArgument("conditions", text, allowed)
    for name in asked:
        _check_name(name, text)
    if isinstance(asked, list):
        return asked
    for name, differs in asked.items():
        if not isinstance(differs, dict):
            raise BadArgument("conditions", text, allowed)
        for key in differs:
            if key not in (*known, DATE):
                raise _unknown(text, key, name, (*known, DATE))
    return {name: _at_clock_time(name, differs, text) for name, differs in asked.items()}


def condition_names(text):
    return list(named_conditions(text))


def of_sun(text, known=DIFFERING):
    """What of these conditions is the business of the sun."""
    asked = named_conditions(text, known)
    return asked if isinstance(asked, list) else _sent({name: {key: value for key, value in one.items() if key in SUN}
                                                        for name, one in asked.items()})


def of_renderer(text):
    asked = named_conditions(text)
    return asked if isinstance(asked, list) else rendered_of(asked)


def folder(text):
    """As seen from where roslaunch was started. A shell leaves the ~ of NAME:=~/folder to us."""
    try:
        return _told(os.path.abspath(os.path.expanduser(text)))
    except FileNotFoundError:  # of the current one, which is asked for where the text is no whole path
        raise BadPath(text, "the current folder has been deleted: change to one that is there, or give a whole path, "
                            "which begins with /") from None


def _told(path):
    """As nodes get it, in UTF-8. Of other letters they would make the name of another file."""
    if path.isascii():
        return path
    if sys.getfilesystemencoding() != "utf-8":
        chosen = next((f"{name}={os.environ[name]}" for name in ("LC_ALL", "LC_CTYPE", "LANG") if os.environ.get(name)), "none")
        raise BadPath(path, f"nodes would take its letters for others, since this locale ({chosen}) is not of UTF-8: "
                            "set LC_ALL=C.UTF-8")
    if os.fsencode(path) != path.encode(errors="replace"):
        raise BadPath(path, "nodes cannot be told its letters, which are not of UTF-8: give it another name")
    return path


def file(text):
    """Seen as a folder is. A name without a dot or slash, such as race_track, stays, and so does what has a scheme, such as
    model://, package:// or https://, which nodes look up."""
    return folder(text) if ("/" in text or "." in text) and "://" not in text else _told(text)


def folders(text):
    names = parse("model_path", text, "a list of folders")
    if not isinstance(names, list):
        raise BadArgument("model_path", text, "a list of folders")
    return [folder(str(name)) for name in names]


def robot(text, robots):
    """The file of a robot, given as one or by the name of its folder in `robots`; empty for none."""
    if not text or "/" in text or "." in text:
        return file(text)
    found = os.path.join(robots, text, text + ".urdf")
    if not os.path.exists(found):
        names = ", ".join(sorted(os.listdir(robots)))
        raise BadArgument("robot", text, f"empty, one of our own ({names}), or a file: .urdf .sdf")
    return found


def dangling_link(path):
    return os.path.islink(path) and not os.path.exists(path)


def output_folder(text):
    """Made here, so that a folder that cannot be written stops everything before it begins."""
    if not text.strip():  # which would be the current one
        raise BadArgument("output", text, "a folder")
    path = folder(text)
    try:
        os.makedirs(path, exist_ok=True)
        with tempfile.TemporaryFile(dir=path):
            pass
    except OSError as error:
        why = "a link to what is not there" if dangling_link(path) else error.strerror
        raise BadArgument("output", text, f"a folder that can be written ({path}: {why})") from None
    return path


def handed_on(words):
    """NAME:=VALUE ... as a launch file hands them on."""
    lost = [word for word in words if ":=" not in word]
    if lost:
        raise BadArgument("planned", " ".join(words), f"words NAME:=VALUE, not {lost[0]!r}")
    return dict(word.split(":=", 1) for word in words)


def roslaunch_words():
    """The command line of the roslaunch that asks us; nothing where we were not asked by one."""
    with contextlib.suppress(psutil.Error):  # one of them ended while we looked
        process = psutil.Process().parent()
        while process is not None:
            words = process.cmdline()
            if any(os.path.basename(word) == "roslaunch" for word in words):
                return words
            process = process.parent()
    return []


def _leads_to(word, file):
    try:
        return os.path.realpath(word) == file
    except FileNotFoundError:  # of the current folder, which has been deleted
        return False


def given(launch_file, words):
    """What was typed behind the launch file as name:=value. roslaunch itself takes a misspelt name without a word, and would
    start a whole experiment, say, with the default."""
    ours = os.path.realpath(launch_file)
    if not any((before == "sunlit" and word == os.path.basename(ours)) or _leads_to(word, ours)
               for before, word in zip(words, words[1:])):
        return {}  # started by a launch file of the user's, whose arguments these are
    parts = [word.split(":=", 1) for word in words if ":=" in word and not word.startswith("_")]
    typed = {name.strip(): value.strip() for name, value in parts}  # as roslaunch takes them
    known = [arg.get("name") for arg in ElementTree.parse(launch_file).iter("arg") if "value" not in arg.attrib]
    for name, value in typed.items():
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            raise BadArgument(name, value, f"one of the arguments of {os.path.basename(launch_file)}"
                              + (f"; {near[0]} is one" if near else f": {', '.join(known)}"))
    return typed
