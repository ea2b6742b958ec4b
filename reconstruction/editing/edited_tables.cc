// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/editing/edited_tables.h"

#include <algorithm>

#include "calibration/files/text_table.h"

namespace insitu {
namespace {

using Fields = std::vector<std::string>;

EditedTable CsvTable(const std::string& name, Fields key, Fields columns, Fields numbers,
                     bool has_state) {
  EditedTable table{name, "survey/" + name + ".csv"};
  table.key = std::move(key);
  table.columns = std::move(columns);
  table.numbers = std::move(numbers);
  table.has_state = has_state;
  return table;
}

EditedTable JsonTable(const std::string& name, const std::string& file, TableForm form, Fields key,
                      Fields columns) {
  EditedTable table{name, file, form};
  if (form != TableForm::kRoot) table.member = name;
  table.key = std::move(key);
  table.columns = std::move(columns);
  return table;
}

EditedTable SampleTable(const std::string& name) {
  return JsonTable(name, "survey/samples.json", TableForm::kList, {"photo", "x", "y"},
                   {"photo", "x", "y", "polygon"});
}

// The certificate of scanned film, its list of fiducial marks, and where they are on each scan.
std::vector<EditedTable> FilmTables() {
  std::vector<EditedTable> tables = {
      JsonTable("film", "calibration/film.json", TableForm::kRoot, {},
                {"focal_mm", "principal_point_mm", "distortion", "transformation"}),
      JsonTable("film_marks", "calibration/film.json", TableForm::kList, {"mark"},
                {"mark", "x_mm", "y_mm"}),
      CsvTable("fiducials", {"photo", "mark"}, {"mark", "x_mm", "y_mm", "photo", "x", "y"},
               {"x_mm", "y_mm", "x", "y"}, true)};
  tables[1].member = "fiducials";
  tables[2].file = "calibration/fiducials.csv";
  return tables;
}

std::vector<EditedTable> MakeTables() {
  const Fields position = {"x", "y", "z", "sigma_x", "sigma_y", "sigma_z"};
  const Fields pixel = {"x", "y", "sigma"};
  const auto with = [&](Fields before, Fields after = {}) {
    Fields columns = std::move(before);
    const Fields& middle = after.empty() ? pixel : position;
    columns.insert(columns.end(), middle.begin(), middle.end());
    columns.insert(columns.end(), after.begin(), after.end());
    return columns;
  };
  std::vector<EditedTable> tables = {
      CsvTable("control_points", {"name"}, with({"name"}, {"role"}), position, false),
      CsvTable("observations", {"photo", "point"}, with({"photo", "point"}), pixel, true),
      CsvTable("edges", {"photo", "from", "to", "x", "y"}, with({"photo", "from", "to"}), pixel,
               true),
      CsvTable("camera_positions", {"photo"}, with({"photo"}, {"role"}), position, false),
      JsonTable("polygons", "survey/polygons.json", TableForm::kList, {"name"},
                {"name", "vertices", "holes", "photo", "material", "mask"}),
      JsonTable("sun", "survey/directions.json", TableForm::kList, {"shadow", "object"},
                {"object", "shadow"}),
      JsonTable("zenith", "survey/directions.json", TableForm::kList, {"bottom", "top"},
                {"bottom", "top"}),
      JsonTable("constraints", "survey/constraints.json", TableForm::kList, {},
                {"kind", "points", "polygons", "value_m", "sigma_m"}),
      SampleTable("horizon"),
      SampleTable("haze"),
      SampleTable("daylight"),
      JsonTable("light", "survey/samples.json", TableForm::kRoot, {}, {}),
      JsonTable("materials", "survey/materials.json", TableForm::kMembers, {"name"}, {}),
      JsonTable("drafts", "survey/drafts.json", TableForm::kList, {"id"}, {"id"}),
      JsonTable("site", "site.json", TableForm::kRoot, {}, {"name"}),
  };
  const std::vector<EditedTable> film = FilmTables();
  tables.insert(tables.end(), film.begin(), film.end());
  for (EditedTable& table : tables) table.is_null_when_empty = table.name == "haze";
  return tables;
}

bool MeansNothing(const EditedTable& table, const std::string& field, const Json::Value& value) {
  if (value.isNull()) return true;
  if (table.form != TableForm::kCsv || !value.isString()) return false;
  return value.asString().empty() ||
         (table.has_state && field == "state" && value.asString() == "on");
}

// Whether what `a` says stands in `b`.
bool HasMeaningOf(const EditedTable& table, const Json::Value& a, const Json::Value& b) {
  for (auto member = a.begin(); member != a.end(); ++member) {
    const std::string name = member.name();
    if (MeansNothing(table, name, *member)) continue;
    const Json::Value* other = b.find(name.data(), name.data() + name.size());
    if (!other || !IsSameValue(*member, *other)) return false;
  }
  return true;
}

Json::Value Meaning(const Json::Value& row) {
  Json::Value meaning(Json::objectValue);
  for (auto member = row.begin(); member != row.end(); ++member) {
    if (!member->isNull()) meaning[member.name()] = *member;
  }
  return meaning;
}

bool HasSameMembers(const Json::Value& a, const Json::Value& b) {
  for (auto member = a.begin(); member != a.end(); ++member) {
    const std::string name = member.name();
    const Json::Value* other = b.find(name.data(), name.data() + name.size());
    if (!IsSameValue(*member, other ? *other : Json::Value::nullSingleton())) return false;
  }
  return true;
}

std::string QuotedJson(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    constexpr char kDigits[] = "0123456789abcdef";
    if (c == '"' || c == '\\') {
      quoted += std::string("\\") + c;
    } else if (c == '\n') {
      quoted += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20) {
      quoted += std::string("\\u00") + kDigits[(c >> 4) & 15] + kDigits[c & 15];
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

}  // namespace

const std::vector<EditedTable>& EditedTables() {
  static const std::vector<EditedTable> tables = MakeTables();
  return tables;
}

const EditedTable* FindEditedTable(const std::string& name) {
  for (const EditedTable& table : EditedTables()) {
    if (table.name == name) return &table;
  }
  return nullptr;
}

bool IsSameValue(const Json::Value& a, const Json::Value& b) {
  if (a.isNumeric() && b.isNumeric()) return a.asDouble() == b.asDouble();
  if (a.isObject() && b.isObject()) return HasSameMembers(a, b) && HasSameMembers(b, a);
  if (!a.isArray() || !b.isArray()) return a == b;
  if (a.size() != b.size()) return false;
  for (Json::ArrayIndex i = 0; i < a.size(); ++i) {
    if (!IsSameValue(a[i], b[i])) return false;
  }
  return true;
}

bool IsSameRow(const EditedTable& table, const Json::Value& a, const Json::Value& b) {
  if (!a.isObject() || !b.isObject()) return IsSameValue(a, b);
  return HasMeaningOf(table, a, b) && HasMeaningOf(table, b, a);
}

std::string KeyOfRow(const EditedTable& table, const Json::Value& row) {
  if (table.form == TableForm::kRoot || !row.isObject()) return "";
  if (table.key.empty()) return OneLineJson(Meaning(row));
  std::string key;
  for (const std::string& field : table.key) key += OneLineJson(row[field]) + '\n';
  return key;
}

std::string RowText(const Json::Value& row, const std::string& field) {
  if (!row.isObject()) return "";
  const Json::Value* value = row.find(field.data(), field.data() + field.size());
  return value && value->isString() ? value->asString() : "";
}

std::string NumberText(const Json::Value& number) {
  return number.type() == Json::realValue ? Digits(number.asDouble()) : number.asString();
}

std::string OneLineJson(const Json::Value& value) {
  if (value.isString()) return QuotedJson(value.asString());
  if (value.isNumeric()) return NumberText(value);
  if (value.isBool()) return value.asBool() ? "true" : "false";
  if (value.isNull()) return "null";
  std::string text;
  for (auto member = value.begin(); member != value.end(); ++member) {
    if (!text.empty()) text += ", ";
    if (value.isObject()) text += QuotedJson(member.name()) + ": ";
    text += OneLineJson(*member);
  }
  return value.isObject() ? "{" + text + "}" : "[" + text + "]";
}

}  // namespace insitu
