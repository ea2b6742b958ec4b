#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Says how well a board calibration knows its lens, as JSON on standard output.

    assess_calibration.py MODEL.cameramodel COLUMNS ROWS [CORNERS.vnl]

MODEL must hold its optimization inputs, as mrcal-calibrate-cameras writes it; CORNERS.vnl, which it
was made from, gives the boards their photographs' names.

Residuals are projected minus found, in pixels of the photographs (mrcal's weights removed),
outliers left out; weighted_rms_px keeps the weights, as mrcal's own programs do. Grids of COLUMNS x
ROWS go row by row: counts and mean residuals over equal cells of the frame, the uncertainty at the
cells' centres. The uncertainty is the standard deviation in the worst direction of a point at
infinity, there and at the frame's centre.

intrinsics_covariance is mrcal's: of the estimated intrinsics (in mrcal's order, unpacked) when the
corners scatter as their residuals do. The solution's regularisation terms hold the estimate but add
no noise. Only for lean models, all of whose intrinsics were estimated.
"""

import json
import sys

import mrcal
import numpy as np


class Solution:
    """The optimum that the model was saved at."""

    def __init__(self, model):
        self.inputs = model.optimization_inputs()
        if self.inputs is None:
            sys.exit("the model holds no optimization inputs")
        # Only this camera's boards: a calibration of several cameras at once names others too.
        camera = model.icam_intrinsics()
        indices = self.inputs["indices_frame_camintrinsics_camextrinsics"]
        self.mine = indices[:, 1] == camera
        _, self.all_residuals, self.jacobian, self.factorization = mrcal.optimizer_callback(
            **self.inputs)
        observations = self.inputs["observations_board"]
        weights = observations[..., 2]
        board = self.all_residuals[: 2 * weights.size].reshape(*weights.shape, 2)
        # Points that were not found stand at (-1, -1): they are no outliers.
        self.found = (observations[..., 0] >= 0) & self.mine[:, np.newaxis, np.newaxis]
        self.inlier = (weights > 0) & self.found
        self.outliers = int(np.sum((weights <= 0) & self.found))
        self.weighted = board[self.inlier]
        self.residuals = np.full(board.shape, np.nan)
        self.residuals[self.inlier] = board[self.inlier] / weights[self.inlier][:, np.newaxis]
        self.pixels = observations[..., :2]
        self.pixel_sigma = float(np.std(self.weighted.ravel()))


def uncertainty_px(model, columns, rows):
    width, height = model.imagersize()
    grid = np.meshgrid((np.arange(columns) + 0.5) * width / columns - 0.5,
                       (np.arange(rows) + 0.5) * height / rows - 0.5)
    pixels = np.vstack((np.stack(grid, axis=-1).reshape(-1, 2),
                        [[(width - 1) / 2, (height - 1) / 2]]))
    directions = mrcal.unproject(pixels, *model.intrinsics(), normalize=True)
    return mrcal.projection_uncertainty(directions, model, atinfinity=True,
                                        what="worstdirection-stdev")


def intrinsics_covariance(model, solution):
    """(n, n) array, or None for a model whose intrinsics were not all estimated."""
    inputs = solution.inputs
    lensmodel, intrinsics = model.intrinsics()
    if (lensmodel.startswith("LENSMODEL_SPLINED") or solution.factorization is None
            or not inputs["do_optimize_intrinsics_core"]
            or not inputs["do_optimize_intrinsics_distortions"]):
        return None
    first = mrcal.state_index_intrinsics(model.icam_intrinsics(), **inputs)
    intrinsics_from_packed = np.zeros((len(intrinsics), solution.jacobian.shape[1]))
    intrinsics_from_packed[range(len(intrinsics)), range(first, first + len(intrinsics))] = 1
    mrcal.unpack_state(intrinsics_from_packed, **inputs)
    gain = solution.factorization.solve_xt_JtJ_bt(intrinsics_from_packed)
    observed = solution.jacobian[: mrcal.num_measurements_boards(**inputs)]
    spread = observed @ gain.T
    return solution.pixel_sigma**2 * (spread.T @ spread)


def over_cells(solution, model, columns, rows):
    """Counts and mean residuals of the inliers over equal cells of the frame."""
    width, height = model.imagersize()
    pixels, residuals = solution.pixels[solution.inlier], solution.residuals[solution.inlier]
    column = np.clip(((pixels[:, 0] + 0.5) * columns / width).astype(int), 0, columns - 1)
    row = np.clip(((pixels[:, 1] + 0.5) * rows / height).astype(int), 0, rows - 1)
    cell = row * columns + column
    counts = np.bincount(cell, minlength=columns * rows)
    means = [np.bincount(cell, weights=residuals[:, axis], minlength=columns * rows)
             / np.maximum(counts, 1) for axis in (0, 1)]
    return {"counts": [int(n) for n in counts], "mean_x_px": rounded(means[0]),
            "mean_y_px": rounded(means[1])}


def photo_of_first_corner(corners):
    """{(x, y) of every corner as text: photo}, so that each board finds its photograph."""
    photos = {}
    if corners:
        for line in open(corners, encoding="utf-8"):
            words = line.split()
            if len(words) >= 3 and words[0][0] != "#" and words[1] != "-":
                photos[float(words[1]), float(words[2])] = words[0].rsplit("/", 1)[-1]
    return photos


def boards(model, solution, corners):
    photos = photo_of_first_corner(corners)
    indices = solution.inputs["indices_frame_camintrinsics_camextrinsics"]
    rows, columns = solution.pixels.shape[1:3]
    center = solution.inputs["calibration_object_spacing"] * np.array(
        ((columns - 1) / 2, (rows - 1) / 2, 0))
    result = []
    for i in np.flatnonzero(solution.mine):
        frame, _, extrinsics = indices[i]
        pose = solution.inputs["frames_rt_toref"][frame]
        if extrinsics >= 0:
            pose = mrcal.compose_rt(solution.inputs["extrinsics_rt_fromref"][extrinsics], pose)
        normal = mrcal.R_from_r(pose[:3])[:, 2]
        inlier = solution.inlier[i]
        lengths = np.linalg.norm(solution.residuals[i][inlier], axis=-1)
        result.append({
            "photo": photos.get(tuple(solution.pixels[i][solution.found[i]][0]), f"board {frame + 1}"),
            "corners": int(inlier.sum()),
            "outliers": int(solution.found[i].sum() - inlier.sum()),
            "rms_px": rms(lengths),
            "worst_px": round(float(np.max(lengths, initial=0)), 6),
            "tilt_deg": round(float(np.degrees(np.arccos(min(abs(normal[2]), 1)))), 3),
            "distance_m": round(float(np.linalg.norm(mrcal.transform_point_rt(pose, center))), 6),
        })
    return result


def rms(lengths):
    return round(float(np.sqrt(np.mean(lengths**2))) if len(lengths) else 0.0, 6)


def rounded(numbers):
    """Not a number, where a splined model ends, becomes null."""
    return [round(float(number), 6) if np.isfinite(number) else None for number in numbers]


def main():
    model = mrcal.cameramodel(sys.argv[1])
    columns, rows = int(sys.argv[2]), int(sys.argv[3])
    solution = Solution(model)
    lengths = np.linalg.norm(solution.residuals[solution.inlier], axis=-1)
    sigmas = rounded(uncertainty_px(model, columns, rows))
    covariance = intrinsics_covariance(model, solution)
    warp = solution.inputs.get("calobject_warp")
    report = {
        "points": len(lengths),
        "outliers": solution.outliers,
        "rms_px": rms(lengths),
        "weighted_rms_px": rms(np.linalg.norm(solution.weighted, axis=-1)),
        "worst_px": round(float(np.max(lengths)), 6),
        "sigma_px": sigmas[:-1],
        "center_px": sigmas[-1],
        "regularised": bool(solution.inputs["do_apply_regularization"]),
        "board_warp_m": [] if warp is None else [float(f"{w:.9g}") for w in warp],
        "cells": over_cells(solution, model, columns, rows),
        "boards": boards(model, solution, sys.argv[4] if len(sys.argv) > 4 else None),
        "intrinsics_covariance": None if covariance is None else covariance.tolist(),
    }
    print(json.dumps(report))


if __name__ == "__main__":
    main()
