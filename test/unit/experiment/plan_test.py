#!/usr/bin/env python3
"""What the arguments of launch files become."""

import os
import re
import shlex
import socket
import sys
import tempfile
import unittest
from unittest import mock
from xml.etree import ElementTree

import rosunit
from roslaunch import substitution_args

sys.dont_write_bytecode = True
SOURCE = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", ".."))
sys.path.insert(0, os.path.join(SOURCE, "scripts"))

from sunlit_experiment import arguments, earlier_run, others, plan, same_settings  # noqa: E402

LAUNCH_FILE = os.path.join(SOURCE, "launch", "experiment.launch")
ROBOTS = os.path.join(SOURCE, "worlds", "robots")
PLACES = {"output": "/results", "robots": ROBOTS, "report": "/report"}


def defaults(**typed):
    """The arguments of experiment.launch, as texts."""
    texts = {arg.get("name"): arg.get("default") for arg in ElementTree.parse(LAUNCH_FILE).iter("arg") if "default" in arg.attrib}
    return dict(texts, **typed)


def handed_on(**typed):
    """All arguments as the launch file hands them on where these are typed."""
    return arguments.handed_on(shlex.split(resolved(LAUNCH_FILE, plan="", **defaults(**typed))["planned"]))


def resolved(launch_file, **typed):
    """The arguments of a launch file as roslaunch resolves those that hand on what is typed."""
    context = {"arg": dict(typed)}
    for arg in ElementTree.parse(launch_file).iter("arg"):
        if re.match("typed|planned|quoted_", arg.get("name")):
            context["arg"][arg.get("name")] = substitution_args.resolve_args(arg.get("value"), context)
    return context["arg"]


def planned(beginning=plan.Beginning(991), **typed):
    texts = defaults(**typed)
    plan.check(texts)
    return plan.parameters(texts, typed, PLACES, beginning)


