// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of scanned film, English and German (Swiss): fiducial mark = Rahmenmarke, principal distance =
// Kammerkonstante.

/** @type {Record<string, [string, string]>} */
export const kFilmTexts = {
  mode_film: ["Film", "Film"],
  key_mode_film: ["mode 5", "Arbeitsgang 5"],
  fiducial: ["fiducial mark", "Rahmenmarke"],
  fiducials: ["Fiducial marks", "Rahmenmarken"],
  certificate: ["Certificate", "Kalibrierschein"],
  certificateNote: [
    "As the camera's certificate prints it, in millimetres: x to the right, y up, seen from the front of the picture. What is typed is kept at once.",
    "Wie im Kalibrierschein der Kamera, in Millimetern: x nach rechts, y nach oben, von vorn auf das Bild gesehen. Was getippt wird, ist sofort gesichert."
  ],
  certificateFirst: [
    "The certificate lists no fiducial marks yet: type it first.",
    "Der Kalibrierschein nennt noch keine Rahmenmarken: zuerst eingeben."
  ],
  principalDistance: ["principal distance c [mm]", "Kammerkonstante c [mm]"],
  principalX: ["principal point of symmetry x [mm]", "Symmetriehauptpunkt x [mm]"],
  principalY: ["y [mm]", "y [mm]"],
  filmMap: ["film to scan", "Film zu Scan"],
  affine: ["affine", "affin"],
  projective: ["projective", "projektiv"],
  filmDistortion: ["Distortion: radius, distortion [mm]", "Verzeichnung: Radius, Verzeichnung [mm]"],
  distortionNote: [
    "A radius a line; positive is outwards, measured less ideal radius. None: leave it empty.",
    "Ein Radius je Zeile; positiv ist nach aussen, gemessener minus idealer Radius. Keine: leer lassen."
  ],
  pasteFiducials: [
    "or paste lines of mark, x, y",
    "oder Zeilen mit Marke, x, y einfügen"
  ],
  badLine: ["Not taken, since this line cannot be read: {text}", "Nicht übernommen, diese Zeile ist unlesbar: {text}"],
  marksTwice: ["Not taken: a mark stands twice.", "Nicht übernommen: eine Marke steht doppelt."],
  radiiRise: [
    "Not taken: radii rise from line to line, here they do not: {text}",
    "Nicht übernommen: Radien steigen von Zeile zu Zeile, hier nicht: {text}"
  ],
  twoRadii: ["Not taken: two radii or more, or none.", "Nicht übernommen: zwei Radien oder mehr, oder keiner."],
  distortionSlip: [
    "Not taken: columns exchanged, or micrometres? The radius comes first, both in millimetres: {text}",
    "Nicht übernommen: Spalten vertauscht, oder Mikrometer? Zuerst der Radius, beide in Millimetern: {text}"
  ],
  noFiducial: [
    "Choose a fiducial mark: N takes the next.",
    "Eine Rahmenmarke wählen: N nimmt die nächste."
  ],
  noFiducialHere: ["The mark is not placed on this photo.", "Die Marke ist auf diesem Foto nicht gesetzt."],
  noSuchFiducial: [
    "The certificate lists no mark {name}.",
    "Der Kalibrierschein nennt keine Marke {name}."
  ],
  notInFilm: [
    "Fiducial marks are placed, moved, doubted, switched off or deleted; points have this in mode 1.",
    "Rahmenmarken werden gesetzt, verschoben, bezweifelt, ausgeschaltet oder gelöscht; dies gilt für Punkte im Arbeitsgang 1."
  ],
  fiducialsDone: ["{photo} has all its fiducial marks.", "{photo} hat alle Rahmenmarken."],
  notPlaced: ["not placed", "nicht gesetzt"],
  placedOnly: ["placed", "gesetzt"],
  filmNoMap: [
    "{photo}: {n} of {all} marks placed; {needed} give a map.",
    "{photo}: {n} von {all} Marken gesetzt; {needed} geben eine Abbildung."
  ],
  filmSigma: [
    "{photo}: {kind} map from {n} marks, redundancy {r}: σ0 {px} px = {film}.",
    "{photo}: Abbildung {kind} aus {n} Marken, Redundanz {r}: σ0 {px} px = {film}."
  ],
  filmUnchecked: [
    "{photo}: {kind} map from {n} marks, redundancy 0: cannot be checked.",
    "{photo}: Abbildung {kind} aus {n} Marken, Redundanz 0: nicht prüfbar."
  ],
  filmScan: ["{scale} px/mm, turned by {turn}°.", "{scale} px/mm, um {turn}° gedreht."],
  offOthers: ["{px} px from where the others put it", "{px} px von dort, wo die andern sie haben"],
  markHead: ["mark", "Marke"],
  vFilm: ["v x y on the film", "v x y im Film"],
  vPixels: ["v x y [px]", "v x y [px]"],
  rHead: ["r", "r"],
  wHead: ["|w|", "|w|"],
  opCertificate: ["film certificate", "Kalibrierschein"],
  opFiducials: ["{n} fiducial marks of the certificate", "{n} Rahmenmarken des Kalibrierscheins"],
  opDeleteFiducial: ["delete fiducial mark {name}", "Rahmenmarke {name} löschen"]
};
