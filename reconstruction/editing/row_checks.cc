// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/editing/row_checks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "calibration/files/json_file.h"
#include "calibration/files/text_table.h"
#include "calibration/files/wording.h"
#include "reconstruction/editing/survey_text.h"
#include "reconstruction/survey/survey_names.h"
#include "reconstruction/survey/tie_points.h"

namespace insitu {
namespace {

using Fault = std::optional<Sentence>;
using Texts = std::vector<std::string>;

constexpr double kLargestFrame = 100000;  // [px], as reconstruction/survey reads it

bool IsIn(const Texts& texts, const std::string& text) {
  return std::find(texts.begin(), texts.end(), text) != texts.end();
}

Json::Value OrList(const Texts& texts) {
  Sentence list = Sentence::Verbatim(texts.at(0));
  for (size_t i = 1; i < texts.size(); ++i) {
    list = Sentence("or", "{one} or {other}", {{"one", list.ToJson()}, {"other", texts[i]}});
  }
  return list.ToJson();
}

Fault FaultOfName(const std::string& what, const std::string& name) {
  if (name.empty()) return Sentence("rowEmpty", "{what} is empty", {{"what", what}});
  const Sentence::Values values = {{"what", what}, {"name", Quoted(name)}};
  if (TrimmedView(name) != name) {
    return Sentence("rowBlanks", "{what} {name} begins or ends with a blank", values);
  }
  const bool has_control = std::any_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
  });
  if (has_control) return Sentence("rowControl", "{what} {name} has a control character", values);
  if (FirstNotUtf8(name)) return Sentence("rowNotUtf8", "{what} {name} is not UTF-8", values);
  return std::nullopt;
}

Fault FaultOfPoint(const std::string& what, const std::string& name) {
  if (!IsTiePointName(name)) return FaultOfName(what, name);
  return Sentence("rowTiePoint", "{what} {name} is named as tie points are, expected another name",
                  {{"what", what}, {"name", Quoted(name)}});
}

Fault FaultOfNumber(const Json::Value& row, const std::string& field) {
  const Json::Value& value = row[field];
  if (!value.isNumeric())
    return Sentence("rowNoNumber", "{field} is no number", {{"field", field}});
  if (std::isfinite(value.asDouble())) return std::nullopt;
  return Sentence("rowNotFinite", "{field} is not finite", {{"field", field}});
}

Fault FaultOfSigma(const Json::Value& row, const std::string& field) {
  if (const Fault fault = FaultOfNumber(row, field)) return fault;
  if (row[field].asDouble() > 0) return std::nullopt;
  return Sentence("rowNotPositive", "{field} is not more than 0", {{"field", field}});
}

Fault FaultOfPixel(const Json::Value& row) {
  for (const std::string field : {"x", "y"}) {
    if (const Fault fault = FaultOfNumber(row, field)) return fault;
    const double value = row[field].asDouble();
    if (value < -0.5 || value > kLargestFrame) {
      return Sentence("rowOutside", "{field} is outside any photograph", {{"field", field}});
    }
  }
  return std::nullopt;
}

Fault FaultOfPhotoName(const Json::Value& row, const Texts& photos) {
  const std::string photo = RowText(row, "photo");
  if (const Fault fault = FaultOfName("photo", photo)) return fault;
  return FaultOfPhoto(photo, photos);
}

Fault FaultOfWord(const Json::Value& row, const std::string& field, const Texts& words) {
  const std::string word = RowText(row, field);
  if (IsIn(words, word)) return std::nullopt;
  return Sentence("rowWord", "{field} is {word}, expected {words}",
                  {{"field", field}, {"word", Quoted(word)}, {"words", OrList(words)}});
}

template <typename... Faults>
Fault FirstFault(const Faults&... faults) {
  for (const Fault& fault : {Fault(faults)...}) {
    if (fault) return fault;
  }
  return std::nullopt;
}

// Two names that must differ.
Fault FaultOfTwo(const Json::Value& row, const std::string& from, const std::string& to) {
  for (const std::string& field : {from, to}) {
    if (const Fault fault = FaultOfPoint(field, RowText(row, field))) return fault;
  }
  if (RowText(row, from) != RowText(row, to)) return std::nullopt;
  return Sentence("rowSamePoint", "{from} and {to} are the same point",
                  {{"from", from}, {"to", to}});
}

