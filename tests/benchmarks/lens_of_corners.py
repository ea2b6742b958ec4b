#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fits a lens of BoofCV's kind (k1 k2, no tangential terms) to the corners of a board calibration.

    lens_of_corners.py OURS.cameramodel

Prints fx fy cx cy k1 k2 p1 p2 k3, by OpenCV; the corners that ours refused stay out.
"""
import sys

import cv2
import mrcal
import numpy as np

def main():
    ours = mrcal.cameramodel(sys.argv[1])
    inputs = ours.optimization_inputs()
    boards = inputs["observations_board"]
    rows, columns = boards.shape[1:3]
    grid = np.zeros((rows, columns, 3), np.float32)
    grid[..., :2] = np.stack(np.meshgrid(np.arange(columns), np.arange(rows)), -1)
    grid *= inputs["calibration_object_spacing"]
    used = [board[..., 2] > 0 for board in boards]
    focal, (width, height) = ours.intrinsics()[1][0], ours.imagersize()
    start = np.array([[focal, 0, (width - 1) / 2], [0, focal, (height - 1) / 2], [0, 0, 1]])
    _, matrix, distortion, _, _ = cv2.calibrateCamera(
        [grid[u] for u in used],
        [board[u][:, :2].astype(np.float32) for board, u in zip(boards, used)],
        (int(width), int(height)), start, None,
        flags=cv2.CALIB_ZERO_TANGENT_DIST | cv2.CALIB_FIX_K3 | cv2.CALIB_USE_INTRINSIC_GUESS)
    print(matrix[0, 0], matrix[1, 1], matrix[0, 2], matrix[1, 2], *distortion.ravel()[:5])


if __name__ == "__main__":
    main()
