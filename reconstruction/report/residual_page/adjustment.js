// The adjustment as a whole: figures, groups, correlations; what it was made from.

function showSummary() {
  const s = report.summary, test = s.global_test, node = section("Adjustment");
  if (report.page_note) element(node, "p", report.page_note);
  const unknowns = Object.entries(s.unknowns_of).map(([what, n]) => `${n} of ${what}`).join(", ");
  element(node, "p", `${s.observations} observations, ${s.unknowns} unknowns` +
    `${unknowns ? ` (${unknowns})` : ""}, datum defect ${s.datum_defect}, redundancy ${s.redundancy}; ${count(s.iterations, "iteration")}, ${s.termination}. ` +
    `The datum is ${s.datum || "not stated"}.` + datumWorth(s.datum_worth));
  element(node, "p", `σ0 ${fixed(s.sigma0, 4)} a posteriori (1 a priori), ${fixed(s.sigma0_px, 3)} px ` +
    `in the images; RMS of the residuals of ${count(s.marks, "mark")} ${fixed(s.image_rms_px, 3)} px. ` +
    `Median σ of a vertex coordinate ${fixed(1000 * s.vertex_sigma_m, 1)} mm.`);
  if (!test) element(node, "p", "No redundancy: there is nothing to test.");
  else element(node, "p", `Global test (χ², α ${test.alpha}): Ω = vᵀPv = ${fixed(test.statistic, 1)}, ` +
    `accepted from ${fixed(test.low, 1)} to ${fixed(test.high, 1)}, p ${fixed(test.p, 4)}: ` +
    `${test.is_met ? "met" : "not met"}.`);
  table(node, report.groups, [
    ["group of observations", g => g.group, "text"],
    ["number", g => g.count, 0],
    ["redundancy", g => g.redundancy, 1],
    ["σ0 of the group", g => g.sigma0, 3],
  ]);
  element(node, "p", "σ0 of a group: by what factor its σ would have to change to agree with its " +
    "residuals (variance component).", "faint");
}

function showCorrelations() {
  const node = section("Correlations above 0.95");
  if (report.correlations.length === 0) return element(node, "p", "None within a photo, camera or point.");
  longTable(node, report.correlations, [
    ["unknown", c => c.first, "text"],
    ["with", c => c.second, "text"],
    ["correlation", c => c.value, 4],
  ]);
}

function showIdentity() {
  const id = report.identity, node = section("Identity",
    "What this report was made from. The same files and options give the same bytes.");
  if (id.command) element(node, "p", id.command);
  table(node, Object.entries(id.software), [["software", s => s[0], "text"], ["version", s => s[1], "text"]]);
  table(node, Object.entries(id.options), [
    ["option", o => o[0], "text"], ["value", o => String(o[1]), "text"]]);
  element(node, "p", `Coordinates: ${id.coordinate_system} (${id.origin_shift_m.join(", ")}). ` +
    `Robust loss: ${id.robust_loss}. Random seed: nothing is random.`);
  if (id.inputs.length === 0) return element(node, "p", "The input files were not stated.", "faint");
  longTable(node, id.inputs, [["file", f => f.file, "long"], ["SHA-256", f => f.sha256, "long"]]);
}

function showConventions() {
  const node = section("Conventions");
  table(node, Object.entries(report.conventions), [
    ["what", c => c[0].replaceAll("_", " "), "text"], ["convention", c => c[1], "long"]]);
}

// What scale, plumb, north and height are worth, in per cent of a building's size.
function datumWorth(worth) {
  if (!worth) return "";
  const degrees = radians => `${+(180 / Math.PI * radians).toPrecision(2)}°`;
  const percent = share => `${+(100 * share).toPrecision(2)} %`;
  const say = (what, sigma, words) => `${what} ${isKnown(sigma) ? words(sigma) : "unknown"}`;
  const turned = sigma => `to ${degrees(sigma)} (${percent(sigma)})`;
  return " Were the network rigid, what holds it is worth: " + [
    say("scale", worth.scale, sigma => `to ${percent(sigma)}`),
    say("plumb", worth.tilt_rad, turned), say("north", worth.heading_rad, turned),
    say("height", worth.height_m, sigma => `to ${+sigma.toPrecision(2)} m`)].join(", ") +
    "; in per cent of a building's size.";
}

// Where nothing gives the scale, what is told in metres elsewhere is told in units.
function nameUnit() {
  if (report.summary.unit !== "arbitrary") return;
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const node = texts.currentNode;
    if (node.parentElement.closest("script, style")) continue;
    node.data = node.data.replace(/\bmm\b(?!\/m)/g, "unit/1000").replace(/(\d) m\b(?!\/)/g, "$1 units");
  }
}
