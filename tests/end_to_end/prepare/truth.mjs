// SPDX-License-Identifier: GPL-3.0-or-later
// Where the demo site's photographs show its points, without noise: truth/truth.json through its lens.
import fs from "node:fs";

/** OpenCV's rational lens: [fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6]. */
function project([fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6], [X, Y, Z]) {
  const x = X / Z, y = Y / Z, r = x * x + y * y;
  const radial = (1 + r * (k1 + r * (k2 + r * k3))) / (1 + r * (k4 + r * (k5 + r * k6)));
  return {
    x: fx * (x * radial + 2 * p1 * x * y + p2 * (r + 2 * x * x)) + cx,
    y: fy * (y * radial + p1 * (r + 2 * y * y) + 2 * p2 * x * y) + cy
  };
}

/**
 * @param {string} site
 * @returns {(photo: string, point: string) => {x: number, y: number}}
 */
export function truePixels(site) {
  const {lens, photos, points} = JSON.parse(fs.readFileSync(`${site}/truth/truth.json`, "utf8"));
  return (photo, point) => {
    const {center, cam_from_world_rotation: turn} = photos[photo];
    const from = points[point].map((value, i) => value - center[i]);
    return project(lens.intrinsics, turn.map(row => row.reduce((sum, value, i) => sum + value * from[i], 0)));
  };
}
