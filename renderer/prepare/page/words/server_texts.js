// SPDX-License-Identifier: GPL-3.0-or-later
// What the server says, in German (Swiss), by the keys of its sentences (calibration/files/sentence.h);
// the English stands in the server. scripts/check_pages compares keys and {values}.

import {kDiagnosisTexts} from "./diagnosis_texts.js";
import {kFaultTexts} from "./fault_texts.js";
import {kRowTexts} from "./row_texts.js";

/** What can be left out, by its `kind`. @type {Record<string, string>} */
export const kKinds = {
  photo: "Foto",
  point: "Punkt",
  polygon: "Polygon",
  sun: "Sonnenpaar",
  zenith: "Lotpaar",
  edge: "Kante",
  constraint: "Bedingung",
  observation: "Bildmessung"
};

/** As what a pasted table was read. @type {Record<string, string>} */
export const kFormats = {
  "table with a header": "Tabelle mit Kopfzeile",
  "reference table of Metashape (CSV)": "Referenztabelle von Metashape (CSV)",
  "markers of Metashape (XML)": "Marken von Metashape (XML)",
  "points of MicMac (DicoAppuisFlottant)": "Punkte von MicMac (DicoAppuisFlottant)",
  "points of AICON (.obc, mm)": "Punkte von AICON (.obc, mm)",
  "gcp_list.txt of OpenDroneMap or OpenSfM": "gcp_list.txt von OpenDroneMap oder OpenSfM",
  "ground_control_points.json of OpenSfM": "ground_control_points.json von OpenSfM"
};

