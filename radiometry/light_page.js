// Haze and daylight: verdict, samples on their photographs, spectra, a cloudless sky's beside them.
"use strict";

const daylight = report.daylight, haze = report.haze;
const kSun = "#b4690e", kSky = "#2b5f8a", kAmbient = "#5a7d2b", kHazeInk = "#7a4f9a";
const percent = value => isKnown(value) ? `${value > 0 ? "+" : ""}${fixed(100 * value, 1)}` : "–";
const withSigma = (value, sigma, digits) =>
  isKnown(value) ? `${fixed(value, digits)}${isKnown(sigma) ? ` ± ${fixed(sigma, digits)}` : ""}` : "–";

// Whether a sample's residual is beyond what its sigma allows.
const isOff = sample => sample.sigmas > 3;

function showPhoto(parent, photo) {
  const margin = 6, width = 480, inner = width - 2 * margin;
  const on = list => list.filter(sample => sample.photo === photo.photo);
  const marks = [Plot.frame({stroke: "#b9c0c5"})];
  if (photo.thumbnail) {
    marks.push(Plot.image([photo], {x: (photo.width - 1) / 2, y: (photo.height - 1) / 2, src: "thumbnail",
      width: inner, height: inner * photo.height / photo.width, preserveAspectRatio: "none", opacity: 0.55}));
  }
  const dots = (samples, stroke, symbol) => [
    Plot.dot(samples, {x: "x", y: "y", r: 4, symbol, fill: "white", fillOpacity: 0.7,
      stroke: s => isOff(s) ? kFail : stroke, strokeWidth: 1.6}),
    Plot.text(samples.filter(s => isKnown(s.residual)), {x: "x", y: "y", dy: -9, text: s => percent(s.residual),
      fill: s => isOff(s) ? kFail : kInk, stroke: "white", strokeWidth: 3, fontSize: 9.5}),
  ];
  marks.push(...dots(on(report.daylight_samples), kSun, "circle"),
    ...dots(on(report.haze_samples), kHazeInk, "square"), ...dots(on(report.horizon_samples), kSky, "triangle"));
  const exposure = [
    isKnown(photo.time_s) ? (photo.time_s < 0.5 ? `1/${fixed(1 / photo.time_s, 0)} s` : `${photo.time_s} s`) : null,
    isKnown(photo.f_number) ? `f/${photo.f_number}` : null,
    isKnown(photo.iso) ? `ISO ${photo.iso}` : null].filter(isKnown).join(", ");
  plot(parent, `${photo.photo}${exposure ? ` (${exposure})` : ""}`, {
    width, height: Math.round(inner * photo.height / photo.width + 2 * margin), margin,
    x: {axis: null, domain: [-0.5, photo.width - 0.5]}, y: {axis: null, domain: [photo.height - 0.5, -0.5]},
    clip: true, marks});
}

function showSamples() {
  const node = section("Samples", "Round: daylight, square: haze, triangle: horizon. Numbers: residual in per " +
    "cent of what was measured; red: beyond three standard deviations.");
  const frames = plots(node, true);
  report.photos.forEach(photo => showPhoto(frames, photo));
  element(node, "h3", `Daylight: RMS ${fixed(daylight.rms_over_sigma, 1)} σ, condition ${fixed(daylight.condition, 1)}`);
  const place = [["photo", s => s.photo, "text"], ["x", s => s.x, 0], ["y", s => s.y, 0],
    ["polygon", s => s.polygon, "text"], ["material", s => s.material, "text"]];
  const residual = [["residual [%]", s => 100 * s.residual, 1], ["[σ]", s => s.sigmas, 1]];
  table(node, report.daylight_samples, [...place,
    ["radiance", s => s.radiance, 3],
    ["cosine to the sun", s => s.sun_cosine, 2],
    ["sky seen [%]", s => 100 * s.sky_share, 0],
    ["unseen around [%]", s => isKnown(s.unseen_share) ? 100 * s.unseen_share : null, 0], ...residual],
    {isFlagged: isOff});
  if (report.haze_samples.length === 0) return;
  element(node, "h3", `Haze: RMS ${fixed(haze.rms_over_sigma, 1)} σ`);
  table(node, report.haze_samples, [...place, ["distance [m]", s => s.distance_m, 1], ...residual],
    {isFlagged: isOff});
}

function showExposure() {
  const {photos, corner_falloff: falloff, corner_falloff_sigma: sigma} = report.exposure;
  if (photos.length < 2) return;
  const node = section("Exposure", "Linear values of each photograph over the site's unit, from surfaces that several show " +
    "and from EXIF. What differs by more than chance and 2 % is brought to the unit, in the montage back again.");
  table(node, photos, [
    ["photo", p => p.photo, "text"],
    ["shared points", p => p.points, 0],
    ["measured [EV]", p => withSigma(Math.log2(p.measured), p.sigma / Math.LN2, 3), "text"],
    ["by EXIF [EV]", p => isKnown(p.by_exif) ? Math.log2(p.by_exif) : null, 2],
    ["red", p => p.white_balance[0], 3], ["blue", p => p.white_balance[2], 3],
    ["applied", p => p.gain.every(g => g === 1) ? "–" : p.gain.map(g => fixed(g, 3)).join(" "), "text"]]);
  if (isKnown(falloff)) element(node, "p", `Corners beside centres: ${withSigma(100 * Math.expm1(falloff), 100 * sigma, 1)} %.`);
}

