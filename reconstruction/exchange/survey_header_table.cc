// SPDX-License-Identifier: GPL-3.0-or-later
// Tables whose first line names their columns, in whose words ever: Metashape's reference export,
// GCP Editor Pro, spreadsheets.
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "calibration/files/delimited_rows.h"
#include "calibration/files/error_at.h"
#include "calibration/files/number_style.h"
#include "calibration/files/plain_text.h"
#include "reconstruction/exchange/survey_file_formats.h"
#include "reconstruction/survey/survey_columns.h"

namespace insitu {
namespace {

struct Header {
  int line = 0;
  char separator = ',';
  std::vector<std::string> titles;
};

std::vector<std::string> Split(const std::filesystem::path& path, const std::string& line,
                               char separator) {
  if (separator == ' ') return SplitAtBlanks(line);
  std::vector<DelimitedRow> rows = SplitDelimited(path, line, separator);
  return rows.empty() ? std::vector<std::string>() : rows[0].cells;
}

// Whether a comment names the columns; prose does not, whatever it holds.
bool NamesColumns(const SurveyText& text, const std::string& titles, Header* header,
                  const SurveyReading& reading) {
  try {
    header->titles = Split(text.path, titles, header->separator);
    return DecideColumns(header->titles, {text.path, header->line}, reading).has_value();
  } catch (const InputError&) {
    return false;
  }
}

bool HasNumber(const std::vector<std::string>& words) {
  return std::any_of(words.begin(), words.end(),
                     [](const auto& word) { return ParseNumber(word).has_value(); });
}

// The header stands before the first line of data, perhaps behind a #; it holds no number.
std::optional<Header> FindTitles(const SurveyText& text, const SurveyReading& reading) {
  const char stated = StatedSeparator(text.content);
  std::istringstream stream(text.content);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    std::string titles(TrimmedView(line));
    if (titles.empty() || (number == 1 && stated != '\0')) continue;
    const bool is_comment = titles[0] == '#';
    while (!titles.empty() && (titles[0] == '#' || titles[0] == ' ')) titles.erase(0, 1);
    Header header{number, stated != '\0' ? stated : SeparatorOfLine(titles), {}};
    if (is_comment) {
      if (NamesColumns(text, titles, &header, reading) && !HasNumber(header.titles)) return header;
      continue;
    }
    header.titles = Split(text.path, titles, header.separator);
    if (HasNumber(header.titles) || header.titles.empty()) return std::nullopt;
    return header;
  }
  return std::nullopt;
}

// "#CoordinateSystem: WKT" or "# CoordinateSystem: WKT", as versions of Metashape write it.
std::optional<std::string> SystemInComment(const std::string& content) {
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

// 47°22'18.5"N, "47 22 18.5 S", -8:30:00, N47 22.5: degrees; nullopt: no such angle.
std::optional<double> ParseAngle(const std::string& cell) {
  double sign = 1;
  std::string text;
  for (const char letter : Folded(cell)) {
    const bool is_hemisphere = letter == 'n' || letter == 's' || letter == 'e' || letter == 'w';
    if (letter == '-' && !text.empty()) return std::nullopt;
    if (letter == '-' || letter == 's' || letter == 'w') sign = -sign;
    const bool is_part = (letter >= '0' && letter <= '9') || letter == '.';
    if (std::isalpha(static_cast<unsigned char>(letter)) && !is_hemisphere) return std::nullopt;
    text += is_part ? letter : ' ';
  }
  const std::vector<std::string> words = SplitAtBlanks(text);
  if (words.empty() || words.size() > 3) return std::nullopt;
  double degrees = 0, unit = 1;
  for (size_t i = 0; i < words.size(); ++i, unit /= 60) {
    const auto value = ParseNumber(words[i]);
    const bool is_whole = value && *value == std::floor(*value);
    if (!value || (i > 0 && *value >= 60) || (i + 1 < words.size() && !is_whole))
      return std::nullopt;
    degrees += *value * unit;
  }
  return sign * degrees;
}

// One line of data by the table's columns, in metres, degrees and pixels.
class Line {
 public:
  Line(const SurveyColumns& columns, const NumberStyle& style, const TextRow& row)
      : columns_(columns), style_(style), row_(row) {}

  bool Has(Column column) const {
    const auto place = columns_.index.find(column);
    return place != columns_.index.end() && place->second < row_.words.size() &&
           !row_.words[place->second].empty();
  }
  const std::string& Text(Column column, const char* what) const {
    return row_.Text(columns_.index.at(column), what);
  }
  double Number(Column column, const char* what) const {
    const std::string& text = Text(column, what);
    auto value = style_.Parse(text);
    const bool is_angle = (column == Column::kX || column == Column::kY) && columns_.has_degrees;
    if (!value && is_angle) value = ParseAngle(text);
    if (value) return *value * FactorOf(column);
    const Sentence::Values values = {{"text", text}, {"what", what}};
    throw ErrorAt(
        row_.place(),
        style_.is_mixed()
            ? Sentence("wordMixed",
                       "\"{text}\" for {what}, expected a finite number; some numbers of "
                       "the table have decimal commas, others points",
                       values)
            : Sentence("wordNumber", "\"{text}\" for {what}, expected a finite number", values));
  }
  std::optional<double> Sigma(Column column) const {
    if (!Has(column)) return std::nullopt;
    return Positive(Number(column, "accuracy"));
  }
  // "0.01/0.01/0.02", as Metashape writes what differs by axis; one number stands for all three.
  std::optional<Eigen::Vector3d> SigmaOfAxes() const {
    if (!Has(Column::kSigmaXyz)) return std::nullopt;
    const auto parts = SplitAt(Text(Column::kSigmaXyz, "accuracy"), '/');
    if (parts.size() == 1) return Eigen::Vector3d::Constant(*Sigma(Column::kSigmaXyz));
    if (parts.size() > 3) {
      throw ErrorAt(row_.place(),
                    Sentence("accuracyParts", "expected an accuracy of one to three parts"));
    }
    Eigen::Vector3d sigma;
    for (size_t axis = 0; axis < 3; ++axis) {  // of two, plan and height
      const std::string& part = parts[parts.size() == 3 ? axis : axis / 2];
      const auto value = style_.Parse(part);
      if (!value) {
        throw ErrorAt(row_.place(),
                      Sentence("wordNumber", "\"{text}\" for {what}, expected a finite number",
                               {{"text", part}, {"what", "accuracy"}}));
      }
      sigma[static_cast<Eigen::Index>(axis)] = Positive(*value * FactorOf(Column::kSigmaXyz));
    }
    return sigma;
  }
  FilePlace Place() const { return row_.place(); }
  const TextRow& row() const { return row_; }

 private:
  double FactorOf(Column column) const {
    const auto unit = columns_.unit.find(column);
    return unit == columns_.unit.end() ? 1 : unit->second.factor;
  }
  double Positive(double sigma) const {
    if (sigma > 0) return sigma;
    throw ErrorAt(row_.place(), Sentence("accuracyBad", "an accuracy that is not positive"));
  }
  const SurveyColumns& columns_;
  const NumberStyle& style_;
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
    const std::string& enabled = line.Text(Column::kEnabled, "enable");
    if (enabled != "0" && enabled != "1" && enabled != "true" && enabled != "false" &&
        enabled != "True" && enabled != "False") {
      throw ErrorAt(line.row().place(),
                    Sentence("flagBad", "\"{text}\" for the enable flag, expected 0 or 1",
                             {{"text", enabled}}));
    }
    const bool is_on = enabled == "1" || enabled == "true" || enabled == "True";
    return is_on ? ControlRole::kControl : ControlRole::kCheck;
  }
  if (!line.Has(Column::kRole)) return ControlRole::kControl;
  std::string role = line.Text(Column::kRole, "role");
  for (char& letter : role) letter = static_cast<char>(std::tolower(letter));
  return role.find("check") == std::string::npos ? ControlRole::kControl : ControlRole::kCheck;
}

SurveyedPoint PointOf(const Line& line) {
  return {
      line.Text(Column::kName, "name"),
      {line.Number(Column::kX, "x"), line.Number(Column::kY, "y"), line.Number(Column::kZ, "z")},
      SigmaOf(line),
      RoleOf(line),
      line.Place()};
}

SurveyedMark MarkOf(const Line& line) {
  return {PhotoName(line.Text(Column::kPhoto, "photo")),
          line.Text(Column::kName, "point"),
          {line.Number(Column::kX, "x"), line.Number(Column::kY, "y")},
          line.Sigma(Column::kSigmaXyz),
          line.Place()};
}

// The lines below the header, as they stand.
std::vector<TextRow> RowsOf(const SurveyText& text, const Header& header) {
  std::vector<TextRow> rows;
  if (header.separator == ' ') {
    rows = SplitTextRows(text.path, text.content, WordSeparator::kBlanks);
  } else {
    for (DelimitedRow& row : SplitDelimited(text.path, text.content, header.separator)) {
      rows.push_back({text.path, row.line, std::move(row.cells)});
    }
  }
  std::erase_if(rows, [&](const TextRow& row) { return row.line <= header.line; });
  return rows;
}

NumberStyle StyleOf(const std::vector<TextRow>& rows, const SurveyColumns& columns) {
  NumberStyle style;
  for (const TextRow& row : rows) {
    for (const auto& [column, index] : columns.index) {
      const bool is_number = column >= Column::kX && column <= Column::kSigmaXyz;
      if (is_number && index < row.words.size()) style.Learn(row.words[index]);
    }
  }
  return style;
}

// Marks that all lie within a pixel of the corner are shares of the picture's sides.
void RequirePixels(const SurveyFile& file) {
  if (file.marks.size() < 3) return;
  const bool are_shares =
      std::all_of(file.marks.begin(), file.marks.end(),
                  [](const SurveyedMark& mark) { return mark.pixel.cwiseAbs().maxCoeff() <= 1; });
  if (!are_shares) return;
  const FilePlace& place = file.marks[0].place;
  throw ErrorAt(place, Sentence("marksShares",
                                "all marks are between -1 and 1: shares of the picture's sides, "
                                "expected pixels of the original photograph"));
}

// A line of units alone below the titles: they move into the titles.
void TakeLineOfUnits(std::vector<TextRow>* rows, std::vector<std::string>* titles) {
  if (rows->empty()) return;
  std::vector<std::string> words = rows->front().words;
  for (std::string& word : words) {
    std::erase_if(word, [](char c) { return c == '[' || c == ']' || c == '(' || c == ')'; });
  }
  const auto is_unit = [](const std::string& word) { return UnitByName(word).has_value(); };
  const auto units = std::count_if(words.begin(), words.end(), is_unit);
  const auto empty = std::count(words.begin(), words.end(), "");
  if (units < 2 || units + empty != std::ssize(words) || words.size() > titles->size()) return;
  for (size_t i = 0; i < words.size(); ++i) {
    if (!words[i].empty()) (*titles)[i] += " [" + words[i] + "]";
  }
  rows->erase(rows->begin());
}

// A column that names each row's coordinate system names one alone.
void RequireOneSystem(const std::vector<std::string>& titles, const std::vector<TextRow>& rows) {
  for (size_t i = 0; i < titles.size(); ++i) {
    std::string title = Folded(titles[i]);
    std::erase_if(title, [](char c) { return c == ' ' || c == '_' || c == '-' || c == '.'; });
    constexpr std::array kSystems = {
        "crs",    "srs",      "epsg",     "csname",  "coordinatesystem",
        "system", "epsgcode", "zone",     "utmzone", "koordinatensystem",
        "datum",  "crscode",  "sridcode", "srid",    "bezugssystem"};
    if (std::ranges::find(kSystems, title) == kSystems.end()) continue;
    const TextRow* first = nullptr;
    for (const TextRow& row : rows) {
      if (i >= row.words.size() || row.words[i].empty()) continue;
      if (first == nullptr) first = &row;
      if (row.words[i] == first->words[i]) continue;
      throw ErrorAt(row.place(),
                    Sentence("tableSystems",
                             "\"{here}\" in column \"{column}\", but \"{before}\" in line {line}: "
                             "two coordinate systems in one table, expected a file for each",
                             {{"here", row.words[i]},
                              {"column", titles[i]},
                              {"before", first->words[i]},
                              {"line", first->line}}));
    }
  }
}

void AddRemarks(const SurveyColumns& columns, const std::vector<std::string>& titles,
                SurveyFile* file) {
  std::string units, left_out;
  for (const auto& [column, unit] : columns.unit) {
    if (unit.factor == 1) continue;
    units +=
        (units.empty() ? "" : ", ") + titles[columns.index.at(column)] + " (" + unit.name + ")";
  }
  if (!units.empty()) {
    file->remarks.push_back(
        Sentence("remarkUnits", "converted to metres or degrees: {units}", {{"units", units}}));
  }
  for (const std::string& title : columns.left_out)
    left_out += (left_out.empty() ? "" : ", ") + title;
  if (!left_out.empty()) {
    file->remarks.push_back(Sentence("remarkColumns",
                                     "left out beside the columns that are taken: {columns}",
                                     {{"columns", left_out}}));
  }
  if (!columns.has_marks) {
    file->has_units = columns.unit.contains(Column::kX) && columns.unit.contains(Column::kZ);
    return;
  }
  file->remarks.push_back(
      Sentence("remarkPixels",
               "it does not say where its pixels count from: taken from the centre of the top-left "
               "pixel"));
}

}  // namespace