/** @type {Record<string, string>} */
export const kServerTexts = {
  ...kDiagnosisTexts,
  ...kFaultTexts,
  ...kRowTexts,
  atPlace: "{place}: {message}",
  named: "{name}: {reason}",
  and: "{one}, {other}",
  then: "{one}; {other}",
  nameHorizon: "Horizont",
  nameHaze: "Dunst",
  nameDaylight: "Tageslicht",
  // To do, and why
  doMontage: "die Montage rechnen",
  whyMontage: "was sie braucht, ist da",
  whyFile: "die Datei macht nicht mit, bis das behoben ist",
  whyFailed: "vorher lässt sich nichts ausgleichen",
  whyDiagnosis: "in den Messungen gefunden",
  doCalibrate: "die Kamera kalibrieren",
  doLens:
    "Aufnahmen einer Tafel oder eine Kameradatei nach calibration/ legen; oder für einen ersten Blick " +
    "die Brennweite aus EXIF nehmen",
  doControl: "Passpunkte: noch {count}",
  whyControl: "ihre Koordinaten stellen die Fotos in die Welt: eintippen oder einfügen",
  doCheck: "einige der Passpunkte zu Kontrollpunkten machen: jetzt ist es keiner",
  whyCheck: "sie bleiben aus der Ausgleichung und sagen, wie gut sie ist",
  whyPhoto: "das Foto ist noch nicht orientiert",
  whyLeftOut: "macht in der Ausgleichung nicht mit",
  doMore: "und {count} weitere, die nicht mitmachen",
  doPolygons: "Boden und Gebäude als Polygone umfahren",
  whyPolygons: "Schatten, Verdeckung und Licht müssen wissen, was dort steht",
  doImages: "Polygone ohne Foto, das sie zeigt ({count}): {names}",
  whyImages: "ihre Farbe kommt aus einem Foto",
  doZenith: "eine lotrechte Kante: unten, dann oben",
  whyZenith: "sonst sagt die z-Achse der Koordinaten, wo oben ist",
  doSun: "ein Sonnenpaar: ein Punkt, dann sein Schatten",
  whySun: "ohne gilt der Himmel als bedeckt, und nichts wirft Schatten",
  doHorizon: "eine Probe des Himmels am Horizont",
  whyHorizon: "worin der Dunst sich verliert",
  doHaze: "Dunst: ein Material in zwei oder mehr Entfernungen",
  whyHaze: "sonst gilt die Luft als klar",
  doDaylight: "Tageslichtproben eines Materials, in Sonne und Schatten: noch {count}",
  whyDaylight: "sie trennen Sonne, Himmel und Umgebungslicht",
  doReflectance: "die Albedo des Materials der Tageslichtproben",
  whyReflectance: "von einer Graukarte oder aus einer Tabelle: sonst wird der Bau zu dunkel",
  whySample: "die Probe macht nicht mit",
  doSite: "Ort und Zeit der Fotos",
  whySite: "um die Sonne mit dem Almanach zu vergleichen",
  doBuilding: "das Modell des geplanten Baus nach building/ legen",
  whyBuilding: "noch ist nichts geplant",
  doConvert: "das Modell des Baus umwandeln",
  whyConvert: "sein Drahtmodell steht dann in jedem Foto",
  whyFilmFault: "daraus lassen sich die Kameras der Scans nicht machen",
  doCertificate: "dem Kalibrierschein des Films fehlt: {what}",
  whyCertificate: "er verbindet die Scans mit dem Objektiv der Kamera: eintippen",
  doScans: "die Scans kalibrieren",
  whyScans: "ihr Film ist vollständig",
  doFiducials: "{photo}: Rahmenmarken zu messen ({count}): {names}",
  whyFiducials: "noch {count} verbinden den Scan mit seiner Kamera",
  whyDisagree: "die Rahmenmarken des Scans stimmen nicht überein",
  doOneFiducial: "{photo}: noch eine Rahmenmarke",
  whyOneFiducial: "die Filmabbildung lässt sich nicht prüfen: ein Fehler einer Marke fiele nicht auf",
  doMoreFiducials: "{photo}: nicht gemessene Rahmenmarken ({count}): {names}",
  whyMoreFiducials: "jede prüft die anderen",
  doFilm: "oder, bei gescanntem Film, den Kalibrierschein der Kamera eintippen",
  whyFilm: "seine Rahmenmarken verbinden dann jeden Scan mit dem Objektiv",
  doCameras: "die Kameras kalibrieren",
  // What takes no part in the adjustment
  photoThree: "braucht drei Passpunkte",
  photoTwo: "braucht noch zwei Passpunkte",
  photoOne: "braucht noch einen Passpunkt",
  photoOnLine: "seine {count} bekannten Punkte liegen auf einer Geraden, noch einen deutlich daneben",
  photoNoPlace:
    "kein Standort der Kamera erklärt seine {count} bekannten Punkte: ist einer am falschen Ort oder " +
    "unter falschem Namen gemessen?",
  photoFails: "die Ausgleichung scheitert",
  notDetermined: "die Messungen bestimmen {what} nicht (im Ganzen {count} Unbekannte); nötig: {remedy}",
  unknownCamera: "die Kamera {name}",
  unknownPhoto: "das Foto {name}",
  unknownPoint: "den Punkt {name}",
  unknownPlane: "die Ebene des Polygons {name}",
  unknownSun: "die Richtung zur Sonne",
  unknownZenith: "die Richtung zum Zenit",
  remedyCamera:
    "mehr Fotos von anderen Seiten, oder ein Objektivmodell mit weniger Parametern (insitu-calibrate " +
    "--lens-model LENSMODEL_OPENCV4)",
  remedyPhoto: "mehr gut verteilte Messungen darauf, oder sein vermessener Standort",
  remedyPoint:
    "eine Messung auf noch einem Foto, seine vermessenen Koordinaten, oder ein Polygon, dessen Ebene ihn hält",
  remedyPlane: "drei seiner Eckpunkte, die gemessen oder vermessen sind und nicht auf einer Geraden liegen",
  remedyDirection: "mehr Paare von Punkten in directions.json",
  adjustmentFails: "die Ausgleichung scheitert: {why}; nötig sind Messungen, die zu ihren Punkten passen",
  pointBehind:
    "der Punkt «{point}» liegt hinter dem Foto «{photo}», das ihn zeigt; nötig ist ein anderer Punkt oder ein " +
    "anderer Standort: trägt die Messung den richtigen Namen?",
  startOutside:
    "{what} ist ausserhalb des Fotos «{photo}» gemessen, nötig ist eine Stelle in {width} × {height} Pixeln",
  startPoint: "der Punkt «{point}»",
  startEdge: "die Kante von «{from}» nach «{to}»",
  startFewControl:
    "das Foto «{photo}» zeigt {count} Passpunkte, nötig sind mindestens drei (Kontrollpunkte zählen nicht): mehr " +
    "messen, oder insitu-tie-points verbindet es mit Fotos, die sie zeigen",
  startOnLine:
    "die {count} Passpunkte auf dem Foto «{photo}» liegen auf einer Geraden, nötig ist einer deutlich daneben",
  startNoPlace:
    "kein Standort der Kamera erklärt die {count} Passpunkte auf dem Foto «{photo}»; nötig sind Messungen, die zu " +
    "einem passen",
  onePhoto: "1 Foto",
  manyPhotos: "{count} Fotos",
  startNoPoint:
    "der Punkt «{point}» ist auf {photos} gemessen und nicht bestimmbar; nötig sind Messungen auf zwei Fotos von " +
    "verschiedenen Orten, oder eine und ein Polygon mit drei anderen bekannten Eckpunkten, oder seine " +
    "Koordinaten als Passpunkt",
  noLens: "sein Objektiv ist noch nicht bekannt: insitu-calibrate ausführen",
  markOutside: "ausserhalb des Fotos gemessen",
  markNoLens: "das Objektiv seines Fotos ist nicht bekannt",
  markBehind: "sein Punkt läge hinter dem Foto",
  markWeak: "die Messungen bestimmen seinen Punkt nicht: noch ein Foto, von einer anderen Seite",
  pointOneRay: "ein Strahl, braucht ein zweites Foto",
  pointHardlyMeets: "seine Strahlen schneiden sich kaum, braucht ein Foto von einer anderen Seite",
  pointNoRay: "kein Strahl, braucht zwei Fotos",
  pointPhotoOut: "ein Strahl, und sein Foto {photo} ist nicht orientiert",
  pointPhotosOut: "keines seiner {count} Fotos ist orientiert",
  edgePhotoOut: "ihr Foto ist nicht orientiert",
  noVertex: "der Eckpunkt {name} ist nicht bestimmt",
  noPoint: "der Punkt {name} ist nicht bestimmt",
  noEnd: "das Ende {name} ist nicht bestimmt",
  noPolygon: "das Polygon {name} ist nicht bestimmt",
  polygonHeld: "die Ebenen durch den Eckpunkt {vertex} bestimmen ihn nicht: messen",
  edgeOnePlace: "die Enden liegen am selben Ort",
  constraintOnePlace: "die Punkte liegen am selben Ort",
  pairOpposed: "zeigt von den anderen Paaren weg: sind die Enden vertauscht?",
  leftOut: "{kind} «{name}» macht nicht mit: {reason}",
  placedByPoints:
    "das Foto «{photo}» ist nur durch Punkte anderer Fotos orientiert; insitu-reconstruct will drei " +
    "Passpunkte darauf",
  // Marks proposed
  markEdge: "eine Kante, keine Ecke",
  markEven: "eine gleichmässige Fläche",
  markFar: "keine Ecke innerhalb von 2.5 px",
  markEvenOrEdge: "eine gleichmässige Fläche, oder zu nahe am Rand",
  markNoCentre: "keine Mitte einer Marke innert 4 px, oder eine Linie",
  matchOblique: "dort zu schräg gesehen",
  matchFrame: "zu nah am Bildrand",
  matchNothing: "nichts dort sieht ähnlich aus",
  matchTwo: "zwei Stellen sehen ähnlich aus",
  matchUncertain: "nichts innerhalb der Unsicherheit sieht ähnlich aus",
  matchNotOriented: "nicht orientiert",
  // Samples and light
  sampleUnknownPhoto: "nennt das Foto «{photo}», das nicht orientiert ist",
  sampleUnknownPolygon: "nennt das Polygon «{polygon}», das es nicht gibt oder das nicht bestimmt ist",
  sampleClipped: "ist überbelichtet, erwartet wird ein Pixel unter dem höchsten Wert des Sensors",
  sampleOutside: "liegt ausserhalb des Fotos von {width} × {height} Pixeln",
  sampleMisses: "trifft das Polygon «{polygon}» nicht",
  sampleHidden: "zeigt das Polygon «{first}» vor dem Polygon «{polygon}»: freie Sicht ist nötig",
  sampleNoSky: "liegt auf dem Polygon «{polygon}», erwartet wird ein Pixel des Himmels",
  lightNoMaterial: "Materialien ohne Eintrag in survey/materials.json, als rein matt angenommen: {materials}",
  lightNoHaze: "keine Dunstproben: die Luft gilt als klar",
  lightNoReflectance:
    "die Albedo der Tageslichtproben fehlt: sie gilt als 1, und der Bau wird neben seiner Umgebung zu dunkel",
  lightOvercast: "keine Sonnenrichtung gemessen: der Himmel gilt als bedeckt",
  lightNegative:
    "die kleinsten Quadrate ohne Schranken machen einen Anteil des Tageslichts negativ, was kein Licht ist: er wird wie " +
    "gerechnet verwendet, so wie der Aufsatz es tut",
  lightSunUnseen: "keine Tageslichtprobe sieht die Sonne: sie bleibt dunkel",
  lightUnseen:
    "Tageslichtproben, die viel Licht von Flächen erhalten, die kein Foto zeigt, und weniger zählen: {samples}",
  lightOtherSky:
    "die Fotos zeigen einen {times}-mal so hellen Himmel, wie er die Tageslichtproben beleuchtet: stimmt ihre " +
    "Albedo, und haben alle Fotos dieselbe Belichtung?",
  lightPoor:
    "die Tageslichtproben trennen Sonne, Himmel und Umgebungslicht kaum: einige in der Sonne, im offenen " +
    "und im tiefen Schatten wählen",
  lightTooFew: "{list}: {count} brauchbare Proben, nötig sind mindestens {least}",
  lightOneDistance: "Dunst: alle Proben in einer Entfernung, nötig sind verschiedene",
  adviceHaze:
    "Dunst: alle Proben liegen {near} bis {far} m entfernt; eine auf demselben Material, viel näher oder " +
    "weiter weg, sagt mehr",
  adviceFurtherHaze:
    "Dunst: eine Probe mehr auf demselben Material, {distance} m entfernt, liesse {left} % der " +
    "Standardabweichung der Transmission",
  adviceFurtherDaylight:
    "Tageslicht: eine Probe mehr {where} liesse {sun} % der Standardabweichung der Sonne und {sky} % jener des " +
    "Himmels",
  inOpenShade: "im offenen Schatten, viel Himmel zugewandt",
  inDeepShade: "im tiefen Schatten, wenig Himmel zugewandt",
  inFullSun: "in voller Sonne, ihr zugewandt",
  adviceTexture:
    "{kind}: die Pixel um {x}, {y} auf {photo} unterscheiden sich um {percent} %, durch Textur oder eine Kante: " +
    "eine gleichmässige Stelle sagt mehr",
  adviceOff:
    "{kind}: die Probe bei {x}, {y} auf {photo} weicht {percent} % ab: ein anderes Material, ein Schatten, " +
    "eine Spiegelung?",
  adviceShade:
    "Tageslicht: noch eine Probe im offenen und eine im tiefen Schatten trennen Sonne, Himmel und " +
    "Umgebungslicht besser",
  relitFailed: "das Licht ist nicht gemessen: {why}",
  relitNoLight: "noch ist kein Licht gemessen: es braucht orientierte Fotos, Polygone und Proben",
  relitNotOriented: "das Foto ist noch nicht orientiert"
};
