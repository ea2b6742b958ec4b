// Exterior orientations, and each photo's frame: residual vectors, coverage.

function showPhotos() {
  const node = section("Exterior orientations", "Azimuth clockwise from +y, elevation above the xy " +
    "plane, roll clockwise of the picture. σ of the rotation is about the camera's axes.");
  table(node, report.photos, [
    ["photo", p => p.photo, "text"],
    ["x m", p => p.center[0], 3], ["y m", p => p.center[1], 3], ["z m", p => p.center[2], 3],
    ["σx mm", p => 1000 * p.center_sigma_m[0], 1],
    ["σy mm", p => 1000 * p.center_sigma_m[1], 1],
    ["σz mm", p => 1000 * p.center_sigma_m[2], 1],
    ["azimuth °", p => p.angles_deg.azimuth, 4],
    ["elevation °", p => p.angles_deg.elevation, 4],
    ["roll °", p => p.angles_deg.roll, 4],
    ["σ about x, y, z ″", p => p.rotation_sigma_deg.map(s => fixed(3600 * s, 0)).join("  "), "text"],
  ]);
  table(node, report.photos, [
    ["photo", p => p.photo, "text"],
    ["marks", p => p.points, 0],
    ["RMS px", p => p.rms_px, 3],
    ["RMS vx", p => p.rms_xy_px[0], 3], ["RMS vy", p => p.rms_xy_px[1], 3],
    ["max |vx|", p => p.max_xy_px[0], 2], ["max |vy|", p => p.max_xy_px[1], 2],
    ["rectangle %", p => 100 * p.coverage.rectangle, 0],
    ["hull %", p => 100 * p.coverage.hull, 0],
    ["radius %", p => 100 * p.coverage.radial, 0],
    ["outside calibrated", p => p.outside_calibrated_region?.length ?? null, 0],
  ]);
  const matrices = folded(node, "rotation matrices and covariances");
  for (const p of report.photos) {
    element(matrices, "h3", p.photo);
    matrixTable(matrices, "rotation of camera from world", ["x", "y", "z"], p.cam_from_world_rotation,
      v => v.toFixed(9));
    matrixTable(matrices, "covariance: rotation [rad], centre [m]", ["rx", "ry", "rz", "x", "y", "z"],
      p.covariance, v => v.toExponential(3));
    const lens = report.cameras[p.camera]?.parameters.filter(parameter => parameter.is_adjusted) ?? [];
    if (p.lens_correlation) {
      matrixTable(matrices, "correlation of rotation and centre with the lens", lens.map(l => l.name),
        p.lens_correlation, v => v.toFixed(3));
    }
  }
}

function matrixTable(parent, caption, names, rows, text) {
  const node = table(parent, rows, names.map((name, i) => [name, row => text(row[i]), "text"]));
  node.createCaption().textContent = caption;
}

// The plot of a photo's frame, pixels as in the photo: y down.
function framePlot(parent, caption, frame, marks, width = 480) {
  const margin = 6;
  return plot(parent, caption, {
    width, height: Math.round((width - 2 * margin) * frame.height / frame.width + 2 * margin), margin,
    x: {axis: null, domain: [-0.5, frame.width - 0.5]},
    y: {axis: null, domain: [frame.height - 0.5, -0.5]},
    clip: true, marks: [Plot.frame({stroke: "#b9c0c5"}), ...marks],
  });
}

// The photo itself, pale, if the report has it. `width` as framePlot's.
function backdrop(frame, width = 480) {
  if (!frame.thumbnail) return [];
  const inner = width - 12;
  return [Plot.image([frame], {x: (frame.width - 1) / 2, y: (frame.height - 1) / 2, src: "thumbnail",
    width: inner, height: inner * frame.height / frame.width, preserveAspectRatio: "none", opacity: 0.5})];
}

// Arrows from (x, y) along (vx, vy), `enlarged` times.
function vectors(rows, enlarged, options = {}) {
  return Plot.arrow(rows, {
    x1: "x", y1: "y", x2: r => r.x + enlarged * r.vx, y2: r => r.y + enlarged * r.vy,
    headLength: 4, strokeWidth: 1, stroke: kAccent, ...options});
}

// The round number (1, 2 or 5 times a power of ten) next below.
function roundBelow(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [5, 2, 1].find(digit => digit * power <= value * (1 + 1e-9)) * power;
}

// How much to enlarge residuals of this RMS in frames of this size, and the bar that tells it.
function vectorScale(rms, size) {
  if (!(rms > 0)) return {enlarged: 0, bar: []};
  const enlarged = roundBelow(0.03 * size / rms), length = roundBelow(0.15 * size / enlarged);
  return {enlarged, bar: frame => scaleBar(0.03 * size, frame.height - 0.04 * size, length * enlarged,
    `${length} px, enlarged ${enlarged} times`)};
}

function showResidualVectors() {
  if (report.photos.length === 0) return;
  const critical = report.observations.critical_w;
  const node = section("Residual vectors", "From each mark to where the adjustment puts it; all photos " +
    `at one scale. Red: test value over ${fixed(critical, 2)}. Grey: means of tie points, by cells.`);
  const rms = d3.quantile(report.photos.filter(p => p.points > 0), 0.5, p => p.rms_px);
  const size = d3.max(report.photos, p => Math.max(p.width, p.height));
  const scale = vectorScale(rms, size);
  const draw = (parent, p) => framePlot(parent,
    `${p.photo}: ${count(p.points, "mark")}, RMS ${fixed(p.rms_px, 2)} px`, p, [
      ...backdrop(p),
      vectors(p.tie_point_grid, scale.enlarged, {stroke: "#8a949b"}),
      Plot.dot(p.marks, {x: "x", y: "y", r: 1.5, fill: m => m.w > critical ? kFail : kAccent}),
      vectors(p.marks, scale.enlarged, {stroke: m => m.w > critical ? kFail : kAccent}),
      Plot.text(p.marks.filter(m => m.w > critical), {x: "x", y: "y", text: "point", dy: -7,
        fill: kFail, stroke: "white"}),
      ...(scale.enlarged ? scale.bar(p) : []),
    ]);
  drawPhotos(node, draw);
}

// The first photos at once, the others in a fold.
function drawPhotos(parent, draw, shown = 12) {
  const first = plots(parent), rest = report.photos.slice(shown);
  report.photos.slice(0, shown).forEach(p => draw(first, p));
  if (rest.length === 0) return;
  const more = plots(folded(parent, `${count(rest.length, "photo")} more`));
  rest.forEach(p => draw(more, p));
}

function showCoverage() {
  const node = section("Coverage", "Where each photo is measured: marks, their hull, and for tie points " +
    "the cells that have some. Brown: the region that mrcal calls valid for the lens, by its own rule.");
  const regionOf = p => report.cameras[p.camera]?.calibrated_region ?? [];
  drawPhotos(node, (parent, p) => framePlot(parent,
    `${p.photo}: hull ${fixed(100 * p.coverage.hull, 0)} % of the frame`, p, [
      Plot.dot(p.tie_point_grid, {x: "x", y: "y", r: 3, symbol: "square", fill: "#c3d3e0"}),
      Plot.hull(p.marks, {x: "x", y: "y", fill: kAccent, fillOpacity: 0.12, stroke: kAccent}),
      Plot.line(regionOf(p), {stroke: "#b5651d", curve: "linear-closed"}),
      Plot.dot(p.marks, {x: "x", y: "y", r: 1.5, fill: kInk}),
    ], 320));
}
