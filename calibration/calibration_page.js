// A camera's calibration: verdict, figures, what the boards covered, what they say of the lens.
"use strict";

const width = report.width, height = report.height;
const frame = {
  width: 480, height: Math.round(480 * height / width * 0.87 + 70),
  x: {domain: [-0.5, width - 0.5], label: "x [px] →"},
  y: {domain: [height - 0.5, -0.5], label: "↓ y [px]"},
};

// [{x1, x2, y1, y2, x, y, value}] of the equal cells of the frame that a grid's rows stand for.
function cells(grid) {
  const dx = width / grid[0].length, dy = height / grid.length;
  return grid.flatMap((row, j) => row.map((value, i) => ({
    x1: i * dx - 0.5, x2: (i + 1) * dx - 0.5, y1: j * dy - 0.5, y2: (j + 1) * dy - 0.5,
    x: (i + 0.5) * dx - 0.5, y: (j + 0.5) * dy - 0.5, value})));
}

const inkOn = (value, top) => value > 0.6 * top ? "white" : kInk;

// A map over the frame, each cell with its number, so that it reads without colour too.
function frameMap(parent, caption, grid, digits, top) {
  const all = cells(grid), known = all.filter(c => isKnown(c.value));
  const shown = c => Math.min(c.value, top);
  plot(parent, caption, {
    ...frame,
    color: {type: "linear", scheme: "blues", domain: [0, top * 1.25], clamp: true},
    marks: [
      Plot.rect(all.filter(c => !isKnown(c.value)), {x1: "x1", x2: "x2", y1: "y1", y2: "y2", fill: "#eee"}),
      Plot.rect(known, {x1: "x1", x2: "x2", y1: "y1", y2: "y2", fill: shown, stroke: "white", strokeWidth: 0.5}),
      Plot.text(known, {x: "x", y: "y", text: c => fixed(c.value, digits(c.value)), fontSize: 8.5,
        fill: c => inkOn(shown(c), top * 1.25)}),
      Plot.frame({stroke: kFaint}),
    ]});
}

const pixels = value => value < 1 ? 2 : value < 10 ? 1 : 0;

function showFigures() {
  const node = section("Camera");
  const from = {boards: "photographs of a chessboard", brought: `a camera file (${report.format})`,
    film: "scanned film", exif: "EXIF alone: not calibrated"}[report.source];
  element(node, "p", `${report.lens_model}, ${width} × ${height} px, from ${from}. ` +
    (report.photos.length > 0 ? `Photographs: ${report.photos.join(", ")}.` : "No photographs yet."));
  if (isKnown(report.largest_deviation_px)) {
    element(node, "p", report.largest_deviation_px === 0
      ? "The lens model is the file's own, number by number."
      : `mrcal's model follows the lens as it was given within ${report.largest_deviation_px.toPrecision(2)} px ` +
        "over the whole frame.");
  }
  if (isKnown(report.rms_px)) showResidualFigures(node);
}

function showResidualFigures(node) {
  const rows = [[report.lens_model, report.points, report.outliers, report.rms_px, report.uncertainty.center_px]];
  if (report.splined_lens_model) {
    rows.push([report.splined_lens_model, null, report.splined_outliers, report.splined_rms_px,
      report.splined_uncertainty.center_px]);
  }
  table(node, rows, [
    ["lens model", r => r[0].replace("LENSMODEL_", ""), "long"],
    ["corners", r => r[1], 0],
    ["outliers", r => r[2], 0],
    ["RMS [px]", r => r[3], 3],
    ["σ at the centre [px]", r => r[4], 3],
  ]);
  element(node, "p", `Largest residual ${fixed(report.worst_px, 2)} px; with mrcal's weights RMS ` +
    `${fixed(report.weighted_rms_px, 3)} px. RMS is per corner, √(Σ|v|²/n). ` +
    `${report.regularised ? "Lightly regularised, as mrcal does by default. " : ""}` +
    (report.board_warp_m.length === 2
      ? `The board is bent by ${report.board_warp_m.map(w => fixed(1000 * w, 2)).join(" and ")} mm along its sides.` : ""),
    "faint");
}

