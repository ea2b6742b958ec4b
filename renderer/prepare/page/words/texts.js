// SPDX-License-Identifier: GPL-3.0-or-later
// Every text of the page: English, German (Swiss). Control point = Passpunkt, check point =
// Kontrollpunkt, mark = Bildmessung, tie point = Verknüpfungspunkt, residual = Verbesserung.

import {kFilmTexts} from "./film_texts.js";
import {kKeyTexts} from "./key_texts.js";
import {kPanelTexts} from "./panel_texts.js";

/** @type {Record<string, [string, string]>} */
export const kTexts = {
  // Things
  point: ["point", "Punkt"],
  points: ["Points", "Punkte"],
  photo: ["photo", "Foto"],
  photos: ["Photos", "Fotos"],
  polygon: ["polygon", "Polygon"],
  polygons: ["Polygons", "Polygone"],
  pair: ["pair", "Paar"],
  pairs: ["Pairs", "Paare"],
  sample: ["sample", "Probe"],
  samples: ["Samples", "Proben"],
  control: ["control point", "Passpunkt"],
  check: ["check point", "Kontrollpunkt"],
  tie: ["tie point", "Verknüpfungspunkt"],
  vertex: ["vertex", "Eckpunkt"],
  prediction: ["predicted", "vorhergesagt"],
  material: ["material", "Material"],
  image: ["image", "Bild"],
  sun: ["sun", "Sonne"],
  zenith: ["zenith", "Zenit"],
  edge: ["edge", "Kante"],
  horizon: ["Horizon", "Horizont"],
  haze: ["Haze", "Dunst"],
  daylight: ["Daylight", "Tageslicht"],
  marks: ["marks", "Messungen"],
  role: ["role", "Rolle"],
  raysHead: ["rays", "Strahlen"],
  remark: ["remark", "Bemerkung"],
  kind: ["kind", "Art"],
  of: ["of", "von"],
  value: ["value [m]", "Wert [m]"],
  unit: ["unit of σ", "Einheit von σ"],
  note: ["note", "Notiz"],
  residual: ["residual", "Verbesserung"],
  flatMm: ["flat mm", "eben mm"],
  table: ["table", "Tabelle"],
  on: ["on", "ein"],
  off: ["off", "aus"],
  dubious: ["dubious", "zweifelhaft"],
  proposed: ["proposed: Enter", "Vorschlag: Enter"],
  filter: ["filter", "filtern"],
  goTo: ["go to x y", "gehe zu x y"],
  sigmaNew: ["new σ [px]", "neues σ [px]"],
  language: ["language", "Sprache"],
  modes: ["modes", "Arbeitsgänge"],
  ephemeris: ["ephemeris", "Ephemeride"],
  clock: ["clock", "Uhr"],
  reflectance: ["albedo of the daylight samples", "Albedo der Tageslichtproben"],
  mode_control: ["Control", "Passpunkte"],
  mode_polygons: ["Polygons", "Polygone"],
  mode_sun: ["Sun, zenith", "Sonne, Zenit"],
  mode_light: ["Light", "Licht"],
  // Buttons
  confirm: ["Confirm", "Setzen"],
  switch: ["Off/on", "Aus/ein"],
  delete: ["Delete", "Löschen"],
  refine: ["Refine", "Verfeinern"],
  match: ["Match", "Zuordnen"],
  close: ["Close", "Schliessen"],
  cancel: ["Cancel", "Abbrechen"],
  stop: ["Stop", "Anhalten"],
  add: ["Add", "Hinzufügen"],
  run: ["Run", "Ausführen"],
  print: ["Print", "Drucken"],
  download: ["Download", "Herunterladen"],
  tryNow: ["Try now", "Jetzt versuchen"],
  dismiss: ["Dismiss", "Verwerfen"],
  takeOver: ["Take over", "Übernehmen"],
  flip: ["Flip side", "Seite wenden"],
  bestImage: ["Best image", "Bestes Bild"],
  drawPolygon: ["Draw polygon", "Polygon zeichnen"],
  sunPair: ["Sun pair", "Sonnenpaar"],
  zenithPair: ["Zenith pair", "Zenitpaar"],
  edgeMark: ["Edge mark", "Kantenmessung"],
  deletePair: ["Delete pairs of point", "Paare des Punkts löschen"],
  deleteSample: ["Delete sample", "Probe löschen"],
  distance: ["Distance", "Distanz"],
  angle: ["Angle", "Winkel"],
  keepTheirs: ["Keep theirs", "Ihre behalten"],
  useMine: ["Use mine", "Meine nehmen"],
  theirs: ["stands now", "steht jetzt"],
  mine: ["mine", "meine"],
  changeKey: ["change", "ändern"],
  resetKeys: ["Keys as they came", "Ursprüngliche Tasten"],
  secondWindow: ["Lists ↗", "Listen ↗"],
  controlTable: ["Coordinates", "Koordinaten"],
  constraints: ["Constraints", "Bedingungen"],
  measure: ["Measure", "Messband"],
  stages: ["Stages", "Schritte"],
  sketches: ["Sketches", "Skizzen"],
  help: ["Keys", "Tasten"],
  enlarge: ["Large", "Gross"],
  doubt: ["Dubious", "Zweifelhaft"],
  // State
  saved: ["saved", "gesichert"],
  kept: ["kept here, saving …", "hier behalten, wird gesichert …"],
  saving: ["saving …", "wird gesichert …"],
  notSaved: ["NOT SAVED", "NICHT GESICHERT"],
  savedNote: ["The survey files hold revision {revision}.", "Die Dateien enthalten Stand {revision}."],
  notAdjusted: ["not adjusted", "nicht ausgeglichen"],
  noRedundancy: ["nothing to check yet", "noch nichts zu prüfen"],
  sigmaBad: ["too large", "zu gross"],
  sigmaNote: [
    "redundancy {r}: {n} observations, {u} unknowns; {ms} ms",
    "Redundanz {r}: {n} Beobachtungen, {u} Unbekannte; {ms} ms"
  ],
  undo: ["Undo: {label}", "Zurück: {label}"],
  redo: ["Redo: {label}", "Vor: {label}"],
  undoNothing: ["Nothing to undo", "Nichts zurückzunehmen"],
  redoNothing: ["Nothing to redo", "Nichts zu wiederholen"],
  undone: ["Undone: {label}", "Zurückgenommen: {label}"],
  redone: ["Redone: {label}", "Wiederholt: {label}"],
  oneRay: ["1 ray", "1 Strahl"],
  rays: ["{n} rays", "{n} Strahlen"],
  predictedWithin: ["predicted ± {px} px (95 %)", "vorhergesagt ± {px} px (95 %)"],
  cannotCheck: ["cannot be checked", "nicht prüfbar"],
  notOriented: ["not oriented yet", "noch nicht orientiert"],
  orientedNote: ["RMS {rms} px", "RMS {rms} px"],
  todo: ["To do ({n})", "Zu tun ({n})"],
  count: ["{n} samples", "{n} Proben"],
  paneLabel: [
    "Photo {photo}: arrows move the crosshair, Enter places, ? lists the keys",
    "Foto {photo}: Pfeile bewegen das Fadenkreuz, Enter setzt, ? zeigt die Tasten"
  ],
  running: ["running", "läuft"],
  done: ["done", "fertig"],
  failed: ["failed, status {status}", "gescheitert, Status {status}"],
  unknownPairs: ["{n} pairs, not determined yet", "{n} Paare, noch nicht bestimmt"],
  deleted: ["deleted", "gelöscht"],
  findings: ["Findings ({n})", "Befunde ({n})"],
  site: ["Site", "Projekt"],
  opSite: ["site: {name}", "Projekt: {name}"],
  siteNote: [
    "Place and time say where the sun must have been.",
    "Ort und Zeit sagen, wo die Sonne stand."
  ],
  wheel: ["Wheel", "Rad"],
  rename: ["Rename", "Umbenennen"],
  newName: ["new name", "neuer Name"],
  everywhere: ["everywhere", "überall"],
  thisMark: ["this mark only", "nur diese Messung"],
  opRenamePoint: ["rename {name} to {to}", "{name} in {to} umbenennen"],
  noToken: [
    "This address has no valid token: open the one that insitu-prepare printed.",
    "Diese Adresse hat kein gültiges Token: jene öffnen, die insitu-prepare ausgab."
  ],
  // Sentences
  serverGone: [
    "The server does not answer. {n} changes wait here and will be sent again.",
    "Der Server antwortet nicht. {n} Änderungen warten hier und werden wieder gesendet."
  ],
  keptAll: [
    "They are kept here, also if the browser ends.",
    "Sie bleiben hier, auch wenn der Browser endet."
  ],
  keptSome: [
    "{n} of them are kept here; the others are lost if the browser ends.",
    "{n} davon bleiben hier; die anderen sind verloren, wenn der Browser endet."
  ],
  notSavedBecause: ["Not saved: {why}", "Nicht gesichert: {why}"],
  cannotLoad: ["The site cannot be loaded: {why}", "Das Projekt lässt sich nicht laden: {why}"],
  readOnlyFile: [
    "{place}: {text} The file is shown as far as it can be read, and not changed.",
    "{place}: {text} Die Datei wird gezeigt, so weit sie lesbar ist, und nicht geändert."
  ],
  readOnlyTable: [
    "Its file cannot be read and is not changed; correct it first.",
    "Die Datei ist nicht lesbar und wird nicht geändert; zuerst berichtigen."
  ],
  refused: ["Refused: {label}. {why}", "Abgelehnt: {label}. {why}"],
  conflict: [
    "“{label}” was not done: someone changed the same rows meanwhile.",
    "«{label}» wurde nicht ausgeführt: dieselben Zeilen wurden inzwischen geändert."
  ],
  mergeDiffers: [
    "{n} rows differ in {from}, a copy of this site that was merged; here stays what was here until it is decided.",
    "{n} Zeilen sind in {from} anders, einer Kopie, die aufgenommen wurde; bis zum Entscheid bleibt, was hier war."
  ],
  here: ["here", "hier"],
  keepHere: ["Keep what is here", "Behalten, was hier ist"],
  keepAllHere: ["Keep all that is here", "Alles behalten, was hier ist"],
  takeOther: ["Take that of {from}", "Jene aus {from} nehmen"],
  opMerge: ["Take a row of {from}", "Zeile aus {from} nehmen"],
  waiting: ["Changes still wait to be saved.", "Noch warten Änderungen auf die Sicherung."],
  nameIt: ["Name the point, then Enter.", "Punkt benennen, dann Enter."],
  badName: [
    "Names are without outer blanks, and not empty.",
    "Namen nicht leer und ohne Leerzeichen aussen."
  ],
  moveFirst: [
    "Nothing is known of its place here: move the crosshair first.",
    "Hier ist sein Ort unbekannt: zuerst das Fadenkreuz bewegen."
  ],
  offFrame: ["Off the photo: not placed.", "Ausserhalb des Fotos: nicht gesetzt."],
  noMark: ["No mark of the point on this photo.", "Keine Messung des Punkts auf diesem Foto."],
  noPoint: ["Choose a point first.", "Zuerst einen Punkt wählen."],
  newPoint: ["{name} is new: place it.", "{name} ist neu: setzen."],
  noSuchPoint: ["There is no point {name}.", "Es gibt keinen Punkt {name}."],
  noPointWants: ["No other point wants rays.", "Kein anderer Punkt braucht Strahlen."],
  noPointHint: [
    "No point: click or Enter makes a new one; N takes the next that needs rays.",
    "Kein Punkt: Klick oder Enter macht einen neuen; N nimmt den nächsten, der Strahlen braucht."
  ],
  pickMark: ["Choose a point's mark here.", "Hier die Messung eines Punkts wählen."],
  badPlace: [
    "“{text}” is no place on the photo; x and y, as 1047.5 816.",
    "«{text}» ist kein Ort auf dem Foto; x und y wie 1047.5 816."
  ],
  badNumber: ["“{text}” is not taken as a number here.", "«{text}» gilt hier nicht als Zahl."],
  twice: ["{name} is in it already.", "{name} ist schon dabei."],
  refined: [
    "Proposed: {shift} px away, σ {sigma} px. Enter takes it.",
    "Vorschlag: {shift} px entfernt, σ {sigma} px. Enter nimmt ihn."
  ],
  notRefined: ["No proposal: {why}", "Kein Vorschlag: {why}"],
  matched: [
    "{n} proposals; Enter takes them one by one.",
    "{n} Vorschläge; Enter nimmt einen nach dem andern."
  ],
  vertexFirst: [
    "first vertex: a point's mark, or a new place",
    "erster Eckpunkt: Messung eines Punkts oder neuer Ort"
  ],
  vertexNext: ["vertex {n}; Backspace takes back", "Eckpunkt {n}; Rücktaste nimmt zurück"],
  vertexOrEnter: ["vertex {n}, or Enter closes", "Eckpunkt {n}, oder Enter schliesst"],
  polygonMade: [
    "{name} is made; I proposes its image, T its material.",
    "{name} ist gemacht; I schlägt das Bild vor, T das Material."
  ],
  polygonAbout: [
    "{flat} mm from flat, {area} m², {off}° off the vertical",
    "{flat} mm uneben, {area} m², {off}° aus dem Lot"
  ],
  noPolygon: ["Choose a polygon in the list first.", "Zuerst ein Polygon in der Liste wählen."],
  noPolygonHint: [
    "B draws a polygon; the list chooses one.",
    "B zeichnet ein Polygon; die Liste wählt eines."
  ],
  bestPhoto: [
    "{photo}: {angle}° from straight on, {mm} mm a pixel",
    "{photo}: {angle}° von senkrecht, {mm} mm je Pixel"
  ],
  noBestPhoto: ["No photo is known to show it. {why}", "Kein Foto zeigt es nachweislich. {why}"],
  taken: ["{name} is there already.", "{name} gibt es schon."],
  pick_object: ["sun: the point that casts the shadow", "Sonne: der Punkt, der den Schatten wirft"],
  pick_shadow: ["sun: its shadow", "Sonne: sein Schatten"],
  pick_bottom: ["zenith: the lower point", "Zenit: der untere Punkt"],
  pick_top: ["zenith: the upper point", "Zenit: der obere Punkt"],
  pick_from: ["from which point", "von welchem Punkt"],
  pick_to: ["to which point", "zu welchem Punkt"],
  pick_apex: ["the angle's vertex", "Scheitel des Winkels"],
  edgePlace: [
    "places on the straight edge {from}–{to}; Enter or Esc ends",
    "Orte auf der geraden Kante {from}–{to}; Enter oder Esc endet"
  ],
  pairMade: ["{a} → {b} is made.", "{a} → {b} ist gemacht."],
  noPair: [
    "No pair or edge mark has this point here.",
    "Kein Paar und keine Kantenmessung hat hier diesen Punkt."
  ],
  sunAbout: [
    "azimuth {azimuth}°, elevation {elevation}° ± {sigma}° from {n} pairs",
    "Azimut {azimuth}°, Höhe {elevation}° ± {sigma}° aus {n} Paaren"
  ],
  ephemerisAbout: [
    "azimuth {azimuth}°, elevation {elevation}°: {difference}° apart",
    "Azimut {azimuth}°, Höhe {elevation}°: {difference}° Abstand"
  ],
  clockAbout: ["{minutes} min would leave {rest}°", "{minutes} min liessen {rest}°"],
  zenithAbout: [
    "{tilt}° from the z axis ± {sigma}° from {n} pairs",
    "{tilt}° von der z-Achse ± {sigma}° aus {n} Paaren"
  ],
  samplePlace: [
    "pixels of even light; Enter or Esc ends",
    "Pixel in gleichmässigem Licht; Enter oder Esc endet"
  ],
  sampleMade: ["{kind} {polygon}: taken.", "{kind} {polygon}: aufgenommen."],
  sample_horizon: ["Horizon samples", "Horizontproben"],
  sample_haze: ["Haze samples", "Dunstproben"],
  sample_daylight: ["Daylight samples", "Tageslichtproben"],
  noPolygonThere: ["No polygon is known there.", "Dort ist kein Polygon bekannt."],
  noSample: ["No sample at the crosshair.", "Keine Probe beim Fadenkreuz."],
  distanceAbout: [
    "{distance} m ± {sigma} mm; height {height} m ± {heightSigma} mm",
    "{distance} m ± {sigma} mm; Höhe {height} m ± {heightSigma} mm"
  ],
  choosePoints: [
    "choose {points} points, on the photos or in the list",
    "{points} Punkte wählen, auf den Fotos oder in der Liste"
  ],
  chooseEither: [
    "choose {points} points or {polygons} polygons, on the photos or in the lists",
    "{points} Punkte oder {polygons} Polygone wählen, auf den Fotos oder in den Listen"
  ],
  controlNote: [
    "What is typed goes to the survey at once. Check points stay out of the adjustment and test it.",
    "Was getippt wird, geht sofort in die Vermessung. Kontrollpunkte bleiben aus der Ausgleichung und prüfen sie."
  ],
  paste: ["Paste a table from a spreadsheet", "Tabelle aus einer Tabellenkalkulation einfügen"],
  orFile: ["or take a file", "oder eine Datei nehmen"],
  importFound: [
    "{n} points ({format}).", "{n} Punkte ({format})."
  ],
  importTaken: [
    "{taken} of these names are there already and would be changed.",
    "{taken} dieser Namen gibt es schon; sie würden geändert."
  ],
  imported: ["{n} points taken over.", "{n} Punkte übernommen."],
  helpNote: [
    "Letters act while a photo has the focus. Esc cancels.",
    "Buchstaben wirken, solange ein Foto den Fokus hat. Esc bricht ab."
  ],
  pressKey: ["{action}: press a key, Esc leaves it", "{action}: Taste drücken, Esc lässt es"],
  keyTaken: ["{key} does something else already.", "{key} tut schon etwas anderes."],
  // Operations, as undo shows them
  opMark: ["mark {point} on {photo}", "{point} auf {photo} messen"],
  opMove: ["move {point} on {photo}", "{point} auf {photo} verschieben"],
  opDelete: ["delete mark {point} on {photo}", "Messung {point} auf {photo} löschen"],
  opSwitch: ["switch {point} on {photo}", "{point} auf {photo} schalten"],
  opDubious: ["doubt {point} on {photo}", "{point} auf {photo} bezweifeln"],
  opPolygon: ["polygon {name}", "Polygon {name}"],
  opImage: ["image of {name}", "Bild von {name}"],
  opMaterial: ["material of {name}", "Material von {name}"],
  opFlip: ["flip {name}", "{name} wenden"],
  opDeletePolygon: ["delete polygon {name}", "Polygon {name} löschen"],
  opRename: ["rename {name} to {to}", "{name} in {to} umbenennen"],
  op_sun: ["sun pair {a} {b}", "Sonnenpaar {a} {b}"],
  op_zenith: ["zenith pair {a} {b}", "Zenitpaar {a} {b}"],
  opDeletePair: ["delete pairs of {name}", "Paare von {name} löschen"],
  opEdge: ["edge {from}–{to} on {photo}", "Kante {from}–{to} auf {photo}"],
  opSample: ["{kind} sample on {photo}", "Probe {kind} auf {photo}"],
  opDeleteSample: ["delete sample on {photo}", "Probe auf {photo} löschen"],
  opCard: ["albedo of the samples", "Albedo der Proben"],
  opConstraint: ["constraint: {kind}", "Bedingung: {kind}"],
  opDeleteConstraint: ["delete constraint", "Bedingung löschen"],
  opControl: ["coordinates of {point}", "Koordinaten von {point}"],
  opDeleteControl: ["delete coordinates of {point}", "Koordinaten von {point} löschen"],
  opImport: ["import {n} points", "{n} Punkte einlesen"],
  opNote: ["note on {point}", "Notiz zu {point}"],
  constraint_distance: ["distance", "Distanz"],
  constraint_height: ["height difference", "Höhenunterschied"],
  constraint_vertical: ["vertical", "lotrecht"],
  constraint_horizontal: ["horizontal", "waagrecht"],
  constraint_parallel: ["parallel", "parallel"],
  constraint_perpendicular: ["perpendicular", "rechtwinklig"],
  stage_calibrate: ["calibrate", "kalibrieren"],
  "stage_tie-points": ["tie points", "Verknüpfungspunkte"],
  stage_reconstruct: ["reconstruct", "rekonstruieren"],
  stage_undistort: ["undistort", "entzerren"],
  stage_light: ["light", "Licht"],
  stage_convert: ["convert", "umwandeln"],
  stage_render: ["render", "rechnen"],
  stage_montage: ["montage", "Montage"],
  ...kPanelTexts,
  ...kKeyTexts,
  ...kFilmTexts
};
