// What the adjustment's uncertainty does to a montage.

function showMontage() {
  const node = section("What it means for the montage", "How far a point that is not part of the survey, " +
    "such as a corner of the planned building, may be drawn beside its place: one σ, the ellipse's " +
    "semi-axes in pixels, and the longer one in mm at the point. The points are report_points of " +
    "site.json, else, until there is a building, the corners of the box around the surveyed walls.");
  const rows = report.montage.flatMap(p => p.views.map(v => ({name: p.name, ...v})));
  if (rows.length === 0) return element(node, "p", "No points were given.", "faint");
  const photos = report.photos.map(p => ({photo: p.photo, seen: rows.filter(r => r.photo === p.photo)}));
  table(node, photos, [
    ["photo", p => p.photo, "text"],
    ["points", p => p.seen.length, 0],
    ["largest σ px", p => d3.max(p.seen, r => r.sigma_major_px), 2],
    ["median σ px", p => d3.median(p.seen, r => r.sigma_major_px), 2],
    ["largest σ mm", p => d3.max(p.seen, r => r.sigma_mm), 1],
  ]);
  longTable(node, rows, [
    ["point", r => r.name, "text"],
    ["photo", r => r.photo, "text"],
    ["x px", r => r.pixel[0], 1],
    ["y px", r => r.pixel[1], 1],
    ["σ major px", r => r.sigma_major_px, 2],
    ["σ minor px", r => r.sigma_minor_px, 2],
    ["σ mm", r => r.sigma_mm, 1],
  ]);
}
