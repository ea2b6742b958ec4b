// SPDX-License-Identifier: GPL-3.0-or-later
// What the diagnosis of the survey finds (reconstruction/diagnosis/), in German (Swiss).

/** @type {Record<string, string>} */
export const kDiagnosisTexts = {
  nameOne: "«{name}»",
  nameNext: "{first}, «{name}»",
  nameAnd: "{first} und «{name}»",
  nameOr: "{first} oder «{name}»",
  nameOthers: "{first} und {count} weitere",
  photoSingle: "Foto {names}",
  photoMany: "Fotos {names}",
  meantOne: "; ist «{a}» gemeint?",
  meantTwo: "; ist «{a}» oder «{b}» gemeint?",
  meantThree: "; ist «{a}», «{b}» oder «{c}» gemeint?",
  unitMillimetres: "Millimetern",
  unitFeet: "Fuss",
  unitKilometres: "Kilometern",
  // Axes and units of all control points or marks
  axesFit:
    "{fault}. Die Messungen von Passpunkten ({photos}) passen wie angegeben auf {given} px (RMS), " +
    "{correction} auf {rms} px. Erwartet: {remedy}",
  axesNoFit:
    "{fault}. Zu den Messungen von Passpunkten ({photos}) passt wie angegeben kein Standort der Kamera, " +
    "{correction} passen sie auf {rms} px. Erwartet: {remedy}",
  axesOr: "{first}; oder {other}",
  axesXAndY: "x und y",
  axesMarksSwap: "mit vertauschten x und y der Messungen",
  axesMarksSwapped: "x und y der Messungen sind vertauscht",
  axesMarksSwapDo: "die Spalten x und y tauschen: x zählt nach rechts, y nach unten",
  axesMarksTop: "mit y der Messungen von oben gezählt",
  axesMarksBottom: "y der Messungen ist von unten gezählt",
  axesMarksTopDo: "Höhe - 1 - y statt y schreiben: (0, 0) ist die Mitte des Pixels oben links",
  axesMarksRight: "mit den Messungen um 90 Grad nach rechts gedreht",
  axesMarksLeft: "mit den Messungen um 90 Grad nach links gedreht",
  copyResized:
    "gemessen wurde in einer Kopie, die {size}-mal so gross ist wie das Foto: x + 0.5 und y + 0.5 mit {factor} " +
    "multiplizieren und 0.5 abziehen",
  copyMillimetres:
    "die Messungen sind Millimeter ab der Ecke, {factor} Pixel je Millimeter; erwartet sind Pixel des Fotos",
  copyShares:
    "die Messungen sind Anteile der Seiten des Fotos, erwartet sind Pixel: x mit seiner Breite, y mit seiner Höhe " +
    "multiplizieren und 0.5 abziehen",
  copyCropped:
    "gemessen wurde in einer Kopie, der links {x} px und oben {y} px fehlen: zu x und y dazuzählen",
  copyResizedCropped:
    "gemessen wurde in einem Ausschnitt, {size}-mal so gross: x und y mit {factor} multiplizieren und {x} und {y} px " +
    "dazuzählen",
  copyNoFit:
    "{copy}. Die Messungen von Passpunkten in {photos} passen so zu keinem Kamerastandort, dann auf {rms} px (RMS)",
  copyFit:
    "{copy}. Die Messungen von Passpunkten in {photos} passen so auf {given} px (RMS), dann auf {rms} px",
  axesMarksTurned: "gemessen wurde in einer gedrehten Kopie des Fotos",
  axesMarksTurnDo: "im Pixelraster des Fotos selbst messen, ohne seine EXIF-Orientierung",
  axesControlSwap: "mit vertauschten x und y der Passpunkte",
  axesControlMirrored:
    "die Passpunkte sind gespiegelt (Linkssystem): x und y sind vertauscht, oder eine Achse zählt rückwärts",
  axesControlSwapDo:
    "die Spalten x und y tauschen, wenn Nord vor Ost steht; sonst das Vorzeichen der Achse wechseln, die " +
    "rückwärts zählt, so dass x nach Osten, y nach Norden und z nach oben zeigt",
  axesControlUp: "mit z der Passpunkte nach oben gezählt",
  axesControlDown: "die Passpunkte sind gespiegelt (Linkssystem): z zählt nach unten",
  axesControlUpDo: "das Vorzeichen von z wechseln: Höhen, nicht Tiefen",
  axesScale: "mit {axes} der Passpunkte mal {factor}",
  axesUnits: "{axes} der Passpunkte in {unit}, der Rest in Metern: die Einheiten sind gemischt",
  axesUnitsDo: "alle Koordinaten in Metern angeben",
  // Names and single points
  namesShifted:
    "die Passpunkte stehen in zwei Koordinatensystemen: {names} sind nach den Fotos alle um {shift} gegen die " +
    "anderen verschoben. Erwartet: alle Koordinaten in einem System",
  namesExchanged:
    "die Punkte «{one}» und «{other}» (Zeile {line}) sind vertauscht: {photos} zeigen jeden dort, wo die " +
    "Koordinaten des anderen liegen. Ist hier «{other}» gemeint und dort «{one}»? Erwartet: die zwei Namen " +
    "getauscht, hier oder in allen Messungen",
  namesAnother:
    "die Messungen von «{name}» zeigen den Punkt «{other}» ({photos}); ist «{other}» gemeint? Erwartet: der " +
    "Name des gezeigten Punkts, oder die Koordinaten von «{name}» (control_points.csv:{line}) berichtigt",
  namesFarOff:
    "der Passpunkt «{name}» liegt {distance} m von dort, wo er nach den Messungen ist ({photos}): {seen} statt {given}",
  namesPointSwapped: "{lies}: x und y sind vertauscht. Erwartet: x Ost, y Nord",
  namesPointUnit: "{lies}: er ist in Millimetern. Erwartet: Meter, wie die anderen",
  namesOneAxis:
    "{lies}: nur {axis} ist falsch, ein Ziffernfehler? Erwartet: Koordinaten und Messungen ein und desselben Punkts",
  namesPointOff: "{lies}. Erwartet: Koordinaten und Messungen ein und desselben Punkts",
  namesMarked: "der Punkt «{name}» ist auf Foto «{photo}» bei {pixel} gemessen",
  namesMarkedOff:
    "der Punkt «{name}» ist auf Foto «{photo}» bei {pixel} gemessen, {distance} px von dort, wo seine " +
    "Koordinaten erscheinen, {expected} (die Messungen, die zusammenpassen, passen auf {rms} px)",
  namesMarksExchanged:
    "{where}: «{name}» und «{other}» (Zeile {line}) sind auf diesem Foto vertauscht; ist «{other}» gemeint? " +
    "Erwartet: die zwei Namen getauscht",
  namesShows: "{where}: dort ist {names}; ist {names} gemeint? Erwartet: der Name des gezeigten Punkts",
  namesMarkSwapped: "{where}: x und y sind vertauscht. Erwartet: x nach rechts, y nach unten",
  namesMarkBottom: "{where}: y ist von unten gezählt. Erwartet: y von oben",
  namesOutside: "{where}: das liegt ausserhalb des Fotos «{photo}»",
  namesMarkThere:
    "{where}. Erwartet: die Messung von «{name}» dort, ein anderer Name, oder berichtigte Koordinaten",
  namesMarkElsewhere:
    "{where}. Erwartet: die Messung von «{name}» auf einem Foto, das ihn zeigt, ein anderer Name, oder " +
    "berichtigte Koordinaten",
  // Camera positions
  positionsUnitDo: "Meter in beiden Dateien",
  positionsSwapped: "haben x und y vertauscht",
  positionsSwapDo: "x und y in beiden Dateien in gleicher Folge",
  positionsMm: "sind in Millimetern und die Passpunkte in Metern",
  positionsControlMm: "sind in Metern und die Passpunkte in Millimetern",
  positionsFeet: "sind in Fuss und die Passpunkte in Metern",
  positionsControlFeet: "sind in Metern und die Passpunkte in Fuss",
  positionsAll:
    "die Kamerastandorte {fault}: jener von Foto «{photo}» liegt {distance} m von dort, wo ihn die Passpunkte " +
    "haben, berichtigt stimmt er. Erwartet: {remedy}",
  positionsOff:
    "der Kamerastandort von Foto «{photo}» liegt {distance} m von dort, wo ihn die Passpunkte haben. Erwartet: " +
    "die Mitte des Objektivs, im System der Passpunkte",
  positionsNamed:
    "der Kamerastandort von Foto «{photo}» liegt {distance} m von dort, wo ihn die Passpunkte haben; ist Foto " +
    "«{other}» gemeint? Erwartet: jeder Standort unter dem Foto, das dort aufgenommen wurde",
  positionsSameView:
    "die Fotos «{one}» und «{other}» haben dieselbe äussere Orientierung: ist eines die Kopie des anderen? " +
    "Erwartet: jedes Foto einmal, und andere von deutlich anderen Standorten",
  // Rows of the files
  rowsMillimetres: " (sind sie in Millimetern?)",
  rowsOneFar:
    "die Passpunkte stehen in zwei Koordinatensystemen: {names} liegt {distance} km von den {count} anderen " +
    "entlang {axis}{unit}. Erwartet: alle Koordinaten in einem System und einer Einheit",
  rowsSomeFar:
    "die Passpunkte stehen in zwei Koordinatensystemen: {names} liegen {distance} km von den {count} anderen " +
    "entlang {axis}{unit}. Erwartet: alle Koordinaten in einem System und einer Einheit",
  rowsDegrees:
    "x und y der Passpunkte sehen aus wie Länge und Breite in Grad: sie umfassen {x} und {y}, z umfasst {z}. " +
    "Erwartet: Meter einer Kartenprojektion oder eines lokalen Systems",
  rowsSamePlace:
    "der Punkt «{name}» hat die gleichen Koordinaten wie «{other}» in Zeile {line}: ein Versehen beim Kopieren? " +
    "Erwartet: jeder Punkt einmal, unter einem Namen",
  rowsSameMarks:
    "das Foto «{other}» hat bei {count} Punkten genau die Messungen des Fotos «{one}»: es ist dasselbe Foto, oder " +
    "die Zeilen wurden kopiert. Erwartet: jedes Foto und jede Messung einmal, sonst zählten sie doppelt",
  rowsUnused:
    "der Punkt «{name}» ist auf keinem Foto gemessen und in keinem Polygon{meant} Erwartet: ein Name für einen " +
    "Punkt in allen Dateien",
  rowsLoneMark:
    "der Punkt «{name}»: nur ein Strahl, vom Foto «{photo}», nicht bestimmt; macht nicht mit. Erwartet: eine " +
    "Messung auf einem zweiten Foto, oder ein Polygon, das ihn hält{meant}",
  // Scale
  scaleApart:
    "die Strecke von «{from}» nach «{to}» ist {value} m, ihre Koordinaten liegen {surveyed} m auseinander",
  scaleDiffer: "{apart}. Erwartet: beide gleich, in Metern",
  scalePointsUnit: "{apart}: sind die Passpunkte in {unit}? Erwartet: beide gleich, in Metern",
  scaleValueUnit: "{apart}: ist value_m in {unit}? Erwartet: beide gleich, in Metern",
  scaleControl:
    "die Passpunkte sind in {unit}: {apart} ({file}:{line}). Erwartet: Koordinaten und Sigmas in Metern",
  scaleWhole:
    "die Kameras stehen {distance} m von den Passpunkten, deren Koordinaten ganze Zahlen sind: sind diese in " +
    "Millimetern? Erwartet: Meter; Fotos allein kennen den Massstab nicht, eine Strecke in constraints.json schon",
  scaleFar:
    "die Kameras stehen {distance} m von den Passpunkten: sind diese in Millimetern? Erwartet: Meter; Fotos allein " +
    "kennen den Massstab nicht, eine Strecke in constraints.json schon",
  scaleClose:
    "die Kameras stehen {distance} m von den Passpunkten: sind deren Koordinaten in Kilometern? Erwartet: Meter",
  scaleSigmas:
    "die Passpunkte haben Sigmas von {sigma} m, passen aber auf {fit} m zu den Fotos: sind die Sigmas in " +
    "Millimetern? Erwartet: Meter"
};
