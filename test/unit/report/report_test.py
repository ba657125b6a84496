#!/usr/bin/env python3
"""What must hold of the report, on output folders made up here (output_folder.py)."""

import csv
import dataclasses
import itertools
import math
import os
import re
import signal
import subprocess
import sys
import tempfile
import types
import unittest
import warnings as of_python
from unittest import mock

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

sys.dont_write_bytecode = True
HERE = os.path.dirname(os.path.abspath(__file__))
SCRIPTS = os.path.join(HERE, "..", "..", "..", "scripts")
sys.path[:0] = [HERE, SCRIPTS]

import output_folder as made  # noqa: E402
from sunlit_report import atlas_figures, atlas_page, atlas_rows, choice, comparisons, files, findings  # noqa: E402
from sunlit_report import figures, localisation, lost, lost_rows, map_figure, names, page, pictures, queries, tables  # noqa: E402
from sunlit_report import matrices, verified, verified_rows, warnings  # noqa: E402
from sunlit_report.csv_rows import ReportError  # noqa: E402

REPORT = os.path.join(SCRIPTS, "report")
ALL_HOLD = [findings.REPRODUCED] * 5


class InFolder(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = kept.name

    def write(self, name, lines):
        return made.write(self.folder, name, lines)

    def read(self):
        return files.read_output(self.folder)

    def verdicts(self):
        return [finding.verdict for finding in findings.judge(self.read())]

    def assert_refused(self, *parts):
        with self.assertRaises(ReportError) as caught:
            self.read()
        for part in parts:
            self.assertIn(part, str(caught.exception))


def changed(difference, pair, e=None, s=None):
    """The holding statistics, but for one difference of one pair (0: 4-12, 1: 4-20, 2: 12-20)."""
    statistics = {name: list(rows) for name, rows in made.HOLDING.items()}
    old_e, old_s = statistics[difference][pair]
    statistics[difference][pair] = (old_e if e is None else e, old_s if s is None else s)
    return statistics


class Findings(InFolder):
    def verdicts_of(self, statistics):
        self.write("frames.csv", made.frames(statistics))
        return self.verdicts()[:5]

    def assert_breaks_only(self, number, statistics):
        expected = list(ALL_HOLD)
        expected[number - 1] = findings.NOT_REPRODUCED
        self.assertEqual(self.verdicts_of(statistics), expected)

    def test_all_hold_where_they_hold(self):
        self.assertEqual(self.verdicts_of(made.HOLDING), ALL_HOLD)

    def test_first_breaks_where_one_algorithm_sets_evening_further_from_morning_than_noon(self):
        self.assert_breaks_only(1, changed("boolean_rgb", 1, e=0.7005))

    def test_second_breaks_where_evening_is_as_bright_as_morning(self):
        self.assert_breaks_only(2, changed("euclidean_grey", 2, e=0.0629))

    def test_second_breaks_where_evening_is_not_just_slightly_further(self):
        self.assert_breaks_only(2, changed("euclidean_rgb", 2, e=0.0961))

    def test_third_breaks_where_boolean_differences_are_apart(self):
        self.assert_breaks_only(3, changed("boolean_grey", 2, e=0.7101))

    def test_third_holds_up_to_its_limit(self):
        self.assertEqual(self.verdicts_of(changed("boolean_grey", 2, e=0.7099)), ALL_HOLD)

    def test_fourth_breaks_where_one_pair_has_another_order(self):
        self.assert_breaks_only(4, changed("brisk", 1, e=0.86))

    def test_fifth_breaks_where_a_feature_varies_more_against_noon(self):
        self.assert_breaks_only(5, changed("orb", 2, s=0.11))

    def test_fifth_breaks_where_a_euclidean_difference_does_not_vary_least(self):
        self.assert_breaks_only(5, changed("euclidean_rgb", 1, s=0.0095))

    def test_numbers_name_what_broke(self):
        self.write("frames.csv", made.frames(changed("boolean_rgb", 1, e=0.7005)))
        first = findings.judge(self.read())[0]
        self.assertEqual([row[0] for row in first.rows if row[-1]], ["Boolean RGB"])
        self.assertEqual(first.rows[0][1:4], ["0.70000", "0.70050", "0.70100"])

    def test_other_hours_cannot_be_judged(self):
        self.write("frames.csv", [line.replace("h04", "h06") for line in made.frames()])
        output = self.read()
        judged = findings.judge(output)
        self.assertEqual([one.verdict for one in judged], [findings.NOT_JUDGED] * 6)
        self.assertEqual(findings.verdict_of_all(judged, output), "none of the 6 can be judged from these conditions")
        self.assertIn("h04", judged[0].reason)

    def test_a_run_of_few_poses_says_that_it_is_one(self):
        self.write("frames.csv", made.frames())
        self.write("run.yaml", made.run())
        output = self.read()
        self.assertEqual(findings.verdict_of_all(findings.judge(output), output),
                         "5 of 6 reproduced, 1 cannot be judged, by 40 poses; the paper's findings are those of 991")

    def test_missing_algorithms_cannot_be_judged(self):
        self.write("frames.csv", made.frames(differences=["boolean_rgb", "orb"]))
        self.assertEqual(self.verdicts()[1:4], [findings.NOT_JUDGED, findings.REPRODUCED, findings.NOT_JUDGED])

    def test_undefined_means_cannot_be_judged(self):
        lines = [re.sub(r"(h04,h20,sift),[^,]*", r"\1,nan", line) for line in made.frames()]
        self.write("frames.csv", lines)
        self.assertEqual(self.verdicts()[0], findings.NOT_JUDGED)


class Circumstances(InFolder):
    """The paper's hours are told by their names; whether all else is the paper's by run.yaml."""

    def told(self, run):
        """The warnings, and the headline."""
        self.write("frames.csv", made.frames())
        self.write("summary.csv", [files.SUMMARY] + [
            f"{a},{b},{difference},40,0,{row.mean},{row.sd},0,1,0,0,0,0,0"
            for (a, b, difference), row in self.read_frames().items()])
        self.write("run.yaml", run)
        output = self.read()
        return warnings.warnings(output), findings.verdict_of_all(findings.judge(output), output)

    def read_frames(self):
        return {key: files.summarise(one) for key, one in files.read_frames(os.path.join(self.folder, "frames.csv")).items()}

    def assert_differs(self, settings, in_warning, in_headline):
        (warning,), headline = self.told(made.run(**settings))
        self.assertIn(in_warning, warning)
        self.assertIn("verdicts", warning)
        self.assertIn(f"reproduced, 1 cannot be judged, by 40 poses; the paper's findings are those of 991; {in_headline}", headline)

    def test_those_of_the_paper_are_not_talked_of(self):
        for settings in ({}, {"about/world": "forza.glb", "about/timezone": "3.0", "about/noise": "0"},
                         {"about/conditions": "{h04: {hour: 4}, h12: {hour: 12}, h20: {hour: 20}, fog: {hour: 12, visibility: 150}}"}):
            told, headline = self.told(made.run(**settings))
            self.assertEqual(told, [])
            self.assertTrue(headline.endswith("are those of 991"), headline)

    def test_others_are_named_wherever_findings_are_counted(self):
        for settings, in_warning, in_headline in (
                ({"about/date": "2024-12-21", "about/exposure": "auto"},
                 "Not as in the paper: date is 2024-12-21, the paper's 2024-07-01; exposure is auto, the paper's fixed.",
                 "not as in the paper: date, exposure"),
                ({"about/site": "[52.5, 13.4, 34]"}, "site is [52.5, 13.4, 34], the paper's [55.792115, 49.122254, 90]", "not as in the paper: site"),
                ({"about/timezone": "2"}, "timezone is 2, the paper's 3", "not as in the paper: timezone"),
                ({"about/noise": "True"}, "noise is True, the paper's false", "not as in the paper: noise"),
                ({"exposure_time": "auto"}, "exposure_time is auto, the paper's 0", "not as in the paper: exposure_time"),
                ({"ratio": "0.8", "inclusive": "true"}, "ratio is 0.8, the paper's 0.5; inclusive is true, the paper's false",
                 "not as in the paper: ratio, inclusive"),
                ({"features/orb/n_features": "2000"}, "n_features is 2000, the paper's 500", "not as in the paper: features/orb/n_features"),
                ({"about/camera": "1280 x 720, 60.0 deg, 1.0 m"}, "size of the images is 1280 x 720", "not as in the paper: size"),
                ({"about/conditions": "{h04: {hour: 5, minute: 30}, h12: {hour: 12, cover: 8}, h20: {hour: 20, noise: true}}"},
                 "hour of h04 is 5, the paper's 4; minute of h04 is 30, the paper's none; cover of h12 is 8, the paper's none; "
                 "noise of h20 is true, the paper's false", "not as in the paper: hour of h04")):
            self.assert_differs(settings, in_warning, in_headline)

    def test_what_is_not_told_is_not_taken_for_the_papers(self):
        self.assert_differs({f"about/{key}": None for key in ("site", "date", "timezone", "exposure")},
                            "tells nothing of date, site, timezone, exposure. The", "not known: date, site, timezone, exposure")
        (warning,), headline = self.told(["poses: 40"])
        self.assertIn("run.yaml tells nothing of date, site, timezone, exposure, ratio, inclusive", warning)
        self.assertIn("not known: date", headline)

    def test_streams_of_other_names_are_compared_with_nobody(self):
        self.write("frames.csv", [line.replace("h04", "a").replace("h12", "b").replace("h20", "c") for line in made.frames()])
        self.assertFalse([one for one in warnings.warnings(self.read()) if "paper" in one])

    def test_texts_that_are_no_yaml_are_others(self):
        self.assert_differs({"about/date": "2024-99-99"}, "date is 2024-99-99", "not as in the paper: date")
        self.assertEqual(self.told(made.run(**{"about/conditions": "{a: ["}))[0], [])


class SelfTests(InFolder):
    def verdict_of(self, **self_test):
        self.write("frames.csv", made.frames() + made.self_frames(**self_test))
        return self.verdicts()[5]

    def test_zeros_are_what_the_paper_found(self):
        self.assertEqual(self.verdict_of(), findings.REPRODUCED)

    def test_small_residues_of_twins_are_too(self):
        self.assertEqual(self.verdict_of(difference="brisk", value=0.012, twins=3), findings.REPRODUCED)

    def test_residues_without_twins_are_not(self):
        self.assertEqual(self.verdict_of(difference="brisk", value=0.012), findings.NOT_REPRODUCED)

    def test_large_residues_are_not(self):
        self.assertEqual(self.verdict_of(difference="brisk", value=0.03, twins=3), findings.NOT_REPRODUCED)

    def test_direct_differences_must_be_exactly_zero(self):
        self.assertEqual(self.verdict_of(difference="euclidean_rgb", value=1e-12), findings.NOT_REPRODUCED)

    def test_a_lone_feature_has_no_second_neighbour(self):
        lone = [line.replace(",500,400,50,", ",1,1,0,") for line in made.self_frames(difference="surf", value=0.01)]
        self.write("frames.csv", made.frames() + lone)
        self.assertEqual(self.verdicts()[5], findings.REPRODUCED)

    def test_of_hours_that_the_paper_has_not_nothing_is_judged(self):
        night = [made.frame(pose, "h00", "self_test/h00", name, value) for pose in range(4)
                 for name, value in (("sift", math.nan), ("orb", 0.5))]
        self.write("frames.csv", made.frames() + made.self_frames() + night)
        self.assertEqual(self.verdicts()[5], findings.REPRODUCED)
        # Alone they are: of what is defined.
        self.write("frames.csv", made.frames() + night)
        self.assertEqual(self.verdicts()[5], findings.NOT_JUDGED)
        self.write("frames.csv", made.frames(differences=["orb"]) + [line for line in night if ",orb," in line])
        self.assertEqual(self.verdicts()[5], findings.NOT_REPRODUCED)

    def test_absent_self_tests_cannot_be_judged(self):
        self.write("frames.csv", made.frames())
        self.assertEqual(self.verdicts()[5], findings.NOT_JUDGED)

    def test_they_stand_apart_from_pairs_of_conditions(self):
        self.write("frames.csv", made.frames() + made.self_frames())
        output = self.read()
        self.assertEqual(output.pairs, made.PAIRS)
        self.assertEqual(output.self_pairs, made.SELF_PAIRS)
        self.assertEqual(output.conditions, made.HOURS)


class Files(InFolder):
    def test_mean_and_spread_follow_the_papers_equations(self):
        self.write("frames.csv", [made.FRAMES_HEADER] + [made.frame(k, "a", "b", "sift", v)
                                                         for k, v in enumerate([0.1, 0.2, math.nan, 0.6])])
        row = self.read().summary["a", "b", "sift"]
        # By hand: (0.1 + 0.2 + 0.6) / 3, and sqrt((0.04 + 0.01 + 0.09) / 2).
        self.assertEqual((row.n, row.undefined), (3, 1))
        self.assertAlmostEqual(row.mean, 0.3, places=12)
        self.assertAlmostEqual(row.sd, math.sqrt(0.07), places=12)

    def test_summary_file_is_taken_as_it_is(self):
        self.write("frames.csv", made.frames())
        self.write("summary.csv", [files.SUMMARY, "h04,h12,sift,40,0,0.84,0.05,0.83,0.85,0.86,0.04,0.87,0.03,2"])
        row = self.read().summary["h04", "h12", "sift"]
        self.assertEqual((row.ci_high, row.symmetric_mean, row.one_to_one_mean), (0.85, 0.86, 0.87))

    def test_symmetric_and_one_to_one_forms_stand_beside_the_papers(self):
        self.write("frames.csv", [made.FRAMES_HEADER] + [made.frame(k, "a", "b", "sift", v, matches=m)
                                                         for k, (v, m) in enumerate([(0.1, 400), (0.2, 401), (-0.3, 500)])])
        row, = tables.counts(self.read())
        self.assertEqual(row["forms"], ["0.00000", "0.01000", "0.02000"])
        self.assertEqual(row["overmatched"], "2")  # of the 400 features of b

    def test_frames_of_older_runs_are_read_without_them(self):
        columns = len(files.OLD_FRAMES.split(","))
        self.write("frames.csv", [",".join(line.split(",")[:columns]) for line in made.frames()])
        self.write("summary.csv", [files.OLD_SUMMARY, "h04,h12,sift,40,0,0.84,0.05,0.83,0.85"])
        for older in files.OLD_CAPTURES:
            rows = csv.DictReader(made.captures())
            self.write("captures.csv", [older, *(",".join(row[name] for name in older.split(",")) for row in rows)])
            output = self.read()
            self.assertEqual(output.captures["h04"]["scene_illuminance"][0], 4321)
        self.assertEqual(tables.counts(output)[0]["forms"], ["0.84000", tables.MISSING, tables.MISSING])

    def test_pictures_under_another_sun_are_pointed_out_once(self):
        self.write("frames.csv", made.frames())
        self.assertFalse([one for one in warnings.warnings(self.read()) if "another sun" in one])
        self.write("problems.csv", [files.PROBLEMS, *[f"other_sun,{pose},{pose}.5,h04,\"its sky is of noon, not of {pose}\""
                                                      for pose in (7, 8, 9)]])
        self.assertEqual([one for one in warnings.warnings(self.read()) if "another sun" in one],
                         ["3 pictures of 4 h were taken under another sun than its first, at poses from 7 to 9, and are left out of all "
                          "numbers. Of the first of them: its sky is of noon, not of 7."])

    def test_problems_of_localised_pictures_are_told_as_others_are(self):
        self.write("localisation.csv", made.queries())
        self.write("localisation_problems.csv", [files.LOCALISATION_PROBLEMS, 'eve,query,1.5,"no_features: orb found nothing in it"',
                                                 "eve,query,2.5,no camera_info of this stamp",
                                                 'eve,query,3.5,"camera/depth/image_raw: its size is 0"',
                                                 'eve,query,4.5,"other_frame: poses are in odom, not map"'])
        output = self.read()
        self.assertEqual(tables.problems(output), [("no_features", 1), ("other_frame", 1), ("unlocalised", 2)])
        self.assertEqual([(row["stamp"], row["where"], row["reason"]) for row in output.problems][:2],
                         [("1.5", "eve (query)", "orb found nothing in it"), ("2.5", "eve (query)", "no camera_info of this stamp")])
        self.assertIn("Poses are of several frames: poses are in odom, not map.", warnings.warnings(output))

    def test_pictures_of_bags_that_stand_in_no_share_are_pointed_out(self):
        self.write("localisation.csv", made.queries())
        harmless = ['eve,query,1.5,"no_features: orb found nothing in it"', 'eve,query,1.5,"other_frame: poses are in odom, not map"',
                    'eve,query,1.5,"duplicate: this stamp had come before; the first image counts"']
        of_two_detectors = ["eve,query,2.5,sift: threw", "eve,query,2.5,orb: threw"]
        for rows, expected in (
                (harmless, []),
                (harmless + of_two_detectors, [
                    "1 picture of the queries could not be used, or not by each detector: all shares are of the others. See problems."]),
                (["eve,query,2.5,no camera/pose of this stamp", "eve,query,3.5,no camera/pose of this stamp",
                  'noon,map,1.5,"two_places: two poses of this stamp are 3 m apart"'], [
                      "2 pictures of the queries could not be used, or not by each detector: all shares are of the others. See problems.",
                      "1 picture of the map could not be used, or not by each detector: it is of the others. See problems."])):
            self.write("localisation_problems.csv", [files.LOCALISATION_PROBLEMS, *rows])
            self.assertEqual([line for line in warnings.warnings(self.read()) if "could not be used" in line], expected)

    def test_why_a_run_is_not_whole_is_pointed_out(self):
        self.write("frames.csv", made.frames())
        self.write("run.yaml", ["outcome: {whole: false, completed_poses: 25, absent_poses: 0, not_mended: 4}", "counters:",
                                "  pairs: {h04-h12: {evaluated: 20, resumed: 3, missing_partner: 1, failed: 1}}"])
        self.assertIn("The run is not whole: 25 poses came, 2 pairs could not be evaluated, 4 pairs or pictures were left out by earlier "
                      "or merged runs. See counters and problems.", warnings.warnings(self.read()))

    def test_detectors_that_depth_places_nowhere_are_pointed_out(self):
        self.write("frames.csv", made.frames())
        for unplaced, expected in (("[]", []), ("3", []), ("['orb']", [
                "Depth tells the place of none of the features that ORB found in the map, so that no query can be found by them: is it of "
                "the map's camera, in m or mm, and not 0?"])):
            self.write("run.yaml", ["outcome: {whole: true, key_frames: 3, not_localised: 0, unplaced: %s}" % unplaced])
            self.assertEqual([line for line in warnings.warnings(self.read()) if "Depth" in line], expected)

    def test_queries_that_were_not_looked_for_are_pointed_out(self):
        self.write("frames.csv", made.frames())
        for count, expected in (("0", []), ("~", []), ("1", ["1 query was"]), ("12", ["12 queries were"])):
            self.write("run.yaml", ["outcome: {whole: true, key_frames: 3, not_localised: %s, unplaced: []}" % count])
            self.assertEqual([line for line in warnings.warnings(self.read()) if "looked for" in line],
                             [f"{who} not looked for, for want of a pose or camera_info: all shares are of the others. See problems."
                              for who in expected])

    def test_summary_of_other_frames_is_pointed_out(self):
        self.write("frames.csv", made.frames(differences=["sift"], pairs=made.PAIRS[:1]))
        self.write("summary.csv", [files.SUMMARY, "h04,h12,sift,40,0,0.84,0.05,0.83,0.85,0.86,0.04,0.87,0.03,0"])
        self.write("run.yaml", made.run())
        self.assertEqual(warnings.warnings(self.read()), [])
        self.write("summary.csv", [files.SUMMARY, "h04,h12,sift,40,0,0.85,0.05,0.83,0.85,0.86,0.04,0.87,0.03,0"])
        self.assertEqual(len(warnings.warnings(self.read())), 1)

    def test_black_pictures_are_pointed_out(self):
        def row(pose, name, value, features_b, b="h12"):
            forms = [value, value, 0, 0]
            return ",".join(str(one) for one in [pose, f"{pose}.0", "h00", b, name, value, 0, features_b, 0, 0, *forms])

        def told():
            found = [one for one in warnings.warnings(self.read()) if "single feature" in one]
            self.assertEqual(len(found), 1)
            return found[0]

        nan = math.nan
        self.write("frames.csv", [files.FRAMES, row(0, "boolean_rgb", 0.0, 0), row(0, "sift", nan, 0), row(1, "sift", 1.0, 9)])
        cause = ": they are black, white or plain, or nothing of the world is in view: look at images/ (images:=true) or matches/."
        self.assertEqual(told(), "No detector found a single feature in any picture of 0 h" + cause)
        self.write("captures.csv", [files.CAPTURES, "h00,0,0,14,auto,0,-11,0,0,0,0.25,,nan"])
        self.assertTrue(told().endswith(" of 0 h (0.25 lx, exposed at EV100 14.0)" + cause), told())
        self.write("captures.csv", [files.CAPTURES, "h00,0,0,14,fixed,0,-11,0,0,0,0.25,,nan"])
        self.assertTrue(told().endswith(cause + " Their exposure is fixed: with exposure:=auto the night is seen."), told())

        # All streams in one line, and those of the self-test not at all.
        os.remove(os.path.join(self.folder, "captures.csv"))
        for value, equal in ((0.1, ""), (0.0, " Such pictures equal each other in every pixel, which says nothing about localisation.")):
            self.write("frames.csv", [files.FRAMES, row(0, "boolean_rgb", value, 0), row(0, "sift", nan, 0),
                                      row(0, "boolean_rgb", 0.0, 0, "self_test/h00"), row(0, "sift", nan, 0, "self_test/h00")])
            self.assertEqual(told(), "No detector found a single feature in any picture of 0 h, 12 h" + cause + equal)

    def test_differences_of_pixels_alone_say_nothing_of_features(self):
        self.write("frames.csv", made.frames(differences=["boolean_rgb"]))
        self.assertFalse([one for one in warnings.warnings(self.read()) if "single feature" in one])

    def test_missing_folder_and_frames_are_named(self):
        with self.assertRaisesRegex(ReportError, "nowhere: no such folder"):
            files.read_output(os.path.join(self.folder, "nowhere"))
        self.assert_refused(os.path.join(self.folder, "frames.csv"), "no such file")

    def test_malformed_lines_are_named(self):
        good = made.frames()[:3]
        for bad, what in [("1,2,3", "3 fields"), (good[2].replace(",h04", ",h04,h04"), "15 fields"),
                          ("x" + good[2], "pose is 'x1'"), ("9" * 20 + good[2], "pose is '99999999999999999999"),
                          (good[2].replace(",0,0,0,", ",0,0.5,0,"), "features_b is '0.5'"),
                          (re.sub(r"boolean_rgb,[^,]*", "boolean_rgb,inf", good[2]), "value is 'inf'"),
                          (good[1], "pose 0 of h04, h12, boolean_rgb was given on line 2")]:
            path = self.write("frames.csv", good[:2] + [bad])
            self.assert_refused(f"{path}:3", what)
        path = self.write("frames.csv", ["pose,value"] + good[1:])
        self.assert_refused(f"{path}:1", files.FRAMES)
        path = self.write("frames.csv", [good[0], *reversed(made.frames()[1:]), good[2]])  # of series that lie within each other
        count = len(made.frames())
        self.assert_refused(f"{path}:{count + 1}: pose 1 of h04, h12, boolean_rgb was given on line {count - 1} already")
        self.write("frames.csv", good[:1])
        self.assert_refused("no results")

    def test_poses_rise_whatever_their_order_in_the_file(self):
        self.write("frames.csv", [made.FRAMES_HEADER, *reversed(made.frames()[1:])])
        for one in self.read().series.values():
            self.assertEqual(one.pose.tolist(), list(range(made.POSES)))

    def test_malformed_other_files_are_named(self):
        self.write("frames.csv", made.frames())
        for name, lines, where in [("path.csv", [files.PATH, "0,0,east,0,0,0"], ":2: x is 'east'"),
                                   ("captures.csv", [files.CAPTURES, "h04,0,0,bright,auto,0,0,0,0,0,0,,nan"], ":2: ev100"),
                                   ("timing.csv", ["stage,seconds"], ":1"),
                                   ("run.yaml", ["settings:", "  a: [1,"], "run.yaml:"),
                                   ("map.yaml", ["x_min: 0"], "x_max"),
                                   ("map.yaml", ["x_min: 0", "x_max: 0", "y_min: 0", "y_max: 1"], "below")]:
            path = self.write(name, lines)
            self.assert_refused(path, where)
            os.remove(path)


class Parts(unittest.TestCase):
    def test_hours_are_called_by_number(self):
        self.assertEqual(names.pair("h04", "h12"), "4–12 h")
        self.assertEqual(names.pair("h04_30", "self_test/h04_30"), "4:30–4:30 h")
        self.assertEqual(names.pair("summer", "winter"), "summer – winter")
        self.assertEqual(names.conditions(["h04", "h12", "h20"]), "4, 12 and 20 h")

    def test_pictures_are_spread_from_end_to_end(self):
        self.assertEqual(choice.evenly_spread(list(range(991)), 5), [0, 248, 495, 742, 990])
        self.assertEqual(choice.evenly_spread([3, 4], 5), [3, 4])

    def test_running_median_skips_undefined_values(self):
        got = figures.running_median(np.array([1.0, math.nan, 3.0, 100.0, 5.0, math.nan, math.nan, math.nan]), 3)
        np.testing.assert_array_equal(got, [1.0, 2.0, 51.5, 5.0, 52.5, 5.0, math.nan, math.nan])

    def test_axes_name_plain_numbers(self):
        def labels(values, prepare=lambda axis: None):
            with figures.plt.rc_context(figures.STYLE):
                figure, axis = figures.plt.subplots()
                axis.plot(values)
                prepare(axis)
                figure.canvas.draw()
                low, high = axis.get_ylim()
                found = [label.get_text() for which in ("major", "minor") for label in axis.get_yticklabels(which=which)
                         if low <= label.get_position()[1] <= high]
                offset = axis.yaxis.get_offset_text().get_text()
                figures.plt.close(figure)
            return sorted(filter(None, found)), offset

        # Little more than a decade: powers of ten alone would name one.
        self.assertEqual(labels([0.004, 0.06], figures.by_powers_of_ten), (["0.005", "0.01", "0.02", "0.05"], ""))
        self.assertEqual(labels([0.002, 50.0], figures.by_powers_of_ten), (["0.01", "0.1", "1", "10"], ""))
        # Close to 1, as a difference of pixels is: no difference to 0.9999.
        found, offset = labels([1.0, 0.99998])
        self.assertEqual(offset, "")
        self.assertTrue(all(label.startswith(("0.9999", "1.0000")) for label in found), found)

    def test_scale_bars_have_round_lengths(self):
        self.assertEqual([map_figure.round_length(v) for v in (7.3, 1.99, 499.0, 500.0, 0.3)], [5, 1, 200, 500, 0.2])

    def test_many_pairs_are_told_three_at_a_time(self):
        self.assertEqual(tables.chunks(list("abcdefg"), 3), [["a", "b", "c"], ["d", "e", "f"], ["g"]])


class Localisation(InFolder):
    def queries(self, *lines):
        return queries.read(self.write("localisation.csv", [queries.HEADER, *lines]))

    def test_shares_are_of_all_queries_and_need_both_position_and_rotation(self):
        found = self.queries("0,0,h12,h04,sift,0.5,5,9,5,localised", "1,1,h12,h04,sift,0.4,5.1,9,5,localised",
                             "2,2,h12,h04,sift,0.6,4,9,5,localised", "3,3,h12,h04,sift,nan,nan,0,5,no_pose")
        one = found["h12", "h04", "sift"]
        self.assertEqual([one.share_within(*bound) for bound in localisation.WITHIN], [0.0, 0.25, 0.75])
        self.assertEqual(one.failures, 1)

    def test_medians_count_failures_as_further_off_than_any(self):
        self.queries("0,0,h12,h04,sift,0.5,5,9,5,localised", "1,1,h12,h04,sift,nan,nan,0,5,no_pose",
                     "2,2,h12,h04,sift,nan,nan,0,5,no_pose", "0,0,h12,h04,orb,0.5,5,9,5,localised",
                     "1,1,h12,h04,orb,0.7,6,9,5,localised", "2,2,h12,h04,orb,nan,nan,0,5,no_pose")
        self.assertEqual([row[-3:-1] for row in localisation.table_rows(self.read())],
                         [["no pose", "no pose"], ["0.700", "6.000"]])

    def test_shares_stand_with_their_intervals(self):
        self.queries("0,0,h12,h04,sift,0.5,5,9,5,localised", "1,1,h12,h04,sift,nan,nan,0,5,no_pose")
        self.write("localisation_summary.csv", [
            queries.SUMMARY, "h12,h04,sift,2,1,0,0,0,0.5,0.25,0.75,0.5,nan,nan,inf,inf,2,nan,nan,nan"])
        self.assertEqual(localisation.table_rows(self.read())[0][5:8], ["0\u00a0[0,\u00a00]", "50\u00a0[25,\u00a075]", "50"])

    def test_what_stands_twice_or_is_no_number_is_refused_with_its_line(self):
        line = "0,0,h12,h04,sift,0.5,5,9,5,localised"
        for lines, what in [([line, line], ":3: pose 0 of h12, h04, sift was given on line 2 already"),
                            ([line.replace("0.5", "far")], ":2: error_m is 'far'")]:
            with self.assertRaisesRegex(ReportError, what):
                self.queries(*lines)

    def test_hours_stand_in_the_order_of_the_day(self):
        found = self.queries(*(f"0,0,h12,{hour},sift,0,0,9,5,localised" for hour in ("h20", "h04_30", "h04")))
        self.assertEqual(localisation.conditions(found, "h12"), ["h04", "h04_30", "h20"])
        self.assertEqual(names.hour_of("h04_30"), 4.5)

    def test_a_cell_reaches_to_the_middle_between_hours_and_never_further_than_an_hour(self):
        self.assertEqual(localisation._cells([4, 4.5, 12]), [(3.75, 4.25), (4.25, 5.5), (11.0, 13.0)])

    def test_conditions_of_any_name_and_size_are_drawn(self):
        self.write("localisation.csv", [queries.HEADER, "7,0,noon,dusk,sift,nan,nan,0,5,no_pose"])
        output = self.read()
        self.assertIn("<svg", localisation.usable_hours(output))
        self.assertIn("<svg", localisation.errors_along_path(output, localisation.pairs(output.queries)))

    def test_a_map_of_several_hours_is_called_by_all_of_them(self):
        self.assertEqual(names.condition_of_map("h08+h16_30"), "8 and 16:30 h")
        self.assertEqual(names.condition_of_map("noon+dusk"), "noon and dusk")
        self.queries("7,0,h08+h16,h12,sift,0.01,0.1,40,5,localised")
        output = self.read()
        self.assertEqual(localisation.table_rows(output)[0][0], "8 and 16 h")
        figure = localisation.usable_hours(output)
        self.assertEqual(figure.count("stroke-dasharray"), 2, "one dashed line an hour of the map")

    def test_pairs_and_elevations_of_a_map_of_several_hours_are_those_of_its_hours(self):
        made.write_all(self.folder)
        # A map of 4 and 12 h, whose D to 20 h is that of the most alike.
        self.write("localisation.csv", [line.replace(",h12,", ",h04+h12,") for line in made.queries() if ",h04," not in line])
        output = self.read()
        self.assertEqual(output.mapped, {"h04", "h12"})
        ((elevation, query, _, least),) = localisation.judged_twice(output)["h04+h12", "orb"]
        self.assertEqual((elevation, query), (-3.0, "h20"))
        compared = [output.summary[pair].mean for pair in (("h04", "h20", "orb"), ("h12", "h20", "orb"))]
        self.assertNotEqual(*compared)
        self.assertEqual(least.mean, min(compared))
        os.remove(os.path.join(self.folder, "frames.csv"))
        self.assertEqual(self.read().conditions, ["h04", "h12", "h20"])
        self.assertEqual(comparisons._hours("h20 in h04+h12", []), "20 h in 4 and 12 h")


class Matrices(InFolder):
    def test_each_pair_stands_in_the_row_of_the_first_and_the_column_of_the_second(self):
        hours = ["h20", "h04", "h06", "h12"]
        lines = [made.frame(0, a, b, "sift", 0.1 * row + 0.01 * column) for row, a in enumerate(hours)
                 for column, b in enumerate(hours) if row < column]
        self.write("frames.csv", [made.FRAMES_HEADER, *lines, made.frame(0, "h06", "self_test/h06", "sift", 0.5)])
        conditions, values = matrices.matrix(self.read(), "sift")
        self.assertEqual(conditions, ["h04", "h06", "h12", "h20"])
        nothing = math.nan  # h20 comes first in all its pairs
        np.testing.assert_allclose(values, [[nothing, 0.12, 0.13, nothing], [nothing, 0.5, 0.23, nothing],
                                               [nothing] * 4, [0.01, 0.02, 0.03, nothing]])
        self.assertIn("<svg", matrices.of_all_pairs(self.read()))
        self.assertTrue(matrices.worth_showing(self.read()))

    def test_three_conditions_are_left_to_the_tables(self):
        self.write("frames.csv", made.frames())
        self.assertFalse(matrices.worth_showing(self.read()))


class Matches(InFolder):
    def rows(self):
        self.write("frames.csv", made.frames())
        return {tuple(cells[:2]): (cells, intervals, undefined) for cells, intervals, undefined in verified.table_rows(self.read())}

    def test_means_and_intervals_are_those_of_the_summary(self):
        self.write("verified.csv", made.verified())
        self.write("verified_summary.csv", made.verified_summary())
        cells, intervals, undefined = self.rows()["4–20 h", "ORB"]
        self.assertEqual(cells[2:], ["40"] + ["0.812"] * 7)
        self.assertEqual(intervals, ["[0.787, 0.838]"] * 7)
        self.assertEqual(undefined, "")

    def test_without_a_summary_means_have_no_intervals(self):
        """As while a run goes on."""
        self.write("verified.csv", made.verified(undefined=[3, 4]))
        cells, intervals, undefined = self.rows()["12–20 h", "SIFT"]
        # Twice 0 to 19 of 50, without 1 and 2: (380 - 3) / 38 / 50.
        self.assertEqual(cells[3:], ["0.198", "0.125", "0.062", "0.375", "0.500", "0.250", "0.950"])
        self.assertEqual(intervals, [""] * 7)
        self.assertEqual(undefined, "precision: 2")

    def test_drawn_are_those_with_the_fewest_and_the_most_right_matches(self):
        made.write_all(self.folder)
        shown = verified.drawn(self.read())
        # Of 40 poses each: 0 right matches at pose 0 and 19 at 38; that of 12 to 20 h has both drawn, the other two others.
        self.assertEqual([[caption for caption, _ in row] for row in shown],
                         [["Fewest right matches of SIFT of the poses drawn: 5, 4–12 h, pose 10.",
                           "Most right matches of SIFT of the poses drawn: 15, 4–12 h, pose 30."],
                          ["Fewest right matches of SIFT: 0, 12–20 h, pose 0.", "Most right matches of SIFT: 19, 12–20 h, pose 38."]])

    def test_of_many_pairs_the_extremes_of_all_are_drawn(self):
        made.write_all(self.folder)
        output = self.read()
        output.verified.poses["h04", "h20", "sift"] = {7: 3, 8: 30}
        for (a, b), poses in zip(made.PAIRS, ((10, 30), (7, 8), (0, 38))):
            some = next(iter(output.matches["h04-h12/sift"].values()))
            output.matches[f"{a}-{b}/sift"] = {pose: some for pose in poses}
        few, verified.PAIRS_DRAWN = verified.PAIRS_DRAWN, 2
        self.addCleanup(setattr, verified, "PAIRS_DRAWN", few)
        self.assertEqual([[caption for caption, _ in row] for row in verified.drawn(output)],
                         [["Fewest right matches of SIFT: 0, 12–20 h, pose 0.", "Most right matches of SIFT: 30, 4–20 h, pose 8."]])

    def test_where_all_poses_are_alike_the_fewest_are_the_most(self):
        made.write_all(self.folder)
        output = self.read()
        some = next(iter(output.matches["h04-h12/sift"].values()))
        for a, b in made.PAIRS:
            output.verified.poses[a, b, "sift"] = {7: 0, 8: 0}
            output.matches[f"{a}-{b}/sift"] = {7: some}
        self.assertEqual([[caption for caption, _ in row] for row in verified.drawn(output)],
                         [[f"Fewest right matches of SIFT: 0, {pair} h, pose 7."] for pair in ("4–12", "4–20", "12–20")])
        few, verified.PAIRS_DRAWN = verified.PAIRS_DRAWN, 2
        self.addCleanup(setattr, verified, "PAIRS_DRAWN", few)
        self.assertEqual([[caption for caption, _ in row] for row in verified.drawn(output)],
                         [["Fewest right matches of SIFT: 0, 12–20 h, pose 7.", "Most right matches of SIFT: 0, 4–20 h, pose 7."]])

    def test_nothing_is_told_of_matches_that_nobody_verified(self):
        self.write("frames.csv", made.frames(differences=["sift"]))
        output = self.read()
        self.assertEqual(page.matches(output), {"verified_rows": []})
        self.assertNotIn("Are the matches right?", page.render(output, findings.judge(output)))

    def test_what_cannot_be_read_is_named_with_its_line(self):
        self.write("frames.csv", made.frames())
        lines = made.verified()
        self.write("verified.csv", lines[:3] + [lines[1]])
        self.assert_refused("verified.csv:4: pose 0 of h04, h12, sift was given on line 2 already")
        self.write("verified.csv", lines[:2] + [lines[2].replace("0.0625", "inf")])
        self.assert_refused("verified.csv:3: average_precision_3px is 'inf', but must be a finite number or nan")
        self.write("verified.csv", ["pose,stamp"])
        self.assert_refused("verified.csv:1: the first line must be pose,stamp,a,b,detector,")
        self.write("verified.csv", lines)
        self.write("verified_summary.csv", made.verified_summary()[:2] + ["h04,h12"])
        self.assert_refused("verified_summary.csv:3: 2 fields, but must be 10")

    def test_an_empty_file_or_only_self_tests_make_a_page(self):
        self.write("frames.csv", made.frames() + made.self_frames())
        self.write("verified.csv", made.verified()[:1])
        output = self.read()
        self.assertEqual(page.matches(output), {"verified_rows": []})
        self.write("verified.csv", [line.replace("h12", "self_test/h04") for line in made.verified() if "h20" not in line])
        output = self.read()
        self.assertEqual([cells[0] for cells, _, _ in verified.table_rows(output)], ["4–4 h", "4–4 h"])
        self.assertIn("Are the matches right?", page.render(output, findings.judge(output)))


class Lost(InFolder):
    def test_shares_are_summed_by_cell_and_of_all(self):
        self.write("frames.csv", made.frames())
        self.write("lost_features.csv", made.lost_features())
        found = self.read().lost["h04", "h12", "sift"]
        self.assertEqual((found.features[0, 0], found.lost[0, 0], found.share[0, 0]), (100, 0, 0.0))
        self.assertEqual(found.share[11, 15], 0.75)
        self.assertTrue(math.isnan(found.share[5, 5]))  # of 9 features a share says nothing
        self.assertEqual(lost.table_rows(self.read())[0][:4], ["4–12 h", "SIFT", "40", "209"])

    def test_what_cannot_be_is_refused_with_its_line(self):
        self.write("frames.csv", made.frames())
        self.write("lost_features.csv", [lost_rows.HEADER, "h04,h12,sift,40,0,0,5,6"])
        self.assert_refused("lost_features.csv:2: column, row and lost must be below 16, 12 and features")

    def test_pictures_without_features_lose_none_and_keep_none(self):
        self.write("frames.csv", made.frames())
        self.write("lost_features.csv", [lost_rows.HEADER, "h04,h12,sift,40,0,0,0,0", "h12,h20,sift,40,0,0,50,10"])
        output = self.read()
        self.assertEqual([cells[-1] for cells in lost.table_rows(output)], ["–", "20.0"])
        lost.heat_maps(output)

    def test_of_many_pairs_those_that_lose_most_are_shown(self):
        some = {(f"h{k:02d}", "h23", "sift"): lost_rows.Lost(1, np.full((12, 16), 100), np.full((12, 16), k)) for k in range(9)}
        self.assertEqual([a for a, _ in lost.shown_pairs(some)], [f"h{k:02d}" for k in range(3, 9)])
        with mock.patch.object(lost, "shown_pairs", wraps=lost.shown_pairs) as asked:
            self.assertEqual(len(lost.table_rows(types.SimpleNamespace(lost=some))), 6)
        self.assertEqual(asked.call_count, 1)


class Elevation(InFolder):
    def test_both_judgements_stand_at_the_height_of_the_sun(self):
        made.write_all(self.folder)
        judged = localisation.judged_twice(self.read())["h12", "orb"]
        # 20 h at -3 degrees with 10 of 40 found, 4 h at 5 degrees with 36 of 40; D of the pair, whichever comes first in it.
        self.assertEqual([(elevation, query, share[0]) for elevation, query, share, _ in judged], [(-3.0, "h20", 0.25), (5.0, "h04", 0.9)])
        self.assertAlmostEqual(judged[1][3].mean, 0.97)

    def test_without_captures_there_is_no_such_figure(self):
        self.write("frames.csv", made.frames(differences=made.METHODS))
        self.write("localisation.csv", made.queries())
        output = self.read()
        self.assertEqual(localisation.judged_twice(output), {})
        self.assertNotIn("over the elevation", page.render(output, findings.judge(output)))

    def test_weathers_of_one_hour_have_no_such_figure(self):
        self.write("frames.csv", made.frames(differences=made.METHODS))
        self.write("localisation.csv", made.queries())
        self.write("captures.csv", made.captures())
        with open(os.path.join(self.folder, "captures.csv"), encoding="utf-8") as file:
            heading, *rows = [line.split(",") for line in file.read().splitlines()]
        column = heading.index("sun_elevation_deg")
        for elevations, is_shown in (({"h04": 5.0, "h20": 5.0}, False), ({"h04": 5.0, "h20": 5.0004}, False),
                                     ({"h04": 5.0, "h20": 7.0}, True)):
            changed = [[*row[:column], str(elevations.get(row[0], 60.0)), *row[column + 1:]] for row in rows]
            self.write("captures.csv", [",".join(row) for row in [heading, *changed]])
            output = self.read()
            self.assertEqual(localisation.over_elevation(output) is not None, is_shown, elevations)
            self.assertEqual("over the elevation" in page.render(output, findings.judge(output)), is_shown, elevations)

    def test_positions_of_many_hours_are_shown_of_some(self):
        self.write("localisation.csv", made.queries())
        lines = [f"{k},0.0,h12,q{hour:02d},sift,{k}.1,0,1,0,0,0,1,{k},0,1" for hour in range(20) for k in range(3)]
        self.write("localisation_poses.csv", [queries.POSITIONS, *lines, "3,0.0,h12,q00,sift,nan,nan,nan,nan,nan,nan,nan,3,0,1"])
        output = self.read()
        self.assertEqual(output.positions["h12", "q00", "sift"].truth.tolist(), [[0, 0, 1], [1, 0, 1], [2, 0, 1], [3, 0, 1]])
        picture, shown, hours = map_figure.found_on_map(output)
        self.assertEqual((shown, hours), (6, 20))
        self.assertIn("<svg", picture)
        self.assertEqual((picture.count("x, east / m"), picture.count("y, north / m")), (1, 6))  # a column of six panels

    def test_lines_from_the_truth_to_estimates_far_off_are_drawn_at_once(self):
        truth = np.arange(900.0).reshape(300, 3)
        figure, axis = plt.subplots()
        map_figure._draw_found(axis, queries.Positions(truth + 5, truth))  # pylint: disable=protected-access
        (drawn,) = axis.collections
        self.assertEqual(np.array(drawn.get_segments()).tolist(), np.stack((truth, truth + 5), axis=1)[:, :, :2].tolist())
        self.assertLess(len(axis.lines), 10)
        plt.close(figure)

    def test_what_is_found_too_high_is_not_found_within_half_a_metre(self):
        # As error_m has it: above the very place by 2 m, by 0.4 m, and beside and above it by 0.4 m each.
        truth = np.array([[0.0, 0.0, 1.0], [10.0, 0.0, 1.0], [20.0, 0.0, 1.0]])
        found = truth + [[0.0, 0.0, 2.0], [0.0, 0.0, 0.4], [0.4, 0.0, 0.4]]
        figure, axis = plt.subplots()
        map_figure._draw_found(axis, queries.Positions(found, truth))  # pylint: disable=protected-access
        (near,) = [line for line in axis.lines if str(line.get_label()).startswith("found within")]
        self.assertEqual(near.get_xdata().tolist(), [10.0])
        plt.close(figure)


class Comparisons(InFolder):
    def test_what_is_significant_is_counted_and_shown(self):
        self.write("frames.csv", made.frames())
        self.write("comparisons.csv", made.comparisons())
        output = self.read()
        methods, hours = comparisons.count_rows(output)
        # 39 poses make 13 blocks of 3, whose p is 1/4096 at least; 30 poses 10. Of three of the methods one has no p.
        self.assertEqual(methods, ["methods", "D", "3", "2", "2", "39", "1", "0", "0.0005"])
        self.assertEqual(hours, ["hours", "error / m", "1", "1", "0", "30", "0", "8", "0.0020"])
        self.assertEqual(comparisons.significant_rows(output), (
            [["D", pair, "SIFT", "ORB", "39", "1 undefined", "-0.125", "[-0.250, -0.062]", "< 0.0001", "< 0.0001"]
             for pair in ("4–20 h", "12–20 h")], 2))
        self.assertEqual(comparisons._row(output.comparisons[0], made.PAIRS)[-2:], [tables.MISSING] * 2)
        self.assertEqual(comparisons._row(output.comparisons[-1], made.PAIRS)[:6],
                         ["error / m", "SIFT", "4 h in 12 h", "20 h in 12 h", "30", "8 failed, 2 alone"])

    def test_what_is_0_everywhere_makes_no_path_long_enough(self):
        # 20 blocks of 2 at a pitch dark hour, where all is lost by both; 10 and 5 blocks where there is something to tell.
        self.write("frames.csv", made.frames(differences=["sift"]))
        header = made.comparisons()[0]
        row = "d,methods,h0{0}-h12,sift,orb,40,0,0,0,{1},{1},{1},1,1,{2}"
        self.write("comparisons.csv", [header, *(row.format(hour, 0, 2) for hour in (1, 2)),
                                       row.format(3, -0.2, 4), row.format(4, -0.2, 8)])
        (counts,) = comparisons.count_rows(self.read())
        self.assertEqual(counts[2:5] + counts[-1:], ["4", "1", "0", f"{4 / 2**9:.4f}"])

    def test_few_of_many_are_shown_and_that_is_said(self):
        self.write("frames.csv", made.frames(differences=["sift"]))
        lines = [f"d,methods,x{k},sift,orb,39,0,0,0,1,1,1,{k / 10000},{k / 10000},3" for k in range(100)]
        self.write("comparisons.csv", [made.COMPARISONS_HEADER, *lines, "d,methods,y,sift,orb,0,9,0,0,nan,nan,nan,nan,nan,0"])
        output = self.read()
        shown, count = comparisons.significant_rows(output)
        self.assertEqual((count, len(shown), shown[0][1], shown[-1][1]), (100, comparisons.SHOWN, "x0", "x39"))
        self.assertEqual(comparisons.count_rows(output)[0][2:7], ["101", "100", "100", "0 to 39", "0 to 9"])
        self.assertIn(f"the {comparisons.SHOWN} surest of 100", page.render(output, findings.judge(output)))

    def test_errors_of_millimetres_are_no_zeros(self):
        self.write("frames.csv", made.frames(differences=["sift"]))
        self.write("comparisons.csv", [made.COMPARISONS_HEADER,
                                       "error_m,hours,sift,h04,h12,39,0,0,0,0.00031,0.00012,0.00049,0.00001,0.00001,3"])
        self.assertEqual(comparisons._row(self.read().comparisons[0], made.PAIRS)[6:8], ["+0.00031", "[+0.00012, +0.00049]"])

    def test_without_any_there_is_no_word_of_it(self):
        self.write("frames.csv", made.frames(differences=["sift"]))
        for lines in ([], [made.COMPARISONS_HEADER]):
            if lines:
                self.write("comparisons.csv", lines)
            output = self.read()
            self.assertNotIn("more than chance", page.render(output, findings.judge(output)))


class Page(InFolder):
    def run_report(self, *arguments):
        return subprocess.run([sys.executable, REPORT, *arguments], capture_output=True, text=True, check=False)

    def page(self):
        with open(os.path.join(self.folder, "report.html"), encoding="utf-8") as file:
            return file.read()

    def test_a_terminal_that_lacks_letters_is_no_reason_to_fail(self):
        self.write("frames.csv", made.frames(differences=["sift"]))
        self.write("captures.csv", [files.CAPTURES, "h04,0,0,14,auto,0,-11,0,0,0,0.00084,,nan"])
        for encoding, dash in (("ascii", "?"), ("iso-8859-1", "?"), ("utf-8", "–")):
            done = subprocess.run([sys.executable, REPORT, self.folder], capture_output=True, check=False,
                                  env=dict(os.environ, PYTHONIOENCODING=encoding))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(dash, done.stdout.decode(encoding))
            self.assertIn("Report: ", done.stdout.decode(encoding))

    def test_nobody_who_reads_on_is_no_word_worth(self):
        self.write("frames.csv", made.frames(differences=["sift"]))
        read, write = os.pipe()
        os.close(read)
        done = subprocess.run([sys.executable, REPORT, self.folder], stdout=write, stderr=subprocess.PIPE, check=False)
        os.close(write)
        self.assertEqual((done.returncode, done.stderr), (-signal.SIGPIPE, b""))
        self.assertIn("report.html", os.listdir(self.folder))

    def test_interrupted_it_ends_without_a_word(self):
        self.write("frames.csv", made.frames(differences=["sift"]))
        captures = os.path.join(self.folder, "captures.csv")
        os.mkfifo(captures)
        # As a terminal starts it: what runs in the background may have been told to ignore this signal.
        reporting = subprocess.Popen([sys.executable, REPORT, self.folder], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                     preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        with open(captures, "w", encoding="utf-8"):  # it reads them
            reporting.send_signal(signal.SIGINT)
            self.assertEqual(reporting.communicate(timeout=60), (b"", b""))
        self.assertEqual(reporting.returncode, 130)
        self.assertEqual(sorted(os.listdir(self.folder)), ["captures.csv", "frames.csv"])

    def test_without_docstrings_it_is_the_same(self):
        self.write("frames.csv", made.frames(differences=["sift"]))
        done = subprocess.run([sys.executable, "-OO", REPORT, self.folder], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        usual = self.run_report(self.folder)
        self.assertEqual(done.stdout, usual.stdout)
        for optimised in ([], ["-OO"]):
            said = subprocess.run([sys.executable, *optimised, REPORT, "--help"], capture_output=True, text=True, check=True).stdout
            self.assertIn("Makes report.html, one", said)

    def test_the_light_of_nights_has_as_many_digits_as_that_of_noons(self):
        shown = [tables.significant(value) for value in (0.00084, 0.0009996, 0.25, 12.346, 99.96, 150.4, 98765.4, 0.0)]
        self.assertEqual(shown, ["0.000840", "0.00100", "0.250", "12.3", "100", "150", "98765", "0"])
        made.write_all(self.folder)
        self.write("captures.csv", [files.CAPTURES, "h04,0,0,14,auto,0,-11,0,0,0,0.00084,,nan", "h04,1,1,14,auto,0,-11,0,0,0,0.00251,,nan"])
        self.assertEqual(tables.conditions(self.read())[0][4], "0.000840 to 0.00251")

    def test_whole_folder_gives_one_self_contained_page(self):
        made.write_all(self.folder)
        done = self.run_report(self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        html = self.page()
        self.assertEqual(set(re.findall(r'(?:src|href)="([^:"]*):', html)), {"data"})
        self.assertNotRegex(html, r"url\(|@import|<script|<link")
        self.assertEqual(html.count("data:image/svg+xml"), 9)
        self.assertEqual(html.count("data:image/jpeg"), 5 * 3 + 4)  # and the best and worst of SIFT's matches of two pairs
        for text in ("0.84000", "0.84577", "9.8.7", "race_track", "4321", "geometry", "20.00", "00c0ffee",
                     "osmesa: llvmpipe (LLVM 15.0.6, 256 bits)", "albedo of the land around the world", "0.173",
                     "cut &lt;short&gt;, it seems", "<td>17</td>"):
            self.assertIn(text, html)
        self.assertNotIn('class="absent"', html)
        self.assertLess(html.index("Until which hour a map serves"), html.index("Differences between conditions"))
        self.assertIn("6 of 6", done.stdout)
        self.assertRegex(done.stdout, r"SIFT +0\.84000 +0\.63000 +0\.83000 +0\.05000 +0\.14000 +0\.05000")
        self.assertRegex(done.stdout, r"paper +0\.84577 +0\.63501")
        self.assertRegex(done.stdout, r"4–12 h +SIFT +40( +0\.812){7}")
        self.assertRegex(done.stdout, r"methods +D +3 +2 +2 +39 +1 +0")

    def test_maps_serve_until_hours_or_under_conditions(self):
        self.assertEqual(names.until_which(["h04", "h12_30"]), "Until which hour")
        self.assertEqual(names.until_which(["h04", "fog"]), "Under which conditions")

    def test_every_absent_file_is_named_in_place(self):
        self.write("frames.csv", made.frames())
        self.assertEqual(self.run_report(self.folder).returncode, 0)
        html = self.page()
        for name in ("captures.csv", "path.csv", "timing.csv", "run.yaml", "images", "summary.csv"):
            self.assertIn(name, html)

    def test_localisation_alone_makes_a_page(self):
        self.write("localisation.csv", made.queries({("h20", "orb"): 30}))
        done = self.run_report(self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"12 h +20 h +ORB +40 +30 +25 +25 +25")
        html = self.page()
        self.assertIn("Until which hour a map of 12 h serves", html)
        self.assertNotIn("Differences between conditions", html)
        self.assertNotIn("published findings", html)

    def test_every_hour_of_a_day_stays_within_20_megabytes(self):
        """276 pairs and 991 poses; pictures of noise are the largest that there are. Files of that size are made in memory."""
        made.write_all(self.folder)
        output = self.read()
        random = np.random.default_rng(1)
        hours = [f"h{hour:02d}" for hour in range(24)]
        noise = os.path.join(self.folder, "noise.png")
        Image.fromarray(random.integers(0, 256, (480, 1280, 3), dtype=np.uint8)).save(noise)
        poses = np.arange(991)
        count = np.full(991, 400)
        mean = dataclasses.replace(next(iter(output.verified.means.values()))["d"], n=991)
        for pair in itertools.combinations(hours, 2):
            for difference in made.DIFFERENCES:
                value = random.uniform(0, 1, 991)
                output.series[(*pair, difference)] = files.Series(poses, value, count, count, count, count, value, value)
                output.summary[(*pair, difference)] = files.summarise(output.series[(*pair, difference)])
            for detector in made.METHODS:
                output.verified.poses[(*pair, detector)] = dict(zip(poses.tolist(), (poses % 50).tolist()))
                output.verified.means[(*pair, detector)] = {name: mean for name in verified_rows.MEASURES}
                output.matches["-".join(pair) + "/" + detector] = {0: noise, 49: noise}
                cells = random.integers(1, 100, (12, 16))
                output.lost[(*pair, detector)] = lost_rows.Lost(991, cells, cells // 2)
        for hour in hours:
            output.images[hour] = {pose: noise for pose in (0, 248, 495, 742, 990)}
            for detector in made.METHODS:
                errors = random.uniform(0, 1, 991)
                places = random.uniform(0, 500, (991, 3))
                output.queries["h12", hour, detector] = queries.Queries(poses, errors, errors, count)
                output.positions["h12", hour, detector] = queries.Positions(places + 0.1, places)
        output.path = {"pose": poses, "x": poses * 1.0, "y": poses * 0.5}
        html = page.render(output, findings.judge(output))
        self.assertLess(len(html.encode()), 20e6)
        self.assertIn("of 12 of the 276 pairs", html)
        self.assertIn("6 of 24 conditions", html)
        self.assertEqual({pair for pair in output.shown_pairs if "h12" not in pair}, set())

    def test_the_way_driven_is_from_the_first_evaluated_pose_to_the_last(self):
        self.write("frames.csv", made.frames(differences=["sift"], pairs=made.PAIRS[:1]))
        self.write("path.csv", [files.PATH] + [f"{pose},{pose}.0,{10 * pose},0,0,0" for pose in range(made.POSES + 20)])
        self.assertIn((f"{10 * (made.POSES - 1)} m", "driven"), page.facts(self.read()))
        self.write("path.csv", [files.PATH, "990,990.0,0,0,0,0", "991,991.0,5,0,0,0"])
        self.assertIn(("0 m", "driven"), page.facts(self.read()))

    def test_the_same_folder_gives_the_same_bytes(self):
        made.write_all(self.folder)
        self.run_report(self.folder)
        first = self.page()
        self.run_report(self.folder)
        self.assertEqual(self.page(), first)

    def test_one_condition_against_itself_is_enough(self):
        self.write("frames.csv", [made.FRAMES_HEADER] + made.self_frames())
        self.assertEqual(self.run_report(self.folder).returncode, 0)
        self.assertIn("No two different conditions were compared", self.page())

    def test_another_file_is_written_where_asked(self):
        self.write("frames.csv", made.frames())
        target = os.path.join(self.folder, "elsewhere.html")
        self.assertEqual(self.run_report(self.folder, "--out", target).returncode, 0)
        self.assertEqual(sorted(os.listdir(self.folder)), ["elsewhere.html", "frames.csv"])

    def test_what_a_user_likes_of_figures_does_not_reach_them(self):
        self.write("frames.csv", made.frames())
        self.assertEqual(self.run_report(self.folder).returncode, 0)
        usual = self.page()
        with tempfile.TemporaryDirectory() as liked:
            with open(os.path.join(liked, "matplotlibrc"), "w", encoding="utf-8") as file:
                file.write("text.usetex: True\nfigure.autolayout: True\n")
            done = subprocess.run([sys.executable, REPORT, self.folder], capture_output=True, check=False,
                                  env=dict(os.environ, MPLCONFIGDIR=liked))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.page(), usual)

    def test_a_folder_whose_name_is_no_text_has_a_page(self):
        folder = os.path.join(os.fsencode(self.folder), b"fol\xfcder")
        os.mkdir(folder)
        with open(os.path.join(folder, b"frames.csv"), "w", encoding="utf-8") as file:
            file.write("\n".join(made.frames(differences=["sift"])) + "\n")
        done = subprocess.run([sys.executable, REPORT, folder], capture_output=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(os.listdir(folder)), [b"frames.csv", b"report.html"])

    def test_a_damaged_picture_is_named(self):
        made.write_all(self.folder)
        picture = next(iter(next(iter(self.read().images.values())).values()))
        with open(picture, "rb") as file:
            whole = file.read()
        at = whole.index(b"IDAT")
        with open(picture, "wb") as file:
            file.write(whole[:at] + b"\x00\x01\x02\x03" + whole[at + 4:])
        with self.assertRaisesRegex(ReportError, "cannot be read as a picture"):
            pictures.picture_of(picture, "RGB")

    def test_failures_end_with_one_line_and_a_status(self):
        unwritable = os.path.join(self.folder, "no", "such", "place.html")
        for prepare, arguments, what in [
                (lambda: None, [self.folder], "frames.csv: no such file, nor localisation.csv"),
                (lambda: self.write("frames.csv", made.frames()[:5] + ["torn,lin"]), [self.folder],
                 "frames.csv:6: 2 fields"),
                (lambda: self.write("frames.csv", made.frames()), [self.folder, "--out", unwritable],
                 "cannot be written")]:
            prepare()
            done = self.run_report(*arguments)
            self.assertEqual(done.returncode, 1)
            self.assertIn(what, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)


class Atlas(InFolder):
    """Two lights, two methods; the numbers of a cell follow from its place."""

    LIGHTS = ["c04,2024-07-01,04:30,60,-3.5,120.5,4.25", "c12,2024-07-01,12:00,180,57,93000,14"]

    def make(self, change=lambda lines: lines):
        lines = [atlas_rows.HEADER]
        for method in ("sift", "orb+clahe"):
            for a in ("c04", "c12"):
                for b in ("c04", "c12"):
                    share = 1.0 if a == b else 0.25 if method == "sift" else 0.0
                    reach = f"{share},0,1"
                    error = "0.01,0.1" if share else "inf,inf"
                    lines.append(f"{a},{b},{method},8,2,{reach},{reach},{reach},{error},0.5,0.4,0.6,1,0.5,0.4,0.6,0,nan,nan,nan,8")
        self.write("atlas.csv", change(lines))
        self.write("conditions.csv", [atlas_rows.CONDITIONS, *self.LIGHTS])

    def test_reads_a_matrix_with_a_map_a_row(self):
        self.make()
        atlas = atlas_rows.read(self.folder)
        self.assertEqual(atlas.methods, ["sift", "orb+clahe"])
        self.assertEqual(atlas.matrices["sift"]["within_0.5m_5deg"].tolist(), [[1, 0.25], [0.25, 1]])
        self.assertTrue(math.isinf(atlas.matrices["orb+clahe"]["median_error_m"][0, 1]))
        self.assertEqual(atlas.conditions.hours, [4.5, 12])
        self.assertEqual(atlas.conditions.sun_elevation_deg.tolist(), [-3.5, 57])

    def test_counts_the_lights_that_a_map_serves(self):
        self.make(lambda lines: [line.replace("c12,c04,sift,8,2,0.25,0,1,0.25", "c12,c04,sift,8,2,0.25,0,1,0.9") for line in lines])
        atlas = atlas_rows.read(self.folder)
        self.assertEqual(atlas_page.served(atlas, "sift").tolist(), [1, 2])
        self.assertEqual(atlas_page.table_rows(atlas)[0], ["SIFT", "12:00", "2", "04:30", "1", "1.5 of 2"])
        self.assertEqual(atlas_page.table_rows(atlas)[1][0], "ORB with CLAHE")

    def test_the_program_draws_pictures_and_a_page_that_needs_nothing_else(self):
        self.make()
        said = subprocess.run([sys.executable, REPORT, self.folder], stdout=subprocess.PIPE, text=True, check=True).stdout
        self.assertIn("SIFT", said)
        pictures_made = [name for name in os.listdir(self.folder) if name.endswith(".png")]
        self.assertEqual(len(pictures_made), 1 + 2 * len(atlas_figures.METRICS))
        self.assertIn("recall_0.5m_5deg_orb+clahe.png", pictures_made)
        with open(os.path.join(self.folder, "report.html"), encoding="utf-8") as file:
            page_text = file.read()
        self.assertEqual(page_text.count('src="data:image/png;base64,'), len(pictures_made))
        self.assertEqual(page_text.count("src="), len(pictures_made))
        first = {}
        for name in pictures_made:
            with open(os.path.join(self.folder, name), "rb") as file:
                first[name] = file.read()
        atlas = atlas_rows.read(self.folder)
        self.assertEqual(atlas_page.pictures(atlas), first)  # the same bytes again

    def test_the_page_says_whether_queries_drive_beside_the_map(self):
        self.make()
        for settings, part in (([], "finds its own place in the map"), (["--query-offset 0"], "finds its own place in the map"),
                               (["# how", "--fov 60", "--query-offset -0.5"], "second drive, -0.5 m to the left")):
            self.write("atlas.txt", settings)
            atlas = atlas_rows.read(self.folder)
            drawn = {"usable_hours.png": b"", **{f"{metric[1]}_{method}.png": b"" for method in atlas.methods
                                                 for metric in atlas_figures.METRICS}}
            self.assertIn(part, " ".join(atlas_page.render(atlas, drawn).split()))

    def test_where_nothing_is_localised_the_matrices_are_drawn_without_a_word(self):
        whole = "1,0,1,1,0,1,1,0,1,0.01,0.1,0.5,0.4,0.6,1,0.5,0.4,0.6,0"
        self.make(lambda lines: [line.replace(whole, "0,0,1,0,0,1,0,0,1,inf,inf,nan,nan,nan,8,nan,nan,nan,8")
                                 .replace("inf,inf,0.5,0.4,0.6,1,", "inf,inf,nan,nan,nan,8,") for line in lines])
        self.write("conditions.csv", [atlas_rows.CONDITIONS, *self.LIGHTS])
        atlas = atlas_rows.read(self.folder)
        self.assertTrue(math.isnan(atlas.matrices["orb+clahe"]["d"].max()))
        with of_python.catch_warnings():
            of_python.simplefilter("error")
            for metric in atlas_figures.METRICS:
                atlas_figures.heat_map(atlas, "orb+clahe", metric)

    def test_several_days_are_told_apart(self):
        self.make()
        self.write("conditions.csv", [atlas_rows.CONDITIONS, self.LIGHTS[0], self.LIGHTS[1].replace("2024-07-01", "2024-12-21")])
        atlas = atlas_rows.read(self.folder)
        self.assertEqual([atlas.conditions.called(i) for i in (0, 1)], ["2024-07-01", "2024-12-21"])
        self.assertIn("2 days", atlas_page.title(atlas))
        atlas_figures.heat_map(atlas, "sift", atlas_figures.METRICS[0])

    def refused(self, *parts):
        with self.assertRaises(ReportError) as caught:
            atlas_rows.read(self.folder)
        for part in parts:
            self.assertIn(part, str(caught.exception))

    def test_bad_files_are_named(self):
        self.make(lambda lines: lines[:-1])
        self.refused("atlas.csv: cells of orb+clahe are missing")
        self.make(lambda lines: lines + lines[-1:])
        self.refused("atlas.csv:10: c12 in the map of c12 by orb+clahe stands there twice")
        self.make(lambda lines: [line.replace("c04,c12,sift", "c04,c13,sift") for line in lines])
        self.refused("atlas.csv:3: c04 or c13 is not in conditions.csv")
        self.make(lambda lines: [line.replace("8,2", "many,2", 1) for line in lines])
        self.refused("atlas.csv:2: n is 'many', but must be a whole number")


class Problems(unittest.TestCase):
    def test_those_that_are_no_fault_come_last_in_the_order_that_they_had(self):
        kinds = ["no_features", "two_places", "no_features", "failed"]
        rows = [{"kind": kind, "pose": pose} for pose, kind in enumerate(kinds)]
        self.assertEqual([row["pose"] for row in tables.gravest_first(rows)], [1, 3, 0, 2])


if __name__ == "__main__":
    import rosunit
    rosunit.unitrun("sunlit", "report", "report_test")