// Cells that the checks of the table do not look at.
Fault FaultOfOtherCells(const EditedTable& table, const Json::Value& row) {
  for (auto member = row.begin(); member != row.end(); ++member) {
    if (IsIn(table.columns, member.name()) || member->isNull()) continue;
    if (!member->isString()) {
      return Sentence("rowNoText", "{field} is no text", {{"field", member.name()}});
    }
    if (member->asString().empty()) continue;
    if (const Fault fault = FaultOfName(member.name(), member->asString())) return fault;
  }
  if (!table.has_state || RowText(row, "state").empty()) return std::nullopt;
  return FaultOfWord(row, "state", {"on", "off", "dubious"});
}

Fault FaultOfPosition(const Json::Value& row) {
  return FirstFault(FaultOfNumber(row, "x"), FaultOfNumber(row, "y"), FaultOfNumber(row, "z"),
                    FaultOfSigma(row, "sigma_x"), FaultOfSigma(row, "sigma_y"),
                    FaultOfSigma(row, "sigma_z"));
}

// Every vertex of a polygon occurs once, in its outline or in one hole.
Fault FaultOfHoles(const Json::Value& holes, std::set<std::string> taken) {
  if (holes.isNull()) return std::nullopt;
  if (!holes.isArray()) return Sentence("rowNoHoles", "holes are no list");
  for (const Json::Value& hole : holes) {
    if (!hole.isArray() || hole.size() < 3) {
      return Sentence("rowFewInHole", "a hole has not three vertices");
    }
    for (const Json::Value& vertex : hole) {
      if (!vertex.isString()) return Sentence("rowNoHoleVertex", "a hole's vertex is no name");
      if (const Fault fault = FaultOfPoint("vertex", vertex.asString())) return fault;
      if (!taken.insert(vertex.asString()).second) {
        return Sentence("rowVertexTwice", "vertex {name} occurs twice, in the outline or a hole",
                        {{"name", Quoted(vertex.asString())}});
      }
    }
  }
  return std::nullopt;
}

Fault FaultOfPolygon(const Json::Value& row, const Texts& photos) {
  std::set<std::string> distinct;
  if (!row["vertices"].isArray()) return Sentence("rowNoVertices", "vertices are no list");
  for (const Json::Value& vertex : row["vertices"]) {
    if (!vertex.isString()) return Sentence("rowNoVertex", "a vertex is no name");
    if (const Fault fault = FaultOfPoint("vertex", vertex.asString())) return fault;
    distinct.insert(vertex.asString());
  }
  if (distinct.size() < 3 || distinct.size() < row["vertices"].size()) {
    return Sentence(
        "rowVertices",
        "has {count} vertices, {distinct} of them distinct; expected at least three, all "
        "distinct",
        {{"count", row["vertices"].size()}, {"distinct", int(distinct.size())}});
  }
  if (const Fault fault = FaultOfHoles(row["holes"], distinct)) return fault;
  if (!row["mask"].isNull() && !row["mask"].isString()) {
    return Sentence("rowNoMask", "mask is no name of a file");
  }
  return FirstFault(FaultOfName("name", RowText(row, "name")),
                    FaultOfName("material", RowText(row, "material")),
                    row["photo"].isNull() ? Fault() : FaultOfPhotoName(row, photos));
}

Fault FaultOfKeys(const Json::Value& row, const Texts& keys) {
  for (const std::string& key : row.getMemberNames()) {
    if (IsRemarkKey(key) || IsIn(keys, key)) continue;
    return Sentence("rowNoKey", "{key} is no key here, expected {keys}",
                    {{"key", Quoted(key)}, {"keys", OrList(keys)}});
  }
  return std::nullopt;
}

struct ConstraintShape {
  size_t points, polygons;
  bool has_value;
};

const std::map<std::string, ConstraintShape>& ConstraintShapes() {
  static const std::map<std::string, ConstraintShape> shapes = {
      {"distance", {2, 0, true}},    {"height", {2, 0, true}},    {"vertical", {2, 1, false}},
      {"horizontal", {2, 1, false}}, {"parallel", {4, 2, false}}, {"perpendicular", {4, 2, false}}};
  return shapes;
}

