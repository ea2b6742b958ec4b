// Data snooping, reliability, and the distribution of the test values.

const unitOf = o => /^(image|edge)/.test(o.group) ? "px" : o.group === "angle" ? "rad" :
  o.group === "lens" ? "σ" : "m";

const kObservationColumns = [
  ["observation", o => o.observation, "long"],
  ["observed", o => o.observed, 3],
  ["residual", o => o.residual, 4],
  ["σ", o => o.sigma, 4],
  ["unit", unitOf, "text"],
  ["redundancy", o => o.redundancy, 3],
  ["w", o => o.w, 2],
  ["detectable", o => o.detectable, 3],
  ["external", o => o.external, 1],
  ["moves point mm", o => isKnown(o.point_shift_m) ? 1000 * o.point_shift_m : null, 1],
];

function showSnooping() {
  const o = report.observations;
  const node = section("Observations", "w: residual over its own σ. Detectable: the smallest error that " +
    "the test finds with 80 % power. External: what an error just not found does to any result, in that " +
    "result's σ; and to the point concerned, in mm.");
  element(node, "p", `${o.flagged} of ${o.controlled} controlled observations have |w| over ` +
    `${fixed(o.critical_w, 2)}; without any error ${fixed(o.flagged_by_chance, 1)} would by chance.`);
  if (o.suspect) {
    element(node, "p", `Suspect: ${o.suspect.observation}, w ${fixed(o.suspect.w, 1)}. To do: ` +
      `${o.suspect.advice}. One at a time: an error spoils its neighbours' residuals. Nothing was deleted.`)
      .style.color = kFail;
  }
  histogram(plots(node));
  element(node, "h3", `The ${o.largest_w.length} largest test values`);
  table(node, o.largest_w, kObservationColumns, {isFlagged: row => Math.abs(row.w) > o.critical_w});
  const flagged = o.largest_w.filter(row => row.advice);
  if (flagged.length > 0) {
    element(node, "h3", "What to look at, in this order");
    table(node, flagged, [
      ["observation", row => row.observation, "long"], ["w", row => row.w, 1],
      ["to do", row => row.advice, "long"]]);
  }
  if (o.weakly_controlled > 0) {
    element(node, "h3", "Hardly controlled");
    element(node, "p", `${o.weakly_controlled} observations have a redundancy number below ` +
      `${o.weak_limit}: others hardly control them, and an error in them would not show.`);
    table(folded(node, `the ${o.least_controlled.length} least controlled`), o.least_controlled,
      kObservationColumns);
  }
  element(node, "p", `All ${o.count} observations are in observations.csv beside this report.`, "faint");
}

function histogram(parent) {
  const h = report.histogram;
  if (h.total === 0) return;
  const bins = h.counts.map((n, i) => ({n, x1: h.low + i * h.step, x2: h.low + (i + 1) * h.step}));
  const normal = d3.range(h.low, -h.low + 0.05, 0.1).map(w =>
    ({w, n: h.total * h.step * Math.exp(-w * w / 2) / Math.sqrt(2 * Math.PI)}));
  const outside = h.below + h.above;
  plot(parent, `${h.total} test values against the standard normal that they should follow` +
    (outside > 0 ? `; ${outside} outside` : ""), {
    height: 280, x: {label: "w"}, y: {label: "observations", grid: true},
    marks: [
      Plot.rectY(bins, {x1: "x1", x2: "x2", y: "n", fill: "#a9c3d9", inset: 0.5}),
      Plot.line(normal, {x: "w", y: "n", stroke: kInk}),
      Plot.ruleX([-1, 1].map(s => s * report.observations.critical_w), {stroke: kFail, strokeDasharray: "3,3"}),
      Plot.ruleY([0]),
    ],
  });
}
