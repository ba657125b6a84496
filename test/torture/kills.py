"""Kills of an experiment: when, of whom, and what has to be true afterwards."""
import dataclasses
import os
import shutil
import time

from trial import Trial, content, kill, left_running, processes

EVERYTHING = "everything"
TARGETS = (EVERYTHING, "roslaunch", "master", "rosout", "experiment", "guard", "sun_position", "render", "self_test",
           "evaluator", "recorder", "report", "plan")


@dataclasses.dataclass
class Moment:
    """A stage of an experiment, and how long after its begin a kill may come, s."""
    stage: str
    longest_s: float
    looks_every_s: float = 0.01


# In the order in which an experiment comes by.
MOMENTS = (Moment("planning", 1.2), Moment("loading", 0.5), Moment("baking", 2.5), Moment("caching", 0.012, 0.0005),
           Moment("rendering", 0.05), Moment("localising", 0.4), Moment("reporting", 1.5))


@dataclasses.dataclass
class Kill:
    """One of them, and what came of it."""
    stage: str
    target: str = "nobody"
    status: int = 0
    seconds: float = 0.0
    result: str = ""

    def is_hole(self):
        return self.result.startswith("HOLE")


class Stages:
    """Whether an experiment has come to a stage, by what it leaves on the disk."""

    def __init__(self, trial, run, rows):
        """`rows`: of frames.csv, from which on it counts as rendering."""
        self.trial, self.run, self.rows = trial, run, rows

    def is_at(self, stage):
        return {"planning": lambda: True,
                "loading": lambda: "render" in processes(self.run),
                "baking": lambda: self.trial.cached(".light.lock"),
                "caching": lambda: self.trial.cached(".part"),
                "rendering": lambda: self.trial.rows() >= self.rows,
                "localising": lambda: self.trial.rows() >= self.trial.rows_when_evaluated(),
                "reporting": lambda: "experiment: reporting" in self.run.said()}[stage]()

    def await_moment(self, moment, delay_s):
        """False where the experiment ended before."""
        while not self.is_at(moment.stage):
            if self.run.process.poll() is not None:
                return False
            time.sleep(moment.looks_every_s)
        time.sleep(delay_s)
        return True


class Killer:
    """Does it again and again to one trial, by a generator with a seed."""

    def __init__(self, generator, trial, reference, wanted=TARGETS):
        """`wanted`: who is to be killed: each time the first that lives, of these in a new order."""
        self.generator, self.trial, self.reference, self.wanted = generator, trial, reference, wanted
        self.is_done = False

    def _victim(self, alive):
        """The first of a shuffled list that lives, and its processes."""
        for name in self.generator.sample(self.wanted, len(self.wanted)):
            if name in alive:
                return name, alive[name]
        return EVERYTHING, [pid for pids in alive.values() for pid in pids]

    def _pick(self, run, alive):
        target, pids = self._victim(alive)
        return target, [pid for pid, _ in run.running()] if target == EVERYTHING else pids

    def kill_once(self, moment):
        """Starts the experiment and kills at that moment."""
        if self.is_done:  # what was killed last did not matter: once more from the beginning
            self.trial.forget()
            self.is_done = False
        if moment.stage in ("baking", "caching"):  # else there is none where a kill came after the bake
            self.trial.forget_bake()
        delay_s = self.generator.uniform(0.0, moment.longest_s)
        done = Kill(moment.stage)
        first = self.trial.rows()
        rows = first + self.generator.randint(1, max(1, self.trial.rows_when_evaluated() - first))
        run = self.trial.start()
        stages = Stages(self.trial, run, rows)
        if moment.stage == "caching":  # over in a few ms: who lives is looked up before
            stages.await_moment(Moment("baking", 0.0), 0.0)
            alive = dict(processes(run))
            alive[EVERYTHING] = [pid for pid, _ in run.running()]
            target, pids = self._victim(alive)
            reached = stages.await_moment(moment, delay_s)
        else:
            reached = stages.await_moment(moment, delay_s)
            target, pids = self._pick(run, dict(processes(run), **{EVERYTHING: []}))
        began = time.monotonic()
        if reached and run.process.poll() is None:
            kill(pids)
            if target == EVERYTHING:
                run.kill()  # whom roslaunch had just started, too
            done.target = target
        self._judge(run, done)
        done.seconds = time.monotonic() - began
        return done

    def _judge(self, run, done):
        """What has to be true of an experiment that lost something: that it ends, with a reason or with all results."""
        try:
            done.status = run.end()
        except AssertionError:
            done.result = "HOLE: never ended"
            return
        left = left_running(run)
        said = run.said()
        has_reason = "experiment: FAILED: " in said or "sunlit: " in said
        if left:
            done.result = "HOLE: left running: " + "; ".join(left)
        elif done.status == 0:
            self.is_done = True
            odd = self.trial.differs_from(self.reference)
            done.result = "HOLE: status 0, but not as undisturbed: " + ", ".join(odd) if odd else "all done"
        elif has_reason:
            done.result = "broke off with a reason"
        elif done.target in (EVERYTHING, "roslaunch", "plan"):
            done.result = "gone at once"
        else:
            done.result = "HOLE: no reason told"
        if done.is_hole():
            done.result += "\n" + said

    def complete(self):
        """Starts it until it completes, which the first start does. What is wrong, or nothing."""
        run = self.trial.start()
        try:
            status = run.end()
        except AssertionError as error:
            return str(error)
        faults = [] if status == 0 else ["status %d\n%s" % (status, run.said())]
        faults += ["left running: " + command for command in left_running(run)]
        faults += ["not as undisturbed: " + name for name in self.trial.differs_from(self.reference)]
        faults += ["left in the cache: " + name for name in self.trial.leftovers()]
        return "; ".join(faults)


def undisturbed(folder, **changes):
    """The trial that others are compared with."""
    trial = Trial(folder, **changes)
    run = trial.start()
    status = run.end()
    if status != 0 or left_running(run):
        raise AssertionError("even undisturbed it fails:\n" + run.said())
    if content(os.path.join(trial.output, "summary.csv")) is None:
        raise AssertionError("there is no summary.csv in " + trial.output)
    return trial


def sequence(generator, kills):
    """So many moments, in the order in which an experiment comes by; each stage in turn, so that all are hit."""
    offset = generator.randrange(len(MOMENTS))
    chosen = [(offset + i * 2) % len(MOMENTS) for i in range(kills)]
    return [MOMENTS[i] for i in sorted(chosen)]


def round_of_kills(folder, killer_of, kills):
    """The kills, and what is wrong at the end of all, or nothing. `killer_of`: makes the killer of a trial in a folder."""
    shutil.rmtree(folder, ignore_errors=True)
    killer = killer_of(folder)
    done = [killer.kill_once(moment) for moment in sequence(killer.generator, kills)]
    return done, killer.complete()
