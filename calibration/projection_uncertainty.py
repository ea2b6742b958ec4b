#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Says how well a board calibration knows its lens, as JSON on standard output.

    projection_uncertainty.py MODEL.cameramodel COLUMNS ROWS

MODEL must hold its optimization inputs, as mrcal-calibrate-cameras writes it. Residuals are in
pixels of the photographs (mrcal's weights removed), outliers left out. The uncertainty is the
standard deviation in the worst direction of a point at infinity, over a grid of COLUMNS x ROWS
that spans the frame, row by row, and at the centre.
"""

import json
import sys

import mrcal
import numpy as np


def residuals_px(inputs):
    """(points, 2) array of the inliers' residuals, and how many outliers there were."""
    observations = inputs["observations_board"]
    weights = observations[..., 2]
    all_residuals = mrcal.optimizer_callback(**inputs, no_jacobian=True, no_factorization=True)[1]
    board = all_residuals[: 2 * weights.size].reshape(*weights.shape, 2)
    inlier = weights > 0
    return board[inlier] / weights[inlier][:, np.newaxis], int(np.sum(~inlier))


def uncertainty_px(model, columns, rows):
    width, height = model.imagersize()
    grid = np.meshgrid(np.linspace(0, width - 1, columns), np.linspace(0, height - 1, rows))
    pixels = np.vstack((np.stack(grid, axis=-1).reshape(-1, 2),
                        [[(width - 1) / 2, (height - 1) / 2]]))
    directions = mrcal.unproject(pixels, *model.intrinsics(), normalize=True)
    return mrcal.projection_uncertainty(directions, model, atinfinity=True,
                                        what="worstdirection-stdev")


def rounded(numbers):
    return [round(float(number), 6) for number in numbers]


def main():
    model = mrcal.cameramodel(sys.argv[1])
    columns, rows = int(sys.argv[2]), int(sys.argv[3])
    residuals, outliers = residuals_px(model.optimization_inputs())
    lengths = np.linalg.norm(residuals, axis=-1)
    sigmas = rounded(uncertainty_px(model, columns, rows))
    report = {
        "points": len(lengths),
        "outliers": outliers,
        "rms_px": round(float(np.sqrt(np.mean(lengths**2))), 6),
        "worst_px": round(float(np.max(lengths)), 6),
        "sigma_px": sigmas[:-1],
        "center_px": sigmas[-1],
    }
    print(json.dumps(report))


if __name__ == "__main__":
    main()
