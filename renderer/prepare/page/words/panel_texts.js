// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of the light's report, the point's table, drafts, camera positions, English and German (Swiss).

/** @type {Record<string, [string, string]>} */
export const kPanelTexts = {
  lines_auto: ["Lines: as needed", "Linien: nach Bedarf"],
  lines_all: ["Lines: all", "Linien: alle"],
  lines_none: ["Lines: none", "Linien: keine"],
  photoFault: ["cannot be shown: {why}", "nicht anzeigbar: {why}"],
  // Light
  through100: ["through 100 m", "durch 100 m"],
  condition: ["condition {value}", "Kondition {value}"],
  rmsSigma: ["residuals RMS {value} σ", "Verbesserungen RMS {value} σ"],
  lightSoon: ["The light is being measured anew …", "Das Licht wird neu gemessen …"],
  airClear: ["No haze samples: taken as clear air.", "Keine Dunstproben: Luft gilt als klar."],
  lightSun: ["sun", "Sonne"],
  lightSky: ["open sky", "offener Himmel"],
  lightAmbient: ["ambient", "Umgebung"],
  weightNote: ["weight of the light D65", "Gewicht des Lichts D65"],
  asPhotographed: ["photographed", "fotografiert"],
  asPhotographedNote: [
    "the mean of what the photographs show around the samples: not adjusted, so without σ",
    "Mittel dessen, was die Fotos um die Proben zeigen: nicht ausgeglichen, darum ohne σ"
  ],
  sunIrradiance: ["sun, irradiance", "Sonne, Bestrahlung"],
  openSky: ["sky, radiance", "Himmel, Leuchten"],
  reflectanceKnown: [
    "Albedo known: brightness is absolute.",
    "Albedo bekannt: die Helligkeit ist absolut."
  ],
  reflectanceUnknown: [
    "Albedo not known: the building's brightness is relative.",
    "Albedo unbekannt: die Helligkeit des Gebäudes ist relativ."
  ],
  leftOut: ["left out", "weggelassen"],
  leftOutHead: ["Left out", "Weggelassen"],
  advice: ["Advice", "Ratschläge"],
  off100: ["off", "Abw."],
  // A point's photos
  vHead: ["v x, y [px]", "v x, y [px]"],
  sigmaMark: ["σ [px]", "σ [px]"],
  sigmaOf: ["σ of {point} on {photo} [px]", "σ von {point} auf {photo} [px]"],
  opSigma: ["σ of {point} on {photo}", "σ von {point} auf {photo}"],
  away: ["{px} px from the prediction", "{px} px von der Vorhersage"],
  crosshairAway: ["crosshair {px} px away", "Fadenkreuz {px} px entfernt"],
  predictedShort: ["predicted ± {px} px", "vorhergesagt ± {px} px"],
  notMarked: ["not marked", "nicht gemessen"],
  take: ["Take", "Nehmen"],
  switchOff: ["Off", "Aus"],
  switchOn: ["On", "Ein"],
  onPlane: [
    "one ray only: taken to stand on the plane of {polygon}",
    "nur ein Strahl: als auf der Ebene von {polygon} angenommen"
  ],
  more: ["{n} more", "{n} weitere"],
  fewer: ["fewer", "weniger"],
  // Holes
  drawHole: ["Draw hole", "Loch zeichnen"],
  hole: ["Hole {n}", "Loch {n}"],
  remove: ["Remove", "Entfernen"],
  holeMade: ["Hole {n} of {name} is made.", "Loch {n} von {name} ist gemacht."],
  holeRemoved: ["Hole {n} of {name} is removed.", "Loch {n} von {name} ist entfernt."],
  noHole: ["{name} has no hole.", "{name} hat kein Loch."],
  whichHole: [
    "Several holes: crosshair into the one to be removed.",
    "Mehrere Löcher: Fadenkreuz in das zu entfernende setzen."
  ],
  opHole: ["hole in {name}", "Loch in {name}"],
  opDeleteHole: ["remove hole of {name}", "Loch von {name} entfernen"],
  // Surfaces
  surface: ["surface beside its colour", "Oberfläche neben der Farbe"],
  surfaceMatte: ["matte, as photographed", "matt, wie fotografiert"],
  mirrors: ["mirrors", "spiegelt"],
  opSurface: ["surface of {material}", "Oberfläche von {material}"],
  // Drafts
  drafts: ["Unfinished", "Unfertig"],
  goOn: ["Go on", "Weiter"],
  discard: ["Discard", "Verwerfen"],
  draftKept: [
    "The unfinished polygon is kept; “Go on” takes it up again.",
    "Das unfertige Polygon bleibt erhalten; «Weiter» nimmt es wieder auf."
  ],
  opDraft: ["keep unfinished polygon", "unfertiges Polygon behalten"],
  opDiscard: ["discard unfinished polygon", "unfertiges Polygon verwerfen"],
  // Camera positions
  cameraPositions: ["Camera positions", "Kamerastandorte"],
  cameraNote: [
    "Where the camera was surveyed: fixed is taken as exact, weighted by its σ, free only as a start.",
    "Wo die Kamera eingemessen ist: fest gilt exakt, gewichtet nach σ, frei nur als Startwert."
  ],
  fixed: ["fixed", "fest"],
  weighted: ["weighted", "gewichtet"],
  free: ["free", "frei"],
  opCamera: ["position of {name}", "Standort von {name}"],
  opDeleteCamera: ["delete position of {name}", "Standort von {name} löschen"],
  // Runs
  "stage_exif-camera": ["camera from EXIF", "Kamera aus EXIF"],
  "stage_exif-site": ["place and time from EXIF", "Ort und Zeit aus EXIF"],
  exifCamera: [
    "Take the focal length from the photographs' EXIF?",
    "Brennweite aus den EXIF-Daten der Fotos nehmen?"
  ],
  exifCameraNote: [
    "This is for a first look only. EXIF tells the focal length to a few percent and nothing of the " +
      "lens's distortion: points may be decimetres off, and no σ tells you. Before anything is measured " +
      "in earnest, photograph a board and calibrate.",
    "Nur für einen ersten Blick. EXIF nennt die Brennweite auf einige Prozent genau und nichts von der " +
      "Verzeichnung: Punkte können um Dezimeter falsch sein, und kein σ sagt es. Vor jeder ernsthaften " +
      "Messung eine Tafel fotografieren und kalibrieren."
  ],
  // Photos in another light
  light_photo: ["as taken", "wie aufgenommen"],
  light_none: ["without sun", "ohne Sonne"],
  light_sun: ["sun alone", "nur Sonne"],
  relitSoon: ["being made …", "wird gerechnet …"],
  relitNot: ["cannot be made: {why}", "geht nicht: {why}"],
  relitNote: [
    "exposed × {times}; {percent} % lie on polygons, the rest is grey",
    "belichtet × {times}; {percent} % liegen auf Polygonen, der Rest ist grau"
  ],
  stopped: ["stopped", "angehalten"],
  firstLook: ["For a first look", "Für einen ersten Blick"]
};