Fault FaultOfSubjects(const Json::Value& row, const ConstraintShape& shape) {
  const bool has_points = !row["points"].empty();
  const Json::Value& names = has_points ? row["points"] : row["polygons"];
  const size_t expected = has_points ? shape.points : shape.polygons;
  if (!names.isArray() || names.size() != expected || expected == 0 ||
      (has_points && !row["polygons"].empty())) {
    if (shape.polygons == 0) {
      return Sentence("rowPoints", "names {count} points, expected {points}",
                      {{"count", names.size()}, {"points", int(shape.points)}});
    }
    return Sentence("rowSubjects",
                    "names {count} points or polygons, expected {points} points or {polygons} "
                    "polygons",
                    {{"count", names.size()},
                     {"points", int(shape.points)},
                     {"polygons", int(shape.polygons)}});
  }
  std::set<std::set<std::string>> edges;
  for (Json::ArrayIndex i = 0; i < names.size(); ++i) {
    if (!names[i].isString()) return Sentence("rowNoSubject", "a point or polygon is no name");
    if (const Fault fault = FaultOfPoint("name", names[i].asString())) return fault;
    if (i % 2 == 0) continue;
    const std::set<std::string> edge = {names[i - 1].asString(), names[i].asString()};
    if (edge.size() < 2 || !edges.insert(edge).second) {
      return Sentence("rowSubjectTwice", "names one of them twice");
    }
  }
  return std::nullopt;
}

Fault FaultOfConstraint(const Json::Value& row) {
  const auto shape = ConstraintShapes().find(RowText(row, "kind"));
  if (shape == ConstraintShapes().end())
    return Sentence("rowKind", "kind {word} is unknown", {{"word", Quoted(RowText(row, "kind"))}});
  Texts keys = {"kind", "points"};
  if (shape->second.polygons > 0) keys.push_back("polygons");
  const Texts values =
      shape->second.has_value ? Texts{"value_m", "sigma_m"} : Texts{"sigma_deg", "sigma_mm_per_m"};
  keys.insert(keys.end(), values.begin(), values.end());
  if (const Fault fault = FirstFault(FaultOfKeys(row, keys), FaultOfSubjects(row, shape->second))) {
    return fault;
  }
  if (shape->second.has_value) {
    const bool is_distance = shape->first == "distance";
    return FirstFault(is_distance ? FaultOfSigma(row, "value_m") : FaultOfNumber(row, "value_m"),
                      FaultOfSigma(row, "sigma_m"));
  }
  const bool has_degrees = !row["sigma_deg"].isNull();
  if (has_degrees == !row["sigma_mm_per_m"].isNull()) {
    return Sentence("rowEitherSigma", "expected either sigma_deg or sigma_mm_per_m");
  }
  return FaultOfSigma(row, has_degrees ? "sigma_deg" : "sigma_mm_per_m");
}

Fault FaultOfReflectance(const Json::Value& rgb) {
  if (rgb.isNull()) return std::nullopt;
  const auto is_part = [](const Json::Value& value) {
    return value.isNumeric() && value.asDouble() > 0 && value.asDouble() <= 1;
  };
  const bool is_fine =
      rgb.isArray() && rgb.size() == 3 && std::all_of(rgb.begin(), rgb.end(), is_part);
  if (is_fine) return std::nullopt;
  return Sentence("rowReflectance",
                  "daylight_reflectance_rgb: expected three numbers above 0 and up to 1");
}

Fault FaultOfMillimetres(const Json::Value& row) {
  return FirstFault(FaultOfName("mark", RowText(row, "mark")), FaultOfNumber(row, "x_mm"),
                    FaultOfNumber(row, "y_mm"));
}

Fault FaultOfDistortion(const Json::Value& rows) {
  if (rows.isNull()) return std::nullopt;
  double last = 0;
  for (const Json::Value& row : rows) {
    const bool rises = row.isArray() && row.size() == 2 && row[0].isNumeric() &&
                       row[1].isNumeric() && row[0].asDouble() > last;
    if (!rises) {
      return Sentence("rowDistortion",
                      "distortion: expected [radius_mm, distortion_mm] with radii rising from > 0");
    }
    last = row[0].asDouble();
  }
  if (rows.isArray() && rows.size() != 1) return std::nullopt;
  return Sentence("rowTwoRadii", "distortion: expected two radii or more");
}

