#!/usr/bin/python3
"""What roslaunch makes of the arguments of experiment.launch, without starting anything; test/unit/experiment has the rest."""
import os
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import unittest.mock
import xmlrpc.server
from xml.etree import ElementTree

import rosunit
import shown
import yaml

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "support"))
from programs import located  # noqa: E402

SOURCE = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", ".."))


class ExperimentArguments(unittest.TestCase):

    def test_every_shipped_parameter_file_is_under_test(self):
        """Each is loaded by the test named here, so that a bad key fails; a new one needs a test first."""
        config = os.path.join(SOURCE, "config")
        self.assertEqual(sorted(name for name in os.listdir(config) if name.endswith(".yaml")),
                         ["evaluator.yaml",      # test_evaluator_parameters.py
                          "render.yaml",         # render_refuses.py
                          "sun_position.yaml"])  # sun_refuses_parameters.py

    def test_every_shipped_waypoint_file_is_a_path(self):
        count_poses = located("count_poses")
        paths = os.path.join(SOURCE, "config", "paths")
        self.assertTrue(os.listdir(paths))
        for name in os.listdir(paths):
            poses = subprocess.check_output([count_poses, "race_track", os.path.join(paths, name), "1.0", "0"])
            self.assertGreater(int(poses), 100, name)

    def test_rviz_shows_each_condition(self):
        for config in ("sunlit.rviz", "sun_position.rviz"):
            for kind, text, names in (("hours", "[4, 20]", ["h04/", "h20/"]), ("conditions", "{a: {}}", ["a/"]),
                                        ("conditions", "", [""])):
                displays = shown.displays(config, kind, text)
                self.assertEqual([d["Marker Topic"] for d in displays if "Marker Topic" in d],
                                 [name + marker for marker in ("sun_marker", "moon_marker") for name in names])
                self.assertEqual(len({d["Name"] for d in displays}), len(displays))
                if config == "sunlit.rviz":
                    clouds = [d for d in displays if "Depth Map Topic" in d]
                    self.assertEqual([d["Color Image Topic"] for d in clouds], [name + "camera/image_raw" for name in names])
                    self.assertEqual({d["Depth Map Topic"] for d in clouds}, {"camera/depth/image_raw"})
                    self.assertEqual([d["Enabled"] for d in clouds], [True] + [False] * (len(names) - 1))

    def parameters(self, *arguments, **surroundings):
        """What experiment.launch would set, without starting anything. `surroundings`: environment variables; None: unset."""
        environment = {name: text for name, text in dict(os.environ, **surroundings).items() if text is not None}
        with tempfile.TemporaryDirectory() as folder:
            return yaml.safe_load(subprocess.check_output(["roslaunch", "--dump-params", "sunlit", "experiment.launch",
                                                           "output:=" + folder, *arguments], env=environment))

    def test_camera_and_night_of_the_published_experiment_are_the_defaults_of_the_renderer(self):
        with open(os.path.join(SOURCE, "config", "render.yaml")) as file:
            shipped = yaml.safe_load(file)
        found = self.parameters()
        for renderer in ("/render/", "/self_test/render/"):
            self.assertEqual(found[renderer + "exposure/mode"], "fixed")  # the one that differs, with its value
            self.assertEqual([found[renderer + "camera/" + key] for key in ("width", "height", "horizontal_fov")], [640, 480, 60.0])
            for group, key in (("night", "enabled"), ("noise", "enabled"), ("noise", "seed"),
                               ("vignetting", "natural"), ("glare", "share"), ("mosaic", "pattern"),
                               ("exposure", "highlight_protection"), ("atmosphere", "turbidity"),
                               ("atmosphere", "ozone"), ("atmosphere", "ground_albedo"), ("transport", "final_gather")):
                self.assertEqual(found[renderer + group + "/" + key], shipped[group][key], renderer + group + "/" + key)

    def test_what_pictures_look_like_reaches_both_renderers(self):
        found = self.parameters("night:=false", "noise:=true", "noise_seed:=7", "exposure:=auto", "highlight_protection:=0",
                                "final_gather:=2", "rasterizer:=builtin", "ground_albedo:=0.6", "vignetting:=cos4", "glare:=0.02",
                                "mosaic:=rggb", "blur:=0.7", "line_delay:=30", "exposure_time:=auto", "speed:=2.5", "adaptation:=0.2",
                                "conditions:={a: {hour: 12}, b: {hour: 12, wet: 1, glare: 0.03, line_delay: 20}}")
        for renderer in ("/render/", "/self_test/render/"):
            self.assertEqual([found[renderer + key] for key in ("night/enabled", "noise/enabled", "noise/seed", "exposure/mode",
                                                                "exposure/highlight_protection", "transport/final_gather",
                                                                "camera/rasterizer", "atmosphere/ground_albedo", "vignetting/natural",
                                                                "glare/share", "mosaic/pattern", "blur/sigma", "shutter/line_delay",
                                                                "shutter/exposure_time", "path/speed", "exposure/adaptation",
                                                                "conditions/a", "conditions/b/wet", "conditions/b/glare/share",
                                                                "conditions/b/shutter/line_delay")],
                             [False, True, 7, "auto", 0.0, 2, "builtin", 0.6, "cos4", 0.02, "rggb", 0.7, 30.0, "auto", 2.5, 0.2, "", 1,
                              0.03, 20])
        self.assertEqual(found["/experiment/arguments/noise_seed"], "7")

    def test_a_launch_file_of_the_same_name_may_have_arguments_of_its_own(self):
        with tempfile.TemporaryDirectory() as folder:
            mine = os.path.join(folder, "experiment.launch")
            with open(mine, "w") as file:
                file.write("""<launch><arg name="mine"/><include file="$(find sunlit)/launch/experiment.launch">
                  <arg name="output" value="$(arg mine)"/></include></launch>""")
            found = yaml.safe_load(subprocess.check_output(["roslaunch", "--dump-params", mine, "mine:=" + folder]))
            self.assertEqual(found["/experiment/output"], folder)
            # Ours is ours by any name.
            os.symlink(os.path.join(SOURCE, "launch", "experiment.launch"), os.path.join(folder, "linked.launch"))
            for name, where in ((os.path.join("launch", "experiment.launch"), SOURCE), ("linked.launch", folder)):
                done = subprocess.run(["roslaunch", "--dump-params", name, "nosie:=true", "output:=" + folder], cwd=where,
                                      stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
                self.assertIn("argument nosie is 'true'", done.stderr)

    def plan_command(self, plan, counter, **typed):
        """What roslaunch does to have a file `plan`."""
        launch_file = os.path.join(SOURCE, "launch", "experiment.launch")
        texts = {arg.get("name"): arg.get("default") for arg in ElementTree.parse(launch_file).iter("arg") if "default" in arg.attrib}
        return [os.path.join(SOURCE, "scripts", "experiment_parameters"), "plan", plan, launch_file, counter, located("check_parameters"),
                *("%s:=%s" % item for item in dict(texts, **typed).items())]

    def refused_plan(self, plan, **typed):
        """What is said where there can be no plan."""
        done = subprocess.run(self.plan_command(plan, located("count_poses"), **typed),
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
        self.assertEqual((done.returncode, done.stdout), (1, ""), done.stderr)
        return done.stderr

    def test_what_is_nowhere_is_refused_by_name(self):
        for name, text, words in (("path", "/nowhere.csv", "/nowhere.csv"), ("robot", "cat", "argument robot is 'cat'"),
                                  ("world", "/nowhere.world", "there is no world /nowhere.world")):
            with tempfile.TemporaryDirectory() as folder:
                said = self.refused_plan(os.path.join(folder, "plan"), **{"output": folder, name: text})
                self.assertEqual(os.listdir(folder), [])
                self.assertIn("sunlit: ", said)
                self.assertIn(words, said)

    def test_what_nodes_would_refuse_is_refused_before_they_start(self):
        """Those ranges stand in the rows of the nodes alone."""
        for typed, words in (({"glare": "0.5"}, "parameter /render/glare/share is 0.5, but must be from 0 to 0.2"),
                             ({"turbidity": "11"}, "parameter /render/atmosphere/turbidity is 11, but must be from 1 to 10"),
                             ({"site": "[91, 0, 0]"}, "parameter /sun_position/site/latitude is 91, but must be from -90 to 90 deg"),
                             ({"conditions": "{a: {hour: 4}, b: {hour: 12, cover: 9}}"}, "cover is 9, but must be from 0 to 8 oktas"),
                             ({"features": "{orb: {n_levels: 0}}"}, "parameter /evaluator/features/orb/n_levels is 0")):
            with tempfile.TemporaryDirectory() as folder:
                said = self.refused_plan(os.path.join(folder, "plan"), output=folder, **typed)
                self.assertEqual(os.listdir(folder), [])
                self.assertIn("sunlit: ", said)
                self.assertIn(words, said)

    def test_fewer_poses_than_the_folder_holds_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "frames.csv"), "w", encoding="utf-8") as frames:
                frames.write("pose,stamp,a,b,difference,value\n7,1000.7,h04,h12,orb,0.5\n")
            said = self.refused_plan(os.path.join(folder, "plan"), output=folder, poses="5")
            self.assertEqual(os.listdir(folder), ["frames.csv"])
            self.assertIn("1 of them are not among the 5 of this path", said)

    def test_beside_another_experiment_on_the_same_master_it_is_refused(self):
        """Both would be broken off."""
        with xmlrpc.server.SimpleXMLRPCServer(("localhost", 0), logRequests=False) as master, tempfile.TemporaryDirectory() as folder:
            uri = "http://localhost:%d" % master.server_address[1]
            master.register_function(lambda caller, name: [1, "", uri] if name == "/experiment" else [-1, "", ""], "lookupNode")
            master.register_function(lambda caller: [1, "", os.getpid()], "getPid")
            threading.Thread(target=master.serve_forever, daemon=True).start()
            with unittest.mock.patch.dict(os.environ, ROS_MASTER_URI=uri):
                said = self.refused_plan(os.path.join(folder, "plan"), output=os.path.join(folder, "output"))
                self.assertIn("sunlit: an experiment is running on %s, and would be broken off" % uri, said)
                self.assertEqual(os.listdir(folder), [])
                self.parameters()  # where nothing is started
            master.shutdown()

    def test_a_log_folder_that_cannot_be_written_to_is_told_in_a_line(self):
        with tempfile.TemporaryDirectory() as folder:
            open(os.path.join(folder, "log"), "w").close()
            said = self.refused_plan(os.path.join(folder, "log", "plan"), output=folder)
            self.assertRegex(said.splitlines()[-1], "^sunlit: .*/log/plan: .*; ROS_LOG_DIR must name a folder that can be written to$")

    def test_letters_that_nodes_would_take_for_others_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            localedef = subprocess.run(["localedef", "-i", "de_DE", "-f", "ISO-8859-1", os.path.join(folder, "de_DE")],
                                       stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
            if not os.path.exists(os.path.join(folder, "de_DE", "LC_CTYPE")):  # the folder is made in any case
                self.skipTest("no locale can be made here: " + localedef.stdout)
            results = os.path.join(folder, "\u00e4")
            with unittest.mock.patch.dict(os.environ, LOCPATH=folder, LC_ALL="de_DE"):
                for name, text in (("output", results), ("world", os.path.join(folder, "\u00e4.world")), ("world", "w\u00e4rld")):
                    said = self.refused_plan(os.path.join(folder, "plan"), **dict(dict(output=folder), **{name: text}))
                    self.assertIn("nodes would take its letters for others, since this locale (LC_ALL=de_DE) is not of UTF-8: "
                                  "set LC_ALL=C.UTF-8", said)
            with unittest.mock.patch.dict(os.environ, LC_ALL="C.UTF-8"):
                said = self.refused_plan(os.path.join(folder, "plan"), output=os.path.join(folder, "\udce4"))
                self.assertIn("nodes cannot be told its letters, which are not of UTF-8", said)
                self.assertEqual(os.listdir(folder), ["de_DE"])
                self.parameters("output:=" + results)

    def test_from_a_folder_that_was_deleted_whole_paths_are_needed_and_do(self):
        with tempfile.TemporaryDirectory() as folder:
            gone = ["sh", "-c", 'mkdir "$0" && cd "$0" && rmdir "$0" && exec "$@"', os.path.join(folder, "gone")]
            launch = [*gone, "roslaunch", "--dump-params", "sunlit", "experiment.launch"]
            found = yaml.safe_load(subprocess.check_output([*launch, "output:=" + folder]))
            self.assertEqual(found["/experiment/output"], folder)
            done = subprocess.run([*launch, "output:=results"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
            self.assertIn("sunlit: results: the current folder has been deleted: change to one that is there, or give a whole path, "
                          "which begins with /\n", done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    def test_a_tilde_is_the_home_folder(self):
        """bash leaves it as it is in NAME:=~/file."""
        with tempfile.TemporaryDirectory() as home:
            with open(os.path.join(home, "w.csv"), "w") as waypoints:
                waypoints.write("0,0,0\n3,0,0\n")
            open(os.path.join(home, "some.world"), "w").close()
            found = self.parameters("world:=~/some.world", "path:=~/w.csv", HOME=home)
            self.assertEqual(found["/evaluator/poses"], 3)
            self.assertEqual(found["/render/path/file"], os.path.join(home, "w.csv"))

    def test_worlds_and_paths_have_any_letters_and_are_found_as_the_renderer_finds_them(self):
        with tempfile.TemporaryDirectory() as folder:
            models, path = os.path.join(folder, "my 'models'"), os.path.join(folder, "it's.csv")
            os.makedirs(os.path.join(models, "place"))
            open(os.path.join(models, "place", "my.world"), "w").close()
            with open(path, "w") as waypoints:
                waypoints.write("0,0,0\n3,0,0\n")
            found = self.parameters("world:=model://place/my.world", "path:=" + path, 'model_path:=["%s"]' % models)
            self.assertEqual((found["/evaluator/poses"], found["/render/model_path"], found["/render/path/file"]), (3, [models], path))

    def test_only_what_was_typed_counts_as_given(self):
        given = {key for key in self.parameters("noise:=true") if key.startswith("/experiment/arguments/")}
        self.assertEqual(given, {"/experiment/arguments/noise", "/experiment/arguments/output"})

    def test_the_plan_lies_beside_the_logs(self):
        with tempfile.TemporaryDirectory() as folder:
            logs = os.path.join(folder, "it's with space")
            found = self.parameters(ROS_LOG_DIR=logs, HOME=None)
            self.assertEqual(os.path.dirname(found["/experiment/plan"]), logs)
            with open(found["/experiment/plan"]) as file:
                self.assertEqual(yaml.safe_load(file)["evaluator"]["poses"], found["/evaluator/poses"])
            for there, expected in ((dict(ROS_HOME=folder), os.path.join(folder, "log")),
                                    (dict(ROS_HOME=None, HOME=folder), os.path.join(folder, ".ros", "log")),
                                    (dict(ROS_HOME=None, TMPDIR=folder), folder)):
                found = self.parameters(**dict(dict(ROS_LOG_DIR=None, HOME=None), **there))
                self.assertEqual(os.path.dirname(found["/experiment/plan"]), expected)

    def test_with_standard_error_closed_it_is_planned_as_well(self):
        with tempfile.TemporaryDirectory() as folder:
            launch = ["roslaunch", "--dump-params", "sunlit", "experiment.launch", "output:=" + folder, "site:=[0, 100, 0]"]
            found = yaml.safe_load(subprocess.check_output(["sh", "-c", 'exec "$@" 2>&-', "sh", *launch]))  # there is a note
            self.assertEqual(found["/experiment/output"], folder)

    def slow_planning(self, folder, *parent):
        """What plans, in the midst of it, started by a command `parent`."""
        slow, begun = os.path.join(folder, "slow"), os.path.join(folder, "begun")
        os.mkfifo(begun)
        with open(slow, "w") as file:
            # It may be left alone where a signal comes at once; then it must not hold what is read here.
            file.write("#!/bin/sh\nexec 2> /dev/null\necho > '%s'\nexec sleep 60\n" % begun)
        os.chmod(slow, 0o755)
        planning = subprocess.Popen([*parent, *self.plan_command(os.path.join(folder, "plan"), slow, output=folder)],
                                    start_new_session=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
        with open(begun):
            return planning

    def test_interrupted_at_its_plan_it_ends_without_a_traceback(self):
        with tempfile.TemporaryDirectory() as folder:
            planning = self.slow_planning(folder)
            os.killpg(planning.pid, signal.SIGINT)  # as a terminal does
            self.assertEqual(planning.communicate(timeout=60), ("", ""))
            self.assertEqual(planning.returncode, 130)

    def test_what_plans_ends_with_the_roslaunch_that_asked_for_it(self):
        """It would mend bags beside the roslaunch that is started next."""
        with tempfile.TemporaryDirectory() as folder:
            launch = self.slow_planning(folder, "sh", "-c", '"$@"; :', "sh")
            launch.terminate()
            # Both pipes are closed once what plans has ended.
            self.assertEqual(launch.communicate(timeout=30), ("", ""))


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "experiment_arguments", ExperimentArguments)
