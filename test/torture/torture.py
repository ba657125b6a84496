#!/usr/bin/python3
"""Kills an experiment at random moments until it had enough, and says what came of it; or does to it what else machines do."""
import argparse
import collections
import os
import random
import signal
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import faults as machine  # noqa: E402  pylint: disable=wrong-import-position
import kills  # noqa: E402  pylint: disable=wrong-import-position
from trial import Trial, kill_leftovers  # noqa: E402  pylint: disable=wrong-import-position

KILLS_A_ROUND = 4


def table(done):
    """How often what was killed when, and what came of it."""
    counts = collections.Counter((kill.stage, kill.target, kill.result.split("\n")[0]) for kill in done)
    lines = ["%-11s %-13s %5s  %s" % ("stage", "killed", "times", "what came of it")]
    order = [moment.stage for moment in kills.MOMENTS]
    for (stage, target, result), count in sorted(counts.items(), key=lambda item: (order.index(item[0][0]), item[0])):
        lines.append("%-11s %-13s %5d  %s" % (stage, target, count, result))
    return "\n".join(lines)


def say(*words):
    print(time.strftime("%H:%M:%S"), *words, flush=True)


def torture(folder, reference, asked):
    """All the kills; whether nothing was wrong."""
    generator = random.Random(asked.seed)
    done, broken = [], []
    rounds = -(-asked.kills // KILLS_A_ROUND)
    for number in range(rounds):
        count = min(KILLS_A_ROUND, asked.kills - len(done))
        changes = dict(record="true") if number % 3 == 2 else {}
        now, fault = kills.round_of_kills(
            os.path.join(folder, "round_%d" % number if asked.keep else "round"),
            lambda place, more=changes: kills.Killer(generator, Trial(place, **more), reference, asked.whom), count)
        done += now
        for kill in now:
            say("%3d %-11s %-13s %5d %6.1f s  %s" % (number, kill.stage, kill.target, kill.status, kill.seconds, kill.result))
        say("%3d then %s" % (number, fault or "completed, as undisturbed"))
        if fault:
            broken.append("round %d: %s" % (number, fault))
    holes = [kill for kill in done if kill.is_hole()]
    if done:
        print("\n%s\n\n%d kills, %d of them with something wrong; %d of %d experiments did not complete as undisturbed" % (
            table(done), len(done), len(holes), len(broken), rounds), *broken, sep="\n")
    return not holes and not broken


def suffer(folder, reference, names):
    """What else machines do; whether nothing was wrong."""
    is_well = True
    for name in names:
        for what, result in machine.ALL[name](os.path.join(folder, name), reference):
            say("%-30s %s" % (what, result))
            is_well = is_well and not result.startswith("HOLE")
    return is_well


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, metavar="N", help="how many (default: 40, none with --faults; about 8 s each)")
    parser.add_argument("--whom", type=lambda text: text.split(","), default=kills.TARGETS, metavar="LIST",
                        help="who is killed, some of " + ",".join(kills.TARGETS))
    parser.add_argument("--seed", type=int, default=1, help="of the generator that says when and whom (default: 1)")
    parser.add_argument("--faults", metavar="LIST", default="", help="what else, some of %s, or all" % ",".join(machine.ALL))
    parser.add_argument("--keep", metavar="DIR", help="a folder in which everything stays, to be looked at")
    asked = parser.parse_args()
    names = list(machine.ALL) if asked.faults == "all" else [name for name in asked.faults.split(",") if name]
    unknown = [name for name in names if name not in machine.ALL]
    if unknown:
        parser.error("there is no fault %s, only %s and all" % (unknown[0], ", ".join(machine.ALL)))
    if not set(asked.whom) <= set(kills.TARGETS):
        parser.error("--whom is %s, but must be some of %s" % (",".join(asked.whom), ",".join(kills.TARGETS)))
    if asked.kills is None:
        asked.kills = 0 if names else 40
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("torture: interrupted"))  # whatever it started ends with it
    with tempfile.TemporaryDirectory() as temporary:
        folder = asked.keep or temporary
        try:
            reference = kills.undisturbed(os.path.join(folder, "undisturbed"))
            is_well = torture(folder, reference, asked)
            is_well = suffer(folder, reference, names) and is_well
        finally:
            kill_leftovers()
    return 0 if is_well else 1


if __name__ == "__main__":
    sys.exit(main())
