// SPDX-License-Identifier: GPL-3.0-or-later
// What the server finds wrong with scanned film, files, photos and questions, in German (Swiss).

/** @type {Record<string, string>} */
export const kFaultTexts = {
  // Scanned film: what the certificate lacks, what is wrong with it
  filmNoFocal: "die Kammerkonstante",
  filmNoMarks: "noch {count} Rahmenmarken mit ihren Millimetern",
  filmListedTwice: "der Kalibrierschein nennt die Marke {mark} zweimal",
  filmOtherMillimetres: "die Marke {mark} von {photo} hat andere Millimeter als im Kalibrierschein",
  filmFolders: "mehrere Ordner in calibration/ enthalten Film; diese Seite zeigt jenen in {folder}",
  filmNoPhoto: "das Foto {photo} ist nicht im Ordner photos",
  filmOtherCamera:
    "{file} gehört zu einer anderen Kamera: entfernen, oder in einen Ordner in calibration/ verschieben und " +
    "insitu prepare neu starten; der Film hat dann den Ordner calibration/film/",
  // What a scan's fiducial marks say of each other
  filmOnLine: "die Marken liegen auf einer Geraden: eine daneben setzen",
  filmSamePlace: "die Marken {one} und {other} stehen am selben Ort: eine davon gehört anderswohin",
  filmMirrored:
    "der Scan ist gegen seine Marken gespiegelt: x und y des Kalibrierscheins vertauscht, y nach unten gezählt, " +
    "zwei gegenüberliegende Marken vertauscht, oder der Film von hinten gescannt",
  filmStretched:
    "der Scan wäre um {percent} % gestreckt oder geschert, was kein Scanner tut: eine Marke steht auf der " +
    "falschen Rahmenmarke, oder x oder y einer Marke ist falsch",
  filmExchanged: "die Marken {one} und {other} sind vertauscht",
  filmWrongMark: "die Marke {one} steht auf der Marke {other}",
  filmSwapped: "x und y der Marke {mark} sind im Kalibrierschein vertauscht",
  filmWrongX: "x der Marke {mark} hat im Kalibrierschein das falsche Vorzeichen",
  filmWrongY: "y der Marke {mark} hat im Kalibrierschein das falsche Vorzeichen",
  filmOffOthers: "die Marke {mark} liegt {px} px ({mm} mm) von dort, wo die andern sie haben",
  filmOr: "{one}, oder {other}",
  filmExplained: "{what}: ohne das passen sie auf {px} px statt {now} px",
  filmFewFit:
    "die Marken passen nicht, bis {px} px daneben: bei so wenigen ist nicht zu sagen, welche falsch ist; " +
    "mehr setzen",
  filmSeveralWrong:
    "die Marken passen nicht, bis {px} px daneben: mehrere sind falsch; mit der schlimmsten beginnen",
  filmBuckled:
    "die Marken passen nur auf {px} px: nochmals messen; bei altem oder welligem Film projektiv versuchen",
  // survey/materials.json and the library
  shareRange: "liegt ausserhalb des Bereichs, nötig ist 0 bis 1",
  weightRange: "liegt ausserhalb des Bereichs, nötig ist mehr als 0",
  materialIndex: "ist keine Brechzahl, nötig ist mehr als 1",
  materialDistribution: "ist «{text}», nötig ist «ggx» oder «beckmann»",
  materialMetal: "ist «{kind}», nötig ist «none», «fresnel», «mirror» oder «conductor»",
  materialSpecular: "ist «{kind}», nötig ist «none», «fresnel» oder «mirror»",
  materialBumps: "steht bei einer Fläche, die nichts spiegelt: ihr Foto zeigt, was das Licht aus den Wellen macht",
  materialDiffuse: "ist «{text}», nötig ist «from photo»",
  bumpsLength: "liegt ausserhalb des Bereichs, nötig sind Meter über 0",
  bumpsSpread: "steht ohne «direction» da",
  bumpsDirection: "ist null, nötig ist [x, y, z] im System der Vermessung",
  bumpsDegrees: "liegt ausserhalb des Bereichs, nötig ist 0 bis 180",
  bumpsSlope: "liegt ausserhalb des Bereichs, nötig ist eine Neigung über 0",
  bumpsSteep: "liegt ausserhalb des Bereichs, nötig ist höchstens 1",
  bumpsLonger: "ist länger als «scale_m»",
  libraryNone: "ist «{name}», {what} der Bibliothek{near}{lamps} (insitu materials zählt sie auf)",
  libraryMaterial: "kein Material",
  libraryLamp: "keine Lampe",
  libraryNear: "; ist {name} gemeint?",
  libraryLamps: "; nötig ist D65, A, blackbody oder eine Lampe der Bibliothek",
  libraryNoReflectance: "hat keinen Reflexionsgrad nach Wellenlängen, der hier nötig ist",
  libraryRange: "deckt das sichtbare Licht nicht, nötig sind Zeilen von 420 nm oder weniger bis 680 oder mehr",
  // Cameras of DBAT
  dbatNumbers: "{count} Zahlen, nötig sind {least}",
  dbatMoreNumbers: "{count} Zahlen, nötig sind {least} oder mehr",
  dbatSensor: "nötig sind Breite,Höhe in mm, als Breite auch «auto»",
  dbatSize: "Bild und Sensor müssen eine Grösse haben",
  dbatWidth: "die Breite muss grösser als 0 oder «auto» sein",
  dbatAspect: "«{text}», nötig ist eine Zahl nahe 1",
  dbatModel:
    "Objektivmodell {model}, nötig ist 3, oder 1 oder 2 ohne Affinität: nur diese lassen sich hier ausgleichen",
  dbatAffineModel:
    "Objektivmodell {model} mit Affinität, nötig ist 3, oder 1 oder 2 ohne Affinität: nur diese lassen sich hier " +
    "ausgleichen",
  dbatConstant: "die Kammerkonstante muss grösser als 0 sein",
  dbatCoefficients: "nötig sind höchstens {most} Koeffizienten",
  dbatBlank: "ist nicht grösser als 0, nötig ist eine kalibrierte Kamera",
  dbatCameraUnit: "«{unit}», nötig ist mm",
  dbatFocal: "die Brennweite muss grösser als 0 sein",
  dbatNoFocal: "<focal> und <cc> fehlen, nötig ist eines von beiden",
  dbatCameraNone: "enthält keine Kamera, nötig ist <document><cameras><camera> von DBAT",
  dbatSeveral: "enthält mehrere Kameras, nötig ist eine, oder ein Ordner, der wie ihre <id> heisst",
  // Files and the disk
  notWritable: "lässt sich nicht schreiben ({reason})",
  diskFull: "kein Platz mehr auf dem Datenträger",
  diskReadOnly: "der Datenträger ist schreibgeschützt",
  noAccess: "keine Berechtigung",
  journalLong: "lässt sich nicht kürzen: {why}",
  journalTorn: "{place}: die letzte Zeile war abgerissen und ist entfernt; sie war nie bestätigt",
  fileReadOnly: "ist schreibgeschützt; nötig ist eine Datei, die geschrieben werden darf",
  fileNotWritten: "lässt sich nicht schreiben; ist der Datenträger voll?",
  fileContended: "wird von einem anderen Programm geschrieben",
  fileContendedLong: "wird von einem anderen Programm dauernd geschrieben",
  fileRemoved: "{file} wurde entfernt; die Datei wird neu geschrieben",
  columnMissing: "die Spalte «{column}» fehlt; nötig ist die Kopfzeile {header}",
  columnTwice: "die Spalte «{column}» steht zweimal; nötig ist die Kopfzeile {header}",
  cellCount: "{count} Zellen, nötig sind {expected}",
  cellNumber: "«{text}» in der Spalte «{column}», nötig ist eine endliche Zahl",
  outsideConflict:
    "{table}: eine Zeile wurde hier und in der Datei geändert; jene der Datei gilt, Ihre war {row}",
  // Photos
  offPhoto: "{table}: das Pixel liegt ausserhalb des Fotos {photo}",
  photoCut: "ist abgeschnitten; nötig ist ein ganzes Foto",
  photoUndecoded: "lässt sich nicht lesen: {why}",
  photoUnreadable: "kein lesbares Bild: {why}",
  photoSize: "ist {size}, kalibriert wurde seine Kamera mit {expected}",
  photoNone: "lässt sich nicht lesen; nötig ist ein Foto",
  photoOther: "hat eine andere Grösse als vorher, nötig ist {size}",
  photoGone: "gibt es nicht mehr; nötig ist ein Foto",
  photoLarge: "ist {size}, höchstens 536 Megapixel dürften es sein; verkleinern",
  photoColors: "ist {colors}, nötig ist RGB oder Grau; in sRGB umwandeln",
  photoType: "hat Pixel der Art {type}, nötig sind 8 oder 16 Bit, half oder float",
  photoDamaged: "abgeschnitten oder beschädigt: {why}",
  photoNotFinite: "das Pixel ({x}, {y}) ist NaN oder unendlich, nötig sind endliche Werte",
  lensNone: "kein Kameramodell, nötig ist eine ganze Datei .cameramodel von mrcal",
  lensUnknown: "sein Objektivmodell ist unbekannt",
  lensExtrinsics: "seine äussere Orientierung ist nicht endlich",
  exifCameraThere: "eine Kamera ist schon da: insitu-calibrate ausführen",
  exifNoFocal: "sein EXIF nennt keine brauchbare Brennweite",
  exifOther:
    "andere Grösse oder Brennweite als die Fotos davor: ihre Kameras gehören in Ordner in calibration/",
  exifNoPhotos: "keine Fotos",
  exifNoPlace: "EXIF keines Fotos nennt Ort oder Zeit: dort eintippen, wo der Name des Projekts steht",
  // Questions
  matchFirst: "der Punkt muss hier gemessen und bestimmt sein",
  askedPhoto: "das Foto {photo} ist noch nicht orientiert",
  askedPoint: "der Punkt {point} ist noch nicht bestimmt",
  askedPoints: "nicht alle diese Punkte sind ausgeglichen, oder zwei liegen am selben Ort",
  askedNothing: "noch ist nichts ausgeglichen",
  askedTwo: "nötig sind zwei Punkte, oder drei für einen Winkel",
  askedThree: "nötig sind drei Eckpunkte oder mehr",
  pastedDegrees: "das sind Grade: insitu import-survey rechnet sie um",
  pastedCrs: "Koordinatensystem {crs}: wird genommen, wie es dasteht",
  pastedSigma: "kein σ angegeben: 0.01 m angenommen",
  stageBusy: "ein anderer Schritt läuft: anhalten oder sein Ende abwarten"
};
