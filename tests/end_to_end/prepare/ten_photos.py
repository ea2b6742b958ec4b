# SPDX-License-Identifier: GPL-3.0-or-later
"""ten_photos.py DEMO_SITE FOLDER: the demo site as if ten photographs had been taken: copies of its three, each
with 20 marks of its own, up to 0.4 px beside those of the original; samples and polygons as they are."""
import csv
import random
import shutil
import sys

demo, folder = sys.argv[1:3]
PHOTOS, MARKS, NOISE = 10, 20, 0.4  # NOISE [px]
shutil.copytree(demo, folder, ignore=shutil.ignore_patterns("work", "montages", "truth"))
shutil.copytree(f"{demo}/work/calibration", f"{folder}/work/calibration", symlinks=True)  # they may lead nowhere
noise = random.Random(1)
with open(f"{demo}/survey/control_points.csv", encoding="utf-8") as file:
    control = {row["name"] for row in csv.DictReader(file) if row["role"] == "control"}
marks = {}
with open(f"{demo}/survey/observations.csv", encoding="utf-8") as file:
    for row in csv.DictReader(file):
        marks.setdefault(row["photo"], []).append(row)
names = sorted(marks)
lines = ["photo,point,x,y,sigma"]
for i in range(PHOTOS):
    original = names[i % len(names)]
    photo = original if i < len(names) else f"{original}_{i}"
    if photo != original:
        shutil.copyfile(f"{demo}/photos/{original}.jpg", f"{folder}/photos/{photo}.jpg")
    # Control first, then vertices, others on each copy.
    rows = sorted(marks[original], key=lambda row: row["point"] not in control)
    held = [row for row in rows if row["point"] in control][:8]
    others = [row for row in rows if row not in held]
    for row in held + [others[(7 * i + j) % len(others)] for j in range(MARKS - len(held))]:
        x, y = (float(row[axis]) + noise.uniform(-NOISE, NOISE) for axis in ("x", "y"))
        lines.append(f"{photo},{row['point']},{x:.2f},{y:.2f},{row['sigma']}")
with open(f"{folder}/survey/observations.csv", "w", encoding="utf-8") as file:
    file.write("\n".join(lines) + "\n")