bool IsHeaderTable(const SurveyText& text, const SurveyReading& reading) {
  const auto header = FindTitles(text, reading);
  return header && DecideColumns(header->titles, {text.path, header->line}, reading);
}

std::optional<Sentence> FaultOfHeader(const SurveyText& text) {
  const auto header = FindTitles(text, {});
  return header ? MissingColumn(header->titles) : std::nullopt;
}

SurveyFile ReadHeaderTable(const SurveyText& text, const SurveyReading& reading) {
  auto header = FindTitles(text, reading);
  INSITU_CHECK(header.has_value());
  std::vector<TextRow> rows = RowsOf(text, *header);
  TakeLineOfUnits(&rows, &header->titles);
  RequireOneSystem(header->titles, rows);
  const auto columns = DecideColumns(header->titles, {text.path, header->line}, reading);
  INSITU_CHECK(columns.has_value());
  SurveyFile file;
  file.crs = SystemInComment(text.content);
  file.has_degrees = columns->has_degrees;
  file.format = file.crs ? "reference table of Metashape (CSV)" : "table with a header";
  const NumberStyle style = StyleOf(rows, *columns);
  for (const TextRow& row : rows) {
    const Line line(*columns, style, row);
    if (columns->has_marks) {
      file.marks.push_back(MarkOf(line));
    } else {
      file.points.push_back(PointOf(line));
    }
  }
  if (columns->has_marks) RequirePixels(file);
  AddRemarks(*columns, header->titles, &file);
  return file;
}

}  // namespace insitu
