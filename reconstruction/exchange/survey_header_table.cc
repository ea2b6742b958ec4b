// SPDX-License-Identifier: GPL-3.0-or-later
// Tables whose first line names their columns, in whose words ever: Metashape's reference export,
// GCP Editor Pro, spreadsheets.
#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "reconstruction/exchange/survey_file_formats.h"

namespace insitu {
namespace {

enum class Column {
  kName,
  kPhoto,
  kX,
  kY,
  kZ,
  kSigmaX,
  kSigmaY,
  kSigmaZ,
  kSigmaXy,
  kSigmaXyz,
  kEnabled,
  kRole,
  kOther
};

using Words = std::set<std::string>;

bool HasAny(const Words& words, const Words& wanted) {
  return std::any_of(wanted.begin(), wanted.end(),
                     [&](const auto& word) { return words.contains(word); });
}

Words WordsOf(const std::string& title) {
  std::string text;
  for (const char letter : title) {
    text += std::isalnum(static_cast<unsigned char>(letter))
                ? static_cast<char>(std::tolower(static_cast<unsigned char>(letter)))
                : ' ';
  }
  const std::vector<std::string> words = SplitAtBlanks(text);
  return {words.begin(), words.end()};
}

const Words kXWords = {"x", "easting", "east", "longitude", "lon", "lng", "u", "px"};
const Words kYWords = {"y", "northing", "north", "latitude", "lat", "v", "py"};
const Words kZWords = {"z", "altitude", "alt", "elevation", "height"};

Column SigmaColumn(const Words& words) {
  if (HasAny(words, {"xyz", "sxyz"})) return Column::kSigmaXyz;
  const bool has_both = HasAny(words, kXWords) && HasAny(words, kYWords);  // "Accuracy_X/Y_(m)"
  if (has_both && HasAny(words, kZWords)) return Column::kSigmaXyz;        // "Accuracy_X/Y/Z_(m)"
  if (has_both || HasAny(words, {"xy", "sxy", "horz", "horizontal"})) return Column::kSigmaXy;
  if (HasAny(words, kXWords) || HasAny(words, {"sx", "se"})) return Column::kSigmaX;
  if (HasAny(words, kYWords) || HasAny(words, {"sy", "sn"})) return Column::kSigmaY;
  if (HasAny(words, kZWords) || HasAny(words, {"sz", "sh", "vert", "vertical"})) {
    return Column::kSigmaZ;
  }
  return Column::kSigmaXyz;
}

// Residuals and estimates, which Metashape writes beside what was measured, are kOther.
Column ColumnOf(const std::string& title) {
  const Words words = WordsOf(title);
  if (HasAny(words, {"error", "errors", "est", "estimated", "var", "variance", "projections"})) {
    return Column::kOther;
  }
  if (HasAny(words, {"accuracy", "sigma", "std", "precision", "sx", "sy", "sz", "se", "sn", "sh",
                     "sxy", "sxyz"})) {
    return SigmaColumn(words);
  }
  if (HasAny(words, {"enable", "enabled"})) return Column::kEnabled;
  if (HasAny(words, {"role", "type"})) return Column::kRole;
  if (HasAny(words, kXWords)) return Column::kX;
  if (HasAny(words, kYWords)) return Column::kY;
  if (HasAny(words, kZWords)) return Column::kZ;
  if (HasAny(words, {"photo", "image", "filename", "file", "img"})) return Column::kPhoto;
  if (HasAny(words, {"name", "label", "id", "point", "gcp", "marker", "target", "station"})) {
    return Column::kName;
  }
  return Column::kOther;
}

struct Header {
  int line = 0;
  char separator = ',';
  std::map<Column, size_t> columns;
  bool has_degrees = false;
};

char SeparatorOf(const std::string& line) {
  for (const char separator : {',', ';', '\t'}) {
    if (line.find(separator) != std::string::npos) return separator;
  }
  return ' ';
}

std::vector<std::string> Split(const std::string& line, char separator) {
  return separator == ' ' ? SplitAtBlanks(line) : SplitAt(line, separator);
}

std::optional<Header> ParseHeader(const std::string& text, int line) {
  std::string titles = text;
  while (!titles.empty() && (titles[0] == '#' || titles[0] == ' ')) titles.erase(0, 1);
  Header header{line, SeparatorOf(titles), {}, false};
  const std::vector<std::string> words = Split(titles, header.separator);
  for (size_t i = 0; i < words.size(); ++i) {
    if (ParseNumber(words[i])) return std::nullopt;
    const Column column = ColumnOf(words[i]);
    if (column != Column::kOther) header.columns.emplace(column, i);
    if (column == Column::kX && HasAny(WordsOf(words[i]), {"longitude", "lon", "lng"})) {
      header.has_degrees = true;
    }
  }
  for (const Column needed : {Column::kName, Column::kX, Column::kY}) {
    if (!header.columns.contains(needed)) return std::nullopt;
  }
  if (!header.columns.contains(Column::kPhoto) && !header.columns.contains(Column::kZ)) {
    return std::nullopt;
  }
  return header;
}

// The header stands before the first line of data, perhaps behind a #.
std::optional<Header> FindHeader(const SurveyText& text) {
  std::istringstream stream(text.content);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::string_view trimmed = TrimmedView(line);
    if (trimmed.empty()) continue;
    if (auto header = ParseHeader(std::string(trimmed), number)) return header;
    if (trimmed[0] != '#') return std::nullopt;
  }
  return std::nullopt;
}

// "#CoordinateSystem: WKT" or "# CoordinateSystem: WKT", as versions of Metashape write it.
std::optional<std::string> NamedSystem(const std::string& content) {
  const std::string key = "CoordinateSystem:";
  const size_t start = content.find(key);
  if (start == std::string::npos || content.find_last_of("#\n", start) == std::string::npos ||
      content[content.find_last_of("#\n", start)] != '#') {
    return std::nullopt;
  }
  const size_t end = std::min(content.find('\n', start), content.size());
  return std::string(
      TrimmedView(std::string_view(content).substr(start + key.size(), end - start - key.size())));
}

// One line of data by the header's columns.
class Line {
 public:
  Line(const Header& header, const TextRow& row) : header_(header), row_(row) {}

