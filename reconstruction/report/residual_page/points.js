// Control, check and object points.

const kAxes = ["x", "y", "z"];

function comparisonTable(parent, comparison) {
  const isOff = p => p.over_sigma > 3;
  longTable(parent, comparison.points, [
    ["point", p => p.name, "text"],
    ...kAxes.map((axis, i) => [`${axis} surveyed m`, p => p.surveyed[i], 3]),
    ...kAxes.map((axis, i) => [`σ${axis} mm`, p => 1000 * p.surveyed_sigma_m[i], 1]),
    ...kAxes.map((axis, i) => [`σ${axis} adj. mm`, p => 1000 * p.adjusted_sigma_m[i], 1]),
    ...kAxes.map((axis, i) => [`Δ${axis} mm`, p => 1000 * p.difference_m[i], 1]),
    ["ΔXY", p => 1000 * p.plan_m, 1],
    ["ΔXYZ", p => 1000 * p.space_m, 1],
    ["worst Δ/σ", p => p.over_sigma, 2],
  ], {isFlagged: isOff}, 40);
  const mm = values => values.map(v => 1000 * v);
  table(parent, [
    ["mean (bias)", mm(comparison.mean_m), null, null],
    ["RMSE", mm(comparison.rms_m), 1000 * comparison.rms_plan_m, 1000 * comparison.rms_space_m],
    ["largest", mm(comparison.max_m), 1000 * comparison.max_plan_m, 1000 * comparison.max_space_m],
  ], [
    [`of ${count(comparison.points.length, "point")}`, r => r[0], "text"],
    ...kAxes.map((axis, i) => [`Δ${axis} mm`, r => r[1][i], 1]),
    ["plan mm", r => r[2], 1],
    ["space mm", r => r[3], 1],
  ]);
  element(parent, "p", `RMS of Δ/σ ${fixed(comparison.rms_over_sigma, 2)}, 1 expected.`);
}

function showCheck() {
  const node = section("Check points", "Surveyed points whose coordinates took no part: adjusted minus " +
    "surveyed, judged by the σ of that difference.");
  if (report.check.points.length > 0) return comparisonTable(node, report.check);
  element(node, "p", "None: accuracy not verified independently.").style.fontWeight = "bold";
  if (report.left_out.points.length === 0) return;
  element(node, "h3", "Instead: leaving out one control point at a time");
  element(node, "p", "Each control point as all other observations predict it. This finds wrong control; " +
    "it does not verify the accuracy independently.", "faint");
  comparisonTable(node, report.left_out);
}

function showControl() {
  const node = section("Control points", "Adjusted minus surveyed; σ before and after the adjustment.");
  if (report.control.points.length === 0) return element(node, "p", "None.");
  comparisonTable(node, report.control);
}

function showPoints() {
  const node = section("Points and vertices", "Standard ellipsoids (one σ): semi-axes a, b, c, and " +
    "where a points to.");
  longTable(node, report.points, [
    ["point", p => p.name, "text"],
    ...kAxes.map((axis, i) => [`${axis} m`, p => p.position[i], 4]),
    ...kAxes.map((axis, i) => [`σ${axis} mm`, p => 1000 * p.sigma_m[i], 1]),
    ...["a", "b", "c"].map((axis, i) => [`${axis} mm`, p => 1000 * p.ellipsoid.semi_axes_m[i], 1]),
    ["azimuth °", p => p.ellipsoid.azimuth_deg, 0],
    ["elevation °", p => p.ellipsoid.elevation_deg, 0],
    ["rays", p => p.rays, 0],
    ["largest angle °", p => p.largest_angle_deg, 1],
    ["RMS px", p => p.rms_px, 2],
  ]);
  const tie = report.tie_points;
  if (tie.count === 0) return element(node, "p", "No tie points.", "faint");
  element(node, "h3", count(tie.count, "tie point"));
  table(node, [["σ in space mm", tie.sigma_m, 1000, 1], ["RMS of its marks px", tie.rms_px, 1, 2]], [
    ["", r => r[0], "text"],
    ["median", r => r[2] * r[1].median, 2],
    ["95 % below", r => r[2] * r[1].percentile_95, 2],
    ["largest", r => r[2] * r[1].max, 2],
  ]);
  element(node, "p", "Photos a point: " + tie.rays.map(r => `${r.rays}: ${r.count}`).join(", ") +
    ". Each with its covariance in points.csv.");
}
