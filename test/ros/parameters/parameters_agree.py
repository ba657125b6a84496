#!/usr/bin/env python3
"""Shipped parameter files, launch arguments and the README say of parameters what the program does: same keys, same
defaults, same ranges."""
import os
import re
import subprocess
import sys
import unittest
import xml.etree.ElementTree
import xmlrpc.client

import rosunit
import yaml

SOURCE = os.environ["SUNLIT_SOURCE_DIR"]
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(SOURCE, "scripts"))

from sunlit_experiment import arguments  # noqa: E402

NUMBER = r"-?\d+(?:\.\d+)?(?:e\+?\d+)?"
# Arguments of experiment.launch that are parameters of the renderer, and what differs on purpose.
ARGUMENTS = {"missing": "missing", "spacing": "path/spacing", "offset": "path/offset", "yaw": "path/yaw", "camera_height": "path/camera_height",
             "width": "camera/width", "height": "camera/height", "horizontal_fov": "camera/horizontal_fov", "turbidity": "atmosphere/turbidity",
             "ozone": "atmosphere/ozone", "ground_albedo": "atmosphere/ground_albedo", "highlight_protection": "exposure/highlight_protection",
             "final_gather": "transport/final_gather", "night": "night/enabled", "lamps": "lamps", "noise": "noise/enabled",
             "noise_seed": "noise/seed", "vignetting": "vignetting/natural", "glare": "glare/share", "mosaic": "mosaic/pattern",
             "baseline": "camera/baseline"}
REQUIRED = ["streams", "output_dir"]  # of the evaluator: in the shipped file stands an example
NODES = {"sun_position_node", "render_node", "evaluator_node"}


def list_parameters(*words):
    return subprocess.run([os.path.join(os.environ["SUNLIT_DEVEL_DIR"], "lib", "sunlit", "list_parameters"), *words],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False, text=True)


def programmed():
    return yaml.safe_load(list_parameters().stdout)


def ranges(text):
    """Every range that a comment tells: (open at its low end, low, open at its high end, high)."""
    text = text.replace("−", "-")
    both = re.findall(rf"(> )?({NUMBER}) (?:…|\.\.\.|to) (< )?({NUMBER})", text)
    return {(bool(above), float(low), bool(below), float(high)) for above, low, below, high in both}


def commented(path):
    """Key -> what stands behind it on its line, on deeper lines of comment below it, and on those right above it."""
    comments, groups, above, last = {}, [], "", None
    with open(path) as file:
        for line in file:
            entry = re.match(r"( *)([a-z_0-9]+):( [^#]*|\s*)(?:# (.*))?$", line.rstrip("\n"))
            if entry:
                depth = len(entry[1]) // 2
                groups = groups[:depth] + [entry[2]]
                last = "/".join(groups)
                comments[last] = above + " " + (entry[4] or "")
                above = ""
            elif line.lstrip().startswith("#"):
                deeper = last is not None and len(line) - len(line.lstrip()) > 2 * len(groups)
                if deeper:
                    comments[last] += " " + line.strip("# \n")
                else:
                    above += " " + line.strip("# \n")
            else:
                above = ""
    return comments


def leaves(tree, prefix=""):
    for key, value in tree.items():
        if isinstance(value, dict) and value:
            yield from leaves(value, prefix + key + "/")
        else:
            yield prefix + key, value


def keys_of(text):
    """The parameters that a text names in backquotes, groups in braces taken apart."""
    keys = []
    for name in re.findall(r"`~?([a-z_0-9/{},]+)`", text):
        group = re.fullmatch(r"(.*)\{(.*)\}", name)
        keys += [group[1] + member for member in group[2].split(",")] if group else [name]
    return keys


def cells_of(text):
    """What stands between the commas of a cell, but for those in brackets."""
    return [cell.strip() for cell in re.findall(r"(?:\[[^\]]*\]|[^,\[])+", text)]


def same(told, row):
    """Whether a cell of the README, such as "0.25 m" or "`[]` (all)", tells the default of this row."""
    default = row["default"]
    told = told.replace("−", "-").split(" (")[0].strip("`")
    if default is None:
        return "unnamed" in told
    if isinstance(default, bool):
        return told == str(default).lower()
    if isinstance(default, str):
        return told == default or default == "" and told in ('""', "none", "own")
    if isinstance(default, list):
        return default == (row["allowed"].split(", ") if told == "all" else yaml.safe_load(told))
    if isinstance(default, dict):
        return yaml.safe_load(told) == default
    number = re.match(NUMBER, told)
    return number is not None and float(number[0]) == default


