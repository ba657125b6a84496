"""How far a run is and how fast it goes, and the one line that says so."""

import collections
import dataclasses
import math
from typing import Optional

WINDOW_S = 60.0    # the pace is that of so long ago
BASIS_POSES = 3    # no pace is told before so many poses
BASIS_S = 2.0      # and so long a time
SILENCE_S = 20.0   # a time left that was told longer ago is none
BAR_CELLS = 30
SMALLEST_BAR = 10


class Pace:
    """Poses a second, from the first pose that this run has done on: what came before it, loading a world, say, is no
    measure, and what an earlier run has done is none either."""

    def __init__(self):
        self.begin = None                 # how many were done when it began
        self.times = collections.deque()  # (s, how many were done by then)

    def update(self, now, done):
        if self.begin is None:
            self.begin = done
        if done > (self.times[-1][1] if self.times else self.begin):
            self.times.append((now, done))
        while len(self.times) > 2 and now - self.times[1][0] > WINDOW_S:
            self.times.popleft()

    def poses_a_second(self, now):
        """NaN as long as there is no basis. A pose that takes longer than the others counts as it passes, so that a run
        that stalls does not look fast."""
        if not self.times:
            return math.nan
        (begin, before), (end, done) = self.times[0], self.times[-1]
        if done - before < BASIS_POSES or now - begin < BASIS_S:
            return math.nan
        usual = (end - begin) / (done - before)
        return (done - before) / max(end - begin, now - begin - usual)


@dataclasses.dataclass
class Status:
    """What a run is at now."""
    doing: str = "starting"
    share: float = math.nan           # of what it is doing, 0 to 1; NaN: unknown
    seconds_left: float = math.nan    # of what it is doing
    silent_s: float = 0.0             # since share and time left were told
    done: Optional[int] = None        # poses; None: not told yet, since an earlier run may have done some
    total: int = 0
    images_a_pose: int = 1
    poses_a_second: float = math.nan

    def turn_to(self, doing, share=math.nan, seconds_left=math.nan, silent_s=0.0):
        self.doing, self.share, self.seconds_left, self.silent_s = doing, share, seconds_left, silent_s

    def follow(self, activity, has_left, silent_s=0.0):
        """What the renderer says that it is at (sunlit/Activity; None: nothing yet), whether it has left, and how long
        ago it said so."""
        if has_left or (activity and activity.doing == "done"):
            self.turn_to("evaluating")
        elif activity and activity.doing in ("loading", "baking"):
            self.turn_to(activity.doing, activity.share, activity.seconds_left, silent_s)
        elif self.done or (activity and activity.doing == "rendering"):
            self.turn_to("rendering")  # it waits for the evaluator again and again, in the midst of its work
        elif activity:
            self.turn_to(activity.doing)


def duration(seconds):
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"


def _parts(status):
    """(activity, speed, time left); the latter two may be empty."""
    activity = status.doing + ("" if math.isnan(status.share) else f" {math.floor(100 * status.share)} %")
    if status.silent_s > SILENCE_S and not math.isnan(status.share):
        activity += f", no news for {duration(status.silent_s)}"
    elif not math.isnan(status.seconds_left):
        activity += f", {duration(status.seconds_left)} left"
    speed = left = ""
    if status.poses_a_second > 0 and status.done < status.total:  # so not where it is NaN
        speed = f"{status.poses_a_second * status.images_a_pose:.1f} images/s"
        left = f"{duration((status.total - status.done) / status.poses_a_second)} left"
    return activity, speed, left


def line(status):
    """For a log: all of it, without a bar."""
    activity, speed, left = _parts(status)
    done = status.done or 0
    percent = 100 * done // status.total if status.total else 0
    poses = f"{done} of {status.total} poses ({percent} %)"
    return ", ".join(part for part in (f"{activity}: {poses}", speed, left) if part)


def bar(done, total, cells):
    full = cells * done // total if total else 0
    return "[" + "#" * full + "-" * (cells - full) + "]"


def fitted(status, columns):
    """For a terminal: what fits into `columns`. A narrow one does without the bar first, then without the speed."""
    activity, speed, left = _parts(status)
    done = status.done or 0
    poses = f"{done}/{status.total} poses"
    for parts in ((poses, speed, left, activity), (poses, left, activity), (poses, activity)):
        text = "  ".join(part for part in parts if part)
        cells = min(BAR_CELLS, columns - len(text) - 4)  # two brackets, two blanks
        if cells >= SMALLEST_BAR:
            return bar(done, status.total, cells) + "  " + text
        if len(text) <= columns:
            return text
    return f"{done}/{status.total}  {activity}"[:max(columns, 0)]
