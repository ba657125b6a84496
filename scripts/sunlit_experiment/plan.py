"""The plan of an experiment: from the arguments of experiment.launch to the parameters of every node, in one go.

Nothing is started, written or read here; what has to be looked up (how many poses the path has, how far an earlier run
came) is given.
"""

import dataclasses
import math

from sunlit_experiment import arguments as read
from sunlit_experiment import recording, same_settings

START_STAMP_S = 1000.0
FRAME_RATE_HZ = 10.0
DEGREES_PER_HOUR = 15
FAR_FROM_NOON_H = 1.5
EVALUATOR, RECORDER = "/evaluator", "/" + recording.NODE  # nodes
# What the evaluator writes down beside its results, as it was typed, but for flags, which have several spellings.
ABOUT = ("world", "robot", "path", "site", "date", "timezone", "hours", "conditions", "spacing", "offset", "yaw", "exposure", "ev100",
         "highlight_protection", "final_gather", "rasterizer", "night", "lamps", "noise", "noise_seed", "vignetting", "glare",
         "blur", "mosaic", "line_delay", "exposure_time", "speed", "adaptation", "turbidity", "ozone", "ground_albedo")
FLAGS = ("night", "noise")


@dataclasses.dataclass
class Beginning:
    """Where a run begins: 0, or where an earlier one in the same folder was broken off."""
    poses: int             # of the whole run
    evaluated: int = 0     # the first pose that is not evaluated
    recorded: int = 0      # the first pose that no bag holds; as `evaluated` where nothing is recorded
    written: dict = dataclasses.field(default_factory=dict)  # what it wrote at its end, as summary.identities() has it
    inputs: str = ""       # the file that says what it was made from, as summary.identity() has it
    about: dict = dataclasses.field(default_factory=dict)  # what it was told about itself, texts by name

    def render_at(self):
        return min(self.evaluated, self.recorded)

    def is_evaluated(self):
        return self.evaluated >= self.poses

    def seen_before(self):
        """The first poses, of which the evaluator sees nothing more."""
        return self.poses if self.is_evaluated() else self.render_at()


def check(typed, given=()):
    """Everything that can be refused by its text alone. `typed`: texts by name; `given`: names of those that the user gave."""
    for name in ("self_test", "record", "report", "images", "night", "noise", "compressed", "rviz", "verbose"):
        read.flag(name, typed[name])
    for name in ("width", "height", "noise_seed", "final_gather", "max_ahead"):
        read.whole(name, typed[name])
    for name in ("horizontal_fov", "camera_height", "offset", "yaw", "ev100", "highlight_protection", "adaptation", "glare", "blur",
                 "line_delay", "turbidity", "ozone", "baseline"):
        read.number(name, typed[name])
    for name in ("ground_albedo", "exposure_time", "speed"):
        read.number_or_auto(name, typed[name])
    for name in ("missing", "exposure", "lamps", "vignetting", "mosaic"):
        read.choice(name, typed[name])
    if typed["rasterizer"]:
        read.choice("rasterizer", typed["rasterizer"])
    read.date_time(typed["date"], typed["timezone"])
    read.site(typed["site"])
    read.folders(typed["model_path"])
    read.differences(typed["differences"], typed["features"])
    read.verified(typed["verify"], typed["differences"], typed["features"])
    map_streams(typed)
    pairs(typed)
    _check_effect(typed, given)


def _check_effect(typed, given):
    """What is given for nothing is refused, by all conditions."""
    ones = conditions(typed).values()
    if "ev100" in given and not any(one.get("exposure", typed["exposure"]) != "auto" for one in ones):
        raise read.BadArgument("ev100", typed["ev100"], "left out where exposure is auto")
    if "noise_seed" in given and not any(one.get("noise", read.flag("noise", typed["noise"])) for one in ones):
        raise read.BadArgument("noise_seed", typed["noise_seed"], "left out where noise is false")


def notes(typed, given=()):
    """Lines about what is likely not meant, but is no fault; `typed` and `given` as above."""
    return [line for line in (read.unused_features(typed["features"], typed["differences"]), _other_zone(typed, given)) if line]


def _other_zone(typed, given):
    """That nobody said of what time zone the hours are, where by that of the default the sun is highest far from 12:00."""
    zone = read.date_time(typed["date"], typed["timezone"])["timezone"]
    late = math.remainder(zone - read.site(typed["site"])["longitude"] / DEGREES_PER_HOUR, 24)  # the sun's noon, after 12:00
    if "timezone" in given or abs(late) <= FAR_FROM_NOON_H:
        return ""
    hour, quarter = divmod(round((12 + late) * 4) % 96, 4)  # no finer: the sun itself is up to 17 minutes late or early
    return (f"hours are of UTC{zone:+g}; the sun is highest there at about {hour:02d}:{quarter * 15:02d}: argument timezone gives "
            "another zone")


def conditions(typed):
    """What each differs in, by name."""
    return read.conditions(typed["conditions"], typed["hours"])


