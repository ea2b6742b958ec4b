#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""film_scans.py SITE FOLDER: the photographs of SITE as if a metric camera had taken them on film, scanned a
little turned. FOLDER becomes a site without a camera: photos, survey, building; film_truth.json holds the
certificate (millimetres) and where each fiducial mark is on each scan (pixels)."""
import csv
import json
import os
import re
import shutil
import sys

import cv2
import numpy

site, folder = sys.argv[1:]
SCALE, TURN = 16, {"left": 0.7, "middle": -0.4, "right": 0.2}  # px/mm; degrees
WIDTH, HEIGHT = 1060, 740  # px
FOCAL, POINT = 56.5, numpy.array([0.12, -0.08])  # mm
RADII = [5, 10, 15, 20, 25, 30, 35, 40]
MARKS = {"1": (-30.512, -20.497), "2": (30.488, -20.503), "3": (30.506, 20.511), "4": (-30.491, 20.489),
         "5": (0.014, -20.602), "6": (30.613, -0.011), "7": (-0.009, 20.597), "8": (-30.604, 0.007)}


def distortion(radius):
    return 2e-6 * radius ** 3


def lens():
    with open(f"{site}/work/calibration/camera.cameramodel", encoding="utf-8") as file:
        numbers = re.search(r"'intrinsics': \[([^]]*)", file.read())[1]
    fx, fy, cx, cy, *rest = (float(number) for number in numbers.split(",") if number.strip())
    return numpy.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]]), numpy.array(rest)


def scan_from_film(turn):
    """Of homogeneous millimetres (y up) to pixels (y down)."""
    a = numpy.radians(turn)
    return numpy.array([[SCALE * numpy.cos(a), -SCALE * numpy.sin(a), WIDTH / 2 + 1.3],
                        [-SCALE * numpy.sin(a), -SCALE * numpy.cos(a), HEIGHT / 2 - 0.8]])


def film_of(direction):
    """Where a camera that sees (x, y), depth 1, y down, has it on its film."""
    ideal = FOCAL * numpy.stack([direction[..., 0], -direction[..., 1]], -1)
    measured = ideal
    for _ in range(20):
        radius = numpy.linalg.norm(measured, axis=-1, keepdims=True)
        measured = ideal * (1 + distortion(radius) / numpy.maximum(radius - distortion(radius), 1e-9))
    return measured + POINT


def draw(photo, turn, matrix, coefficients):
    to_scan = scan_from_film(turn)
    y, x = numpy.mgrid[0:HEIGHT, 0:WIDTH].astype(float)
    film = numpy.stack([x - to_scan[0, 2], y - to_scan[1, 2]], -1) @ numpy.linalg.inv(to_scan[:, :2]).T
    measured = film - POINT
    radius = numpy.linalg.norm(measured, axis=-1, keepdims=True)
    ideal = measured * (1 - distortion(radius) / numpy.maximum(radius, 1e-9))
    rays = numpy.concatenate([ideal * [1, -1] / FOCAL, numpy.ones((HEIGHT, WIDTH, 1))], -1).reshape(-1, 3)
    pixels, _ = cv2.projectPoints(rays, numpy.zeros(3), numpy.zeros(3), matrix, coefficients)
    pixels = pixels.reshape(HEIGHT, WIDTH, 2).astype(numpy.float32)
    image = cv2.remap(cv2.imread(f"{site}/photos/{photo}.jpg"), pixels, None, cv2.INTER_CUBIC,
                      borderMode=cv2.BORDER_REPLICATE).astype(float)
    image[(abs(film[..., 0]) > 29.3) | (abs(film[..., 1]) > 19.3)] = 20
    for mark in MARKS.values():
        offset = abs(film - mark)
        width, length = 0.5 + SCALE * (0.09 - offset), offset.max(-1, keepdims=True) < 0.9
        line = numpy.clip(width.max(-1, keepdims=True), 0, 1) * length
        image = image * (1 - line) + 235 * line
    cv2.imwrite(f"{folder}/photos/{photo}.png", image.round().astype(numpy.uint8))


def main():
    matrix, coefficients = lens()
    os.makedirs(f"{folder}/photos")
    os.makedirs(f"{folder}/survey")
    for name in ("control_points.csv", "directions.json", "materials.json", "polygons.json"):
        shutil.copy(f"{site}/survey/{name}", f"{folder}/survey/{name}")
    shutil.copytree(f"{site}/building", f"{folder}/building")
    shutil.copy(f"{site}/site.json", folder)
    marks = {}
    for photo, turn in TURN.items():
        draw(photo, turn, matrix, coefficients)
        to_scan = scan_from_film(turn)
        marks[photo] = {name: [round(value, 3) for value in to_scan @ [*mm, 1]] for name, mm in MARKS.items()}
    with open(f"{site}/survey/observations.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        seen = cv2.undistortPoints(numpy.array([[[float(row["x"]), float(row["y"])]]]), matrix, coefficients)
        row["x"], row["y"] = scan_from_film(TURN[row["photo"]]) @ [*film_of(seen[0, 0]), 1]
    with open(f"{folder}/survey/observations.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    with open(f"{folder}/film_truth.json", "w", encoding="utf-8") as file:
        json.dump({"focal_mm": FOCAL, "principal_point_mm": POINT.tolist(), "fiducials": MARKS, "scans": marks,
                   "distortion": [[radius, round(distortion(radius), 6)] for radius in RADII]}, file)


main()
