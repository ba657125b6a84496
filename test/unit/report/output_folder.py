"""Output folders made up for the tests: frames with a known mean and spread, and the files beside them."""

import math
import os

from PIL import Image

DIFFERENCES = ["boolean_rgb", "boolean_grey", "euclidean_rgb", "euclidean_grey", "sift", "surf", "orb", "brisk"]
FEATURES = DIFFERENCES[4:]
HOURS = ["h04", "h12", "h20"]
PAIRS = [("h04", "h12"), ("h04", "h20"), ("h12", "h20")]
SELF_PAIRS = [(hour, f"self_test/{hour}") for hour in HOURS]
POSES = 40

# (E, s) of the three pairs for which all of the paper's findings hold.
HOLDING = {
    "boolean_rgb": ((0.70, 0.06), (0.69, 0.07), (0.701, 0.06)),
    "boolean_grey": ((0.70, 0.06), (0.66, 0.10), (0.702, 0.06)),
    "euclidean_rgb": ((0.064, 0.009), (0.003, 0.002), (0.071, 0.010)),
    "euclidean_grey": ((0.063, 0.009), (0.003, 0.002), (0.070, 0.010)),
    "sift": ((0.84, 0.05), (0.63, 0.14), (0.83, 0.05)),
    "surf": ((0.94, 0.02), (0.75, 0.11), (0.93, 0.02)),
    "brisk": ((0.95, 0.02), (0.80, 0.10), (0.96, 0.02)),
    "orb": ((0.97, 0.01), (0.85, 0.10), (0.97, 0.02)),
}

FRAMES_HEADER = ("pose,stamp,a,b,difference,value,features_a,features_b,matches,zero_second,symmetric,one_to_one,"
                 "matches_back,matches_one_to_one")


def alternating(mean, sd, count=POSES):
    """Values of exactly this mean and sample standard deviation: half above it, half below."""
    step = sd * math.sqrt((count - 1) / count)
    return [mean + step if k % 2 else mean - step for k in range(count)]


def frame(pose, a, b, difference, value, twins=0, matches=50):
    """The symmetric and one-to-one forms lie 0.01 and 0.02 above the value."""
    counts = (500, 400, matches) if difference in FEATURES else (0, 0, 0)
    forms = [repr(value + 0.01), repr(value + 0.02), 45, 40] if difference in FEATURES else [repr(value), repr(value), 0, 0]
    fields = [pose, f"{pose / 10:.9f}", a, b, difference, repr(value), *counts, twins, *forms]
    return ",".join(str(field) for field in fields)


def frames(statistics=None, differences=None, pairs=None):
    """Lines of frames.csv."""
    statistics = statistics or HOLDING
    lines = [FRAMES_HEADER]
    for difference in differences or DIFFERENCES:
        for index, (a, b) in enumerate(PAIRS):
            if pairs is None or (a, b) in pairs:
                lines += [frame(pose, a, b, difference, value)
                          for pose, value in enumerate(alternating(*statistics[difference][index]))]
    return lines


def self_frames(value=0.0, twins=0, difference=None):
    """Lines of self-tests; `value` and `twins` are those of one difference, all others are 0."""
    return [frame(pose, a, b, name, value if name == difference else 0.0, twins if name == difference else 0)
            for a, b in SELF_PAIRS for name in DIFFERENCES for pose in range(0, POSES, 10)]


QUERIES_HEADER = "pose,stamp,map,query,detector,error_m,error_deg,inliers,retrieved,status"
METHODS = ["sift", "orb"]


def queries(lost=None):
    """Lines of localisation.csv: the other hours in a map of noon. All are found to 0.1 m and 1 degree, but for the first
    `lost[query, detector]` poses, which are not found at all."""
    lost = lost or {}
    found, not_found = ("0.1", "1", "120", "5", "localised"), ("nan", "nan", "0", "5", "no_pose")
    return [QUERIES_HEADER] + [
        ",".join([str(pose), f"{pose / 10:.9f}", "h12", query, detector,
                  *(not_found if pose < lost.get((query, detector), 0) else found)])
        for query in ("h04", "h20") for detector in METHODS for pose in range(POSES)]


VERIFIED_HEADER = ("pose,stamp,a,b,detector,features_a,features_b,repeatability,matching_score_3px,"
                   + ",".join(f"mma_{t}px" for t in range(1, 11))
                   + ",mutual_matches,ratio_matches,precision_3px,recall_3px,average_precision_3px,d,d_symmetric,d_one_to_one")


def verified(undefined=()):
    """Lines of verified.csv: of 50 accepted matches as many are right as half the pose, 0.4 at t = 1 px and 0.05 more for each
    further px. Poses of `undefined` have no accepted match."""
    lines = [VERIFIED_HEADER]
    for a, b in PAIRS:
        for detector in METHODS:
            for pose in range(POSES):
                accepted = 0 if pose in undefined else 50
                precision = pose // 2 / 50 if accepted else math.nan
                accuracies = [0.4 + 0.05 * t for t in range(10)]
                lines.append(",".join(str(cell) for cell in [
                    pose, f"{pose / 10:.9f}", a, b, detector, 500, 400, 0.25, 0.375, *accuracies, 120, accepted, precision,
                    0.125, 0.0625, 0.95, 0.96, 0.97]))
    return lines


def verified_summary():
    """Lines of verified_summary.csv that say something else than verified.csv, so that it is seen whose means are shown."""
    lines = ["a,b,detector,measure,n,undefined,mean,sd,ci_low,ci_high"]
    for a, b in PAIRS:
        for detector in METHODS:
            for measure in VERIFIED_HEADER.split(",")[5:]:
                lines.append(f"{a},{b},{detector},{measure},{POSES},0,0.8125,0.1,0.7875,0.8375")
    return lines


