#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""demo_figures.py SITE: the demo site's reconstruction against its truth.

Prints one line a figure, "ok: ..." or "FAIL: ...": every pose, the sun and the zenith lie within
their reported 95 % ellipsoids, check points within 1.2 of their sigma.
"""
import json
import sys

import cv2
import numpy as np

CHI_SQUARE_95 = {2: 5.991, 6: 12.592}


def at_most(what, value, bound):
    print(f"{'ok' if value <= bound else 'FAIL'}: {what} {value:.3f}, at most {bound}")


def load(path):
    with open(path, encoding='utf-8') as file:
        return json.load(file)


def squared_distance(error, covariance):
    return error @ np.linalg.solve(covariance, error)


def pose_error(photo, truth):
    """Left rotation increment [rad] and camera centre [m], as the report's covariance has them."""
    turn = np.array(truth['cam_from_world_rotation']) @ np.array(photo['cam_from_world_rotation']).T
    return np.concatenate([cv2.Rodrigues(turn)[0].ravel(),
                           np.subtract(truth['center'], photo['center'])])


def direction_distance(direction, truth):
    unit, error = np.array(direction['unit']), np.subtract(truth, direction['unit'])
    across = np.linalg.svd(unit[None])[2][1:]
    return squared_distance(across @ error, across @ np.array(direction['covariance']) @ across.T)


def main():
    site = sys.argv[1]
    truth = load(f'{site}/truth/truth.json')
    report = load(f'{site}/work/reconstruction/report.json')
    scene = load(f'{site}/work/reconstruction/scene.json')
    for photo in report['photos']:
        error = pose_error(photo, truth['photos'][photo['photo']])
        at_most(f"pose of {photo['photo']}, chi square", squared_distance(
            error, np.array(photo['covariance'])), CHI_SQUARE_95[6])
    for name in ('sun', 'zenith'):
        at_most(f'{name}, chi square', direction_distance(scene[name], truth[name]),
                CHI_SQUARE_95[2])
    at_most('check points RMS over sigma', report['check']['rms_over_sigma'], 1.2)


if __name__ == '__main__':
    main()
