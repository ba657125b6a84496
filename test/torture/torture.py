#!/usr/bin/python3
"""Kills an experiment at random moments until it had enough, and says what came of it."""
import argparse
import collections
import os
import random
import signal
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import kills  # noqa: E402  pylint: disable=wrong-import-position
from launching import kill_leftovers  # noqa: E402  pylint: disable=wrong-import-position,wrong-import-order

KILLS_A_ROUND = 4


def table(done):
    """How often what was killed when, and what came of it."""
    counts = collections.Counter((kill.stage, kill.target, kill.result.split("\n")[0]) for kill in done)
    lines = ["%-11s %-13s %5s  %s" % ("stage", "killed", "times", "what came of it")]
    order = [moment.stage for moment in kills.MOMENTS]
    for (stage, target, result), count in sorted(counts.items(), key=lambda item: (order.index(item[0][0]), item[0])):
        lines.append("%-11s %-13s %5d  %s" % (stage, target, count, result))
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=40, metavar="N", help="how many (default: 40; about 8 s each)")
    parser.add_argument("--seed", type=int, default=1, help="of the generator that says when and whom (default: 1)")
    parser.add_argument("--keep", metavar="DIR", help="a folder in which everything stays, to be looked at")
    asked = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("torture: interrupted"))  # whatever it started ends with it
    generator = random.Random(asked.seed)
    done, faults = [], []
    with tempfile.TemporaryDirectory() as temporary:
        folder = asked.keep or temporary
        try:
            reference = kills.undisturbed(os.path.join(folder, "undisturbed"))
            for number in range(-(-asked.kills // KILLS_A_ROUND)):
                count = min(KILLS_A_ROUND, asked.kills - len(done))
                changes = dict(record="true") if number % 3 == 2 else {}
                now, fault = kills.round_of_kills(os.path.join(folder, "round_%d" % number if asked.keep else "round"),
                                                  generator, count, reference, **changes)
                done += now
                for kill in now:
                    print("%s %3d %-11s %-13s %5d %6.1f s  %s" % (time.strftime("%H:%M:%S"), number, kill.stage, kill.target,
                                                                 kill.status, kill.seconds, kill.result), flush=True)
                print("%12d then %s" % (number, fault or "completed, as undisturbed"), flush=True)
                if fault:
                    faults.append("round %d: %s" % (number, fault))
        finally:
            kill_leftovers()
    holes = [kill for kill in done if kill.is_hole()]
    print("\n%s\n\n%d kills, %d of them with something wrong; %d of %d experiments did not complete as undisturbed" % (
        table(done), len(done), len(holes), len(faults), -(-asked.kills // KILLS_A_ROUND)))
    for fault in faults:
        print(fault)
    return 1 if holes or faults else 0


if __name__ == "__main__":
    sys.exit(main())