function showCoverage() {
  const node = section("Where the boards were, and what they left over");
  const pair = plots(node, true);
  const counts = cells(report.cells.counts), top = Math.max(1, ...counts.map(c => c.value));
  frameMap(pair, "Corners in each part of the frame", report.cells.counts, () => 0, top);
  const arrows = cells(report.cells.mean_x_px).map((c, i) => ({...c, u: c.value,
    v: report.cells.mean_y_px[Math.floor(i / report.cells.mean_x_px[0].length)][i % report.cells.mean_x_px[0].length],
    n: counts[i].value})).filter(c => c.n > 0);
  const longest = Math.max(1e-9, ...arrows.filter(c => c.n > 2).map(c => Math.hypot(c.u, c.v)));
  const step = 10 ** Math.floor(Math.log10(longest)), round = step * (longest >= 5 * step ? 5 : longest >= 2 * step ? 2 : 1);
  const scale = 0.9 * width / report.cells.counts[0].length / longest;
  plot(pair, "Mean residual in each part: in one direction side by side, they are the lens model's fault", {
    ...frame, marks: [
      Plot.frame({stroke: kFaint}),
      Plot.arrow(arrows, {x1: "x", y1: "y", x2: c => c.x + scale * c.u, y2: c => c.y + scale * c.v,
        stroke: kAccent, strokeOpacity: c => c.n > 2 ? 1 : 0.35, strokeWidth: 1.4, headLength: 5}),
      ...scaleBar(0.02 * width, height * 0.975, scale * round, `${round} px`),
    ]});
}

function showUncertainty() {
  const node = section("What the projection is worth",
    "Standard deviation of a far point's image in its worst direction [px]. The lean model is always the more " +
    "confident one; where the two part, no board was seen: believe the splined one. Grey: beyond it.");
  const pair = plots(node, true);
  const seen = report.uncertainty.sigma_px.flat().filter(isKnown).sort((a, b) => a - b);
  const other = (report.splined_uncertainty ?? report.uncertainty).sigma_px.flat().filter(isKnown).sort((a, b) => a - b);
  const top = Math.max(2 * seen[seen.length >> 1], 2 * other[other.length >> 1]);
  frameMap(pair, `σ by ${report.lens_model.replace("LENSMODEL_", "")}`, report.uncertainty.sigma_px, pixels, top);
  if (report.splined_uncertainty) {
    frameMap(pair, "σ by the splined model", report.splined_uncertainty.sigma_px, pixels, top);
  }
}

function showDifferences() {
  if (!report.splined_difference) return;
  const node = section("Put to the test",
    "How far apart two lenses put a far point's image [px], after the rotation between them that no calibration can tell.");
  const pair = plots(node, true);
  const medians = [report.cross_validation, report.splined_difference].filter(isKnown)
    .map(d => d.difference_px.flat().filter(isKnown).sort((a, b) => a - b)).map(d => d[d.length >> 1]);
  const top = 2.5 * Math.max(...medians);
  if (report.cross_validation) {
    frameMap(pair, `Cross-validation: two halves of the boards, RMS ${fixed(report.cross_validation.rms_px, 2)} px`,
      report.cross_validation.difference_px, pixels, top);
  }
  frameMap(pair, `Lens model against the splined one, RMS ${fixed(report.splined_difference.rms_px, 2)} px`,
    report.splined_difference.difference_px, pixels, top);
}

function showBoards() {
  const node = section("Boards", "Worst first. A board far above the others was blurred, bent or moved.");
  const boards = [...report.boards].sort((a, b) => b.rms_px - a.rms_px);
  const typical = boards[boards.length >> 1].rms_px;
  plot(plots(node, true), "Tilt and distance of the boards; dots grow with their RMS", {
    width: 480, height: 260,
    x: {label: "tilt [°] →", domain: [0, 90]}, y: {label: "↑ distance [m]", zero: true, nice: true}, grid: true,
    marks: [Plot.dot(boards, {x: "tilt_deg", y: "distance_m", r: b => 2 + 3 * Math.sqrt(b.rms_px / typical),
      stroke: b => b.rms_px > 2.5 * typical ? kFail : kAccent, fill: "white", fillOpacity: 0.6})]});
  const columns = [
    ["photo", b => b.photo, "text"],
    ["corners", b => b.corners, 0],
    ["outliers", b => b.outliers, 0],
    ["RMS [px]", b => b.rms_px, 3],
    ["worst [px]", b => b.worst_px, 2],
    ["tilt [°]", b => b.tilt_deg, 0],
    ["distance [m]", b => b.distance_m, 2],
  ];
  const isFlagged = b => b.rms_px > 2.5 * typical || b.outliers > 0.1 * (b.corners + b.outliers);
  table(node, boards.slice(0, 12), columns, {isFlagged});
  if (boards.length > 12) table(folded(node, `the other ${boards.length - 12}`), boards.slice(12), columns, {isFlagged});
  if (report.boards_not_found?.length > 0) {
    element(node, "p", `No board found in ${report.boards_not_found.join(", ")}.`);
  }
}