def pairs(typed):
    return read.pairs(list(conditions(typed)), read.flag("self_test", typed["self_test"]),
                      read.whole("self_test_every", typed["self_test_every"], 1))


def map_streams(typed):
    """The conditions that the others are looked for in; none where nothing is localised."""
    times = conditions(typed)
    asked = read.map_streams(typed["map"], times)
    return asked if len(times) > 1 and localising(typed) else []


def localising(typed):
    return read.localising(typed["localise"], typed["differences"], typed["features"])


def recorded_topics(typed):
    return recording.topics(list(conditions(typed)), read.flag("compressed", typed["compressed"]), bool(_right(typed)))


def parameters(typed, given, places, beginning):
    """The parameters of all nodes, a tree. `typed`: all arguments as texts by name; `given`: those of them that the user
    gave; `places`: files and folders by name (output, robots, report)."""
    has_self_test = read.flag("self_test", typed["self_test"])
    tree = {"experiment": _experiment(typed, given, places, beginning), "sun_position": _sun_position(typed),
            "render": _main_renderer(typed, given, places, beginning), "evaluator": _evaluator(typed, places, beginning)}
    if has_self_test:
        tree["self_test"] = {"render": _self_test_renderer(typed, given, places, beginning)}
    return tree


def _experiment(typed, given, places, beginning):
    has_self_test = read.flag("self_test", typed["self_test"])
    tree = {"arguments": given, "output": places["output"], "poses": beginning.poses,
            "verbose": read.flag("verbose", typed["verbose"]), "images_a_pose": len(conditions(typed)),
            "self_test_every": read.whole("self_test_every", typed["self_test_every"]),
            "needed": ["sun_position", "render", "evaluator"] + (["self_test/render"] if has_self_test else [])}
    if read.flag("record", typed["record"]):
        tree["recording"] = {"topics": recorded_topics(typed),
                             "start_stamp": START_STAMP_S, "frame_rate": FRAME_RATE_HZ,
                             "begin": beginning.render_at()}
    if beginning.written:
        tree["earlier"] = beginning.written
    if beginning.is_evaluated():
        tree["inputs"] = beginning.inputs
    if read.flag("report", typed["report"]):
        tree["report"] = places["report"]
    return tree


def _sun_position(typed):
    return {"date_time": read.date_time(typed["date"], typed["timezone"]), "site": read.site(typed["site"]),
            "conditions": read.times_of(conditions(typed))}


def _camera(typed, given):
    """A pinhole, or what a file says; beside that only what the user gave, which the renderer compares with it."""
    pinhole = {"width": read.whole("width", typed["width"]), "height": read.whole("height", typed["height"]),
               "horizontal_fov": read.number("horizontal_fov", typed["horizontal_fov"])}
    if not typed["calibration"]:
        return pinhole
    return {"calibration": read.file(typed["calibration"]), **{name: pinhole[name] for name in pinhole if name in given}}


def _right(typed):
    """The right camera's parameters below `camera`; none where there is no such camera."""
    tree = {}
    if typed["right_calibration"]:
        tree["right"] = {"calibration": read.file(typed["right_calibration"])}
    baseline = read.number("baseline", typed["baseline"])
    if baseline:
        tree["baseline"] = baseline
    return tree


def _renderer(typed, given, places, beginning):
    """What both renderers share."""
    # Without a name, the renderer draws by the first that was built.
    rasterizer = {"rasterizer": typed["rasterizer"]} if typed["rasterizer"] else {}
    return {
        "conditions": read.rendered_of(conditions(typed)),
        "world": read.file(typed["world"]),
        "model_path": read.folders(typed["model_path"]),
        "missing": typed["missing"],
        "robot": {"file": read.robot(typed["robot"], places["robots"])},
        "path": {"file": read.file(typed["path"]), "spacing": read.number("spacing", typed["spacing"]),
                 "camera_height": read.number("camera_height", typed["camera_height"]), "count": beginning.poses,
                 "offset": read.number("offset", typed["offset"]), "yaw": read.number("yaw", typed["yaw"]),
                 "speed": read.number_or_auto("speed", typed["speed"])},
        "camera": {**_camera(typed, given), **rasterizer},
        "exposure": {"mode": typed["exposure"], "ev100": read.number("ev100", typed["ev100"]),
                     "highlight_protection": read.number("highlight_protection", typed["highlight_protection"]),
                     "adaptation": read.number("adaptation", typed["adaptation"])},
        "shutter": {"line_delay": read.number("line_delay", typed["line_delay"]),
                    "exposure_time": read.number_or_auto("exposure_time", typed["exposure_time"])},
        "transport": {"final_gather": read.whole("final_gather", typed["final_gather"])},
        "night": {"enabled": read.flag("night", typed["night"])},
        "lamps": typed["lamps"],
        "noise": {"enabled": read.flag("noise", typed["noise"]), "seed": read.whole("noise_seed", typed["noise_seed"])},
        "vignetting": {"natural": typed["vignetting"]},
        "glare": {"share": read.number("glare", typed["glare"])},
        "blur": {"sigma": read.number("blur", typed["blur"])},
        "mosaic": {"pattern": typed["mosaic"]},
        "atmosphere": {"turbidity": read.number("turbidity", typed["turbidity"]),
                       "ozone": read.number("ozone", typed["ozone"]),
                       "ground_albedo": read.number_or_auto("ground_albedo", typed["ground_albedo"])},
        "frame_rate": FRAME_RATE_HZ,
        "start_stamp": START_STAMP_S,
        "compressed": read.flag("compressed", typed["compressed"]),
        "max_ahead": read.whole("max_ahead", typed["max_ahead"]),
        "look_ahead": False,  # while poses are evaluated all cores are busy: it would only take memory
        "exit_when_done": True,
    }


