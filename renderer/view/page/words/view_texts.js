// SPDX-License-Identifier: GPL-3.0-or-later
// Every text of the viewing page: English, German (Swiss).

/** @type {Record<string, [string, string]>} */
export const kTexts = {
  photo: ["Photo", "Foto"],
  kind_photo: ["photograph", "Fotografie"],
  kind_input: ["photograph without distortion", "Fotografie ohne Verzeichnung"],
  kind_montage: ["montage", "Montage"],
  kind_unfinished: ["being rendered", "in Berechnung"],
  kind_difference: [
    "difference × 8 (black: the same bit for bit)",
    "Differenz × 8 (schwarz: Bit für Bit gleich)"
  ],
  layer_photograph: ["layer: share of the photograph", "Ebene: Anteil der Fotografie"],
  layer_computed: ["layer: computed share", "Ebene: berechneter Anteil"],
  layer_front: ["layer: in front", "Ebene: davor"],
  layer_sunlit: ["layer: sun that arrives", "Ebene: Sonne, die ankommt"],
  layer_unseen: ["layer: seen by no photograph", "Ebene: von keiner Fotografie gesehen"],
  part: ["layer: {name}", "Ebene: {name}"],
  variant: ["variant {name}", "Variante {name}"],
  hour: ["at {name}", "um {name}"],
  left: ["left, before", "links, vorher"],
  right: ["right, after", "rechts, nachher"],
  compare: ["Compare", "Vergleichen"],
  mode_side: ["side by side", "nebeneinander"],
  mode_slider: ["slider", "Schieber"],
  mode_flicker: ["flicker", "Wechsel"],
  before: ["before", "vorher"],
  after: ["after", "nachher"],
  split: ["border between before and after", "Grenze zwischen vorher und nachher"],
  outline: ["outline ± 2 σ", "Umriss ± 2 σ"],
  outlineUnknown: [
    "outline without σ: the adjustment tells no covariances",
    "Umriss ohne σ: die Ausgleichung nennt keine Kovarianzen"
  ],
  outlineNone: ["no outline: {why}", "kein Umriss: {why}"],
  outlineSigma: [
    "outline: σ of its corners up to {most} px",
    "Umriss: σ seiner Ecken bis {most} px"
  ],
  difference: ["difference", "Differenz"],
  differs: [
    "{n} pixels differ ({share} %), by {most} codes at most",
    "{n} Pixel verschieden ({share} %), höchstens um {most} Stufen"
  ],
  otherGrid: [
    "these two pictures have different pixel grids",
    "diese zwei Bilder haben verschiedene Pixelraster"
  ],
  noPicture: ["no such picture yet", "dieses Bild gibt es noch nicht"],
  renders: ["Renders", "Berechnungen"],
  render: ["render", "berechnen"],
  resume: ["go on", "weiter"],
  again: ["again", "neu"],
  stop: ["stop", "anhalten"],
  quality: ["quality", "Güte"],
  quality_fast: ["fast: a quick look", "schnell: ein rascher Blick"],
  quality_draft: ["draft", "Entwurf"],
  quality_final: ["final", "endgültig"],
  state_running: ["running", "läuft"],
  state_waiting: ["stopped", "angehalten"],
  state_none: ["", ""],
  tiles: ["{done} of {total} tiles", "{done} von {total} Kacheln"],
  unfinished: ["not rendered yet", "noch nicht berechnet"],
  hatched: ["hatched: not rendered yet", "schraffiert: noch nicht berechnet"],
  clipped: ["clipped", "überbelichtet"],
  linear: ["linear", "linear"],
  encoded: ["sRGB", "sRGB"],
  share: ["share", "Anteil"],
  runEnded: ["{photo}: rendered", "{photo}: berechnet"],
  runStopped: [
    "{photo}: stopped; what is rendered is kept",
    "{photo}: angehalten; was berechnet ist, bleibt"
  ],
  runFailed: ["{photo}: failed: {why}", "{photo}: gescheitert: {why}"],
  cannotLoad: ["Cannot load the site: {why}", "Der Ort kann nicht geladen werden: {why}"],
  noToken: [
    "This address has no valid token. Open the one that insitu view printed.",
    "Diese Adresse hat kein gültiges Token. Öffne die von insitu view ausgegebene."
  ],
  serverGone: [
    "insitu view does not answer: is it still running?",
    "insitu view antwortet nicht: läuft es noch?"
  ],
  help: ["keys", "Tasten"],
  close: ["close", "schliessen"],
  language: ["language", "Sprache"],
  stageLabel: [
    "{photo}: {left} and {right}; arrows move the cursor",
    "{photo}: {left} und {right}; Pfeile bewegen den Zeiger"
  ],
  key: ["key", "Taste"],
  does: ["does", "Wirkung"],
  key_side: ["side by side", "nebeneinander"],
  key_slider: ["slider before/after", "Schieber vorher/nachher"],
  key_flicker: ["before/after in place, each time", "vorher/nachher am Ort, jedes Mal"],
  key_auto: ["flicker by itself", "von selbst wechseln"],
  key_splitLeft: ["slider to the left", "Schieber nach links"],
  key_splitRight: ["slider to the right", "Schieber nach rechts"],
  key_outline: ["outline ± 2 σ", "Umriss ± 2 σ"],
  key_difference: ["difference of left and right, and back", "Differenz von links und rechts, und zurück"],
  key_layer: ["next layer on the right", "nächste Ebene rechts"],
  key_variant: ["next montage on the right", "nächste Montage rechts"],
  key_unfinished: ["what is being rendered on the right", "die laufende Berechnung rechts"],
  key_swap: ["exchange left and right", "links und rechts tauschen"],
  key_nextPhoto: ["next photo", "nächstes Foto"],
  key_previousPhoto: ["previous photo", "voriges Foto"],
  key_fit: ["whole picture", "ganzes Bild"],
  key_zoom100: ["one pixel a pixel", "ein Pixel je Pixel"],
  key_zoom200: ["200 %", "200 %"],
  key_zoom1600: ["1600 %", "1600 %"],
  key_zoomIn: ["closer", "näher"],
  key_zoomOut: ["farther", "weiter weg"],
  key_centre: ["cursor to the middle", "Zeiger in die Mitte"],
  key_run: ["render, go on, stop", "berechnen, weiter, anhalten"],
  key_arrows: ["move the cursor 1 px (Shift 10, Ctrl 100)", "Zeiger um 1 px (Umschalt 10, Strg 100)"],
  key_help: ["this list", "diese Liste"]
};
