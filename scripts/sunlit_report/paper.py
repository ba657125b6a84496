"""What the published experiment measured: R. Sultanov, R. Safin, E. A. Martinez-Garcia, E. Magid, "Modeling Sunlight in
Gazebo for Vision-Based Applications Under Varying Light Conditions", ICINCO 2024, pp. 519-526."""

import datetime

CITATION = ("R. Sultanov, R. Safin, E. A. Martínez-García, E. Magid: Modeling Sunlight in Gazebo for Vision-Based "
            "Applications Under Varying Light Conditions. ICINCO 2024, pp. 519–526, doi:10.5220/0013068700003822")

POSES = 991
MORNING, NOON, EVENING = "h04", "h12", "h20"
HOUR_OF = {MORNING: 4, NOON: 12, EVENING: 20}
PAIRS = [(MORNING, NOON), (MORNING, EVENING), (NOON, EVENING)]

# By what it was taken, as experiment.launch calls it: of one camera without faults, under a clear sky.
DATE = datetime.date(2024, 7, 1)
LIGHT = {"date": DATE, "site": [55.792115, 49.122254, 90], "timezone": 3, "exposure": "fixed"}
CAMERA = {"noise": False, "vignetting": "none", "glare": 0, "blur": 0, "mosaic": "none", "line_delay": 0, "exposure_time": 0}
PIXELS = "640 x 480"
# How it was compared, as the evaluator's parameters: detectors have OpenCV's defaults.
MATCHING = {
    "ratio": 0.5, "inclusive": False,
    "features/sift/n_features": 0, "features/sift/n_octave_layers": 3, "features/sift/contrast_threshold": 0.04,
    "features/sift/edge_threshold": 10, "features/sift/sigma": 1.6,
    "features/surf/hessian_threshold": 100, "features/surf/n_octaves": 4, "features/surf/n_octave_layers": 3,
    "features/surf/extended": False, "features/surf/upright": False,
    "features/orb/n_features": 500, "features/orb/scale_factor": 1.2, "features/orb/n_levels": 8,
    "features/orb/edge_threshold": 31, "features/orb/first_level": 0, "features/orb/wta_k": 2, "features/orb/patch_size": 31,
    "features/orb/fast_threshold": 20,
    "features/brisk/threshold": 30, "features/brisk/n_octaves": 3, "features/brisk/pattern_scale": 1,
}

# Mean E and standard deviation s of the three pairs.
_E_AND_S = {
    "boolean_rgb": ((0.70159, 0.69474, 0.70102), (0.06709, 0.07227, 0.06767)),
    "boolean_grey": ((0.70078, 0.66502, 0.70063), (0.06680, 0.10038, 0.06752)),
    "euclidean_rgb": ((0.06425, 0.00308, 0.07117), (0.00917, 0.00190, 0.01036)),
    "euclidean_grey": ((0.06308, 0.00295, 0.07000), (0.00862, 0.00176, 0.01014)),
    "sift": ((0.84577, 0.63501, 0.83832), (0.04907, 0.14882, 0.05197)),
    "surf": ((0.94056, 0.81301, 0.93860), (0.01816, 0.10936, 0.02048)),
    "orb": ((0.97809, 0.89677, 0.97376), (0.01723, 0.09651, 0.02059)),
    "brisk": ((0.95350, 0.86339, 0.95288), (0.01580, 0.09893, 0.01765)),
}
# The same of each hour against itself, 4, 12 and 20 h; all others are 0.
_SELF_E_AND_S = {
    "sift": ((1.19e-5, 0, 4.54e-6), (0.00023, 0, 0.00014)),
    "orb": ((8.04e-6, 0, 8.04e-6), (0.00025, 0, 0.00025)),
    "brisk": ((0.01224, 0.00751, 0.01274), (0.00655, 0.00324, 0.00578)),
}


def e_and_s(a, b, difference):
    """(E, s) that the paper gives for two conditions, a == b meaning a self-test; None where it gives none."""
    if difference not in _E_AND_S:
        return None
    hours = [MORNING, NOON, EVENING]
    if a == b and a in hours:
        e, s = _SELF_E_AND_S.get(difference, ((0, 0, 0), (0, 0, 0)))
        return e[hours.index(a)], s[hours.index(a)]
    if (a, b) not in PAIRS:
        return None
    e, s = _E_AND_S[difference]
    return e[PAIRS.index((a, b))], s[PAIRS.index((a, b))]
