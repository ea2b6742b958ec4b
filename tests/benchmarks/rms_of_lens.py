#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints the RMS [px, per corner] that another lens leaves in the corners of a board calibration.

    rms_of_lens.py OURS.cameramodel THEIRS.cameramodel

Only the boards' poses and their curvature are solved again; the corners that ours refused stay out.
"""

import sys

import mrcal
import numpy as np


def main():
    ours, theirs = (mrcal.cameramodel(path) for path in sys.argv[1:3])
    inputs = ours.optimization_inputs()
    inputs["lensmodel"], intrinsics = theirs.intrinsics()
    inputs["intrinsics"] = np.array([intrinsics])
    inputs.update(do_optimize_intrinsics_core=False, do_optimize_intrinsics_distortions=False,
                  do_apply_outlier_rejection=False, do_apply_regularization=False)
    mrcal.optimize(**inputs)
    used = inputs["observations_board"][..., 2] > 0
    residuals = mrcal.optimizer_callback(**inputs, no_jacobian=True, no_factorization=True)[1]
    residuals = residuals[: 2 * used.size].reshape(*used.shape, 2)[used]
    print(f"{np.sqrt(np.mean(np.sum(residuals**2, axis=-1))):.6f}")


if __name__ == "__main__":
    main()