// A spectrum with the band of its standard deviation.
function spectrumPlot(parent, caption, light, color, unit) {
  const rows = light.spectrum.map((value, i) => ({nm: report.wavelengths_nm[i], value,
    low: value - light.sigma[i], high: value + light.sigma[i]}));
  plot(parent, caption, {height: 240, grid: true, x: {label: "wavelength [nm] →"}, y: {label: `↑ ${unit}`, zero: true},
    marks: [Plot.ruleY([0], {stroke: kFaint}),
      Plot.areaY(rows, {x: "nm", y1: "low", y2: "high", fill: color, fillOpacity: 0.2, curve: "step"}),
      Plot.line(rows, {x: "nm", y: "value", stroke: color, curve: "step"})]});
}

function showLight() {
  const node = section("Sun and sky", "One unit for all: 1 is white in the photographs. Band: ± one standard deviation.");
  const pair = plots(node, true);
  spectrumPlot(pair, "Sun, irradiance across its rays", daylight.sun, kSun, "irradiance");
  spectrumPlot(pair, "Open sky, radiance", daylight.sky, kSky, "radiance");
  const parts = [["sun, across its rays", daylight.sun], ["open sky", daylight.sky], ["surroundings", daylight.ambient]];
  table(node, parts, [
    ["light", p => p[0], "text"],
    ["luminance", p => withSigma(p[1].luminance, p[1].luminance_sigma, 3), "text"],
    ["colour temperature [K]", p => withSigma(p[1].kelvin, p[1].kelvin_sigma, 0), "text"],
    ["from the black body's [Δuv]", p => p[1].duv, 4]]);
  element(node, "p", "No temperature: bluer than any black body, or too far from all of them.", "faint");
  if (!daylight.clear_skies) return;
  element(node, "h3", `Sun : sky on the level is ${withSigma(daylight.sun_to_sky, daylight.sun_to_sky_sigma, 2)}` +
    `, the sun standing ${fixed(daylight.sun_elevation_deg, 1)}° high`);
  element(node, "p", "What cloudless skies give at that height of the sun [Bird, Riordan 1986]:", "faint");
  table(node, daylight.clear_skies, [
    ["aerosol optical depth at 500 nm", s => s.aerosol_depth, 2],
    ["sun : sky", s => s.sun_to_sky, 2],
    ["sun [K]", s => s.sun_kelvin, 0],
    ["sky [K]", s => s.sky_kelvin, 0]]);
}

function showHaze() {
  const node = section("Haze");
  if (!haze) return element(node, "p", "No haze samples: the air is taken as clear.");
  const km = metres => isKnown(metres) ? `${(metres / 1000).toPrecision(3)} km` : "no end";
  element(node, "p", `Meteorological range (contrast down to 2 %) ${km(haze.range_m)}, between ` +
    `${km(haze.range_from_m)} and ${km(haze.range_to_m)} within one standard deviation; extinction ` +
    `${withSigma(1000 * haze.extinction_per_m, 1000 * haze.extinction_sigma_per_m, 3)} per km at 555 nm.`);
  plot(plots(node), "What is left over 200 m", {height: 220, grid: true,
    x: {label: "wavelength [nm] →"}, y: {label: "↑ transmittance", domain: [0, 1]},
    marks: [Plot.line(haze.transmittance_per_m.map((tau, i) => [report.wavelengths_nm[i], tau ** 200]),
      {stroke: kHazeInk, curve: "step"})]});
}

function showClipped() {
  if (report.clipped.length === 0) return;
  const node = section("Clipped", "Share of each polygon's pixels at the photograph's highest code. What they reflect " +
    "is known to be at least what is seen: changes of light there are bounds.");
  longTable(node, report.clipped, [
    ["polygon", c => c.polygon, "text"],
    ["photo", c => c.photo, "text"],
    ["clipped [%]", c => 100 * c.share, 1]]);
}

function showAdvice() {
  const node = section("A further sample");
  if (report.advice.length === 0) return element(node, "p", "None would tell much more.");
  const list = element(node, "ul");
  report.advice.forEach(text => element(list, "li", text));
}

const verdict = structuredClone(report.verdict);
if (verdict.reasons.length === 0) {
  verdict.reasons.push({severity: "pass", reason: "Samples agree within what they are known to; sun, sky and haze are told apart."});
}
showVerdict(verdict);
showSamples();
showExposure();
showLight();
showHaze();
showClipped();
showAdvice();
