#!/usr/bin/env python3
"""export_dataset, as people type it: what it writes is read here by numpy and OpenCV alone, as others read it."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import cv2
import numpy as np
import rosunit
import yaml

from timelapse import WORLD, located, run

# Round the corner of the box, which is seen from two sides.
WAYPOINTS = "0,-2\n4,-2.5\n8,-5\n9,-9\n"
CAMERA = ["--world", WORLD, "--size", "160x120", "--fov", "75", "--bounced", "off", "--supersampling", "1"]
FORMATS = ("tum", "euroc", "colmap")


def rotation(w, x, y, z):
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def transform(turn, move):
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = turn, move
    return matrix


def lines_of(file):
    return [line for line in pathlib.Path(file).read_text().splitlines() if not line.startswith(("#", "%"))]


def read_tum(folder):
    """fx, fy, cx, cy with (0, 0) in the middle of the first pixel; map_from_optical, depth and picture of each frame."""
    settings = cv2.FileStorage(str(folder / "orb_slam.yaml"), cv2.FILE_STORAGE_READ)
    camera = [settings.getNode("Camera." + key).real() for key in ("fx", "fy", "cx", "cy")]
    scale = settings.getNode("DepthMapFactor").real()
    truth = {}
    for line in lines_of(folder / "groundtruth.txt"):
        stamp, x, y, z, qx, qy, qz, qw = line.split()
        truth[stamp] = transform(rotation(*map(float, (qw, qx, qy, qz))), [float(x), float(y), float(z)])
    frames = []
    for line in lines_of(folder / "associations.txt"):
        stamp, picture, of_depth, depth = line.split()
        assert stamp == of_depth
        steps = cv2.imread(str(folder / depth), cv2.IMREAD_UNCHANGED)
        frames.append((truth[stamp], steps / scale, cv2.imread(str(folder / picture), cv2.IMREAD_UNCHANGED)))
    assert [line.split() for line in lines_of(folder / "rgb.txt")] == [
        line.split()[:2] for line in lines_of(folder / "associations.txt")]
    assert [line.split() for line in lines_of(folder / "depth.txt")] == [
        line.split()[2:] for line in lines_of(folder / "associations.txt")]
    return camera, frames


def read_euroc(folder):
    sensor = yaml.safe_load((folder / "mav0/cam0/sensor.yaml").read_text())
    depth = yaml.safe_load((folder / "mav0/depth0/sensor.yaml").read_text())
    body_from_optical = np.array(sensor["T_BS"]["data"]).reshape(4, 4)
    truth = {}
    for line in lines_of(folder / "mav0/state_groundtruth_estimate0/data.csv"):
        words = line.split(",")
        assert len(words) == 17
        truth[words[0]] = transform(rotation(*map(float, words[4:8])), list(map(float, words[1:4]))) @ body_from_optical
    frames = []
    for line in lines_of(folder / "mav0/cam0/data.csv"):
        stamp, name = line.split(",")
        steps = cv2.imread(str(folder / "mav0/depth0/data" / name), cv2.IMREAD_UNCHANGED)
        frames.append((truth[stamp], steps / depth["depth_steps_per_metre"],
                       cv2.imread(str(folder / "mav0/cam0/data" / name), cv2.IMREAD_UNCHANGED)))
    assert lines_of(folder / "timestamps.txt") == [line.split(",")[0] for line in lines_of(folder / "mav0/cam0/data.csv")]
    return sensor["intrinsics"], frames


def read_poses(images):
    """x, y, z, qx, qy, qz, qw of map_from_optical of each picture in COLMAP's images.txt, which has the inverse."""
    poses = {}
    for line in lines_of(images)[::2]:
        _, qw, qx, qy, qz, x, y, z, camera, name = line.split()
        assert camera == "1"
        qw, qx, qy, qz = map(float, (qw, qx, qy, qz))
        place = -rotation(qw, qx, qy, qz).T @ [float(x), float(y), float(z)]
        poses[name] = [*place, -qx, -qy, -qz, qw]
    return poses


def read_colmap(folder):
    (number, model, width, height, *camera), = [line.split() for line in lines_of(folder / "sparse/0/cameras.txt")]
    assert (number, model, width, height) == ("1", "PINHOLE", "160", "120")
    fx, fy, cx, cy = map(float, camera)
    frames = []
    for name, (x, y, z, qx, qy, qz, qw) in read_poses(folder / "sparse/0/images.txt").items():
        picture = cv2.imread(str(folder / "images" / name), cv2.IMREAD_UNCHANGED)
        depth_width, depth_height, channels, rest = (folder / "depth" / (name + ".bin")).read_bytes().split(b"&", 3)
        depth = np.frombuffer(rest, "<f4").reshape(int(depth_height), int(depth_width), int(channels))[:, :, 0]
        frames.append((transform(rotation(qw, qx, qy, qz), [x, y, z]), depth, picture))
    assert lines_of(folder / "sparse/0/points3D.txt") == []
    return [fx, fy, cx - 0.5, cy - 0.5], frames


