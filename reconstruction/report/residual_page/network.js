// The network in plan and elevation: photos, points, polygons, standard ellipses, and control.

// Views: where a position and a covariance go in a drawing about the origin shift.
function networkViews() {
  const shift = report.identity.origin_shift_m;
  // The elevation looks along the photos' mean line of sight: its x axis is their mean right.
  const right = [0, 1].map(i => d3.sum(report.photos, p => p.cam_from_world_rotation[0][i]));
  const length = norm(right);
  const across = length > 0.1 * report.photos.length ? right.map(v => v / length) : [1, 0];
  const label = (axis, offset) => offset === 0 ? `${axis} [m]` : `${axis} − ${offset} [m]`;
  const view = (name, rows, labels) => ({name, labels,
    of: x => rows.map(row => d3.sum(row, (r, i) => r * (x[i] - shift[i]))),
    turn: v => rows.map(row => d3.sum(row, (r, i) => r * v[i])),
    covariance: c => rows.map(a => rows.map(b =>
      d3.sum(a, (ai, i) => ai * d3.sum(b, (bk, k) => bk * c[i][k]))))});
  return [
    view("plan", [[1, 0, 0], [0, 1, 0]], [label("x", shift[0]), label("y", shift[1])]),
    view("elevation, along the photos' mean line of sight", [[...across, 0], [0, 0, 1]],
      ["across [m]", label("z", shift[2])]),
  ];
}

// The outline of a standard ellipse, `enlarged` times.
function ellipse(center, [[a, b], [, c]], enlarged, name) {
  const mean = (a + c) / 2, half = Math.hypot((a - c) / 2, b), angle = Math.atan2(2 * b, a - c) / 2;
  const major = Math.sqrt(Math.max(mean + half, 0)), minor = Math.sqrt(Math.max(mean - half, 0));
  return d3.range(0, 33).map(i => {
    const u = enlarged * major * Math.cos(i * Math.PI / 16), v = enlarged * minor * Math.sin(i * Math.PI / 16);
    return {name, x: center[0] + u * Math.cos(angle) - v * Math.sin(angle),
      y: center[1] + u * Math.sin(angle) + v * Math.cos(angle)};
  });
}

const placed = (view, position, more = {}) => {
  const [x, y] = view.of(position);
  return {x, y, ...more};
};

// A drawing at equal scales whose frame holds all of `rows`.
function mapPlot(parent, caption, view, rows, marks) {
  const width = 640, pad = 0.06;
  const range = key => {
    const [low, high] = d3.extent(rows, key);
    return [low - pad * (high - low) - 1e-3, high + pad * (high - low) + 1e-3];
  };
  let [x, y] = [range(r => r.x), range(r => r.y)];
  const scale = Math.max(x[1] - x[0], (y[1] - y[0]) / 0.9), middle = (y[0] + y[1]) / 2;
  const share = Math.max((y[1] - y[0]) / scale, 0.3);
  x = [(x[0] + x[1] - scale) / 2, (x[0] + x[1] + scale) / 2];
  y = [middle - share * scale / 2, middle + share * scale / 2];
  plot(parent, caption, {
    width, height: Math.round((width - 60) * share + 60), marginLeft: 50, marginRight: 10, marginTop: 25,
    marginBottom: 35, grid: true, clip: true, x: {domain: x, label: view.labels[0]}, y: {domain: y, label: view.labels[1]},
    marks: marks(x, y, scale),
  });
}

function polygonLines(view) {
  const position = new Map(report.points.map(p => [p.name, p.position]));
  return report.polygons.flatMap(polygon => d3.groups(polygon.vertices, v => v.hole ?? 0).flatMap(([hole, ring]) =>
    [...ring, ring[0]].filter(v => position.has(v.name)).map(v => placed(view, position.get(v.name), {name: `${polygon.name} ${hole || ""}`}))));
}

function showNetwork() {
  if (report.photos.length === 0) return;
  const node = section("Network", "Photos (red) with their lines of sight, points and polygons, standard " +
    "ellipses enlarged; tie points, where there are any, thinned out in grey.");
  const parent = plots(node, true);
  for (const view of networkViews()) networkPlot(parent, view);
}

