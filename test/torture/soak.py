#!/usr/bin/python3
"""A camera drives lap after lap under a moving sun, one picture after the other asked of the renderer through ROS; its memory,
threads, open files and time a picture go to a CSV, and at the end it is said whether they stayed flat.
"""
import argparse
import csv
import os
import signal
import statistics
import subprocess
import sys
import time

import rospy
from nav_msgs.msg import Path
from sunlit.srv import RenderView

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "support"))
from ports import free_port  # noqa: E402

COLUMNS = ("seconds", "picture", "lap", "picture_s", "rss_mb", "threads", "files", "sun_files", "sun_rss_mb", "master_rss_mb")
WARM_UP = 0.2          # of the time
GROWTH_MB = 20.0       # of memory between the halves after it: what allocators do anyway
GROWTH_SHARE = 0.03
STARTING_S = 600.0     # a bake may be among it
MASTER_S = 60.0
MEGABYTE = 1024.0 ** 2


def usage(pid):
    """Resident memory (MB), threads and open files of a process."""
    with open("/proc/%d/status" % pid) as status:
        lines = dict(line.split(":", 1) for line in status)
    return int(lines["VmRSS"].split()[0]) * 1024 / MEGABYTE, int(lines["Threads"]), len(os.listdir("/proc/%d/fd" % pid))


class Nodes:
    """A master, a sun that moves and a renderer that waits to be asked, until the end of the block."""

    def __init__(self, asked):
        self.asked = asked
        self.processes = []

    def _start(self, *command):
        self.processes.append(subprocess.Popen(command, start_new_session=True, stdout=self.log, stderr=subprocess.STDOUT))
        return self.processes[-1].pid

    def __enter__(self):
        port = free_port()
        os.environ["ROS_MASTER_URI"] = "http://localhost:%d" % port
        self.log = open(self.asked.csv + ".log", "w")
        try:
            self._start_all(port)
        except BaseException:
            self.__exit__()
            raise
        return self

    def _await_master(self):
        deadline = time.monotonic() + MASTER_S
        while True:
            try:
                rospy.get_master().getPid()
                return
            except OSError:
                if self.processes[0].poll() is not None or time.monotonic() > deadline:
                    raise SystemExit("soak: there is no master; the reason stands in %s.log" % self.asked.csv) from None
                time.sleep(0.1)

    def _start_all(self, port):
        self.master = self._start("rosmaster", "--core", "-p", str(port))
        self._await_master()
        rospy.set_param("/sun_position", {"date_time": {"year": 2024, "month": 7, "day": 1, "hour": 3, "minute": 0, "second": 0.0,
                                                        "timezone": 3.0, "rate": self.asked.rate}})
        # A given start, so that the path is known before it.
        rospy.set_param("/render", {"world": self.asked.world, "path": {"file": self.asked.path}, "start_stamp": 1.0,
                                    "autostart": False, "camera": {"width": self.asked.width, "height": self.asked.width * 3 // 4}})
        self.sun = self._start("rosrun", "sunlit", "sun_position_node", "__name:=sun_position")
        self.render = self._start("rosrun", "sunlit", "render_node", "__name:=render")

    def __exit__(self, *_):
        for number in (signal.SIGINT, signal.SIGKILL):
            for process in reversed(self.processes):
                if process.poll() is None:
                    os.killpg(process.pid, number)
                    try:
                        process.wait(15.0)
                    except subprocess.TimeoutExpired:
                        continue
        self.log.close()


def measure(asked, nodes):
    """A row a picture."""
    rospy.init_node("soak", disable_signals=True)
    view = rospy.ServiceProxy("/render/render_view", RenderView)
    rospy.wait_for_service("/render/render_view", STARTING_S)
    path = rospy.wait_for_message("/path", Path, STARTING_S).poses[::asked.every]
    rows, began = [], time.monotonic()
    with open(asked.csv, "w", buffering=1, newline="") as file:
        writer = csv.writer(file)
        writer.writerow(COLUMNS)
        while time.monotonic() - began < 60.0 * asked.minutes:
            lap, place = divmod(len(rows), len(path))
            start = time.monotonic()
            answer = view(pose=path[place].pose)
            if not answer.success:
                raise SystemExit("soak: picture %d: %s" % (len(rows), answer.message))
            now = time.monotonic()
            rss, threads, files = usage(nodes.render)
            sun_rss, _, sun_files = usage(nodes.sun)
            rows.append((now - began, len(rows), lap, now - start, rss, threads, files, sun_files, sun_rss, usage(nodes.master)[0]))
            writer.writerow(["%.3f" % value if isinstance(value, float) else value for value in rows[-1]])
    return rows


def judged(rows):
    """Lines, and whether all is flat."""
    warm = [row for row in rows if row[0] >= WARM_UP * rows[-1][0]]
    half = len(warm) // 2
    is_flat, lines = True, ["%-14s %10s %10s %10s" % ("after warm-up", "1st half", "2nd half", "largest")]
    for index in range(3, len(COLUMNS)):
        values = [row[index] for row in warm]
        first, second = statistics.median(values[:half]), statistics.median(values[half:])
        lines.append("%-14s %10.3f %10.3f %10.3f" % (COLUMNS[index], first, second, max(values)))
        allowed = max(GROWTH_MB, GROWTH_SHARE * first) if "rss" in COLUMNS[index] else 1.0
        if index > 3:  # the time depends on what else the machine does, and is only told
            is_flat = is_flat and second - first <= allowed
    return lines, is_flat


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    parser.add_argument("minutes", nargs="?", type=float, default=20.0)
    parser.add_argument("--csv", default="soak.csv", help="where the rows go; what the nodes say goes beside it")
    parser.add_argument("--world", default="race_track", help="as render_node's")
    parser.add_argument("--path", default="", help="waypoints; empty: those of race_track")
    parser.add_argument("--every", type=int, default=25, help="only each n-th pose of the path, so that there are several laps")
    parser.add_argument("--width", type=int, default=320, help="px")
    parser.add_argument("--rate", type=float, default=144.0, help="seconds of sun time a second: a day in ten minutes")
    asked = parser.parse_args()
    asked.csv = os.path.abspath(asked.csv)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("soak: interrupted"))
    with Nodes(asked) as nodes:
        rows = measure(asked, nodes)
    if len(rows) < 20:
        sys.exit("soak: only %d pictures: give it more minutes" % len(rows))
    lines, is_flat = judged(rows)
    print("\n".join(lines))
    print("%s: %d pictures, %.1f laps in %.0f s; rows in %s" % ("flat" if is_flat else "NOT FLAT", len(rows), rows[-1][2] + 1,
                                                              rows[-1][0], asked.csv))
    return 0 if is_flat else 1


if __name__ == "__main__":
    sys.exit(main())