READERS = {"tum": read_tum, "euroc": read_euroc, "colmap": read_colmap}


def depth_errors(camera, a, b):
    """Points of frame a's depth, seen in frame b: relative differences of their inverse depth there from b's own, which
    on a plane is linear over the picture, so that it can be read off between pixels. Not where b sees an edge nearby."""
    fx, fy, cx, cy = camera
    (map_from_a, depth_a, _), (map_from_b, depth_b, _) = a, b
    v, u = np.nonzero(depth_a > 0)
    z = depth_a[v, u].astype(float)
    points = map_from_a @ np.stack([(u - cx) / fx * z, (v - cy) / fy * z, z, np.ones_like(z)])
    x, y, z = (np.linalg.inv(map_from_b) @ points)[:3]
    ahead = z > 0.1
    x, y, z = x[ahead], y[ahead], z[ahead]
    u, v = fx * x / z + cx, fy * y / z + cy
    height, width = depth_b.shape
    left, top = np.floor(u).astype(int), np.floor(v).astype(int)
    inside = (left >= 1) & (top >= 1) & (left < width - 2) & (top < height - 2)
    u, v, z, left, top = u[inside], v[inside], z[inside], left[inside], top[inside]
    nearness = np.where(depth_b > 0, 1.0 / np.where(depth_b > 0, depth_b, 1.0).astype(float), 1e9)  # none: an edge
    around = np.stack([nearness[top + j, left + i] for j in (-1, 0, 1, 2) for i in (-1, 0, 1, 2)])
    corner = np.stack([nearness[top + j, left + i] for j in (0, 1) for i in (0, 1)])
    second = np.abs(np.diff(around.reshape(4, 4, -1), 2, axis=1)).max(axis=(0, 1)) + np.abs(
        np.diff(around.reshape(4, 4, -1), 2, axis=0)).max(axis=(0, 1))
    flat = (around.max(axis=0) < 1e9) & (second < 0.003 * corner[0])
    p, q = u - left, v - top
    there = corner[0] * (1 - p) * (1 - q) + corner[1] * p * (1 - q) + corner[2] * (1 - p) * q + corner[3] * p * q
    return (1.0 / z / there - 1.0)[flat], int(inside.sum())


