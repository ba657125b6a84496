"""One experiment in a folder of its own, started as often as it takes, and compared with one that nobody disturbed."""
import contextlib
import os
import shutil
import signal
import sys
import time

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "ros", "experiment"))
# pylint: disable-next=wrong-import-position,unused-import
from launching import WAYPOINTS, WORLD, Launched, kill_leftovers  # noqa: E402,F401

POSES = 60
PATIENCE_S = 120.0
ARGUMENTS = dict(world=WORLD, path=WAYPOINTS, spacing=0.16, poses=POSES, hours="[10, 12]", width=160, height=120,
                 differences="[boolean_rgb, euclidean_grey, orb]", self_test_every=10, report="true")
# What depends on nothing but the arguments.
RESULTS = ("summary.csv", "frames.csv", "verified.csv", "verified_summary.csv", "lost_features.csv", "comparisons.csv",
           "localisation.csv", "localisation_poses.csv", "localisation_summary.csv", "captures.csv", "path.csv",
           "problems.csv", "inputs.yaml", "rasterizer.yaml", "ground.yaml", "map.png", "map.yaml")
# What a finished experiment has; bags are called by the time when they begin.
CACHED = (".light", ".features", ".air")
# Part of a command line -> who that is. The first that fits counts.
PARTS = (("sunlit_experiment.guard", "guard"), ("experiment_node", "experiment"), ("sun_position_node", "sun_position"),
         ("__name:=recorder", "recorder"), ("scripts/report", "report"), ("evaluator_node", "evaluator"),
         ("rosmaster", "master"), ("rosout", "rosout"), ("experiment_parameters", "plan"), ("count_poses", "plan"), ("check_parameters", "plan"),
         ("render_node", "render"), ("roslaunch", "roslaunch"))


def name_of(command):
    """Of a process, by its command line; None for a shell or what else helps for a moment."""
    if "render_node" in command and "self_test" in command:
        return "self_test"
    return next((name for part, name in PARTS if part in command), None)


def content(path):
    with contextlib.suppress(OSError), open(path, "rb") as file:
        return file.read()
    return None


def files_below(folder):
    return sorted(os.path.relpath(os.path.join(parent, name), folder)
                  for parent, _, names in os.walk(folder) for name in names)


def is_bag(name):
    return name.startswith("recording_") and name.endswith(".bag")


class Trial:
    """An output folder, a cold cache, and the experiment that uses both."""

    def __init__(self, folder, cache=None, output=None, **changes):
        self.output = output or os.path.join(folder, "output")
        self.cache = cache or os.path.join(folder, "cache")
        os.makedirs(self.cache, exist_ok=True)
        self.arguments = dict(ARGUMENTS, output=self.output, **changes)
        self.surroundings = {"SUNLIT_CACHE_DIR": self.cache}

    def forget(self):
        """All that it has made."""
        shutil.rmtree(self.output, ignore_errors=True)
        shutil.rmtree(self.cache, ignore_errors=True)
        os.makedirs(self.cache)

    def forget_bake(self):
        for name in self.cached(".light"):
            os.remove(os.path.join(self.cache, name))

    def start(self, **surroundings):
        return Launched("experiment.launch", dict(self.surroundings, **surroundings), **self.arguments)

    def rows(self):
        """Whole lines of frames.csv."""
        return (content(os.path.join(self.output, "frames.csv")) or b"").count(b"\n")

    def rows_when_evaluated(self):
        poses = self.arguments["poses"]
        pairs = poses + 2 * -(-poses // self.arguments["self_test_every"])
        return 1 + pairs * self.arguments["differences"].count(",") + pairs

    def cached(self, ending):
        with contextlib.suppress(OSError):
            return [name for name in os.listdir(self.cache) if name.endswith(ending)]
        return []

    def differs_from(self, reference):
        """Names of results that are not, byte for byte, those of another trial, and of files that only one of them has."""
        odd = [name for name in RESULTS
               if content(os.path.join(self.output, name)) != content(os.path.join(reference.output, name))]
        here, there = ({name for name in files_below(trial.output) if not is_bag(name) and name != "recording.csv"}
                       for trial in (self, reference))
        return odd + sorted(here ^ there)

    def leftovers(self):
        """Files of the cache that are no result."""
        return [name for name in files_below(self.cache) if not name.endswith(CACHED)]


def processes(run):
    """Name -> process ids of all that is alive of a launch."""
    found = {}
    for pid, command in run.running():
        name = name_of(command)
        if name:
            found.setdefault(name, []).append(pid)
    return found


def kill(pids):
    for pid in pids:
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)


def left_running(run, patience_s=PATIENCE_S):
    """Command lines of what does not end in the wake of its roslaunch."""
    deadline = time.monotonic() + patience_s
    while run.running() and time.monotonic() < deadline:
        time.sleep(0.05)
    left = run.running()
    run.kill()
    return [command for _, command in left]
