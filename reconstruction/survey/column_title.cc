// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/survey/column_title.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "calibration/files/plain_text.h"
#include "calibration/files/words.h"

namespace insitu {
namespace {

using TitleWords = std::set<std::string>;

constexpr double kFoot = 0.3048, kSurveyFoot = 1200.0 / 3937;
constexpr char kPlainFoot[] = "feet";

// Accents are off and letters small: "Höhe" is "hohe".
const TitleWords kXWords = {"x",           "e",          "east",          "easting", "ost",
                            "ostwert",     "rechtswert", "rechts",        "rw",      "longitude",
                            "long",        "lon",        "lng",           "lange",   "laenge",
                            "longitudine", "px",         "ostkoordinate", "xcoord",  "ecoord"};
const TitleWords kYWords = {
    "y",        "n",   "north",  "northing",   "nord", "nordwert",       "hochwert", "hoch",  "hw",
    "latitude", "lat", "breite", "latitudine", "py",   "nordkoordinate", "ycoord",   "ncoord"};
const TitleWords kZWords = {
    "z",       "h",       "altitude",   "alt",        "elevation",   "elev",   "height",
    "hgt",     "heights", "hohe",       "hoehe",      "hohen",       "quota",  "altezza",
    "hauteur", "cota",    "altitudine", "meereshohe", "meereshoehe", "zcoord", "elevazione"};
const TitleWords kGeographicWords = {"longitude", "long",   "lon",         "lng",
                                     "lange",     "laenge", "longitudine", "latitude",
                                     "lat",       "breite", "latitudine"};
const TitleWords kEllipsoidWords = {"ellipsoidal",   "ellips",         "ellip",
                                    "ellipsoidisch", "ellipsoidische", "ellipsoid",
                                    "wgs84",         "ellissoidica",   "ellipsoidale"};
const TitleWords kOrthometricWords = {
    "orthometric", "ortho", "orthometrisch", "orthometrische", "msl",          "nhn", "dhhn", "nn",
    "ln02",        "egm",   "ign69",         "ortometrica",    "orthometrique"};
const TitleWords kSigmaWords = {"accuracy",    "sigma",
                                "sigmas",      "std",
                                "stdev",       "stddev",
                                "stdv",        "sd",
                                "precision",   "prec",
                                "rms",         "rmse",
                                "genauigkeit", "standardabweichung",
                                "stabw",       "ecart",
                                "emq",         "precisione",
                                "scarto",      "sqm",
                                "incertezza",  "incertitude",
                                "uncertainty", "unsicherheit",
                                "cq",          "quality",
                                "mittlerer",   "sx",
                                "sy",          "sz",
                                "se",          "sn",
                                "sh",          "sxy",
                                "sxyz",        "hrms",
                                "vrms",        "hsdv",
                                "vsdv",        "sdx",
                                "sdy",         "sdz",
                                "sde",         "sdn",
                                "sdh",         "my",
                                "mx",          "mz"};
// Of something else than the point, or no measurement: residuals and estimates beside Metashape's.
const TitleWords kOtherWords = {
    "error",        "errors",     "estimated",  "var",        "variance",     "projections",
    "antenna",      "antenne",    "antennen",   "rod",        "pole",         "instrument",
    "geoid",        "undulation", "separation", "base",       "baseline",     "units",
    "unit",         "dop",        "pdop",       "hdop",       "vdop",         "gdop",
    "residual",     "residuals",  "samples",    "satellites", "start",        "end",
    "status",       "yaw",        "pitch",      "roll",       "scale",        "factor",
    "convergence",  "slope",      "distance",   "offset",     "delta",        "dx",
    "dy",           "dz",         "objectid",   "fid",        "code",         "description",
    "beschreibung", "bemerkung",  "remark",     "comment",    "antennenhohe", "antennenhoehe",
    "einheit",      "origin",     "date",       "time",       "job",          "project",
    "cs",           "crs",        "mount",      "operator",   "feature",      "layer",
    "stake"};
const TitleWords kPhotoWords = {"photo", "image", "filename", "file",      "img",
                                "foto",  "bild",  "immagine", "photograph"};
const TitleWords kNameWords = {"name",        "label",     "nom",      "nome",
                               "bezeichnung", "punktname", "pointname"};
const TitleWords kPointWords = {"id",          "point",     "gcp",       "marker",  "target",
                                "station",     "punkt",     "punto",     "pt",      "pointid",
                                "ptid",        "nr",        "no",        "num",     "number",
                                "nummer",      "numero",    "matricule", "pnr",     "punktnr",
                                "punktnummer", "passpunkt", "pkt",       "punktid", "pktnr"};

bool HasAny(const TitleWords& words, const TitleWords& wanted) {
  return std::any_of(wanted.begin(), wanted.end(),
                     [&](const auto& word) { return words.contains(word); });
}

TitleWords WordsOf(const std::string& title) {
  std::string text, folded = Folded(title);
  const size_t number = folded.find("n\xC2\xB0");
  if (number != std::string::npos) folded.replace(number, 3, "no ");
  for (const char letter : folded) {
    text += std::isalnum(static_cast<unsigned char>(letter)) ? letter : ' ';
  }
  const std::vector<std::string> words = SplitAtBlanks(text);
  return {words.begin(), words.end()};
}

ColumnUnit Length(double factor, const char* name) {
  return {ColumnUnit::Kind::kLength, factor, name};
}

using UnitNames = std::map<std::string, ColumnUnit>;

void AddLengths(UnitNames* units) {
  const auto add = [&](const std::vector<const char*>& names, const ColumnUnit& unit) {
    for (const char* name : names) units->emplace(name, unit);
  };
  add({"m", "meter", "meters", "metre", "metres", "metri", "metro"}, Length(1, "m"));
  add({"mm", "millimeter", "millimetre", "millimeters", "millimetres", "millimetri"},
      Length(1e-3, "mm"));
  add({"cm", "centimeter", "centimetre", "centimeters", "centimetres", "zentimeter"},
      Length(1e-2, "cm"));
  add({"dm", "dezimeter"}, Length(0.1, "dm"));
  add({"km", "kilometer", "kilometre", "kilometers", "kilometres"}, Length(1e3, "km"));
  add({"ft", "feet", "foot", "fuss", "pieds", "piedi"}, Length(kFoot, kPlainFoot));
  add({"ift", "intft", "ftint", "internationalfeet", "internationalfoot", "intfeet", "ftintl",
       "internationalft", "footint", "feetint", "feetinternational", "ftinternational", "fti"},
      Length(kFoot, "international feet"));
  add({"usft", "ftus", "ussurveyfeet", "ussurveyfoot", "surveyfeet", "surveyfoot", "sft", "usfeet",
       "usfoot", "feetus", "footus", "ussft", "surveyft", "ussurveyft", "usfootsurvey",
       "ftussurvey", "ussf"},
      Length(kSurveyFoot, "US survey feet"));
  add({"in", "inch", "inches", "zoll"}, Length(0.0254, "inches"));
  add({"yd", "yard", "yards"}, Length(0.9144, "yards"));
}

const UnitNames& Units() {
  static const UnitNames units = [] {
    using Kind = ColumnUnit::Kind;
    UnitNames all;
    AddLengths(&all);
    for (const char* name : {"deg", "degree", "degrees", "\xC2\xB0", "degrees", "decimaldegrees",
                             "dd", "gradi", "degres", "altgrad"}) {
      all.emplace(name, ColumnUnit{Kind::kAngle, 1, "degrees"});
    }
    for (const char* name : {"gon", "gons", "grads", "grades", "gradians", "neugrad", "ngrad"}) {
      all.emplace(name, ColumnUnit{Kind::kAngle, 0.9, "gon"});
    }
    for (const char* name : {"rad", "radian", "radians"}) {
      all.emplace(name, ColumnUnit{Kind::kAngle, 180 / M_PI, "radians"});
    }
    for (const char* name : {"dms", "dmmss", "degminsec"}) {
      all.emplace(name, ColumnUnit{Kind::kAngle, 1, "degrees, minutes, seconds"});
    }
    for (const char* name : {"px", "pixel", "pixels", "pix"}) {
      all.emplace(name, ColumnUnit{Kind::kPixel, 1, "px"});
    }
    for (const char* name : {"norm", "normalized", "normalised", "normalisiert", "normalise", "01",
                             "relative", "%", "percent"}) {
      all.emplace(name, ColumnUnit{Kind::kShare, 1, "shares of the picture"});
    }
    return all;
  }();
  return units;
}

// What stands in brackets, each on its own, and the rest of the title.
std::pair<std::string, std::vector<std::string>> WithoutBrackets(const std::string& title) {
  std::string rest;
  std::vector<std::string> inside;
  int depth = 0;
  for (const char letter : title) {
    if (letter == '(' || letter == '[' || letter == '{') {
      if (depth++ == 0) inside.emplace_back();
    } else if (letter == ')' || letter == ']' || letter == '}') {
      depth = std::max(depth - 1, 0);
      rest += ' ';
    } else {
      (depth > 0 ? inside.back() : rest) += letter;
    }
  }
  return {rest, inside};
}

// A unit behind the title's last mark: "Easting_ft", "E in m", "X/mm", "Easting US ft".
std::optional<ColumnUnit> TrailingUnit(const std::string& rest) {
  std::string text = Folded(rest);
  for (char& letter : text) {
    if (letter == '_' || letter == '/' || letter == '-' || letter == '.') letter = ' ';
  }
  const std::vector<std::string> words = SplitAtBlanks(text);
  for (size_t count = std::min<size_t>(words.size(), 4); count-- > 1;) {
    std::string joined;
    for (size_t i = words.size() - count; i < words.size(); ++i) joined += words[i];
    if (joined == "in" || joined == "no") continue;
    const auto unit = UnitByName(joined);
    if (unit) return unit;
  }
  return std::nullopt;
}

Column SigmaOf(const TitleWords& words, ColumnTitle* title) {
  const bool has_x =
      HasAny(words, kXWords) || HasAny(words, {"sx", "se", "sdx", "sde", "mx", "est"});
  const bool has_y = HasAny(words, kYWords) || HasAny(words, {"sy", "sn", "sdy", "sdn", "my"});
  if (HasAny(words, {"xyz", "sxyz", "3d", "enh"})) return Column::kSigmaXyz;
  if (has_x && has_y) {  // "Accuracy_X/Y_(m)", "Accuracy_X/Y/Z_(m)"
    return HasAny(words, kZWords) ? Column::kSigmaXyz : Column::kSigmaXy;
  }
  if (HasAny(words, {"xy", "sxy", "en", "horz", "horizontal", "hz", "lateral", "plan",
                     "planimetric", "2d", "hrms", "hsdv", "lage", "planimetrie"})) {
    return Column::kSigmaXy;
  }
  if (HasAny(words, {"vert", "vertical", "vrms", "vsdv", "1d", "sz", "sh", "sdz", "sdh", "mz"})) {
    return Column::kSigmaZ;
  }
  if (has_x) return Column::kSigmaX;
  if (words.contains("v")) return Column::kSigmaZ;
  if (has_y) return Column::kSigmaY;
  title->is_letter_h = words.contains("h");
  return HasAny(words, kZWords) ? Column::kSigmaZ : Column::kSigmaXyz;
}

// "Est" is east in French and Italian; beside another word Metashape's estimate.
bool IsEstimate(const TitleWords& words) {
  return words.contains("est") && words.size() > 1 &&
         (HasAny(words, kXWords) || HasAny(words, kYWords) || HasAny(words, kZWords));
}

// u and v, which other titles hold too: "Höhe ü. M."
bool IsPictureAxis(const TitleWords& words, const char* axis) {
  return words.contains(axis) && (words.size() == 1 || HasAny(words, kPhotoWords) ||
                                  HasAny(words, {"pixel", "px", "coord", "coordinate"}));
}

Column MeaningOf(const TitleWords& words, ColumnTitle* title) {
  if (HasAny(words, {"projections", "antenna", "base", "var", "variance", "units"}) ||
      IsEstimate(words)) {
    return Column::kOther;
  }
  if (HasAny(words, kSigmaWords)) return SigmaOf(words, title);
  if (words == TitleWords{"p"}) return Column::kName;  // P,N,E,Z,D of field books
  if (HasAny(words, {"enable", "enabled"})) return Column::kEnabled;
  if (HasAny(words, {"role", "type", "rolle", "typ"}) && words.size() == 1) return Column::kRole;
  if (HasAny(words, kOtherWords)) return Column::kOther;
  if (HasAny(words, kXWords) || words.contains("est") || IsPictureAxis(words, "u"))
    return Column::kX;
  if (HasAny(words, kYWords) || IsPictureAxis(words, "v")) return Column::kY;
  const bool is_height =
      HasAny(words, kZWords) || HasAny(words, kEllipsoidWords) || HasAny(words, kOrthometricWords);
  if (is_height && !HasAny(words, {"target", "ziel"})) return Column::kZ;
  if (HasAny(words, kPhotoWords)) return Column::kPhoto;
  if (HasAny(words, kNameWords) || HasAny(words, kPointWords)) return Column::kName;
  return Column::kOther;
}

// How many words say something beside the quantity.
int RankOf(const TitleWords& words, Column column) {
  TitleWords plain;
  if (column == Column::kX) plain = kXWords;
  if (column == Column::kY) plain = kYWords;
  if (column == Column::kZ) plain = kZWords;
  if (column == Column::kPhoto) plain = kPhotoWords;
  if (column == Column::kName) plain = kPointWords;
  plain.insert(
      {"coordinate", "coordinates", "koordinate", "coord", "coordonnee", "coordinata", "est"});
  // Beside a plain one they leave open which is meant.
  if (column >= Column::kX && column <= Column::kZ) plain.insert({"grid", "ground", "local"});
  const bool is_named = column == Column::kName || column == Column::kPhoto;
  if (is_named) plain.insert(kNameWords.begin(), kNameWords.end());
  const auto others = std::count_if(words.begin(), words.end(),
                                    [&](const auto& word) { return !plain.contains(word); });
  const bool is_number_only = column == Column::kName && !HasAny(words, kNameWords);
  return 2 * static_cast<int>(others) + is_number_only;
}

const std::vector<std::pair<std::string, Column>>& ColumnNames() {
  static const std::vector<std::pair<std::string, Column>> names = {
      {"name", Column::kName},
      {"photo", Column::kPhoto},
      {"east", Column::kX},
      {"north", Column::kY},
      {"height", Column::kZ},
      {"sigma_east", Column::kSigmaX},
      {"sigma_north", Column::kSigmaY},
      {"sigma_height", Column::kSigmaZ},
      {"sigma_plan", Column::kSigmaXy},
      {"sigma", Column::kSigmaXyz},
      {"role", Column::kRole}};
  return names;
}

bool StatesLimits(const std::string& folded) {
  for (const char* sign : {"95", "2 sigma", "2sigma", "2drms", "99", "2-sigma"}) {
    if (folded.find(sign) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

std::optional<ColumnUnit> UnitByName(const std::string& name) {
  std::string plain;
  for (const char letter : Folded(name)) {
    const bool is_mark =
        letter == ' ' || letter == '.' || letter == '-' || letter == '_' || letter == ',';
    if (!is_mark) plain += letter;
  }
  if (plain.find("\xC2\xB0") != std::string::npos) plain = "\xC2\xB0";
  const auto unit = Units().find(plain);
  return unit == Units().end() ? std::nullopt : std::optional(unit->second);
}

bool IsPlainFoot(const ColumnUnit& unit) { return unit.name == kPlainFoot; }

ColumnTitle ReadColumnTitle(const std::string& text) {
  ColumnTitle title;
  title.text = text;
  const auto [rest, inside] = WithoutBrackets(text);
  std::string words_of = rest;
  std::optional<std::string> unknown;
  for (const std::string& part : inside) {
    auto unit = UnitByName(part);
    const std::vector<std::string> first = SplitAtBlanks(part);
    if (!unit && first.size() > 1) unit = UnitByName(first[0]);  // "Höhe [m ü. M.]"
    if (unit) {
      title.unit = unit;
    } else {
      words_of += " " + part;
      if (text.find("[" + part + "]") != std::string::npos) unknown = part;
    }
  }
  const TitleWords words = WordsOf(words_of);
  title.column = MeaningOf(words, &title);
  if (!title.unit) title.unit = TrailingUnit(rest);
  TitleWords said = words;
  if (title.unit && inside.empty()) {
    std::erase_if(said, [](const auto& word) { return UnitByName(word).has_value(); });
  }
  title.rank = RankOf(said, title.column);
  title.is_geographic = HasAny(words, kGeographicWords);
  title.is_ellipsoidal = HasAny(words, kEllipsoidWords);
  TitleWords others = words;
  title.is_map_axis = others.erase("x") + others.erase("y") > 0 && !HasAny(others, kXWords) &&
                      !HasAny(others, kYWords);
  const bool is_sigma = title.column >= Column::kSigmaX && title.column <= Column::kSigmaXyz;
  if (unknown && !title.unit && title.column != Column::kOther && title.column != Column::kName) {
    title.fault =
        Sentence("titleUnit", "the unit [{unit}] is none that we know", {{"unit", *unknown}});
  } else if (is_sigma && StatesLimits(Folded(text))) {
    title.fault = Sentence("titleLimits",
                           "holds limits of a confidence, expected standard deviations: divide by "
                           "what they are of sigma");
  }
  return title;
}

std::optional<Column> ColumnByName(const std::string& name) {
  for (const auto& [word, column] : ColumnNames()) {
    if (word == name) return column;
  }
  return std::nullopt;
}

std::string NameOf(Column column) {
  for (const auto& [word, named] : ColumnNames()) {
    if (named == column) return word;
  }
  return "enabled";
}

}  // namespace insitu