class ParametersAgree(unittest.TestCase):
    def check_file(self, node, name):
        path = os.path.join(SOURCE, "config", name)
        with open(path) as file:
            text = file.read()
        shipped = dict(leaves(yaml.safe_load(text)))
        comments = commented(path)
        for key, row in programmed()[node].items():
            with self.subTest(file=name, key=key):
                if key not in shipped:
                    explained = re.search(rf"# *{key.split('/')[-1]}: *([^#\n]*)(.*)", text)
                    self.assertIsNotNone(explained, "neither set nor explained")
                    if row["default"]:
                        self.assertEqual(yaml.safe_load(explained[1]), row["default"])
                    self.assertEqual(ranges(explained[2]), ranges(row["allowed"]))
                    continue
                if key in REQUIRED and node == "evaluator_node":
                    self.assertIn("No default.", comments[key])
                    self.assertFalse(row["default"])
                    continue
                self.assertEqual(shipped[key], row["default"])
                told = ranges(row["allowed"])
                if told:
                    self.assertTrue(told & ranges(comments[key]), f"{row['allowed']} is not in {comments[key]!r}")
                    self.assertEqual(ranges(comments[key]), told, "another range stands there too")

    def test_words_are_refused_but_for_help(self):
        done = [list_parameters(word) for word in ("--help", "render_node")]
        self.assertEqual([run.returncode for run in done], [0, 1])
        self.assertEqual((done[1].stdout, done[1].stderr), ("", done[0].stdout))

    def test_sun_position(self):
        self.check_file("sun_position_node", "sun_position.yaml")

    def test_render(self):
        self.check_file("render_node", "render.yaml")

    def test_evaluator(self):
        self.check_file("evaluator_node", "evaluator.yaml")

    def test_examples_in_comments_are_what_roslaunch_hands_on(self):
        checked = 0
        for name in ("sun_position.yaml", "render.yaml", "evaluator.yaml"):
            with open(os.path.join(SOURCE, "config", name)) as file:
                examples = re.findall(r"^ *# *([a-z_0-9]+: [\[{].*[\]}])", file.read(), re.MULTILINE)
            for example in examples:
                with self.subTest(file=name, example=example):
                    self.assertTrue(xmlrpc.client.dumps((yaml.safe_load(example),)))
                    checked += 1
        self.assertGreater(checked, 5)

    def test_arguments_of_the_experiment(self):
        rows = programmed()["render_node"]
        launch = xml.etree.ElementTree.parse(os.path.join(SOURCE, "launch", "experiment.launch"))
        arguments = {arg.get("name"): arg for arg in launch.getroot().findall("arg")}
        for argument, key in ARGUMENTS.items():
            with self.subTest(argument=argument):
                self.assertEqual(yaml.safe_load(arguments[argument].get("default")), rows[key]["default"])
                told = ranges(arguments[argument].get("doc"))
                self.assertLessEqual(told, ranges(rows[key]["allowed"]))

    def test_weather_of_the_experiments_conditions(self):
        rows = programmed()["render_node"]
        self.assertEqual(sorted(arguments.WEATHER), sorted(key.split("/")[1] for key in rows if key.startswith("weather/")))

    def test_suns_of_the_conditions_of_launch_files(self):
        """Each parameter that may differ is known by its last part or by its group, and nothing else is."""
        rows = [key.split("/") for key in programmed()["sun_position_node"] if key not in ("conditions", "diagnostic_period")]
        groups = {key[0] for key in rows if len(key) > 1}
        self.assertEqual(set(arguments.SUN), groups | {key[-1] for key in rows if key[0] != "frames"})

    def test_cameras_of_the_experiments_conditions(self):
        rows = programmed()["render_node"]
        for name, (group, row) in arguments.CAMERA.items():
            with self.subTest(name=name):
                self.assertIn(group + "/" + row, rows)

    def test_words_of_choices_of_launch_files(self):
        rows = programmed()["render_node"]
        keys = {"missing": "missing", "exposure": "exposure/mode", "rasterizer": "camera/rasterizer", "lamps": "lamps",
                "vignetting": "vignetting/natural", "mosaic": "mosaic/pattern", "overcast": "weather/overcast"}
        self.assertEqual({name: ", ".join(words) for name, words in arguments.CHOICES.items()},
                         {name: rows[key]["allowed"] for name, key in keys.items()})

    def test_parameters_that_launch_files_set(self):
        """Each is a parameter of its node, and the argument that it comes from names no other range."""
        checked = 0
        programs = programmed()
        for name in sorted(os.listdir(os.path.join(SOURCE, "launch"))):
            launch = xml.etree.ElementTree.parse(os.path.join(SOURCE, "launch", name)).getroot()
            docs = {arg.get("name"): arg.get("doc") or "" for arg in launch.findall("arg")}
            for node in launch.iter("node"):
                if node.get("type") not in NODES:
                    continue
                rows = programs[node.get("type")]
                for setting in node.findall("param") + node.findall("rosparam"):
                    key = setting.get("name") or setting.get("param")
                    if key is None:
                        continue  # a whole file
                    with self.subTest(launch=name, key=key):
                        self.assertIn(key, rows)
                        words = " ".join([setting.get("value") or "", setting.get("command") or "", setting.text or ""])
                        for argument in re.findall(r"\$\(arg (\w+)\)", words):
                            self.assertLessEqual(ranges(docs.get(argument, "")), ranges(rows[key]["allowed"]))
                        checked += 1
        self.assertGreater(checked, 20)

    def tables(self, section):
        """The cells of each row of the tables in a section of the README."""
        with open(os.path.join(SOURCE, "README.md")) as file:
            sections = dict(re.findall(r"^### ([\w.]+)\n(.*?)(?=^##)", file.read(), re.MULTILINE | re.DOTALL))
        for line in re.findall(r"^\| (`.*)\|$", sections[section], re.MULTILINE):
            yield [cell.strip() for cell in line.split(" |")]

    def test_arguments_of_the_experiment_in_the_readme(self):
        """All stand there; with the default of the launch file, and no range that is not its parameter's."""
        rows = programmed()["render_node"]
        launch = xml.etree.ElementTree.parse(os.path.join(SOURCE, "launch", "experiment.launch")).getroot()
        left = {arg.get("name"): arg.get("default") for arg in launch.findall("arg") if arg.get("doc")}
        for names, told, meaning, *_ in self.tables("experiment.launch"):
            keys = keys_of(names)
            defaults = cells_of(told)
            with self.subTest(arguments=names):
                self.assertEqual(len(defaults), len(keys))
                allowed = set().union(*(ranges(rows[ARGUMENTS[key]]["allowed"]) for key in keys if key in ARGUMENTS))
                if any(key in ARGUMENTS for key in keys):
                    self.assertLessEqual(ranges(meaning), allowed)
            for key, default in zip(keys, defaults):
                with self.subTest(argument=key):
                    own = left.pop(key)
                    plain = default.split(" (")[0].strip("`")
                    if plain == '""':
                        self.assertEqual(own, "")
                    else:
                        number = re.match(NUMBER + "(?= |$)", plain)
                        typed = number[0] if number else plain
                        self.assertEqual(yaml.safe_load(own), yaml.safe_load(typed))
        self.assertEqual(left, {})

    def test_defaults_and_ranges_of_the_readme(self):
        checked = 0
        for node, rows in programmed().items():
            for cells in self.tables(node):
                keys = [key for key in keys_of(cells[0]) if key in rows]
                if not keys or len(keys) != len(keys_of(cells[0])):
                    continue
                allowed = set().union(*(ranges(rows[key]["allowed"]) for key in keys))
                with self.subTest(node=node, keys=cells[0]):
                    self.assertLessEqual(ranges(" ".join(cells[2:])), allowed)
                    if set(keys) & set(REQUIRED) and node == "evaluator_node":
                        self.assertEqual(cells[1], "required")
                        continue
                    defaults = cells_of(cells[1])
                    if len(defaults) == len(keys):
                        for key, told in zip(keys, defaults):
                            self.assertTrue(same(told, rows[key]), f"{key}: {told}")
                            checked += 1
        self.assertGreater(checked, 30)

    def test_every_parameter_stands_in_the_readme(self):
        with open(os.path.join(SOURCE, "README.md")) as file:
            named = set(keys_of(file.read()))
        for node, rows in programmed().items():
            for key in rows:
                with self.subTest(node=node, key=key):
                    self.assertTrue(key in named or key.startswith("features/"), "not in README.md")


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "parameters_agree", ParametersAgree, sysargs=sys.argv)