  bool Has(Column column) const {
    const auto place = header_.columns.find(column);
    return place != header_.columns.end() && place->second < row_.words.size() &&
           !row_.words[place->second].empty();
  }
  const std::string& Text(Column column, const char* what) const {
    return row_.Text(header_.columns.at(column), what);
  }
  double Number(Column column, const char* what) const {
    return row_.Number(header_.columns.at(column), what);
  }
  std::optional<double> Sigma(Column column) const {
    if (!Has(column)) return std::nullopt;
    return Positive(Number(column, "the accuracy"));
  }
  // "0.01/0.01/0.02", as Metashape writes what differs by axis; one number stands for all three.
  std::optional<Eigen::Vector3d> SigmaOfAxes() const {
    if (!Has(Column::kSigmaXyz)) return std::nullopt;
    const auto parts = SplitAt(Text(Column::kSigmaXyz, "the accuracy"), '/');
    if (parts.size() == 1) return Eigen::Vector3d::Constant(*Sigma(Column::kSigmaXyz));
    if (parts.size() > 3) throw row_.Error("expected an accuracy of one to three parts");
    Eigen::Vector3d sigma;
    for (size_t axis = 0; axis < 3; ++axis) {  // of two, plan and height
      const std::string& part = parts[parts.size() == 3 ? axis : axis / 2];
      const auto value = ParseNumber(part);
      if (!value) throw row_.Error("\"" + part + "\" for the accuracy, expected a finite number");
      sigma[static_cast<Eigen::Index>(axis)] = Positive(*value);
    }
    return sigma;
  }
  FilePlace Place() const { return row_.place(); }
  const TextRow& row() const { return row_; }

 private:
  double Positive(double sigma) const {
    if (!(sigma > 0)) throw row_.Error("an accuracy that is not positive");
    return sigma;
  }
  const Header& header_;
  const TextRow& row_;
};

std::optional<Eigen::Vector3d> SigmaOf(const Line& line) {
  const auto all = line.SigmaOfAxes();
  const auto plan = line.Sigma(Column::kSigmaXy);
  const auto x = line.Sigma(Column::kSigmaX), y = line.Sigma(Column::kSigmaY),
             z = line.Sigma(Column::kSigmaZ);
  if ((!x && !plan && !all) || (!y && !plan && !all) || (!z && !all)) return std::nullopt;
  const Eigen::Vector3d rest = all.value_or(Eigen::Vector3d::Zero());
  return Eigen::Vector3d(x.value_or(plan.value_or(rest.x())), y.value_or(plan.value_or(rest.y())),
                         z.value_or(rest.z()));
}

ControlRole RoleOf(const Line& line) {
  if (line.Has(Column::kEnabled)) {
    const std::string& enabled = line.Text(Column::kEnabled, "the enable flag");
    if (enabled != "0" && enabled != "1" && enabled != "true" && enabled != "false" &&
        enabled != "True" && enabled != "False") {
      throw line.row().Error("\"" + enabled + "\" for the enable flag, expected 0 or 1");
    }
    const bool is_on = enabled == "1" || enabled == "true" || enabled == "True";
    return is_on ? ControlRole::kControl : ControlRole::kCheck;
  }
  if (!line.Has(Column::kRole)) return ControlRole::kControl;
  std::string role = line.Text(Column::kRole, "the role");
  for (char& letter : role) letter = static_cast<char>(std::tolower(letter));
  return role.find("check") == std::string::npos ? ControlRole::kControl : ControlRole::kCheck;
}

SurveyedPoint PointOf(const Line& line) {
  return {
      line.Text(Column::kName, "the name"),
      {line.Number(Column::kX, "x"), line.Number(Column::kY, "y"), line.Number(Column::kZ, "z")},
      SigmaOf(line),
      RoleOf(line),
      line.Place()};
}

SurveyedMark MarkOf(const Line& line) {
  return {PhotoName(line.Text(Column::kPhoto, "the photo")),
          line.Text(Column::kName, "the point"),
          {line.Number(Column::kX, "x"), line.Number(Column::kY, "y")},
          line.Sigma(Column::kSigmaXyz),
          line.Place()};
}

}  // namespace

bool IsHeaderTable(const SurveyText& text) { return FindHeader(text).has_value(); }

SurveyFile ReadHeaderTable(const SurveyText& text) {
  const auto header = FindHeader(text);
  INSITU_CHECK(header.has_value());
  const bool has_marks = header->columns.contains(Column::kPhoto);
  SurveyFile file;
  file.crs = NamedSystem(text.content);
  file.has_degrees = header->has_degrees;
  file.format = file.crs ? "reference table of Metashape (CSV)" : "table with a header";
  const std::vector<TextRow> rows =
      header->separator == ';' ? SplitTextRows(text.path, text.content, WordSeparator::kSemicolon)
                               : text.rows;
  for (const TextRow& row : rows) {
    if (row.line <= header->line) continue;
    const Line line(*header, row);
    if (has_marks) {
      file.marks.push_back(MarkOf(line));
    } else {
      file.points.push_back(PointOf(line));
    }
  }
  if (has_marks) {
    file.remarks.push_back(
        "it does not say where its pixels count from: taken from the centre of "
        "the top-left pixel");
  }
  return file;
}

}  // namespace insitu
