// Planes: how flat, how plumb, how square; areas and edges; sun and zenith.

const slope = s => s ? `${fixed(s.mm_per_m, 2)} ± ${fixed(s.sigma_mm_per_m, 2)}` : "–";

function showPolygons() {
  const polygons = report.polygons;
  if (polygons.length === 0) return;
  const node = section("Polygons", "Plumb: tilt of a wall out of the zenith; level: of a floor.");
  longTable(node, polygons, [
    ["polygon", p => p.name, "text"],
    ["photo", p => p.photo, "text"],
    ["material", p => p.material, "text"],
    ...kAxes.map((axis, i) => [`normal ${axis}`, p => p.normal[i], 5]),
    ["σ offset mm", p => isKnown(p.offset_sigma_m) ? 1000 * p.offset_sigma_m : null, 1],
    ["planarity RMS mm", p => p.planarity_rms_mm, 1],
    ["off plumb mm/m", p => slope(p.verticality), "text"],
    ["off level mm/m", p => slope(p.levelness), "text"],
    ["area m²", p => p.area.m2, 3],
    ["σ m²", p => p.area.sigma_m2, 3],
  ], {}, 40);
  planarityPlot(node, polygons);
  const vertices = polygons.flatMap(p => p.vertices.filter(v => isKnown(v.off_plane_mm))
    .map(v => ({polygon: p.name, ...v})));
  const critical = report.observations.critical_w;
  const fold = folded(node, `distances of ${vertices.length} vertices from their planes`);
  table(fold, vertices, [
    ["polygon", v => v.polygon, "text"],
    ["vertex", v => v.name, "text"],
    ["off plane mm", v => v.off_plane_mm, 2],
    ["σ mm", v => v.off_plane_sigma_mm, 2],
    ["w", v => v.w, 2],
  ], {isFlagged: v => Math.abs(v.w) > critical, isNarrow: true});
  const edges = polygons.flatMap(p => p.edges.map(e => ({polygon: p.name, ...e})));
  table(folded(node, count(edges.length, "edge")), edges, [
    ["polygon", e => e.polygon, "text"],
    ["from", e => e.from, "text"],
    ["to", e => e.to, "text"],
    ["length m", e => e.m, 4],
    ["σ mm", e => 1000 * e.sigma_m, 1],
  ], {isNarrow: true});
  const bases = [...new Set(polygons.map(p => p.sigma_basis))];
  element(node, "p", `σ of areas and lengths: ${bases.join("; ")}.`, "faint");
}

// The polygons that fit their planes worst, a dot a vertex.
function planarityPlot(parent, polygons, shown = 40) {
  const worst = polygons.filter(p => isKnown(p.planarity_rms_mm))
    .sort((a, b) => b.planarity_rms_mm - a.planarity_rms_mm).slice(0, shown);
  if (worst.length === 0) return;
  const vertices = worst.flatMap(p => p.vertices.filter(v => isKnown(v.off_plane_mm))
    .map(v => ({polygon: p.name, ...v})));
  const critical = report.observations.critical_w;
  const color = v => Math.abs(v.w) > critical ? kFail : kAccent;
  const caption = "distance of vertices from their plane with σ, worst polygons first" +
    (polygons.length > shown ? ` (${shown} of ${polygons.length})` : "");
  plot(plots(parent, true), caption, {
    width: 640, height: 60 + 16 * worst.length, marginLeft: 130, grid: true,
    x: {label: "off plane [mm]"}, y: {domain: worst.map(p => p.name), label: null},
    marks: [
      Plot.ruleX([0], {stroke: kFaint}),
      Plot.ruleY(vertices, {y: "polygon", x1: v => v.off_plane_mm - v.off_plane_sigma_mm,
        x2: v => v.off_plane_mm + v.off_plane_sigma_mm, stroke: color, strokeOpacity: 0.5}),
      Plot.dot(vertices, {x: "off_plane_mm", y: "polygon", r: 2.5, fill: color}),
    ],
  });
}

function showPlaneEffect() {
  const effect = report.plane_effect, test = effect.test;
  if (report.polygons.length === 0) return;
  const node = section("With and without planes", "The same network solved again without its planes. " +
    "σ and w are along the axis that the planes hold most; without an error in them w is standard normal.");
  if (effect.unknown_because) return element(node, "p", `Not compared: ${effect.unknown_because}.`, "faint");
  element(node, "p", `Without planes: σ0 ${fixed(effect.sigma0_without, 4)}, redundancy ` +
    `${effect.redundancy_without}. The planes add ${fixed(test.statistic, 1)} to vᵀPv; if they hold, ` +
    `${test.degrees} are expected and at most ${fixed(test.limit, 1)} (χ², α ${test.alpha}): ` +
    `${test.is_met ? "they hold" : "they do not all hold"}.`);
  const size = s => norm(s.difference_m), critical = report.observations.critical_w;
  longTable(node, [...effect.shifts].sort((a, b) => size(b) - size(a)), [
    ["point or camera", s => s.name, "text"],
    ...kAxes.map((axis, i) => [`moved ${axis} mm`, s => 1000 * s.difference_m[i], 1]),
    ["in space mm", s => 1000 * size(s), 1],
    ["σ mm", s => isKnown(s.sigma_m) ? 1000 * s.sigma_m : null, 1],
    ["w", s => s.w, 2],
  ], {isFlagged: s => Math.abs(s.w) > critical});
  if (effect.held_by_planes.length === 0) return;
  element(node, "p", "On fewer than two photos, therefore held by planes and constraints alone and not " +
    `compared: ${effect.held_by_planes.join(", ")}.`);
}

function showAdjoining() {
  const pairs = report.adjoining_polygons;
  if (pairs.length === 0) return;
  const node = section("Adjoining polygons", "Angles between outward normals of polygons that share an " +
    "edge; σ takes their planes as independent.");
  longTable(node, pairs, [
    ["polygon", p => p.first, "text"],
    ["adjoins", p => p.second, "text"],
    ["angle °", p => p.angle_deg, 4],
    ["σ °", p => p.sigma_deg, 4],
    ["off square mm/m", p => slope(p.perpendicularity), "text"],
  ], {isNarrow: true});
}

function showDirections() {
  const known = Object.entries(report.directions).filter(([, d]) => d !== null);
  const node = section("Directions");
  table(node, known, [
    ["direction", d => d[0], "text"],
    ...kAxes.map((axis, i) => [axis, d => d[1].unit[i], 6]),
    ["azimuth °", d => d[1].azimuth_deg, 3],
    ["elevation °", d => d[1].elevation_deg, 3],
    ["pairs", d => d[1].pairs, 0],
    ["σ °", d => d[1].sigma_deg, 4],
  ]);
  if (report.directions.sun === null) element(node, "p", "No sun pairs: overcast sky.", "faint");
}
