#!/usr/bin/python3
"""Every launch file starts, does its work and ends with status 0 at Ctrl-C; run from an install space by workspace.py."""
import os
import subprocess
import sys
import tempfile
import unittest

import rospkg
import rosunit
import shown
import yaml
from geometry_msgs.msg import Point, Pose, Quaternion
from launching import WAYPOINTS, WORLD, Launched, kill_leftovers
from sunlit.srv import RenderView


class LaunchFilesStart(unittest.TestCase):

    @classmethod
    def tearDownClass(cls):
        kill_leftovers()

    def check(self, launched, *topics, conditions=None):
        """Each topic gets a message, and what RViz shows of `conditions`, as typed, is there."""
        for topic in topics:
            launched.wait_for(lambda: topic in launched.topics(), "advertised " + topic)
            heard = launched.ros("rostopic", "echo", "-n", "1", "--noarr", topic)
            self.assertEqual(heard.returncode, 0, heard.stdout)
            self.assertIn("header", heard.stdout)
        if conditions is not None:
            wanted = shown.topics("sunlit.rviz", "conditions", conditions)
            self.assertIn("/camera/depth/camera_info", wanted)
            launched.wait_for(lambda: wanted <= launched.topics(), "had all of " + ", ".join(sorted(wanted)))
        self.finish(launched)

    def folder(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        return folder.name

    def finish(self, launched):
        self.assertEqual(launched.interrupt(), 0, launched.said())
        self.assertEqual(launched.left_running(), [])

    def test_none_is_left_out(self):
        """experiment.launch is started by experiment_runs.py, and from an install space by workspace.py."""
        tested = {name[len("test_"):] + ".launch" for name in dir(self) if name.startswith("test_")} | {"experiment.launch"}
        folder = os.path.join(rospkg.RosPack().get_path("sunlit"), "launch")
        launch_files = {name for name in os.listdir(folder) if name.endswith(".launch")}
        self.assertEqual(launch_files - tested, set())
        self.assertIn("render.launch", launch_files)

    def test_a_misspelt_argument_stops_each(self):
        for name in ("demo", "evaluator", "render", "sun_position"):
            needed = dict(output="results") if name == "evaluator" else {}
            launched = Launched(name + ".launch", rivz="true", **needed)
            self.assertEqual(launched.end(), 1, launched.said())
            self.assertIn("sunlit: argument rivz is 'true', but must be one of the arguments of " + name + ".launch",
                          launched.said())

    def test_all_parameters_belong_to_a_node_or_to_roslaunch(self):
        for name in ("demo", "evaluator", "render", "sun_position"):
            nodes = ("/sun_position/", "/render/", "/evaluator/")
            keys = self.parameters(name, *(["output:=" + self.folder()] if name == "evaluator" else []))
            self.assertTrue([key for key in keys if key.startswith(nodes)], name)
            # In the demo the renderer is the clock, and takes this back as it ends.
            clock = ["/use_sim_time"] if name == "demo" else []
            self.assertEqual([key for key in keys if not key.startswith(nodes + ("/roslaunch/", "/ros"))], clock, name)

    def parameters(self, name, *arguments):
        return yaml.safe_load(subprocess.check_output(["roslaunch", "--dump-params", "sunlit", name + ".launch", *arguments]))

    def test_quotes_and_apostrophes_reach_the_nodes(self):
        folder = self.folder()
        found = self.parameters("render", "world:=%s/it's.world" % folder, "path:=%s/a 'b'.csv" % folder,
                                """conditions:={a: {date: '2024-12-21'}, b: {overcast: "cie"}}""")
        self.assertEqual([found["/render/" + key] for key in ("world", "path/file", "conditions")],
                         [folder + "/it's.world", folder + "/a 'b'.csv", {"a": "", "b": {"overcast": "cie"}}])
        self.assertEqual(found["/sun_position/conditions"]["a"], {"year": 2024, "month": 12, "day": 21})
        self.assertEqual(self.parameters("evaluator", "output:=%s/it's" % folder)["/evaluator/output_dir"], folder + "/it's")

    def test_a_file_of_parameters_counts_but_for_what_is_typed(self):
        folder = self.folder()
        for name, node, tree, typed in (
                ("evaluator", "/evaluator/", dict(streams=["a", "b"], pairs=[["a", "b"]], differences=["orb"], verify=[], poses=7,
                                                  images="none", idle_timeout=2.5, exit_when_done=True),
                 dict(streams=["c", "d"], pairs=[["d", "c"]], differences=["sift"], verify=["sift"], poses=0, images="all",
                      idle_timeout=0.5, exit_when_done=False)),
                ("render", "/render/", dict(world="/mine.world", autostart=False, **{"path/file": "/mine.csv"}),
                 dict(world="/typed.world", autostart=True, **{"path/file": "/typed.csv"}))):
            config = os.path.join(folder, name + ".yaml")
            with open(config, "w") as file:
                yaml.safe_dump(tree, file)
            needed = ["config:=" + config] + (["output:=" + folder] if name == "evaluator" else [])
            found = self.parameters(name, *needed)
            self.assertEqual({key: found.get(node + key) for key in tree}, tree)
            words = ["%s:=%s" % (key.split("/")[0], yaml.safe_dump(value, default_flow_style=True).split("\n")[0])
                     for key, value in typed.items()]
            found = self.parameters(name, *needed, *words)
            self.assertEqual({key: found[node + key] for key in typed}, typed)

    def test_sun_position(self):
        self.check(Launched("sun_position.launch"), "/sun")

    def test_render(self):
        conditions = "{a: {hour: 9}, b: {hour: 12}}"
        self.check(Launched("render.launch", world=WORLD, path=WAYPOINTS, conditions=conditions), "/a/sun", "/b/sun", "/path",
                   conditions=conditions)

    def test_conditions_of_render_differ_in_weather_too(self):
        config = os.path.join(self.folder(), "small.yaml")
        with open(config, "w") as file:
            yaml.safe_dump(dict(world=WORLD, path=dict(file=WAYPOINTS), camera=dict(width=32, height=24), autostart=False,
                                transport=dict(enabled=False), exposure=dict(mode="fixed", ev100=14.0)), file)
        launched = Launched("render.launch", config=config,
                            conditions="{clear: {hour: 9}, grey: {hour: 9, cover: 8, overcast: cie}, usual: {}}")
        service = "/render/render_view"
        launched.wait_for(lambda: launched.has_service(service), "advertised " + service)
        grey, clear, usual = (self.view_of(launched, service, condition) for condition in ("grey", "clear", "usual"))
        self.assertLess(sum(grey), 0.7 * sum(clear))
        self.assertNotEqual(usual, clear)  # of noon, as the shipped file has it
        by_hand = launched.ros("rosservice", "call", service,
                               "{condition: clear, pose: {position: {z: 1.0}, orientation: {w: 1.0}}}")
        again = yaml.safe_load(by_hand.stdout)["image"]["data"]
        self.assertEqual(len(again), len(clear))
        self.assertLess(sum(abs(a - b) for a, b in zip(again, clear)), 0.1 * len(clear))  # the sun has gone on a little
        self.finish(launched)

    def view_of(self, launched, service, condition):
        pose = Pose(position=Point(z=1.0), orientation=Quaternion(w=1.0))
        replies = []

        def answered():
            replies.append(launched.call(service, RenderView, pose=pose, condition=condition))
            return replies[-1].success  # not until its sun has been heard
        launched.wait_for(answered, "rendered " + condition)
        return list(replies[-1].image.data)

    def test_render_with_a_robot(self):
        launched = Launched("render.launch", world=os.path.relpath(WORLD), path=os.path.relpath(WAYPOINTS), robot="rover")
        launched.wait_for(lambda: "Robot rover" in launched.said(), "loaded the robot")
        launched.wait_for(lambda: "All poses are rendered" in launched.said(), "rendered the path")
        self.finish(launched)

    def test_demo(self):
        # As typed in a terminal: nodes start in another folder.
        self.check(Launched("demo.launch", world=os.path.relpath(WORLD), path=os.path.relpath(WAYPOINTS)), "/sun", "/path",
                   conditions="")

    def test_evaluator(self):
        launched = Launched("evaluator.launch", streams="[a, b]", output=self.folder())
        launched.wait_for(lambda: "/evaluator/progress" in launched.topics(), "advertised its progress")
        self.assertIn("data: 0", launched.ros("rostopic", "echo", "-n", "1", "/evaluator/progress").stdout)
        self.finish(launched)


if __name__ == "__main__":
    # Each launch file has a master of its own, so this needs none.
    rosunit.unitrun("sunlit", "launch_files_start", LaunchFilesStart, sysargs=sys.argv)
