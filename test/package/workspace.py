#!/usr/bin/env python3
"""sunlit builds in a user's ordinary catkin workspace, and its launch files run from the install space.

The build at hand has shown that the sources compile. The workspace is configured, linked and installed anew, but takes
object files from that build where command and files are the same: see compile_once.py."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import rosunit

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "test" / "support"))
from ports import free_port  # noqa: E402

POSES = 2
WAYPOINTS = SOURCE / "test" / "support" / "worlds" / "straight.csv"
# Of models that come with the package, where SDF can be read. The built-in world needs no files, but minutes for its light as
# it is built here.
READS_SDF = os.environ.get("SUNLIT_SDFORMAT_VERSION", "0") != "0"
WITHOUT_SDF = SOURCE / "test" / "support" / "worlds" / "two_boxes.urdf"
WORLD = """<sdf version="1.6"><world name="yard">
  <include><uri>model://ground_plane</uri></include>
  <include><uri>model://sun</uri></include>
  <model name="box"><static>true</static><pose>6 1 0.5 0 0 0</pose>
    <link name="link"><visual name="visual"><geometry><box><size>1 1 1</size></box></geometry></visual></link>
  </model>
</world></sdf>
"""


class Workspace(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="sunlit_workspace_"))
        (cls.folder / "src").mkdir()
        (cls.folder / "src" / "sunlit").symlink_to(SOURCE)
        (cls.folder / "yard.world").write_text(WORLD)
        cls.environment = {key: value for key, value in os.environ.items()
                           if not key.startswith(("ROS_", "CMAKE_PREFIX_PATH", "LD_LIBRARY_PATH", "PYTHONPATH", "MAKE"))}
        cls.environment.update(ROS_HOSTNAME="localhost", ROS_HOME=str(cls.folder / "ros_home"))
        twins = {"devel": "SUNLIT_DEVEL_DIR", "build/sunlit": "SUNLIT_BUILD_DIR", "src/sunlit": "SUNLIT_SOURCE_DIR"}
        cls.environment["SUNLIT_SAME_FOLDERS"] = ":".join(f"{cls.folder}/{ours}={os.environ.get(theirs, '')}"
                                                          for ours, theirs in twins.items())

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder, ignore_errors=True)

    def run_in_workspace(self, command, setup=None):
        """Runs `command` through bash with the workspace's `setup` sourced; its output stands in the failure."""
        source = f". {self.folder}/{setup}/setup.bash && " if setup else ""
        done = subprocess.run(["bash", "-c", f"cd {self.folder} && {source}{command}"], env=self.environment,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout[-4000:]}")
        return done.stdout

    def experiment(self):
        """The two hours are noon against itself an hour later: enough to see that all parts run together,
        and that our models, the rover and its meshes are found."""
        port = free_port()
        self.environment["ROS_MASTER_URI"] = f"http://localhost:{port}"
        output = self.folder / "output"
        self.run_in_workspace(f"roslaunch -p {port} sunlit experiment.launch path:={WAYPOINTS} "
                              f"world:={'yard.world' if READS_SDF else WITHOUT_SDF} "
                              f"poses:={POSES} hours:='[12, 13]' differences:='[boolean_rgb, orb]' robot:=rover "
                              f"output:={output}", "install")
        self.assertIn("h12,h13,boolean_rgb", (output / "summary.csv").read_text())
        self.assertTrue((output / "report.html").exists())
        self.run_in_workspace("rosrun sunlit report --help", "install")
        # By a library that is loaded when there is a picture to be written.
        self.run_in_workspace(f"rosrun sunlit snapshot --world {WITHOUT_SDF} --bounced off --size 64x48 --out it.png", "install")
        self.assertTrue((self.folder / "it.png").exists())

    def test_builds_installs_and_runs(self):
        self.run_in_workspace(f"catkin_make install -j{len(os.sched_getaffinity(0))} -DPYTHON_EXECUTABLE=/usr/bin/python3 "
                              "-DCATKIN_ENABLE_TESTING=OFF "
                              f"-DCMAKE_DISABLE_PRECOMPILE_HEADERS={os.environ.get('SUNLIT_NOT_PRECOMPILED') or 'OFF'} "
                              f"-DSUNLIT_UNITY={os.environ.get('SUNLIT_UNITY') or 'OFF'} "
                              f"-DCMAKE_CXX_COMPILER_LAUNCHER={SOURCE}/test/package/compile_once.py")
        self.run_in_workspace("rosrun sunlit report --help", "devel")  # of all else tests start the like of it
        shutil.move(str(self.folder / "src"), str(self.folder / "src_gone"))  # the install space stands alone
        shutil.rmtree(self.folder / "devel")
        shutil.rmtree(self.folder / "build")
        self.experiment()
        # Their results stand beside ours, each by itself.
        result = "".join(word.replace("package_workspace", "launch_files_start") for word in sys.argv if word.startswith("--gtest_output="))
        self.run_in_workspace(f"/usr/bin/python3 {SOURCE}/test/ros/experiment/launch_files_start.py {result or '--text'}", "install")


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "package_workspace", Workspace, sysargs=sys.argv)