function showIntrinsics() {
  if (report.intrinsics.length > 40) return;
  const covariance = report.intrinsics_covariance, node = section("Interior orientation", covariance
    ? "mrcal's order, pixels. σ from the scatter of the corners; parameters trade off against each other, so judge the maps above, not these."
    : "mrcal's order, pixels.");
  const sigma = i => covariance ? Math.sqrt(covariance[i][i]) : null;
  table(node, report.intrinsics.map((value, i) => ({name: report.intrinsics_names[i], value, sigma: sigma(i)})), [
    ["parameter", p => p.name, "text"],
    ["value", p => p.value, 6],
    ["σ", p => p.sigma, 6],
  ]);
  if (!covariance) return;
  const high = [];
  covariance.forEach((row, i) => row.slice(0, i).forEach((c, j) => {
    const r = c / (sigma(i) * sigma(j));
    if (Math.abs(r) > 0.95) high.push(`${report.intrinsics_names[j]} with ${report.intrinsics_names[i]} ${fixed(r, 3)}`);
  }));
  element(node, "p", high.length > 0 ? `Correlations above 0.95: ${high.join("; ")}.` : "No correlation above 0.95.");
}

function showFilm() {
  const film = report.film, node = section("Scanned film",
    `${film.transformation} map between image and bitmap coordinates from ${count(film.fiducials.length, "fiducial mark")}; ` +
    (isKnown(film.sigma_px) ? `σ of a mark's coordinate ${fixed(film.sigma_px, 3)} px.` : "none more than needed, so no σ.") +
    ` Calibrated focal length ${film.focal_mm} mm, principal point (${film.principal_point_mm.join(", ")}) mm.`);
  const pair = plots(node, true);
  const longest = Math.max(1e-9, ...film.fiducials.map(f => norm(f.residual_px)));
  const scale = 0.08 * width / longest;
  plot(pair, "Residuals of the fiducial marks", {
    ...frame, marks: [
      Plot.frame({stroke: kFaint}),
      Plot.dot(film.fiducials, {x: f => f.bitmap_px[0], y: f => f.bitmap_px[1], r: 2, fill: kInk}),
      Plot.text(film.fiducials, {x: f => f.bitmap_px[0], y: f => f.bitmap_px[1], text: "mark", dy: -8}),
      Plot.arrow(film.fiducials, {x1: f => f.bitmap_px[0], y1: f => f.bitmap_px[1],
        x2: f => f.bitmap_px[0] + scale * f.residual_px[0], y2: f => f.bitmap_px[1] + scale * f.residual_px[1],
        stroke: kAccent, headLength: 5}),
      ...scaleBar(0.1 * width, height * 0.9, scale * longest, `${longest.toPrecision(2)} px`),
    ]});
  if (film.distortion.length > 0) {
    plot(pair, "Radial distortion as certified", {
      width: 480, height: 260, grid: true, x: {label: "radius [mm] →"}, y: {label: "↑ distortion [µm]"},
      marks: [Plot.ruleY([0], {stroke: kFaint}),
        Plot.line([[0, 0], ...film.distortion], {x: r => r[0], y: r => 1000 * r[1], curve: "monotone-x", stroke: kAccent}),
        Plot.dot(film.distortion, {x: r => r[0], y: r => 1000 * r[1], r: 2.5, fill: kAccent})]});
  }
  table(node, film.fiducials, [
    ["mark", f => f.mark, "text"],
    ["x [mm]", f => f.image_mm[0], 3], ["y [mm]", f => f.image_mm[1], 3],
    ["x [px]", f => f.bitmap_px[0], 2], ["y [px]", f => f.bitmap_px[1], 2],
    ["vx [px]", f => f.residual_px[0], 3], ["vy [px]", f => f.residual_px[1], 3],
  ]);
}

const verdict = structuredClone(report.verdict);
if (verdict.reasons.length === 0) {
  verdict.reasons.push({severity: "pass", reason: report.boards
    ? "A good calibration: boards all over the frame, tilted, near and far; residuals small; halves and models agree."
    : "The camera was taken as it was brought."});
}
showVerdict(verdict);
showFigures();
if (report.film) showFilm();
if (report.cells) showCoverage();
if (report.uncertainty) showUncertainty();
showDifferences();
if (report.boards?.length > 0) showBoards();
showIntrinsics();