class Arguments(unittest.TestCase):

    def assert_refused(self, words, function, *texts):
        with self.assertRaises(arguments.BadArgument) as caught:
            function(*texts)
        self.assertIn(words, str(caught.exception))

    def test_hours_are_named_by_the_clock(self):
        names = lambda text: list(arguments.clock_times(text))
        self.assertEqual(names("[4, 12, 20]"), ["h04", "h12", "h20"])
        self.assertEqual(names("[4.5, 0, 23.9997222]"), ["h04_30", "h00", "h23_59_59"])
        self.assertEqual(arguments.clock_times("12.25"), {"h12_15": {"hour": 12, "minute": 15, "second": 0.0}})
        # The last half second of a day does not spill into the next.
        self.assertEqual(names("[23.99999]"), ["h23_59_59"])

    def test_conditions_stand_for_hours(self):
        typed = "{noon: {hour: 12}, fog: {hour: 12.5, month: 11, visibility: 150}, grey: {hour: 9, cover: 8, overcast: cie}}"
        tree = planned(conditions=typed)
        self.assertEqual(tree["sun_position"]["conditions"],
                         {"noon": {"hour": 12, "minute": 0, "second": 0.0},
                          "fog": {"hour": 12, "minute": 30, "second": 0.0, "month": 11},
                          "grey": {"hour": 9, "minute": 0, "second": 0.0}})
        self.assertEqual(tree["render"]["conditions"],
                         {"noon": "", "fog": {"visibility": 150}, "grey": {"cover": 8, "overcast": "cie"}})
        self.assertEqual(tree["self_test"]["render"]["conditions"], tree["render"]["conditions"])
        self.assertIn({"a": "noon", "b": "fog"}, tree["evaluator"]["pairs"])
        self.assertEqual(tree["evaluator"]["localisation"]["map"], "noon")
        self.assertEqual(planned(conditions=typed, map="[grey]")["evaluator"]["localisation"]["map"], "grey")
        self.assertEqual(planned()["render"]["conditions"], ["h04", "h12", "h20"])

    def test_bad_conditions_are_refused(self):
        for text, part in (("[4]", "a map from names"), ("{a: 4}", "with an hour"), ("{a: {cover: 8}}", "with an hour"),
                           ("{a: {hour: 24}}", "with an hour"), ("{a: {hour: 4, covr: 8}}", "did you mean cover"),
                           ("{a: {hour: 4, x: 8}}", "known are hour"), ("{a-b: {hour: 4}}", "with names of"),
                           ("{a: {hour: 4}", "a map from names"), ("{4: {hour: 4}}", "with names of"),
                           ("{a: {hour: 12, rain: }, b: {hour: 12}}", "with a value for rain in a"),
                           ("{a: {hour: 12}, a: {hour: 13}}", "without a twice"),
                           ("{a: {hour: 12, rain: 5, rain: 10}}", "without rain twice"),
                           ("{a: {hour: 010}}", "without a zero before 10"),
                           ("{a: {hour: 12, ? [1] : 2}}", "a map from names"),
                           ("{a: {hour: 12, minute: half}}", "with minute as a whole number from 0 to 59 in a, not 'half'"),
                           ("{a: {hour: 12, minute: 60}}", "with minute as a whole number from 0 to 59 in a, not 60"),
                           ("{a: {hour: 12, minute: 0.5}}", "with minute as a whole number from 0 to 59 in a, not 0.5"),
                           ("{a: {hour: 12, second: 30s}}", "with second as a number, at least 0 and below 60 in a, not '30s'"),
                           ("{a: {hour: 12, second: [1]}}", "with second as a number, at least 0 and below 60 in a, not [1]"),
                           ("{a: {hour: 12.5, minute: 10}}", "without minute in a, whose hour 12.5 has a fraction")):
            self.assert_refused("argument conditions is", arguments.conditions, text, "[4]")
            self.assert_refused(part, arguments.conditions, text, "[4]")

    def test_hours_beside_conditions_are_refused(self):
        self.assertEqual(arguments.USUAL_HOURS, defaults()["hours"])
        typed = "{noon: {hour: 12}, grey: {hour: 12, cover: 8}}"
        for hours in ("[6, 18]", "[4, 12]", "12", ""):
            with self.assertRaises(arguments.BadArgument) as caught:
                planned(conditions=typed, hours=hours)
            self.assertEqual(str(caught.exception), f"argument hours is {hours!r}, but must be left out beside conditions, "
                             "which have hours of their own: noon, grey")
        # What roslaunch fills in, however it is spelt, is not told from what was left out.
        self.assertEqual(list(planned(conditions=typed, hours="[4,12, 20]")["render"]["conditions"]), ["noon", "grey"])
        self.assertEqual(planned(conditions="{}", hours="[6, 18]")["render"]["conditions"], ["h06", "h18"])

    def test_bad_hours_are_refused(self):
        # The last two are no YAML for other reasons: a date that is none, and more brackets than Python goes into.
        for hours in ("2024-99-99", "[" * 5000, "[]", "[24]", "[-1]", "[4, 4.0]", "[true]", "[.nan]", "{4: 5}", "[4", "noon"):
            self.assert_refused("argument hours is", arguments.clock_times, hours)

    def test_robots_are_ours_by_name_or_files(self):
        self.assertEqual(arguments.robot("", ROBOTS), "")
        self.assertEqual(arguments.robot("some.urdf", ROBOTS), os.path.join(os.getcwd(), "some.urdf"))
        self.assert_refused("argument robot is 'cat', but must be empty, one of our own (rover), or a file",
                            arguments.robot, "cat", ROBOTS)
        for name in os.listdir(ROBOTS):
            self.assertTrue(os.path.isfile(arguments.robot(name, ROBOTS)), name)

    def test_conditions_are_a_list_or_a_map(self):
        self.assertEqual(arguments.condition_names("{a: {hour: 4}, b: {}}"), ["a", "b"])
        for text, name in (("{4: {hour: 4}}", "4"), ("[a, b-c]", "'b-c'"), ("[a, [b]]", "['b']"), ("{a/b: {}}", "'a/b'")):
            self.assert_refused("with names of letters, digits and _, a letter first, not " + name, arguments.condition_names, text)
        for text in ("morning", "5"):  # not the letters m, o, r ...
            self.assert_refused("argument conditions is '%s', but must be a list of names" % text,
                                arguments.condition_names, text)

    def test_hours_of_conditions_may_have_fractions(self):
        for split in (arguments.of_sun, lambda text: arguments.of_sun(text, arguments.SUN)):
            self.assertEqual(split("{a: {hour: 18.75}, b: {hour: 9, minute: 5}}"),
                             {"a": {"hour": 18, "minute": 45, "second": 0.0}, "b": {"hour": 9, "minute": 5}})
            self.assertEqual(split("{a: {hour: 25.5}}"), {"a": {"hour": 25.5}})  # which the node refuses, with its range
            self.assert_refused("without second in a, whose hour 9.5 has a fraction", split, "{a: {hour: 9.5, second: 0}}")
        self.assertEqual(arguments.conditions("{a: {hour: 9, minute: 5}}", arguments.USUAL_HOURS),
                         {"a": {"hour": 9, "minute": 5, "second": 0.0}})

    def test_a_condition_may_have_a_date(self):
        day = {"year": 2024, "month": 12, "day": 21}
        noon = {"hour": 12, "minute": 0, "second": 0.0}
        for typed in ("2024-12-21", "'2024-12-21'"):
            text = "{a: {hour: 12, date: %s}}" % typed
            self.assertEqual(arguments.conditions(text, arguments.USUAL_HOURS), {"a": {**noon, **day}})
            self.assertEqual(arguments.of_sun(text, arguments.SUN), {"a": {"hour": 12, **day}})
            self.assertEqual(arguments.of_renderer(text), ["a"])
        for wrong, part in (("2024-02-30", "without 2024-02-30, which is no date"), ("noon", "with a date, year-month-day"), ("12", "with a date"),
                            ("2024-12-21 10:00:00", "with a date"), ("2024-12-21, month: 12", "without month in a, which has a date")):
            with self.assertRaisesRegex(arguments.BadArgument, part):
                arguments.conditions("{a: {hour: 12, date: %s}}" % wrong, arguments.USUAL_HOURS)

    def test_conditions_of_render_launch_are_split_between_sun_and_renderer(self):
        typed = "{a: {hour: 9, cover: 8, glare: 0.03, site: {latitude: 10}}, b: {hour: 9, glare: {wings: 0.2}, blur: {}}, c: {}}"
        # The parameter server keeps no empty map, and the nodes read an empty text as one.
        self.assertEqual(arguments.of_sun(typed), {"a": {"hour": 9, "site": {"latitude": 10}}, "b": {"hour": 9}, "c": ""})
        self.assertEqual(arguments.of_renderer(typed),
                         {"a": {"cover": 8, "glare": {"share": 0.03}}, "b": {"glare": {"wings": 0.2}}, "c": ""})
        self.assertEqual(arguments.of_renderer("{a: {hour: 9}, b: {}}"), ["a", "b"])
        for function in (arguments.of_sun, arguments.of_renderer):
            self.assertEqual(function("[a, b]"), ["a", "b"])
            self.assert_refused("without covr in a (did you mean cover?)", function, "{a: {hour: 9, covr: 8}}")
            self.assert_refused("must be a list of names", function, "{a: 9}")
        # Where there is no renderer, nobody would heed it.
        self.assert_refused("without cover in a", arguments.of_sun, "{a: {cover: 8}}", arguments.SUN)

    def test_all_pairs_and_each_hour_with_itself(self):
        self.assertEqual(arguments.pairs(["h04", "h12", "h20"], True, 10),
                         [{"a": "h04", "b": "h12"}, {"a": "h04", "b": "h20"}, {"a": "h12", "b": "h20"},
                          {"a": "h04", "b": "self_test/h04", "every": 10},
                          {"a": "h12", "b": "self_test/h12", "every": 10},
                          {"a": "h20", "b": "self_test/h20", "every": 10}])
        self.assertEqual(arguments.pairs(["h04", "h12"], False, 10), [{"a": "h04", "b": "h12"}])
        self.assert_refused("two or more, or one with self_test:=true", arguments.pairs, ["h04"], False, 10)

    def test_dates_and_places(self):
        self.assertEqual(arguments.date_time("2024-07-01", "3"),
                         {"year": 2024, "month": 7, "day": 1, "timezone": 3.0, "rate": 0.0})
        form = "argument date is '%s', but must be a date, year-month-day, such as 2024-07-01"
        for wrong, more in (("2024-02-30", ", with a day from 1 to 29 in month 2 of year 2024"), ("2023-04-31", ", with a day from 1 to 30 in month "
                            "4 of year 2023"), ("2024-13-01", ", with a month from 1 to 12"), ("0000-01-01", ""), ("noon", "")):
            with self.assertRaises(arguments.BadArgument) as refused:
                arguments.date_time(wrong, "3")
            self.assertEqual(str(refused.exception), form % wrong + more)
        self.assert_refused("argument timezone is", arguments.date_time, "2024-07-01", "19")
        self.assertEqual(arguments.site("[55.5, 49, 90]"), {"latitude": 55.5, "longitude": 49.0, "elevation": 90.0})
        self.assert_refused("argument site is", arguments.site, "[55.5, 49]")

    def test_files_are_seen_from_where_roslaunch_was_started(self):
        self.assertEqual(arguments.file("race_track"), "race_track")
        self.assertEqual(arguments.file("some.world"), os.path.join(os.getcwd(), "some.world"))
        self.assertEqual(arguments.file(""), "")
        for looked_up in ("model://my_world", "package://mine/worlds/a.world", "https://fuel.gazebosim.org/1.0/them/worlds/A"):
            self.assertEqual(arguments.file(looked_up), looked_up)

    def test_a_tilde_is_the_home_folder_for_every_file_and_folder(self):
        """bash leaves it as it is in NAME:=~/file."""
        with tempfile.TemporaryDirectory() as home, mock.patch.dict(os.environ, HOME=home):
            self.assertEqual(arguments.file("~/some.world"), os.path.join(home, "some.world"))
            self.assertEqual(arguments.folders("[~/a, b]"), [os.path.join(home, "a"), os.path.join(os.getcwd(), "b")])
            self.assertEqual(arguments.output_folder("~/results"), os.path.join(home, "results"))

    def test_an_empty_folder_for_results_is_not_the_current_one(self):
        for text in ("", " "):
            self.assert_refused("argument output is %r, but must be a folder" % text, arguments.output_folder, text)
        words = ["/usr/bin/roslaunch", "sunlit", "experiment.launch", "output:="]  # of which roslaunch makes the default
        self.assertEqual(arguments.given(LAUNCH_FILE, words), {"output": ""})

    def test_what_was_typed_is_known_and_a_misspelt_name_is_not(self):
        words = ["/usr/bin/python3", "/usr/bin/roslaunch", "-p", "11311", "sunlit", "experiment.launch"]
        self.assertEqual(arguments.given(LAUNCH_FILE, words + ["hours:=[4, 12]", "__name:=x"]), {"hours": "[4, 12]"})
        self.assert_refused("argument nosie is 'true', but must be one of the arguments of experiment.launch; noise is one",
                            arguments.given, LAUNCH_FILE, words + ["nosie:=true"])
        # Another launch file has arguments of its own.
        self.assertEqual(arguments.given(LAUNCH_FILE, ["roslaunch", "mine", "experiment.launch", "nosie:=true"]), {})


