// SPDX-License-Identifier: GPL-3.0-or-later
// Why a row is refused, and what is wrong with a survey's file, in German (Swiss).

/** @type {Record<string, string>} */
export const kRowTexts = {
  // A row that somebody wants
  or: "{one} oder {other}",
  rowOf: "{table}: {fault}",
  rowNoTable: "es gibt keine Tabelle «{table}»",
  rowNoColumn: "{table}: die Spalte «{field}» gibt es nicht",
  rowReadOnly: "{place}: {fault}; bis das behoben ist, lässt sich die Tabelle nur lesen",
  nothingToUndo: "nichts rückgängig zu machen",
  nothingToRedo: "nichts wiederherzustellen",
  rowEmpty: "{what} ist leer",
  rowBlanks: "{what} {name} beginnt oder endet mit einem Leerzeichen",
  rowControl: "{what} {name} enthält ein Steuerzeichen",
  rowNotUtf8: "{what} {name} ist nicht UTF-8",
  rowTiePoint: "{what} {name} heisst wie ein Verknüpfungspunkt; nötig ist ein anderer Name",
  rowNoNumber: "{field} ist keine Zahl",
  rowNotFinite: "{field} ist nicht endlich",
  rowNotPositive: "{field} ist nicht grösser als 0",
  rowOutside: "{field} liegt ausserhalb jedes Fotos",
  rowWord: "{field} ist {word}, nötig ist {words}",
  rowSamePoint: "{from} und {to} sind derselbe Punkt",
  rowNoText: "{field} ist kein Text",
  rowNoHoles: "die Löcher sind keine Liste",
  rowFewInHole: "ein Loch hat nicht drei Eckpunkte",
  rowNoHoleVertex: "ein Eckpunkt eines Lochs ist kein Name",
  rowVertexTwice: "der Eckpunkt {name} kommt zweimal vor, im Umriss oder in einem Loch",
  rowNoVertices: "die Eckpunkte sind keine Liste",
  rowNoVertex: "ein Eckpunkt ist kein Name",
  rowVertices: "hat {count} Eckpunkte, davon {distinct} verschiedene; nötig sind mindestens drei, alle verschieden",
  rowNoMask: "mask ist kein Name einer Datei",
  rowNoKey: "{key} ist hier kein Schlüssel, nötig ist {keys}",
  rowPoints: "nennt {count} Punkte, nötig sind {points}",
  rowSubjects: "nennt {count} Punkte oder Polygone, nötig sind {points} Punkte oder {polygons} Polygone",
  rowNoSubject: "ein Punkt oder Polygon ist kein Name",
  rowSubjectTwice: "nennt eines davon zweimal",
  rowKind: "die Art {word} ist unbekannt",
  rowEitherSigma: "nötig ist entweder sigma_deg oder sigma_mm_per_m",
  rowReflectance: "daylight_reflectance_rgb: nötig sind drei Zahlen über 0 und bis 1",
  rowDistortion: "distortion: nötig sind [Radius_mm, Verzeichnung_mm] mit steigenden Radien über 0",
  rowTwoRadii: "distortion: nötig sind zwei Radien oder mehr",
  rowPrincipalPoint: "principal_point_mm: nötig sind zwei Zahlen",
  rowNumberNotFinite: "eine Zahl ist nicht endlich",
  rowTextNotUtf8: "ein Text ist nicht UTF-8",
  rowNoId: "id fehlt",
  photoNotThere: "das Foto «{photo}» ist nicht im Ordner photos{hint}",
  photoEnding: "; «{photo}» schreiben, ohne die Endung",
  // JSON
  jsonInvalid: "kein gültiges JSON: {why}",
  jsonMissing: "«{key}» fehlt",
  jsonOther: "ist {what}, nötig ist {expected}",
  jsonNull: "null",
  jsonBoolean: "ein Wahrheitswert",
  jsonText: "ein Text",
  jsonArray: "eine Liste",
  jsonObject: "ein Objekt",
  jsonObjectWith: "ein Objekt mit «{key}»",
  jsonNumber: "eine Zahl",
  jsonWhole: "eine ganze Zahl",
  jsonBool: "true oder false",
  jsonNotFinite: "ist nicht endlich, nötig ist eine endliche Zahl",
  jsonNumbers: "hat {count} Zahlen, nötig sind {expected}",
  // Tables of a survey
  tableEmpty: "leer, nötig ist die Kopfzeile {header}",
  columnNone: "die Spalte «{column}» fehlt",
  cellEmpty: "die Spalte «{column}» ist leer",
  cellMixed:
    "«{text}» in der Spalte «{column}», nötig ist eine endliche Zahl; manche Zahlen der Tabelle haben " +
    "Dezimalkommas, andere Punkte",
  cellNotPositive: "{column} ist {text}, nötig ist mehr als 0",
  cellRole: "role ist «{text}», nötig ist {words}",
  cellPixel:
    "{column} ist {text}, nötig ist eine Stelle des unveränderten Fotos in Pixeln, gezählt von der Mitte des " +
    "Pixels oben links",
  pointTwice: "der Punkt «{point}» steht schon in Zeile {line}, nötig ist jeder Name einmal",
  markTwice:
    "der Punkt «{point}» ist auf dem Foto «{photo}» schon in Zeile {line} gemessen, nötig ist eine Bildmessung " +
    "je Foto: eine Zeile entfernen, oder den Punkt nennen, den sie zeigt",
  positionTwice: "das Foto «{photo}» hat schon in Zeile {line} eine Position, nötig ist jedes Foto einmal",
  edgeItself: "die Kante verbindet den Punkt «{point}» mit sich selbst, nötig sind zwei Punkte",
  // Tables that are pasted
  fileEmpty: "ist leer",
  formatUnknown:
    "hat kein bekanntes Format; nötig ist zum Beispiel ein Koordinatensystem und Zeilen «X Y Z px py Bild Name» " +
    "(OpenDroneMap), eine Kopfzeile «name,x,y,z», Zeilen «Name X Y Z», Zeilen «Bild,Punkt,x,y» (Pix4D), XML von " +
    "Metashape, MicMac oder DBAT, JSON von OpenSfM",
  surveyNothing: "enthält weder Punkte noch Bildmessungen (gelesen als {format})",
  wordMissing: "{what} fehlt, nötig als Wert {index} der Zeile",
  wordNumber: "«{text}» für {what}, nötig ist eine endliche Zahl",
  wordWhole: "«{text}» für {what}, nötig ist eine ganze Zahl",
  wordMixed:
    "«{text}» für {what}, nötig ist eine endliche Zahl; manche Zahlen der Tabelle haben Dezimalkommas, andere Punkte",
  accuracyParts: "nötig ist eine Genauigkeit aus einem bis drei Teilen",
  accuracyBad: "eine Genauigkeit, die nicht positiv ist",
  accuracyNotPositive: "die Genauigkeit ist {text}, nötig ist mehr als 0",
  flagBad: "«{text}» in der Spalte enable, nötig ist 0 oder 1",
  marksShares:
    "alle Bildmessungen liegen zwischen -1 und 1: Anteile der Bildseiten; nötig sind Pixel des unveränderten Fotos",
  tableSystems:
    "«{here}» in der Spalte «{column}», aber «{before}» in Zeile {line}: zwei Koordinatensysteme in einer Tabelle; nötig ist eine Datei für jedes",
  pointsOnePlace: "der Punkt «{point}» steht am Ort von «{other}»",
  listValues:
    "{count} Werte; nötig sind Name x y z, dann nichts, oder Genauigkeiten von Lage und Höhe, oder von x, y und z",
  remarkUnits: "umgerechnet in Meter oder Grad: {units}",
  remarkColumns: "neben den Spalten, die genommen werden, weggelassen: {columns}",
  remarkPixels: "sagt nicht, von wo seine Pixel zählen: von der Mitte des Pixels oben links angenommen",
  remarkUnstated: "{count} Unsicherheiten sind 1, was MicMac schreibt, wenn keine angegeben war",
  remarkUnpinned: "{count} Bildmessungen sind nicht bestätigt, nur vorausgesagt, und weggelassen",
  remarkNoAltitude: "der Punkt «{point}» hat keine Höhe und ist weggelassen",
  remarkNoPhoto: "{count} Bildmessungen sind auf Fotos, die nicht im Ordner photos sind",
  remarkFixed: "{count} Punkte sind dort fest, ohne σ",
  remarkNoHeight: "{count} Bildmessungen sind von Punkten ohne Höhe und weggelassen",
  remarkUnusedMarks: "{count} Bildmessungen sind als unbenutzt bezeichnet",
  remarkUnusedPoints: "{count} Punkte sind als unbenutzt bezeichnet",
  remarkFifthColumn: "die fünfte Spalte (je nach Version Zoom oder Genauigkeit) gilt nicht als σ",
  odmOneLine:
    "das Koordinatensystem und der erste Punkt stehen auf einer Zeile ({begin}...), nötig ist ein Zeilenende " +
    "nach dem System",
  aiconCamera: "Bildmessungen in mm brauchen die Kamera daneben, «{file}»",
  aiconOneCamera: "nötig ist eine Kamera für die Bildmessungen aller Fotos",
  openSfmTwo: "nötig sind zwei Zahlen",
  openSfmOff: "liegt neben dem Bild, nötig ist -0.5 bis 0.5 seiner längeren Seite",
  // Scripts of DBAT and their tables
  dbatHere: "«{text}»: hier ist nur $HERE bekannt, nötig ist ein Pfad von dort aus",
  dbatNoFile: "ist leer, nötig ist der Name einer Datei",
  dbatFileGone: "die Datei «{file}» gibt es nicht",
  dbatFilter: "nötig ist keep oder remove",
  dbatTwice: "das Bild «{image}» steht zweimal",
  dbatSxy: "sxy muss grösser als 0 sein",
  dbatNoSigma: "Bildmessungen ohne σ, nötig ist eine Spalte oder ein Attribut sxy",
  dbatNoMarks: "keine einzige Bildmessung",
  dbatUnits: "units=«{units}», nötig ist degrees oder radians",
  dbatNoCamera: "keine Kamera",
  dbatLoaded: "«{text}», nötig ist loaded oder default",
  dbatTruth: "«{text}», nötig ist true oder false",
  dbatParameter: "ist kein bekannter Parameter einer Kamera",
  dbatFixed: "teilweise feste Orientierungen gehen nicht, nötig ist überall true",
  dbatUnit: "«{text}», nötig ist m oder mm",
  dbatNoScript: "ist kein Skript von DBAT: dbat_script_version fehlt",
  dbatSigmas: "σ müssen grösser als 0 sein, oder für einen festen Punkt alle 0",
  dbatNoColumn: "das Format dieser Tabelle hat keine Spalte «{column}»",
  dbatEmpty: "die Spalte «{column}» ist leer",
  dbatNumber: "«{text}» in der Spalte «{column}», nötig ist eine Zahl",
  dbatValues: "{count} Werte, nötig sind {expected} ({format})",
  dbatPointTwice: "der Punkt «{point}» steht auch auf Zeile {line}",
  dbatImage: "das Bild «{image}» ist nicht in der Liste der Bilder",
  // Titles of columns
  columnOfName: "der Name des Punkts",
  columnOfPhoto: "das Foto",
  columnOfX: "Ost (x)",
  columnOfY: "Nord (y)",
  columnOfHeight: "die Höhe",
  columnOfAccuracy: "eine Genauigkeit",
  columnsEqual:
    "die Spalten {titles} sind alle {quantity}; welche ist gemeint? Die anderen weglassen, oder " +
    "insitu import-survey mit --column {name}=TITEL",
  columnFault: "die Spalte {title}: {fault}",
  columnsOrder:
    "die Spalte {y} steht vor {x}, wie dort, wo x nach Norden zählt; welche ist Ost? Die Spalten Ost und Nord " +
    "nennen, oder insitu import-survey mit --column east=TITEL --column north=TITEL",
  columnUnit: "die Spalte {title} ist in {unit}, nötig ist {expected}",
  unitAngle: "Grad oder Gon",
  unitLength: "eine Länge",
  unitPixels: "Pixel des unveränderten Fotos",
  columnFeet:
    "die Spalte {title} ist in Fuss, von denen es zwei gibt (2 ppm verschieden: ein Meter auf 500 km); " +
    'insitu import-survey mit --unit "US survey feet" oder --unit "international feet" sagt, welche',
  columnMissingOf:
    "keine Spalte ist {quantity} (es gibt {columns}); einer diesen Namen geben, oder insitu import-survey mit " +
    "--column {name}=TITEL",
  titleUnit: "die Einheit [{unit}] ist keine bekannte",
  titleLimits:
    "Grenzen eines Vertrauensbereichs, nötig sind Standardabweichungen: durch das teilen, was sie von σ sind",
  // XML
  xmlElement: "<{element}>: {message}",
  xmlInvalid: "kein gültiges XML ({why})",
  xmlNothing: "kein XML: es hat kein Element",
  xmlNumber: "«{text}», nötig ist eine endliche Zahl",
  xmlNumbers: "«{text}», nötig sind endliche Zahlen",
  xmlNoNumbers: "ist leer, nötig sind Zahlen",
  xmlMissing: "<{name}> fehlt",
  xmlNoAttribute: "das Attribut «{name}» fehlt",
  xmlAttribute: "{name}=«{text}», nötig ist eine endliche Zahl",
  xmlCount: "{count} Zahlen, nötig sind {expected}",
  xmlSigmas: "nötig sind Unsicherheiten grösser als 0",
  xmlVariances: "nötig sind Varianzen grösser als 0",
  xmlUnknown: "ist keine bekannte Vermessung, nötig ist XML von Metashape, MicMac, MMVII oder DBAT",
  xmlAccuracy: "nötig ist für jede Achse eine Genauigkeit grösser als 0",
  xmlNoMarker: "marker_id nennt keinen Marker",
  xmlNoCamera: "camera_id nennt keine Kamera",
  xmlNoChunk:
    "ist weder ein Chunk von Metashape noch ein Skript von DBAT; nötig sind von Metashape die exportierten " +
    "Marker, von DBAT das Skript, das seine anderen Dateien nennt",
  // Polygons, pairs, constraints of a survey
  ringOutline: "der Umriss schneidet sich selbst oder hat keine Fläche",
  ringHole: "Loch {hole} schneidet sich selbst oder hat keine Fläche",
  ringOutside: "Loch {hole} liegt nicht im Umriss",
  ringsOverlap: "Loch {hole} und Loch {other} überdecken sich",
  ringsNothing: "die Löcher lassen nichts übrig",
  polygonBent:
    "das Polygon «{polygon}» ist alles andere als eben: der Eckpunkt «{vertex}» liegt {off} neben der besten " +
    "Ebene, höchstens {limit} dürften es sein ({tolerance} und zehn σ von {sigma}, dem des unsichersten Eckpunkts)",
  polygonHoles:
    "das Polygon «{polygon}»: {fault}; nötig sind Löcher im Umriss, ihre Eckpunkte der Reihe nach",
  polygonCrossed:
    "der Umriss des Polygons «{polygon}» schneidet sich selbst oder hat keine Fläche; nötig sind die " +
    "Eckpunkte der Reihe nach",
  pairAway:
    "das Paar von «{from}» nach «{to}» zeigt von den anderen Paaren weg; nötig sind zwei Punkte in der " +
    "Reihenfolge, die in der Datei steht",
  pointsOneSpot: "«{from}» und «{to}» liegen am selben Ort, nötig sind zwei verschiedene Punkte",
  maskNotThere: "die Maske «{mask}» ist nicht im Ordner survey",
  keyUnknown: "«{key}» ist dort kein Schlüssel, nötig ist einer von {expected}",
  holeFew: "ein Loch des Polygons «{polygon}» hat {count} Eckpunkte, nötig sind mindestens drei",
  holeVertexTwice:
    "ein Loch des Polygons «{polygon}» hat den Eckpunkt «{vertex}», den das Polygon schon hat; nötig ist jeder " +
    "Eckpunkt einmal",
  polygonVertices:
    "das Polygon «{polygon}» hat {count} Eckpunkte, davon {distinct} verschiedene; nötig sind mindestens drei, " +
    "alle verschieden",
  polygonTwice: "das Polygon «{polygon}» kommt zweimal vor",
  pairTwice: "das Paar nennt den Punkt «{point}» zweimal, nötig sind zwei Punkte",
  kindUnknown: "die Art ist «{word}», nötig ist eine von {words}",
  constraintSubjects: "eine Bedingung «{kind_name}» gilt für {points} verschiedene Punkte oder {polygons} Polygone",
  notPositive: "ist {number}, nötig ist mehr als 0",
  eitherSigma: "nötig ist entweder «sigma_deg» oder «sigma_mm_per_m»",
  constraintPolygon: "nennt das Polygon «{polygon}», nötig ist ein Polygon aus polygons.json{hint}"
};