class ExportDataset(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.waypoints = self.folder / "corner.csv"
        self.waypoints.write_text(WAYPOINTS)

    def arguments(self, out, *more):
        return [str(self.folder / out), "--path", str(self.waypoints), *CAMERA, *more]

    def make(self, out, *more):
        done = run("export_dataset", *self.arguments(out, *more))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def refused(self, *arguments):
        done = run("export_dataset", *arguments)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1), done.stderr)
        self.assertTrue(done.stderr.startswith("export_dataset: "), done.stderr)
        return done.stderr

    def test_a_point_of_one_picture_is_in_the_others_where_calibration_and_poses_say(self):
        self.make("set", "--format", "tum,euroc,colmap", "--depth-scale", "2000")
        exact_camera, exact_frames = read_colmap(self.folder / "set/colmap")
        for name in FORMATS:
            camera, frames = READERS[name](self.folder / "set" / name)
            self.assertEqual(len(frames), 15)
            # The ninth digit, and of what goes through a product of matrices the last few of a double.
            np.testing.assert_allclose(camera, exact_camera, rtol=0, atol=2e-9)
            for (pose, _, _), (exact, _, _) in zip(frames, exact_frames):
                np.testing.assert_allclose(pose, exact, rtol=0, atol=1e-8)
            # A float has 6e-8 at both ends; steps of 1/2000 m round what is 1 m away or more by 2.5e-4 at most.
            bound = 2e-7 if name == "colmap" else 3e-4
            for i, j in ((0, 4), (4, 0), (5, 9), (10, 13)):
                errors, seen = depth_errors(camera, frames[i], frames[j])
                self.assertGreater(len(errors), 0.5 * seen, (name, i, j))
                hidden = np.abs(errors) > 0.01  # behind the box, or in front of what was behind it
                self.assertLess(hidden.mean(), 0.1, (name, i, j))
                self.assertLess(np.sqrt(np.mean(errors[~hidden] ** 2)), bound, (name, i, j))

    def test_a_point_is_in_the_right_picture_where_baseline_and_depth_say(self):
        self.make("mono", "--format", "euroc", "--count", "1", "--depth-scale", "2000")
        self.make("set", "--format", "euroc,tum", "--count", "1", "--depth-scale", "2000", "--baseline", "0.25")
        root = self.folder / "set/euroc"
        camera, ((_, depth, left),) = read_euroc(root)
        mav0 = [yaml.safe_load((root / "mav0" / name / "sensor.yaml").read_text()) for name in ("cam0", "cam1")]
        body_from_left, body_from_right = [np.array(sensor["T_BS"]["data"]).reshape(4, 4) for sensor in mav0]
        left_from_right = np.linalg.inv(body_from_left) @ body_from_right
        np.testing.assert_allclose(left_from_right, transform(np.eye(3), [0.25, 0, 0]), rtol=0, atol=1e-9)
        for key in ("intrinsics", "resolution", "distortion_coefficients"):
            self.assertEqual(mav0[0][key], mav0[1][key])
        self.assertEqual(lines_of(root / "mav0/cam1/data.csv"), lines_of(root / "mav0/cam0/data.csv"))
        right = cv2.imread(str(root / "mav0/cam1/data/1000000000000.png"), cv2.IMREAD_UNCHANGED)
        # The wall of the box stands before the sky and the ground: its left edge, the steepest step of its row.
        row = left.shape[0] // 2
        edges = [int(np.argmax(np.abs(np.diff(picture[row].astype(int))))) for picture in (left, right)]
        near = depth[row, edges[0] - 2:edges[0] + 4]
        disparity = camera[0] * 0.25 / near[near > 0].min()
        self.assertLessEqual(abs(edges[0] - edges[1] - disparity), 1.0)  # both edges are whole pixels
        self.assertGreater(disparity, 1.5)
        # What has one camera is as without the other, and the left one, too.
        self.assertFalse((self.folder / "set/tum/mav0").exists())
        self.assertIn("Camera.bf: 8.", (self.folder / "set/tum/orb_slam.yaml").read_text())
        alone, both = self.content("mono"), self.content("set/euroc")
        for name in ("mav0/cam0/data/1000000000000.png", "mav0/depth0/data/1000000000000.png", "mav0/cam0/sensor.yaml"):
            self.assertEqual(alone[name], both[name])
        settings = cv2.FileStorage(str(root / "orb_slam.yaml"), cv2.FILE_STORAGE_READ)
        self.assertAlmostEqual(settings.getNode("Camera.bf").real(), 0.25 * camera[0], 8)
        self.assertAlmostEqual(settings.getNode("RIGHT.P").mat()[0, 3], -0.25 * camera[0], 8)
        self.assertEqual(settings.getNode("LEFT.P").mat()[0, 3], 0)
        # One that is missing is made again.
        (root / "mav0/cam1/data/1000000000000.png").unlink()
        self.make("set", "--format", "euroc,tum", "--count", "1", "--depth-scale", "2000", "--baseline", "0.25")
        self.assertEqual(self.content("set/euroc"), both)

    def test_half_a_pixel_would_show(self):
        self.make("set", "--format", "colmap", "--count", "6")
        camera, frames = read_colmap(self.folder / "set")
        for shift in ((0.5, 0), (-0.5, 0), (0, 0.5), (0, -0.5)):
            wrong = [camera[0], camera[1], camera[2] + shift[0], camera[3] + shift[1]]
            errors = np.concatenate([depth_errors(wrong, frames[i], frames[j])[0] for i, j in ((0, 1), (0, 2), (4, 5))])
            self.assertGreater(np.sqrt(np.mean(errors[np.abs(errors) < 0.01] ** 2)), 1e-5, shift)

    def test_pictures_are_those_of_snapshot(self):
        self.make("set", "--format", "tum", "--first", "3", "--count", "1", "--hours", "18.5", "--date", "2024-06-01")
        picture, depth = self.folder / "picture.png", self.folder / "depth.pfm"
        done = run("snapshot", "--path-pose", "3", "--path", str(self.waypoints), *CAMERA, "--time", "18:30", "--date", "2024-06-01",
                   "--out", str(picture), "--depth", str(depth))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual((self.folder / "set/rgb/1000.300000000.png").read_bytes(), picture.read_bytes())
        metres = cv2.imread(str(depth), cv2.IMREAD_UNCHANGED)
        steps = cv2.imread(str(self.folder / "set/depth/1000.300000000.png"), cv2.IMREAD_UNCHANGED)
        expected = np.where(np.isfinite(metres) & (metres * 5000 < 65535.5), metres, 0) * 5000
        self.assertLessEqual(np.abs(steps - expected).max(), 0.501)

    def test_each_hour_and_format_has_a_folder_and_each_pose_is_drawn_once(self):
        said = self.make("day", "--format", "colmap,tum", "--hours", "6,12.5,20", "--count", "4", "--stride", "2")
        self.assertEqual(len(re.findall("^pose . of 2: number [02] of the path, 3 pictures; ", said, re.MULTILINE)), 2)
        folders = sorted(str(path.relative_to(self.folder / "day")) for path in (self.folder / "day").glob("*/*"))
        hours = ("h06", "h12_30", "h20")
        self.assertEqual(folders, [hour + "/" + name for hour in hours for name in ("colmap", "tum")])
        for hour in hours:
            images = sorted(os.listdir(self.folder / "day" / hour / "colmap/images"))
            self.assertEqual(images, ["000000.png", "000002.png"])
        pictures = {(self.folder / "day" / hour / "tum/rgb/1000.200000000.png").read_bytes() for hour in hours}
        depths = {(self.folder / "day" / hour / "tum/depth/1000.200000000.png").read_bytes() for hour in hours}
        self.assertEqual((len(pictures), len(depths)), (3, 1))
        for text in ("groundtruth.txt", "orb_slam.yaml", "associations.txt"):
            self.assertEqual(len({(self.folder / "day" / hour / "tum" / text).read_bytes() for hour in hours}), 1)
        # One hour of the three, made alone, is the same.
        self.make("alone", "--format", "tum", "--hours", "20", "--count", "4", "--stride", "2")
        self.assertEqual(self.content("alone", "export_dataset.txt"), self.content("day/h20/tum"))

    def content(self, folder, *without):
        files = [path for path in (self.folder / folder).rglob("*") if path.is_file() and path.name not in without]
        return {str(path.relative_to(self.folder / folder)): path.read_bytes() for path in files}

    def test_goes_on_with_a_broken_off_run(self):
        few = ["--format", "euroc,colmap", "--hours", "8,20", "--count", "3"]
        self.make("whole", *few)
        whole = self.content("whole")
        said = self.make("whole", *few)
        self.assertIn("3 poses are there already\n", said)
        self.assertNotIn("pose 1 of", said)
        root = self.folder / "whole"
        (root / "h20/euroc/mav0/cam0/data/1000100000000.png").unlink()
        (root / "h08/colmap/depth/000002.png.bin").write_bytes(b"160&120&1&half")
        (root / "h08/colmap/sparse/0/images.txt").unlink()
        (root / "h08/colmap/images" / "000000.png.99999999.0.part").write_bytes(b"half")
        kept = root / "h08/euroc/mav0/cam0/data/1000100000000.png"
        os.utime(kept, (1, 1))
        said = self.make("whole", *few)
        self.assertIn("1 poses are there already\n", said)
        self.assertEqual(len(re.findall("of the path, 1 picture; ", said)), 2)
        self.assertEqual(self.content("whole"), whole)
        self.assertEqual(kept.stat().st_mtime, 1)

    def test_a_killed_run_leaves_no_half_files_and_no_lists(self):
        arguments = self.arguments("killed", "--format", "tum")
        process = subprocess.Popen([located("export_dataset"), *arguments], stdout=subprocess.PIPE, text=True)
        for line in process.stdout:
            if line.startswith("pose 2 of"):
                process.kill()
                break
        process.stdout.close()
        self.assertEqual(process.wait(), -9)
        for file in (self.folder / "killed").rglob("*.png"):
            self.assertIsNotNone(cv2.imread(str(file), cv2.IMREAD_UNCHANGED), file)
        self.assertFalse((self.folder / "killed/rgb.txt").exists())
        said = self.make("killed", "--format", "tum")
        self.assertRegex(said, "^[2-9] poses are there already\n")
        self.make("whole", "--format", "tum")
        self.assertEqual(self.content("killed"), self.content("whole"))

    def test_does_not_mix_other_options_or_strangers(self):
        few = ["--format", "tum", "--count", "1"]
        self.make("set", *few)
        for more, said in ((["--hours", "4"], "without --hours 4"), (["--ev", "9"], "without --ev 9"),
                           (["--depth-scale", "500"], "without --depth-scale 500"), (["--format", "colmap"], "--format")):
            refusal = self.refused(*self.arguments("set", *few, *more))
            self.assertIn("its pictures were made with other options", refusal)
            self.assertIn(said, refusal)
        self.waypoints.write_text(WAYPOINTS.replace("9,-9", "9,-8"))
        self.assertIn("content of the path", self.refused(*self.arguments("set", *few)))
        (self.folder / "mine").mkdir()
        (self.folder / "mine/thesis.tex").write_text("years")
        self.assertIn("mine: holds thesis.tex, but no export_dataset.txt", self.refused(*self.arguments("mine", *few)))
        self.assertEqual(os.listdir(self.folder / "mine"), ["thesis.tex"])

    def test_says_what_depth_has_no_room(self):
        part = "depth: ([0-9.]+) % of the pixels that see something have 0"
        said = self.make("near", "--format", "tum", "--count", "1")
        self.assertIn("13.107 m at --depth-scale 5000 (told of 1 pictures made now)", said)
        share = float(re.search(part, said).group(1))
        camera, ((_, near, _),) = read_tum(self.folder / "near")
        self.make("exact", "--format", "colmap", "--count", "1")
        _, ((_, exact, _),) = read_colmap(self.folder / "exact")
        self.assertAlmostEqual(share, 100 * ((exact > 0) & (near == 0)).sum() / (exact > 0).sum(), delta=0.051)
        # The ground reaches 200 m at most, where 65535 steps of 1/300 m are 218 m.
        self.assertNotIn("depth:", self.make("far", "--format", "tum", "--count", "1", "--depth-scale", "300"))
        _, ((_, far, _),) = read_tum(self.folder / "far")
        self.assertTrue(((far > 0) == (exact > 0)).all())

    def test_bad_arguments_are_one_line(self):
        out = str(self.folder / "x")
        one = ["--format", "tum"]
        for arguments, part in (
                ([], "--format FORMAT is missing"), ([out], "--format FORMAT is missing"), (one, "OUTPUT is missing"),
                (one + [out, out + "y"], "OUTPUT is one folder, but there are"),
                (["--format", "kitti", out], "--format is [kitti], but must be a list of some of tum, euroc, colmap"),
                (["--format", "tum,tum", out], "each once"), (["--format", "tum,", out], "each once"),
                (one + [out, "--hours", "24"], "--hours is 24, but must be from 0 to less than 24 h"),
                (one + [out, "--hours", "-1"], "--hours is -1"), (one + [out, "--hours", "noon"], '--hours is "noon"'),
                (one + [out, "--hours", "4,,5"], '--hours is ""'), (one + [out, "--hours", "nan"], "--hours is"),
                (one + [out, "--hours", "4,4.0001"], "--hours names h04 twice"),
                (one + [out, "--depth-scale", "0"], "--depth-scale is 0, but must be from 0.1 to 1000000 1/m"),
                (["--format", "colmap", out, "--depth-scale", "500"], "--depth-scale is of tum and euroc"),
                (one + [out, "--baseline", "0.1"], "--baseline is of euroc"),
                (["--format", "euroc", out, "--baseline", "-1"], "--baseline is -1, but must be from 0 to 100 m"),
                (one + [out, "--rate", "0"], "--rate is 0, but must be from 0.001 to 1000 Hz"),
                (one + [out, "--first", "991"], "--first 991 and --count 0 ask for more than the path's 991 poses"),
                (one + [out, "--count", "992"], "--count 992 ask for more"), (one + [out, "--count", "-1"], "--count is -1"),
                (one + [out, "--stride", "0"], "--stride is 0, but must be from 1 to 1000000000"),
                (one + [out, "--spacing", "0"], "--spacing is 0"), (one + [out, "--world", WORLD], "--path FILE is missing"),
                (one + [out, "--path", out + ".csv"], out + ".csv"), (one + [WORLD + "/x"], "the folder cannot be made"),
                (one + [out, "--compensation", "1", "--ev", "9"], "--compensation needs --ev auto"),
                (one + [out, "--world", out + ".world", "--path", str(self.waypoints)], ".world"),
                (one + [out, "--world", out + ".world", "--path", out + ".csv"], "there is no world " + out),
                (one + [out, "--world", out + ".world"], "there is no world " + out),
                (one + [out, "--final-gather", "2", "--bounced", "off"], "leave out --bounced off")):
            self.assertIn(part, self.refused(*arguments), arguments)
            self.assertFalse(os.path.exists(out), arguments)


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "tools_export_dataset", ExportDataset, sysargs=sys.argv)
