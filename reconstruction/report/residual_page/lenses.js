// Interior orientations, their calibration, and what of the residuals repeats in every photo.

function showCameras() {
  const node = section("Interior orientations");
  if (report.cameras.length === 0) element(node, "p", "Not stated.", "faint");
  for (const camera of report.cameras) {
    element(node, "h3", `${camera.name}: ${camera.lens_model}`);
    const isAdjusted = camera.parameters.some(p => p.is_adjusted);
    element(node, "p", isAdjusted ? "Adjusted together with the site (self-calibration)" +
      (report.groups.some(g => g.group === "lens") ? "; its calibration is an observation, the group lens." : ".") :
      camera.is_considered ? "Held as calibrated; the calibration's uncertainty enters every σ." :
      "Held as calibrated, taken as exact: every σ leaves the lens's uncertainty out.", "faint");
    table(node, camera.parameters, [
      ["parameter", p => p.name, "text"],
      ["value", p => p.value.toPrecision(9), "text"],
      ["σ", p => isKnown(p.sigma) ? p.sigma.toPrecision(3) : null, "text"],
      ["state", p => p.is_adjusted ? "adjusted" : "held", "text"],
      ["|value| / σ", p => p.t, 1],
      ["p of value 0", p => p.p, 4],
    ]);
    if (camera.correlation) {
      matrixTable(folded(node, "correlations of its parameters"), camera.name,
        camera.parameters.filter(p => p.is_adjusted).map(p => p.name), camera.correlation,
        v => v.toFixed(3));
    }
    showCalibration(node, camera);
  }
}

const kSources = {
  brought: "The camera was brought with the site; its calibration's residuals are not known.",
  film: "Scanned film: see the calibration's own report for its fiducial marks.",
  exif: "NOT CALIBRATED: the focal length is EXIF's, without distortion and principal point.",
};

function showCalibration(node, camera) {
  const c = camera.calibration;
  if (!c) return element(node, "p", "No calibration report: how sure the lens is, is unknown.", "faint");
  const boards = isKnown(c.boards_found) ? count(c.boards_found, "board") : "boards";
  element(node, "p", (isKnown(c.rms_px) ? `Calibrated from ${boards}, ${count(c.points, "corner")}, ` +
    `${count(c.outliers, "outlier")}: RMS ${fixed(c.rms_px, 3)} px, worst ${fixed(c.worst_px, 2)} px.` :
    kSources[c.source] ?? "Where the calibration comes from was not stated.") +
    (camera.model_file ? ` Model: ${camera.model_file}, its SHA-256 under Identity.` : "") +
    (c.verdict ? ` The calibration's own verdict: ${c.verdict}.` : ""));
  const maps = [["this lens model", c.uncertainty], ["the splined model", c.splined_uncertainty]]
    .filter(([, uncertainty]) => uncertainty?.sigma_px);
  if (maps.length === 0) return;
  const pair = plots(node);
  for (const [what, {sigma_px}] of maps) uncertaintyPlot(pair, `${what} of ${camera.name}`, sigma_px, c);
}

// Expected standard deviation of a projection over the frame, cell by cell.
function uncertaintyPlot(parent, what, rows, frame) {
  const cells = rows.flatMap((row, i) => row.map((sigma, k) => ({sigma,
    x1: k / row.length * frame.width - 0.5, x2: (k + 1) / row.length * frame.width - 0.5,
    y1: i / rows.length * frame.height - 0.5, y2: (i + 1) / rows.length * frame.height - 0.5})));
  const known = cells.filter(cell => isKnown(cell.sigma));
  const dark = d3.max(known, cell => cell.sigma) * 0.6;
  framePlot(parent, `expected σ of a projection [px], by ${what}`, frame, [
    Plot.rect(known, {x1: "x1", x2: "x2", y1: "y1", y2: "y2",
      fill: d => d3.interpolateBlues(0.1 + 0.8 * d.sigma / (dark / 0.6))}),
    Plot.text(known, {x: d => (d.x1 + d.x2) / 2, y: d => (d.y1 + d.y2) / 2, text: d => fixed(d.sigma, 2),
      fontSize: 9, fill: d => d.sigma > dark ? "white" : kInk}),
  ]);
}

function showLensResiduals() {
  const cameras = report.lens_residuals;
  if (cameras.length === 0) return;
  const node = section("Residuals by place in the frame", "Means over all photos of a camera: what " +
    "remains systematic here is the lens's, or a film's. One mark a cell says little.");
  for (const camera of cameras) {
    const name = report.cameras[camera.camera]?.name ?? `camera ${camera.camera}`;
    const parent = plots(node), size = Math.max(camera.width, camera.height);
    const typical = d3.quantile(camera.grid, 0.5, c => Math.hypot(c.vx, c.vy));
    const scale = vectorScale(typical, size);
    framePlot(parent, `${name}: mean residuals by cells, ${count(camera.marks, "mark")}`, camera, [
      vectors(camera.grid, scale.enlarged, {strokeWidth: 1.2}),
      Plot.dot(camera.grid, {x: "x", y: "y", r: c => c.marks, fill: kAccent, fillOpacity: 0.3}),
      ...(scale.enlarged ? scale.bar(camera) : []),
    ]);
    radiusPlot(parent, name, camera);
  }
}

function radiusPlot(parent, name, camera) {
  const parts = ["radial", "tangential"];
  const rings = camera.by_radius.flatMap(ring => parts.map((part, i) => ({part, radius: ring.radius_px,
    mean: ring.mean_px[i], spread: ring.rms_px[i] / Math.sqrt(ring.marks)})));
  const points = report.photos.filter(p => p.camera === camera.camera).flatMap(p => p.marks.map(m => {
    const x = m.x - (camera.width - 1) / 2, y = m.y - (camera.height - 1) / 2, r = Math.hypot(x, y);
    return {r, radial: r > 0 ? (m.vx * x + m.vy * y) / r : 0};
  }));
  const color = {domain: parts, range: [kAccent, "#b5651d"], legend: false};
  plot(parent, `${name}: residuals against radius. Blue: radial, dots single marks; brown: tangential; ` +
    "lines: means of rings with their σ", {
    height: 320, grid: true, color, x: {label: "radius from the frame's middle [px]"},
    y: {label: "residual [px]"},
    marks: [
      Plot.dot(points, {x: "r", y: "radial", r: 1.2, fill: kAccent, fillOpacity: 0.4}),
      Plot.ruleY([0], {stroke: kFaint}),
      Plot.ruleX(rings, {x: "radius", y1: d => d.mean - d.spread, y2: d => d.mean + d.spread, stroke: "part"}),
      Plot.lineY(rings, {x: "radius", y: "mean", stroke: "part", marker: "dot"}),
    ],
  });
}