class Plan(unittest.TestCase):

    def assert_refused(self, words, **typed):
        with self.assertRaises(arguments.BadArgument) as caught:
            plan.check(defaults(**typed))
        self.assertIn(words, str(caught.exception))

    def test_every_argument_of_the_launch_file_is_planned_with(self):
        """An argument that is documented but never handed on would be taken without a word."""
        self.assertEqual(list(handed_on()), list(defaults()))

    def test_what_is_handed_on_is_as_it_was_typed_whatever_quotes_are_in_it(self):
        self.assertEqual(handed_on(), defaults())
        typed = {"model_path": "['my models']", "world": "it's.world", "output": "my \"best\" 'run' \\ $HOME",
                 "conditions": "12", "noise": "true"}
        self.assertEqual(handed_on(**typed), defaults(**typed))
        for text in ("0701", "2024.10", "1e3", "True", "true"):  # not as numbers or truths
            self.assertEqual(handed_on(output=text, world=text), defaults(output=text, world=text))

    def test_texts_of_the_other_launch_files_are_handed_on_as_typed(self):
        for file, names in (("evaluator", ["output"]), ("demo", ["world", "path"]),
                            ("render", ["world", "robot", "path", "calibration", "right_calibration"])):
            for text in ("0701", "2024.10", "True", "it's", ""):
                found = resolved(os.path.join(SOURCE, "launch", file + ".launch"), conditions="", **dict.fromkeys(names, text))
                for name in names:
                    self.assertEqual(shlex.split("'%s'" % found["quoted_" + name]), [text], (file, name))

    def test_other_words_than_names_and_values_are_refused(self):
        with self.assertRaisesRegex(arguments.BadArgument, "must be words NAME:=VALUE, not 'models'"):
            arguments.handed_on(["world:=my", "models"])

    def test_words_that_are_no_choice_are_refused(self):
        for name, word, words in (("exposure", "14", "fixed, auto"), ("missing", "skip", "stop, warn"), ("lamps", "true", "auto, on, off"),
                                  ("rasterizer", "gpu", "osmesa, egl, builtin"), ("vignetting", "cos", "none, cos4"),
                                  ("mosaic", "rgbg", "none, rggb, bggr, grbg, gbrg")):
            self.assert_refused("argument %s is %r, but must be one of %s" % (name, word, words), **{name: word})
        self.assert_refused("with overcast as one of layer, cie in a, not 'cei'", conditions="{a: {hour: 4, overcast: cei}}")
        self.assert_refused("with exposure as one of fixed, auto in a, not 14", conditions="{a: {hour: 4, exposure: 14}}")
        for both in ("ev100: 12, exposure: {mode: fixed, ev100: 10}", "exposure: {mode: fixed, ev100: 10}, ev100: 12"):
            self.assert_refused("without both ev100 and exposure: {ev100: …} in a", conditions="{a: {hour: 4, %s}}" % both)
        planned(conditions="{a: {hour: 4, exposure: {mode: auto}}, b: {hour: 5, mosaic: rggb, overcast: layer}}")

    def test_what_is_given_for_nothing_is_refused(self):
        for name, typed, part in (("ev100", {"ev100": "9", "exposure": "auto"}, "argument ev100 is '9', but must be left out where"),
                                  ("noise_seed", {"noise_seed": "7"}, "argument noise_seed is '7', but must be left out where")):
            with self.assertRaisesRegex(arguments.BadArgument, part):
                plan.check(defaults(**typed), typed)
            plan.check(defaults(**typed))  # by a launch file that gives all of them, it may be
        for typed in ({"ev100": "9", "exposure": "auto", "conditions": "{a: {hour: 4}, b: {hour: 4, exposure: fixed}}"},
                      {"ev100": "9"}, {"noise_seed": "7", "noise": "1"}, {"noise_seed": "7", "conditions": "{a: {hour: 4, noise: true}}"}):
            plan.check(defaults(**typed), typed)

    def test_defaults_are_no_bad_arguments(self):
        plan.check(defaults())

    def test_what_is_no_number_or_no_truth_is_refused_by_name(self):
        self.assert_refused("argument width is 'wide', but must be a whole number", width="wide")
        self.assert_refused("argument self_test_every is 0, but must be a whole number of at least 1", self_test_every="0")
        self.assert_refused("argument ev100 is 'nan', but must be a number", ev100="nan")
        self.assert_refused("argument noise is 'yes', but must be true or false", noise="yes")
        self.assert_refused("argument verbose is 'loudly', but must be true or false", verbose="loudly")
        self.assert_refused("argument differences is '[sfit]'", differences="[sfit]")
        self.assert_refused("argument differences is '[orb, orb]', but must be without orb twice", differences="[orb, orb]")
        self.assert_refused("argument verify is '[surf]', but must be auto, or a list of some of sift:",
                            differences="[sift, boolean_rgb]", verify="[surf]")
        self.assert_refused("argument verify is 'sift', but must be auto, or a list of some of sift, surf, orb, brisk:", verify="sift")
        for text in ("sift", "[sift]", "{mine: sift}", "{mine: {}}", "{1: {type: sift}}", "{mine: {type"):
            self.assert_refused("argument features is %r, but must be a map of detectors by name" % text, features=text)

    def test_what_is_no_time_or_place_is_refused_by_name(self):
        self.assert_refused("argument hours is '[4, x]'", hours="[4, x]")
        self.assert_refused("argument hours or conditions is 'h12', but must be two or more", hours="[12]", self_test="false")
        self.assert_refused("argument date is '2024-02-31'", date="2024-02-31")
        self.assert_refused("argument site is '[91]'", site="[91]")

    def test_the_land_beyond_the_world_reflects_as_typed_or_as_the_world_does(self):
        for typed, told in (({}, "auto"), ({"ground_albedo": "0.6"}, 0.6)):
            tree = planned(**typed)
            self.assertEqual(tree["render"]["atmosphere"]["ground_albedo"], told)
            self.assertEqual(tree["self_test"]["render"]["atmosphere"]["ground_albedo"], told)
            self.assertEqual(tree["evaluator"]["about"]["ground_albedo"], str(told))
        for text in ("snow", "nan", ""):
            self.assert_refused("argument ground_albedo is %r, but must be auto or a number" % text, ground_albedo=text)

    def test_detectors_under_names_of_ones_own_can_be_differences(self):
        mine = "{mine: {type: sift, preprocessing: gamma, gamma: {exponent: 0.4}}}"
        tree = planned(differences="[orb, mine]", features=mine)["evaluator"]
        self.assertEqual(tree["differences"], ["orb", "mine"])
        self.assertEqual(tree["features"], {"mine": {"type": "sift", "preprocessing": "gamma", "gamma": {"exponent": 0.4}}})
        self.assert_refused("argument differences is '[yours]', but must be all, or a list of some of boolean_rgb, ",
                            differences="[yours]", features=mine)
        self.assertEqual(arguments.unused_features(mine, "[orb, mine]"), "")
        net = planned(differences="[net]", features="{net: {type: onnx, model: nets/a.onnx}}")["evaluator"]["features"]["net"]
        self.assertEqual(net["model"], os.path.abspath("nets/a.onnx"))
        self.assertEqual(arguments.unused_features("{mine: {type: sift}, orb: {n_features: 9}, kaze: {upright: true}}", "all"),
                         "argument features sets mine, kaze, which no difference uses: add to differences")
        self.assert_refused("rootsift, onnx, mine", differences="[yours]", features=mine)
        self.assertNotIn("features", planned()["evaluator"])
        self.assertEqual(planned(differences="[orb, mine]", features=mine, verify="[mine]")["evaluator"]["verify"], ["mine"])

    def test_hours_of_a_time_zone_that_nobody_gave_are_told_of_where_noon_is_elsewhere(self):
        def notes(given=(), **typed):
            return plan.notes(defaults(**typed), given)
        for site, noon in (("[40.7, -74, 10]", "20:00"), ("[-33.9, 151.2, 50]", "05:00"), ("[0, 180, 0]", "03:00"),
                           ("[0, -179, 0]", "03:00"), ("[48.2, 22.4, 0]", "13:30")):
            self.assertEqual(notes(site=site), [f"hours are of UTC+3; the sun is highest there at about {noon}: argument timezone "
                                                "gives another zone"])
            self.assertEqual(notes(["site", "timezone"], site=site), [])
        for near in ("[55.792115, 49.122254, 90]", "[48.2, 22.6, 0]", "[48.2, 67.4, 0]"):
            self.assertEqual(notes(site=near), [])
        self.assertEqual(notes(features="{mine: {type: sift}}"),
                         ["argument features sets mine, which no difference uses: add to differences"])

    def test_both_renderers_make_the_same_pictures(self):
        tree = planned(night="false", noise="true", noise_seed="7", exposure="auto", highlight_protection="0",
                       final_gather="2", robot="rover", width="320", vignetting="cos4", glare="0.02", mosaic="rggb")
        main, other = tree["render"], tree["self_test"]["render"]
        ours = {"path", "resume_at", "wait_for", "subscribers"}  # what poses they draw, and when
        for key in (main.keys() & other.keys()) - ours:
            self.assertEqual(main[key], other[key], key)
        self.assertEqual(main.keys() - other.keys(), {"output_dir", "publish_clock"})
        self.assertEqual(other.keys() - main.keys(), {"sun_namespace", "publish_tf", "count_skipped", "exact_sky", "warn_of_inputs"})
        self.assertEqual((main["night"], main["noise"], main["exposure"]["mode"], main["camera"]["width"]),
                         ({"enabled": False}, {"enabled": True, "seed": 7}, "auto", 320))
        self.assertEqual((main["vignetting"], main["glare"], main["mosaic"]),
                         ({"natural": "cos4"}, {"share": 0.02}, {"pattern": "rggb"}))
        self.assertEqual({**main["path"], "stride": 10}, other["path"])

    def test_a_right_camera_is_rendered_once_and_recorded(self):
        self.assertNotIn("right", planned(record="true")["render"]["subscribers"])
        self.assertNotIn("right", planned()["render"]["camera"])
        self.assertNotIn("baseline", planned()["render"]["camera"])
        tree = planned(calibration="my.yaml", right_calibration="right.yaml", record="true")
        self.assertEqual(tree["render"]["camera"]["right"], {"calibration": os.path.abspath("right.yaml")})
        self.assertNotIn("right", tree["self_test"]["render"]["camera"])  # whose pictures are compared, and not recorded
        self.assertEqual(tree["render"]["subscribers"]["right"], 1)
        topics = tree["experiment"]["recording"]["topics"]
        self.assertIn("/h04/camera/right/image_raw", topics)
        self.assertIn("/h04/camera/right/camera_info", topics)
        tree = planned(baseline="0.12", compressed="true", record="true")
        self.assertEqual(tree["render"]["camera"]["baseline"], 0.12)
        self.assertIn("/h04/camera/right/image_raw/compressed", tree["experiment"]["recording"]["topics"])
        self.assertEqual(planned(baseline="0.12")["render"]["subscribers"]["right"], 0)

    def test_a_calibration_stands_for_what_is_not_typed_beside_it(self):
        tree = planned(calibration="my.yaml")
        for renderer in (tree["render"], tree["self_test"]["render"]):
            self.assertEqual(renderer["camera"], {"calibration": os.path.abspath("my.yaml")})
        self.assertEqual(planned(calibration="my.yaml", width="752")["render"]["camera"],
                         {"calibration": os.path.abspath("my.yaml"), "width": 752})  # which the renderer compares
        self.assertEqual(tree["evaluator"]["about"]["camera"], "my.yaml, 1.0 m")
        self.assertEqual(planned()["render"]["camera"], {"width": 640, "height": 480, "horizontal_fov": 60.0})

    def test_the_evaluator_chooses_what_it_verifies_unless_told(self):
        self.assertNotIn("verify", planned()["evaluator"])
        self.assertEqual(planned(verify="[]")["evaluator"]["verify"], [])
        self.assertEqual(planned(verify="[brisk]")["evaluator"]["verify"], ["brisk"])

    def test_without_a_self_test_nobody_waits_for_one(self):
        tree = planned(self_test="false")
        self.assertNotIn("self_test", tree)
        self.assertEqual(tree["render"]["wait_for"], ["/evaluator/progress"])
        self.assertNotIn("self_test/render", tree["experiment"]["needed"])
        self.assertEqual(tree["evaluator"]["streams"], ["h04", "h12", "h20"])
        self.assertFalse(tree["evaluator"]["report"], "which is the experiment's, at its very end")

    def test_other_hours_are_looked_for_in_the_map_of_the_one_nearest_to_noon(self):
        tree = planned()["evaluator"]["localisation"]
        self.assertEqual(tree, {"map": "h12", "queries": ["h04", "h20"]})
        tree = planned(hours="[4, 10.5, 20]", map="20", localise="[brisk]")["evaluator"]["localisation"]
        self.assertEqual(tree, {"map": "h20", "queries": ["h04", "h10_30"], "detectors": ["brisk"]})
        self.assertEqual(planned(hours="[4, 10.5, 20]")["evaluator"]["localisation"]["map"], "h10_30")
        tree = planned(map="[4, 20]")["evaluator"]["localisation"]
        self.assertEqual(tree, {"map": "h04+h20", "queries": ["h12"]})  # by those that the evaluator has
        tree = planned(localise="[sift]")["evaluator"]["localisation"]
        self.assertEqual(tree["detectors"], ["sift"])

    def test_nothing_is_localised_without_detectors_or_a_second_hour(self):
        for typed in ({"localise": "[]"}, {"hours": "[12]"}, {"differences": "[boolean_rgb]"}):
            tree = planned(**typed)
            self.assertNotIn("localisation", tree["evaluator"])
            self.assertEqual(tree["render"]["subscribers"]["truth"], 0)

    def test_maps_and_detectors_that_there_are_not_are_refused(self):
        for typed, words in (({"map": "13"}, "argument map is '13', but must be auto"), ({"map": "noon"}, "argument map"),
                             ({"map": "[4, 4]"}, "argument map"), ({"map": "[4, 12, 20]"}, "argument map"),
                             ({"map": "[]"}, "argument map"),
                             ({"localise": "[akaze]"}, "argument localise is '[akaze]'")):
            with self.assertRaisesRegex(arguments.BadArgument, re.escape(words)):
                planned(**typed)

    def test_what_is_no_run_of_ours_is_rendered_from_the_beginning(self):
        """The evaluator then says what is wrong with it."""
        for run in (b"\xa1", b"settings: {differences: 3}", b"settings: {differences: '3'}", b"settings: text", b"[" * 5000,
                    b"settings: 2024-99-99", b"3"):
            with tempfile.TemporaryDirectory() as folder:
                with open(os.path.join(folder, "run.yaml"), "wb") as file:
                    file.write(run)
                with open(os.path.join(folder, "frames.csv"), "w", encoding="utf-8") as file:
                    file.write("pose,stamp,a,b,difference\n²,1000.0,h04,h12,orb\n" + "9" * 5000 + ",1000.0,h04,h12,orb\n")
                self.assertEqual(earlier_run.first_not_evaluated(folder, arguments.pairs(["h04", "h12"], False, 1), "[orb]"), 0)
                self.assertEqual(earlier_run.about(folder), {})

    def test_what_an_earlier_run_was_told_about_itself_is_in_its_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(earlier_run.about(folder), {})
            with open(os.path.join(folder, "run.yaml"), "w", encoding="utf-8") as file:
                file.write("settings:\n  ratio: '0.5'\n  about/world: 'it''s mine.sdf'\n  about/ev100: '14.0'\n  3: x\n")
            self.assertEqual(earlier_run.about(folder), {"world": "it's mine.sdf", "ev100": "14.0"})

    def test_rendering_waits_for_a_recorder(self):
        self.assertEqual(planned()["render"]["subscribers"], {"images": 1, "poses": 1, "truth": 1, "others": 0, "of": ["/evaluator"]})
        self.assertEqual(planned(record="true")["render"]["subscribers"], {"images": 2, "poses": 2, "truth": 2, "others": 1,
                                                                                "of": ["/evaluator", "/recorder"]})

    def test_the_recording_holds_what_each_image_was_made_under(self):
        topics = planned(record="true", hours="[4, 5]")["experiment"]["recording"]["topics"]
        self.assertEqual(sorted(topic for topic in topics if topic.startswith("/h04/")),
                         ["/h04/camera/camera_info", "/h04/camera/capture", "/h04/camera/image_raw", "/h04/celestial",
                          "/h04/moon", "/h04/sun"])
        self.assertEqual(len(topics), len(set(topics)))
        self.assertLess({"/clock", "/tf", "/tf_static"}, set(topics))

    def test_poses_that_are_evaluated_but_in_no_bag_are_rendered_again(self):
        tree = planned(plan.Beginning(20, evaluated=15, recorded=8), record="true")
        self.assertEqual(tree["render"]["resume_at"], 8)
        self.assertEqual(tree["self_test"]["render"]["resume_at"], 15)  # that one is not recorded

    def test_where_all_is_evaluated_inputs_are_compared_before_anything_is_reported(self):
        self.assertEqual(planned(plan.Beginning(20, evaluated=20, inputs="7 8"))["experiment"]["inputs"], "7 8")
        self.assertNotIn("inputs", planned(plan.Beginning(20, evaluated=19, inputs="7 8"))["experiment"])

    def test_flags_are_told_in_one_spelling(self):
        for spelling in ("True", "1"):
            self.assertEqual(planned(noise=spelling)["evaluator"]["about"]["noise"], "true")

    def test_the_self_test_is_told_as_the_person_who_asks_for_it_calls_it(self):
        """By the evaluator's streams and pairs, which follow from it, nobody would know it."""
        self.assertEqual(planned(self_test="false", self_test_every="3")["evaluator"]["about"]["self_test"], "false")
        self.assertEqual(planned(self_test="True", self_test_every="3")["evaluator"]["about"]["self_test"], "every 3")

    def told_again(self, before, evaluated=5, **typed):
        """What the evaluator is told where a run was told `before` about itself."""
        return planned(plan.Beginning(20, evaluated=evaluated, about=before), **typed)["evaluator"]["about"]

    def test_what_is_spelt_otherwise_is_told_as_before(self):
        before = self.told_again({}, hours="[5, 13]", night="true", glare="0.0", world="mine.sdf")
        self.assertEqual(before["night"], "true")
        for typed in ({}, {"ev100": "14"}, {"spacing": " 1.00"}, {"hours": "[5.0,13]"}, {"night": "True"},
                      {"night": "1"}, {"timezone": "3.0"}, {"site": "[55.7921150, 49.122254,90.0]"}, {"world": "./mine.sdf"},
                      {"conditions": "{h05: {hour: 5}, h13: {hour: 13}}", "hours": "[4, 12, 20]"}):
            again = self.told_again(before, **{"hours": "[5, 13]", "world": "mine.sdf", **typed})
            self.assertEqual(again, before, typed)
        for typed in ({"ev100": "14.1"}, {"night": "false"}, {"hours": "[5, 13.5]"}, {"hours": "[5]"},
                      {"glare": "0.01"}, {"timezone": "4"}):
            again = self.told_again(before, **{"hours": "[5, 13]", "world": "mine.sdf", **typed})
            self.assertEqual([name for name, text in again.items() if text != before[name]], list(typed))

    def test_conditions_are_the_same_in_any_order_of_what_differs(self):
        typed = "{grey: {hour: 12, cover: 8, overcast: cie}, noon: {hour: 12.5}}"
        before = self.told_again({}, conditions=typed)
        for again in (typed, '{"grey": {overcast: cie, cover: 8.0, hour: 12}, noon: {hour: 12, minute: 30}}'):
            self.assertEqual(self.told_again(before, conditions=again), before)
        other = typed.replace("8", "7")
        self.assertEqual(self.told_again(before, conditions=other)["conditions"], other)

    def test_a_file_may_have_moved_once_what_it_holds_is_compared(self):
        typed = dict(world="/here/mine.sdf", calibration="/here/cam.yaml", camera_height="1.0")
        before = {**self.told_again({}, **typed), "world": "mine.sdf", "camera": "cam.yaml, 1 m"}  # as it was typed once
        self.assertEqual(self.told_again(before, **typed), before)
        # Nor may a run that the renderer then refuses be told of as one of another world.
        other = self.told_again(before, **{**typed, "world": "other.sdf", "path": "mine.csv", "robot": "rover"})
        self.assertEqual(other, before)
        afresh = self.told_again(before, evaluated=0, **typed)
        self.assertEqual((afresh["world"], afresh["camera"]), ("/here/mine.sdf", "/here/cam.yaml, 1.0 m"))
        for changed in ({"camera_height": "1.1"}, {"calibration": "/here/cam2.yaml"}):
            self.assertNotEqual(self.told_again(before, **{**typed, **changed})["camera"], before["camera"])

    def test_with_nothing_left_the_self_test_does_not_bake(self):
        for evaluated, transport in ((19, {"final_gather": 2}), (20, {"enabled": False})):
            tree = planned(plan.Beginning(20, evaluated=evaluated), final_gather="2")
            self.assertEqual(tree["self_test"]["render"]["transport"], transport)
            self.assertEqual(tree["render"]["transport"], {"final_gather": 2})

    def test_where_all_is_evaluated_only_the_recorder_is_waited_for(self):
        tree = planned(plan.Beginning(20, evaluated=20, recorded=8), record="true")
        self.assertEqual(tree["render"]["wait_for"], [])
        self.assertEqual(tree["render"]["subscribers"], {"images": 1, "poses": 1, "truth": 1, "others": 1, "of": ["/recorder"]})

    def test_an_earlier_run_is_taken_up_where_it_has_a_gap(self):
        with tempfile.TemporaryDirectory() as folder:
            pairs = arguments.pairs(["h04", "h12"], True, 2)
            begins = lambda differences: earlier_run.first_not_evaluated(folder, pairs, differences)
            self.assertEqual(begins("[boolean_rgb, orb]"), 0)
            rows = ["pose,stamp,a,b,difference,value,features_a,features_b,matches,zero_second"]
            evaluated = {0: (("h04", "h12"), ("h04", "self_test/h04"), ("h12", "self_test/h12")), 1: (("h04", "h12"),),
                         2: (("h04", "h12"), ("h04", "self_test/h04")), 3: (("h04", "h12"),)}
            for pose, here in evaluated.items():
                rows += ["%d,1000.0,%s,%s,%s,0.5,0,0,0,0" % (pose, a, b, difference)
                         for a, b in here for difference in ("boolean_rgb", "orb")]
            with open(os.path.join(folder, "frames.csv"), "w") as frames:
                frames.write("\n".join(rows) + "\n4,1000.4,h04,h1")  # torn by a crash
            self.assertEqual(begins("[boolean_rgb, orb]"), 2)  # one self-test of pose 2 is missing
            with open(os.path.join(folder, "problems.csv"), "w") as problems:
                problems.write("kind,pose,stamp,where,reason\nlost,0,1000.0,h04,\nother_sun,1,1000.1,h04,\"of 9 h, not of 4 h\"\n")
            self.assertEqual(begins("[boolean_rgb, orb]"), 1)  # it is evaluated, but the evaluator will leave it out
            os.remove(os.path.join(folder, "problems.csv"))
            # An evaluator without SURF, say, whose `all` are two.
            self.assertEqual(begins("all"), 0)
            with open(os.path.join(folder, "run.yaml"), "w") as run:
                run.write("settings:\n  differences: '[boolean_rgb, orb]'\nposes: 5\n")
            self.assertEqual(begins("all"), 2)
            # Where matches are verified, a pair needs those rows too.
            with open(os.path.join(folder, "run.yaml"), "w") as run:
                run.write("settings:\n  differences: '[boolean_rgb, orb]'\n  verify: '[orb]'\nposes: 5\n")
            self.assertEqual(begins("all"), 0)
            with open(os.path.join(folder, "verified.csv"), "w") as verified:
                verified.write("pose,stamp,a,b,detector,features_a\n")
                verified.writelines("0,1000.0,%s,%s,orb,3\n" % pair for pair in evaluated[0])
            self.assertEqual(begins("all"), 1)

    def test_pictures_that_an_earlier_run_did_not_keep_are_told_of(self):
        with tempfile.TemporaryDirectory() as folder:
            def told(poses):
                return earlier_run.without_pictures(folder, ["h04", "h12"], poses)
            self.assertEqual(told(0), "")
            for stream, poses in (("h04", (0, 1, 2)), ("h12", (0, 2))):
                os.makedirs(os.path.join(folder, "images", stream))
                for pose in poses:
                    open(os.path.join(folder, "images", stream, "%06d.png" % pose), "w").close()
            self.assertEqual(told(1), "")
            self.assertEqual(told(4), f"images: {folder} lacks pictures of 2 of the 4 poses that are evaluated already, and pictures are "
                                      "kept of what is evaluated anew alone: choose another output to have all")
        self.assertEqual(plan.Beginning(20, evaluated=15, recorded=8).seen_before(), 8)
        self.assertEqual(plan.Beginning(20, evaluated=20, recorded=8).seen_before(), 20)

    def test_an_earlier_run_is_not_taken_up_with_fewer_poses_than_it_evaluated(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(earlier_run.evaluated_beyond(folder, 3), "")
            with open(os.path.join(folder, "frames.csv"), "w") as frames:
                frames.write("pose,stamp,a,b,difference,value\n")
                frames.writelines("%d,1000.0,h04,h12,%s,0.5\n" % (pose, difference) for pose in (0, 1, 2, 5)
                                  for difference in ("orb", "boolean_rgb"))
                frames.write("9,1000.9,h04,h1")  # torn by a crash
            self.assertEqual(earlier_run.evaluated_beyond(folder, 6), "")
            self.assertEqual(earlier_run.evaluated_beyond(folder, 2),
                             folder + " holds 4 evaluated poses, and 2 of them are not among the 2 of this path: choose another "
                             "output, or poses:=6 at least")

    def test_files_of_an_earlier_run_need_not_be_found_from_a_folder_that_was_deleted(self):
        before = {"world": "mine.world", "camera": "640x480, 60.0 deg, 1.0 m"}
        self.addCleanup(os.chdir, os.getcwd())
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
        now = {"world": "/else/mine.world", "camera": "640x480, 60.0 deg, 1 m"}
        self.assertEqual(same_settings.as_before(now, before, False), {**now, "camera": before["camera"]})
        self.assertEqual(same_settings.as_before({**now, "camera": "640x480, 50.0 deg, 1 m"}, before, False)["camera"],
                         "640x480, 50.0 deg, 1 m")


class BesideOthers(unittest.TestCase):

    def test_the_master_is_that_of_roslaunch(self):
        launch = ["python3", "/opt/ros/bin/roslaunch", "sunlit", "experiment.launch", "hours:=[4, 5]"]
        with mock.patch.dict(os.environ, ROS_MASTER_URI="http://robot:11311"):
            self.assertEqual(others.master(launch), "http://robot:11311")
            for port in (["-p", "11312"], ["-p11312"], ["--port", "11312"], ["--port=11312"]):
                self.assertEqual(others.master(launch[:2] + port + launch[2:]), "http://localhost:11312")
            self.assertIsNone(others.master(launch + ["--dump-params"]))
            self.assertIsNone(others.master(launch + ["--args=/render"]))
            del os.environ["ROS_MASTER_URI"]
            self.assertEqual(others.master([]), "http://localhost:11311")

    def test_what_does_not_answer_is_no_experiment(self):
        with socket.socket() as silent, mock.patch.object(others, "PATIENCE_S", 0.2):
            silent.bind(("localhost", 0))
            port = silent.getsockname()[1]
            for uri in ("http://localhost:%d" % port, "http://localhost:x", "localhost", ""):
                self.assertFalse(others.is_running(uri), uri)
            silent.listen()
            self.assertFalse(others.is_running("http://localhost:%d" % port))
        self.assertIsNone(socket.getdefaulttimeout())


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "experiment_plan", "__main__")