// Of a certificate as far as it is typed.
Fault FaultOfCertificate(const Json::Value& row) {
  const Json::Value& point = row["principal_point_mm"];
  const bool has_point =
      point.isArray() && point.size() == 2 && point[0].isNumeric() && point[1].isNumeric();
  if (!point.isNull() && !has_point) {
    return Sentence("rowPrincipalPoint", "principal_point_mm: expected two numbers");
  }
  return FirstFault(row["focal_mm"].isNull() ? Fault() : FaultOfSigma(row, "focal_mm"),
                    FaultOfDistortion(row["distortion"]),
                    row["transformation"].isNull()
                        ? Fault()
                        : FaultOfWord(row, "transformation", {"affine", "projective"}));
}

// Anywhere in a value: what JSON could not hold.
Fault FaultWithin(const Json::Value& value) {
  if (value.isNumeric() && !std::isfinite(value.asDouble())) {
    return Sentence("rowNumberNotFinite", "a number is not finite");
  }
  if (value.isString() && FirstNotUtf8(value.asString())) {
    return Sentence("rowTextNotUtf8", "a text is not UTF-8");
  }
  if (!value.isArray() && !value.isObject()) return std::nullopt;
  for (const Json::Value& item : value) {
    if (const Fault fault = FaultWithin(item)) return fault;
  }
  return std::nullopt;
}

Fault FaultOfCsvRow(const EditedTable& table, const Json::Value& row, const Texts& photos) {
  if (const Fault fault = FaultOfOtherCells(table, row)) return fault;
  if (table.name == "control_points") {
    return FirstFault(FaultOfPoint("name", RowText(row, "name")), FaultOfPosition(row),
                      FaultOfWord(row, "role", {"control", "check"}));
  }
  if (const Fault fault = FaultOfPhotoName(row, photos)) return fault;
  if (table.name == "fiducials") return FirstFault(FaultOfMillimetres(row), FaultOfPixel(row));
  if (table.name == "camera_positions") {
    return FirstFault(FaultOfPosition(row),
                      FaultOfWord(row, "role", {"fixed", "weighted", "free"}));
  }
  return FirstFault(table.name == "observations" ? FaultOfPoint("point", RowText(row, "point"))
                                                 : FaultOfTwo(row, "from", "to"),
                    FaultOfPixel(row), FaultOfSigma(row, "sigma"));
}

}  // namespace

std::optional<Sentence> FaultOfRow(const EditedTable& table, const Json::Value& row,
                                   const std::vector<std::string>& photos) {
  if (const Fault fault = FaultWithin(row)) return fault;
  if (table.form == TableForm::kCsv) return FaultOfCsvRow(table, row, photos);
  if (table.name == "polygons") {
    return FirstFault(FaultOfKeys(row, table.columns), FaultOfPolygon(row, photos));
  }
  if (table.name == "sun" || table.name == "zenith") {
    return FirstFault(FaultOfKeys(row, table.columns),
                      FaultOfTwo(row, table.columns[0], table.columns[1]));
  }
  if (table.name == "constraints") return FaultOfConstraint(row);
  if (table.file == "survey/samples.json" && table.form == TableForm::kList) {
    const Fault name =
        table.name == "horizon" ? Fault() : FaultOfName("polygon", RowText(row, "polygon"));
    return FirstFault(FaultOfPhotoName(row, photos), FaultOfPixel(row), name);
  }
  if (table.name == "light") return FaultOfReflectance(row["daylight_reflectance_rgb"]);
  if (table.name == "film") return FaultOfCertificate(row);
  if (table.name == "film_marks") return FaultOfMillimetres(row);
  if (table.name == "materials") return FaultOfName("name", RowText(row, "name"));
  if (table.name == "drafts" && row["id"].isNull()) return Sentence("rowNoId", "id is missing");
  return std::nullopt;
}

}  // namespace insitu