COMPARISONS_HEADER = "metric,family,same,a,b,n,undefined,failed,unpaired,mean_difference,low,high,p,p_holm,block_length"


def comparisons():
    """Lines of comparisons.csv: SIFT's D is surely smaller between two pairs of hours, and nothing else is known."""
    lines = [COMPARISONS_HEADER]
    for a, b in PAIRS:
        p = "nan" if (a, b) == PAIRS[0] else "1e-05"
        lines.append(f"d,methods,{a}-{b},sift,orb,39,1,0,0,-0.125,-0.25,-0.0625,{p},{p},3")
    lines.append("error_m,hours,sift,h04 in h12,h20 in h12,30,0,8,2,0.5,-0.25,0.75,0.25,0.5,3")
    return lines


def lost_features():
    """Lines of lost_features.csv of one pair: three cells with features."""
    found = {(0, 0): (100, 0), (15, 11): (100, 75), (5, 5): (9, 9)}
    return ["a,b,detector,poses,column,row,features,lost"] + [
        ",".join(str(cell) for cell in ["h04", "h12", "sift", POSES, column, row, *found.get((column, row), (0, 0))])
        for row in range(12) for column in range(16)]


def positions():
    """Lines of localisation_poses.csv: as `queries`, each 0.1 m beside the truth."""
    lines = ["pose,stamp,map,query,detector,x,y,z,qx,qy,qz,qw,true_x,true_y,true_z"]
    for query in ("h04", "h20"):
        for detector in METHODS:
            for k in range(POSES):
                found = "nan,nan,nan,nan,nan,nan,nan" if k < 4 else f"{k},{k % 7 + 0.1},1,0,0,0,1"
                lines.append(f"{k},{k / 10:.9f},h12,{query},{detector},{found},{k},{k % 7},1")
    return lines


def captures():
    """Lines of captures.csv: the sun sinks from hour to hour."""
    return ["stream,pose,stamp,ev100,exposure_mode,sun_azimuth_deg,sun_elevation_deg,"
            "moon_azimuth_deg,moon_elevation_deg,moon_illuminated_fraction,scene_illuminance,utc,utc_s"] + [
        f"{hour},{k},{k / 10},12.5,auto,{90 + 10 * n},{5 - 4 * n},nan,nan,nan,4321,2024-07-01T00:{n:02d}:00.000Z,{773107200 + 60 * n}"
        for n, hour in enumerate(HOURS) for k in range(POSES)]


# Of run.yaml where a run is made as the paper's was, in an experiment's own words.
SETTINGS = {"ratio": "0.5", "inclusive": "false", "features/orb/n_features": "500", "about/world": "race_track",
            "about/site": "[55.792115, 49.122254, 90.0]", "about/date": "2024-07-01", "about/timezone": "3", "about/exposure": "fixed",
            "about/conditions": "{}", "about/noise": "false", "about/glare": "0.0", "about/camera": "640 x 480, 60.0 deg, 1.0 m"}


def run(**settings):
    """Lines of run.yaml as far as its settings go; `settings` are others of about, None for one that is not told."""
    changed = {**SETTINGS, **{key if key in SETTINGS else f"about/{key}": value for key, value in settings.items()}}
    return ["settings:"] + [f"  {key}: '{value}'" for key, value in changed.items() if value is not None]


def write(folder, name, lines):
    path = os.path.join(folder, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    return path


def write_all(folder):
    """Every file that a report reads."""
    write(folder, "frames.csv", frames() + self_frames())
    write(folder, "localisation.csv", queries({("h04", "orb"): 4, ("h20", "orb"): 30}))
    write(folder, "verified.csv", verified())
    write(folder, "verified_summary.csv", verified_summary())
    write(folder, "comparisons.csv", comparisons())
    write(folder, "lost_features.csv", lost_features())
    write(folder, "localisation_poses.csv", positions())
    for pair, drawn in (("h04-h12", (10, 30)), ("h12-h20", (0, 38))):
        for pose in drawn:
            path = os.path.join(folder, "matches", pair, "sift", f"{pose:06d}.png")
            os.makedirs(os.path.dirname(path), exist_ok=True)
            Image.new("RGB", (128, 48), (60, pose, 60)).save(path)
    write(folder, "path.csv",
          ["pose,stamp,x,y,z,yaw_deg"] + [f"{k},{k / 10},{k},{k % 7},1.0,0" for k in range(POSES)])
    write(folder, "captures.csv", captures())
    write(folder, "run.yaml", run() + ["versions:", "  sunlit: '9.8.7'", "counters:", "  streams:",
                                       "    'h04': {received: 40, late: 17}"])
    write(folder, "rasterizer.yaml", ["rasterizer: 'osmesa: llvmpipe (LLVM 15.0.6, 256 bits)'"])
    write(folder, "ground.yaml", ["ground_albedo: 0.173"])
    write(folder, "inputs.yaml", ["sunlit: '9.8.7'", "world: '00c0ffee'", "path: '0123456789abcdef'"])
    write(folder, "problems.csv", ["kind,pose,stamp,where,reason", "undecodable,,1.5,h12,\"cut <short>, it seems\""])
    write(folder, "timing.csv", ["stage,what,count,seconds", "render,geometry,40,0.8"])
    write(folder, "map.yaml", ["x_min: -10", "x_max: 60", "y_min: -20", "y_max: 30"])
    Image.new("RGB", (70, 50), (90, 120, 90)).save(os.path.join(folder, "map.png"))
    for hour in HOURS:
        for pose in range(0, POSES, 5):
            path = os.path.join(folder, "images", hour, f"{pose:06d}.png")
            os.makedirs(os.path.dirname(path), exist_ok=True)
            Image.new("RGB", (64, 48), (pose, 60, 60)).save(path)