def _main_renderer(typed, given, places, beginning):
    readers = [EVALUATOR + "/progress"]
    if read.flag("self_test", typed["self_test"]):
        readers.append("/self_test/render/progress")  # counts as one, so that the two keep abreast
    recorders = 1 if read.flag("record", typed["record"]) else 0
    evaluators = 1
    if recorders and beginning.is_evaluated() and beginning.recorded < beginning.poses:
        evaluators = 0  # it ends at once, having nothing to do; only the recorder is left to wait for
        readers = []
    # By name: a viewer that listens, or an evaluator about to leave, is none of those who must miss nothing.
    counted = [EVALUATOR] * evaluators + [RECORDER] * recorders
    tree = _renderer(typed, given, places, beginning)
    tree["camera"].update(_right(typed))
    tree.update(
        resume_at=beginning.render_at(),
        publish_clock=True,
        output_dir=places["output"],
        wait_for=readers,
        # Of each kind of topic before the first image leaves.
        subscribers={"images": len(counted), "poses": len(counted),
                     "truth": (evaluators if map_streams(typed) else 0) + recorders, "others": recorders, "of": counted})
    if _right(typed):
        tree["subscribers"]["right"] = recorders
    return tree


def _self_test_renderer(typed, given, places, beginning):
    """The second one, of each hour against itself; it is not recorded."""
    tree = _renderer(typed, given, places, beginning)
    tree["path"]["stride"] = read.whole("self_test_every", typed["self_test_every"])
    if beginning.is_evaluated():  # it has nothing left to render, and should not bake for it
        tree["transport"] = {"enabled": False}
    tree.update(
        resume_at=beginning.evaluated,
        exact_sky=True,
        wait_for=[EVALUATOR + "/progress"],
        subscribers={"images": 1, "of": [EVALUATOR]},
        sun_namespace="/",
        warn_of_inputs=False,  # the first does
        publish_tf=False,
        count_skipped=True)  # the evaluator counts what both have rendered
    return tree


def _about(typed, beginning):
    about = {name: str(read.flag(name, typed[name])).lower() if name in FLAGS else typed[name] for name in ABOUT}
    every = read.whole("self_test_every", typed["self_test_every"])
    about["self_test"] = f"every {every}" if read.flag("self_test", typed["self_test"]) else "false"
    about["camera"] = f"{_about_camera(typed)}, {typed['camera_height']} m"
    # With nothing evaluated there is nothing that the renderer would compare files with.
    return same_settings.as_before(about, beginning.about, has_inputs=beginning.evaluated > 0)


def _about_camera(typed):
    return typed["calibration"] or f"{typed['width']} x {typed['height']}, {typed['horizontal_fov']} deg"


def _evaluator(typed, places, beginning):
    names = list(conditions(typed))
    if read.flag("self_test", typed["self_test"]):
        names += [read.self_test_stream(name) for name in names]
    tree = {"streams": names, "pairs": pairs(typed), "poses": beginning.poses, "whole_path": True,
            "frame_rate": FRAME_RATE_HZ, "stamp_start": START_STAMP_S, "output_dir": places["output"],
            "images": "all" if read.flag("images", typed["images"]) else "samples", "exit_when_done": True,
            "report": False,  # the experiment draws it, once its recording is complete, too
            "about": _about(typed, beginning)}
    if read.flag("compressed", typed["compressed"]):
        tree["image_transport"] = "compressed"
    if typed["differences"] != "all":  # else its own default
        tree["differences"] = read.differences(typed["differences"], typed["features"])
    detectors = read.features(typed["features"])
    if detectors:
        tree["features"] = detectors
    verified = read.verified(typed["verify"], typed["differences"], typed["features"])
    if verified is not None:  # else its own default
        tree["verify"] = verified
    if of_map := map_streams(typed):
        hours = list(conditions(typed))
        tree["localisation"] = {"map": "+".join(of_map), "queries": [name for name in hours if name not in of_map]}
        if typed["localise"] != "auto":  # else those of its own that this build of it has
            tree["localisation"]["detectors"] = localising(typed)
    return tree
