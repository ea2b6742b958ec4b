// Which spectra stand behind colours: the diagram, basis functions, metamers, the round trip.
"use strict";

const spaceInks = ["#a4262c", "#2b5f8a", "#5a7d2b", "#7a4f9a"];
const primaryInks = {red: "#b02a2a", green: "#2f7d32", blue: "#2450a4"};
const edges = report.edges_nm;

const spaceColors = {domain: report.spaces.map(space => space.name), range: spaceInks};

// A spectrum of bins as the points of its steps.
const steps = spectrum => spectrum.flatMap((value, i) => [[edges[i], value], [edges[i + 1], value]]);

function showDiagram() {
  const node = section("Chromaticities", "The spectrum locus with its wavelengths, the triangles of four RGB " +
    "spaces with their white points, and the colour asked for.");
  const locus = report.locus.map(color => ({nm: color.nm, x: color.xy[0], y: color.xy[1]}));
  const triangles = report.spaces.flatMap(space => ["red", "green", "blue", "red"]
    .map(corner => ({space: space.name, x: space[corner][0], y: space[corner][1]})));
  const whites = report.spaces.map(space => ({space: space.name, x: space.white[0], y: space.white[1]}));
  node.append(Plot.legend({color: spaceColors}));
  plot(plots(node, true), "CIE 1931", {width: 640, height: 680, grid: true,
    x: {domain: [0, 0.8], label: "x →"}, y: {domain: [0, 0.9], label: "↑ y"},
    color: spaceColors,
    marks: [
      Plot.line([...locus, locus[0]], {x: "x", y: "y", stroke: kInk}),
      Plot.text(locus.filter(color => color.nm % 20 === 0 && color.nm >= 460 && color.nm <= 620),
        {x: "x", y: "y", text: color => `${color.nm}`, dx: 14, dy: -6, fontSize: 9, fill: kFaint}),
      Plot.line(triangles, {x: "x", y: "y", stroke: "space", z: "space", strokeWidth: 1.6}),
      Plot.dot(whites, {x: "x", y: "y", stroke: "space", r: 4, symbol: "plus"}),
      Plot.dot([report.color.xy], {x: point => point[0], y: point => point[1], fill: kInk, r: 4}),
    ]});
}

function basisMarks(bases, branch, dash) {
  return bases.filter(basis => isKnown(basis[branch])).map(basis => Plot.line(steps(basis[branch].spectrum),
    {x: point => point[0], y: point => point[1], stroke: primaryInks[basis.primary], strokeWidth: 1.8,
      strokeDasharray: dash}));
}

function showBases() {
  const node = section("Basis functions", "Solid: the non-negative solution with the lowest peak. Dashed: the box " +
    "with two transitions that comes nearest, which counts only where there is no solution.");
  const frames = plots(node);
  report.spaces.forEach(space => plot(frames, space.name, {width: 420, height: 260, grid: true,
    x: {domain: [380, 780], label: "wavelength [nm] →"}, y: {label: "↑ radiance", zero: true},
    marks: [...basisMarks(space.bases, "box", "3 3"), ...basisMarks(space.bases, "exact")]}));
  const rows = report.spaces.flatMap(space => space.bases.map(basis => ({...basis, space: space.name})));
  const used = basis => basis.exact ?? basis.box;
  table(node, rows, [
    ["space", b => b.space, "text"],
    ["primary", b => b.primary, "text"],
    ["found by", b => isKnown(b.exact) ? "solution" : "nearest box", "text"],
    ["λ₂ [nm]", b => used(b).transitions_nm[0], 1],
    ["λ₃ [nm]", b => used(b).transitions_nm[1], 1],
    ["c₁", b => used(b).weights[0], 4],
    ["c₂", b => used(b).weights[1], 4],
    ["c₃", b => used(b).weights[2], 4],
    ["off in XYZ", b => used(b).off, 4],
    ["nearest box off", b => b.box.off, 4]],
    {isFlagged: b => !isKnown(b.exact)});
}

function showMetamers() {
  const rgb = report.color.rgb.map(value => fixed(value, 3)).join(", ");
  const node = section("Metamers", `Spectra of one colour, ${rgb} of ${report.color.space} (linear): different ` +
    "in light, the same to the eye.");
  const points = report.metamers.flatMap(metamer => steps(metamer.spectrum)
    .map(([x, y]) => ({x, y, space: metamer.space})));
  node.append(Plot.legend({color: spaceColors}));
  plot(plots(node, true), "by the basis of each space", {width: 640, height: 320, grid: true,
    x: {domain: [380, 780], label: "wavelength [nm] →"}, y: {label: "↑ radiance", zero: true},
    color: spaceColors,
    marks: [Plot.ruleY([0]), Plot.line(points, {x: "x", y: "y", stroke: "space", z: "space", strokeWidth: 1.6})]});
  table(node, report.metamers, [
    ["space", m => m.space, "text"],
    ["red", m => m.rgb[0], 4],
    ["green", m => m.rgb[1], 4],
    ["blue", m => m.rgb[2], 4],
    ["in its triangle", m => m.is_inside ? "yes" : "no: the spectrum may be negative", "text"]],
    {isFlagged: m => !m.is_inside});
}

function showRoundTrip() {
  const node = section("Round trip", "RGB to spectrum and back, over 4912 colours of each space.");
  table(node, report.spaces, [
    ["space", s => s.name, "text"],
    ["worst error of a channel", s => s.round_trip.worst.toExponential(1), "text"],
    ["lowest radiance [% of the peak]", s => 100 * s.round_trip.lowest, 2]],
    {isFlagged: s => s.round_trip.lowest < -1e-9});
}

showDiagram();
showBases();
showMetamers();
showRoundTrip();