function networkPlot(parent, view) {
  const photos = report.photos.map(p => placed(view, p.center, {name: p.photo, photo: p}));
  const points = report.points.map(p => placed(view, p.position, p));
  const tie = report.tie_points.shown.map(x => placed(view, x));
  const rows = [...photos, ...points, ...tie];
  const size = Math.max(d3.max(rows, r => r.x) - d3.min(rows, r => r.x), d3.max(rows, r => r.y) - d3.min(rows, r => r.y));
  const sigma = d3.quantile(report.points, 0.75, p => norm(p.sigma_m));
  const enlarged = sigma > 0 ? roundBelow(0.02 * size / sigma) : 0;
  const ellipses = [
    ...points.map(p => ellipse([p.x, p.y], view.covariance(p.covariance_m2), enlarged, "point " + p.name)),
    ...photos.map(p => ellipse([p.x, p.y], view.covariance(p.photo.covariance.slice(3).map(r => r.slice(3))),
      enlarged, "photo " + p.name))].flat();
  const sights = photos.map(p => {
    const [dx, dy] = view.turn(p.photo.cam_from_world_rotation[2]);
    return {x: p.x, y: p.y, vx: dx, vy: dy};
  });
  const bar = enlarged ? roundBelow(0.15 * size / enlarged) : 0;
  mapPlot(parent, `${view.name}; ellipses enlarged ${enlarged} times`, view, rows, (x, y, scale) => [
    Plot.dot(tie, {x: "x", y: "y", r: 0.7, fill: "#aab3b9"}),
    Plot.line(polygonLines(view), {x: "x", y: "y", z: "name", stroke: "#9aa5ad", strokeWidth: 0.8}),
    Plot.dot(points, {x: "x", y: "y", r: 1.3, fill: kInk}),
    Plot.line(ellipses, {x: "x", y: "y", z: "name", stroke: d => d.name.startsWith("photo ") ? kFail : kAccent}),
    vectors(sights, 0.06 * scale, {stroke: kFail}),
    Plot.dot(photos, {x: "x", y: "y", r: 2.5, fill: kFail}),
    Plot.text(photos, {x: "x", y: "y", text: "name", dy: 10, fill: kFail, stroke: "white"}),
    ...(enlarged ? scaleBar(x[0] + 0.03 * scale, y[0] + 0.03 * scale, bar * enlarged,
      `σ ${+(1000 * bar).toPrecision(3)} mm`) : []),
  ]);
}

function showControlVectors() {
  const kinds = [["control", report.control, kAccent], ["check", report.check, kFail],
    ...(report.check.points.length ? [] : [["control left out", report.left_out, "#b5651d"]])];
  const all = kinds.flatMap(([kind, comparison, color]) =>
    comparison.points.map(p => ({...p, kind, color})));
  if (all.length === 0) return;
  const parent = plots(section("Differences at control and check points", "From the surveyed to the " +
    "adjusted position, enlarged. Blue: control; red: check; brown: control points left out one at a time."), true);
  const length = d3.quantile(all, 0.9, p => p.space_m);
  const isNamed = p => all.length <= 25 || p.kind === "check" || p.over_sigma > 3;
  for (const view of networkViews()) {
    const rows = all.map(p => {
      const [vx, vy] = view.turn(p.difference_m);
      return placed(view, p.surveyed, {vx, vy, name: isNamed(p) ? p.name : "", color: p.color});
    });
    const outline = polygonLines(view);
    const frame = [...rows, ...outline];
    const size = d3.max(frame, r => r.x) - d3.min(frame, r => r.x) || 1;
    const enlarged = length > 0 ? roundBelow(0.05 * size / length) : 0;
    const bar = enlarged ? roundBelow(0.15 * size / enlarged) : 0;
    mapPlot(parent, `${view.name}; differences enlarged ${enlarged} times`, view, frame, (x, y, scale) => [
      Plot.line(outline, {x: "x", y: "y", z: "name", stroke: "#c9d0d4", strokeWidth: 0.8}),
      Plot.dot(rows, {x: "x", y: "y", r: 2, fill: "color"}),
      vectors(rows, enlarged, {stroke: "color"}),
      Plot.text(rows, {x: "x", y: "y", text: "name", dy: -8, fontSize: 9, fill: kFaint, stroke: "white"}),
      ...(enlarged ? scaleBar(x[0] + 0.03 * scale, y[0] + 0.03 * scale, bar * enlarged,
        `${+(1000 * bar).toPrecision(3)} mm`) : []),
    ]);
  }
}
