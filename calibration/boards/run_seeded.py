#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a Python program found in PATH with numpy's random numbers seeded.

    run_seeded.py PROGRAM ARGUMENT...

mrcal-calibrate-cameras starts the distortion from random numbers; seeded, the same boards give the
same model to the last bit.
"""

import runpy
import shutil
import sys

import numpy as np


def main():
    program = shutil.which(sys.argv[1])
    if program is None:
        sys.exit(f"{sys.argv[1]} is not installed, expected the Debian package mrcal")
    sys.argv = [program] + sys.argv[2:]
    np.random.seed(0)
    runpy.run_path(program, run_name="__main__")


if __name__ == "__main__":
    main()
