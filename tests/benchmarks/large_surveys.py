#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""large_surveys.py BIN LARGE_SURVEY PHOTOS...: prints, as JSON, what the whole of insitu-reconstruct costs on
surveys of so many photographs of 2 000 marks each, which the tool LARGE_SURVEY makes: with the marks by name in
observations.csv, with all but the control points' as tie points, and beside COLMAP's bare bundle_adjuster
started from the result; and after how long a mark outside its photograph is told. Two threads or one: seconds
are the clock's, cpu_seconds all threads'."""
import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time


def measured(command, status=0):
    """seconds, CPU seconds and peak memory of a command, which must end with that status"""
    start = time.monotonic()
    with open(os.devnull, "w", encoding="utf-8") as nowhere:
        program = subprocess.Popen(command, stdout=nowhere, stderr=nowhere)
        _, code, usage = os.wait4(program.pid, 0)
    program.returncode = os.waitstatus_to_exitcode(code)
    if program.returncode != status:
        sys.exit(f"{' '.join(command)}: status {program.returncode}, expected {status}")
    return {"seconds": round(time.monotonic() - start, 1),
            "cpu_seconds": round(usage.ru_utime + usage.ru_stime, 1),
            "peak_gb": round(usage.ru_maxrss / 2**20, 2)}


def reconstruction(programs, site, *options):
    """the whole program, with the sizes of what it reports"""
    row = measured([programs + "/insitu-reconstruct", site, *options])
    for name, key in (("report.html", "page_mb"), ("report.json", "report_mb")):
        path = os.path.join(site, "work/reconstruction", name)
        row[key] = round(os.path.getsize(path) / 2**20, 2)
    return row


def rows_of(site, name):
    with open(os.path.join(site, "survey", name), newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


def write_observations(site, rows):
    with open(os.path.join(site, "survey/observations.csv"), "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)


def tell_fault(programs, site):
    """after how many seconds the last mark but 99 is refused for lying outside its photograph"""
    rows = rows_of(site, "observations.csv")
    rows[-100] = rows[-100][:2] + ["61000"] + rows[-100][3:]
    write_observations(site, rows)
    return measured([programs + "/insitu-reconstruct", site], status=2)


def large_survey(programs, tool, photos):
    with tempfile.TemporaryDirectory() as folder:
        site, model, adjusted = (os.path.join(folder, name) for name in ("site", "model", "adjusted"))
        subprocess.run([sys.executable, tool, str(photos), "2000", site], check=True, stdout=subprocess.DEVNULL)
        measured([programs + "/insitu-calibrate", site])
        marks = rows_of(site, "observations.csv")
        figures = {"photos": photos, "marks": len(marks) - 1,
                   "by_name": reconstruction(programs, site, "--colmap-model", model)}
        if shutil.which("colmap"):
            os.mkdir(adjusted)
            figures["colmap_bundle_adjuster"] = measured(
                ["colmap", "bundle_adjuster", "--input_path", model, "--output_path", adjusted,
                 "--BundleAdjustment.refine_focal_length", "0", "--BundleAdjustment.refine_extra_params", "0"])
        control = {row[0] for row in rows_of(site, "control_points.csv")}
        figures["fault_told"] = tell_fault(programs, site)
        write_observations(site, [marks[0]] + [row for row in marks[1:] if row[1] in control])
        measured([programs + "/insitu-tie-points", site, "--model", model, "--points", "1000000"])
        figures["by_tie_points"] = reconstruction(programs, site)
        return figures


print(json.dumps([large_survey(sys.argv[1], sys.argv[2], int(count)) for count in sys.argv[3:]]))
