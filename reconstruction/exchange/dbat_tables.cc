// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/exchange/dbat_tables.h"

#include <algorithm>

#include "calibration/files/error_at.h"
#include "calibration/files/text_table.h"

namespace insitu {
namespace {

Eigen::Vector3d Sigma(const DbatTable::Row& row) {
  Eigen::Vector3d sigma = Eigen::Vector3d::Constant(row.Find("sxyz").value_or(0));
  if (const auto sxy = row.Find("sxy")) sigma.head<2>().setConstant(*sxy);
  if (const auto sx = row.Find("sx")) sigma.x() = *sx;
  if (const auto sy = row.Find("sy")) sigma.y() = *sy;
  if (const auto sz = row.Find("sz")) sigma.z() = *sz;
  const bool is_fixed = sigma.isZero(0);
  if (!is_fixed && !(sigma.minCoeff() > 0)) {
    throw ErrorAt(row.place,
                  Sentence("dbatSigmas", "sigmas must be positive, or all 0 for a fixed point"));
  }
  return sigma;
}

}  // namespace

const std::string& DbatTable::Row::Text(const std::string& column) const {
  const auto cell = cells.find(column);
  if (cell == cells.end()) {
    throw ErrorAt(place,
                  Sentence("dbatNoColumn", "the format of this table has no column \"{column}\"",
                           {{"column", column}}));
  }
  if (cell->second.empty()) {
    throw ErrorAt(place,
                  Sentence("dbatEmpty", "column \"{column}\" is empty", {{"column", column}}));
  }
  return cell->second;
}

double DbatTable::Row::Number(const std::string& column) const {
  const std::string& text = Text(column);
  const auto value = ParseNumber(text);
  if (!value) {
    throw ErrorAt(place,
                  Sentence("dbatNumber", "\"{text}\" in column \"{column}\", expected a number",
                           {{"text", text}, {"column", column}}));
  }
  return *value;
}

std::optional<double> DbatTable::Row::Find(const std::string& column) const {
  if (!cells.contains(column)) return std::nullopt;
  return Number(column);
}

DbatTable ReadDbatTable(const std::filesystem::path& path, const std::string& format) {
  const std::vector<std::string> columns = SplitAt(format, ',');
  DbatTable table;
  for (const TextRow& row : ReadTextRows(path, WordSeparator::kComma)) {
    if (row.words.size() != columns.size()) {
      throw ErrorAt(row.place(),
                    Sentence("dbatValues", "{count} values, expected {expected} ({format})",
                             {{"count", static_cast<int>(row.words.size())},
                              {"expected", static_cast<int>(columns.size())},
                              {"format", format}}));
    }
    DbatTable::Row parsed{{row.path, row.line}, {}};
    for (size_t i = 0; i < columns.size(); ++i) parsed.cells[columns[i]] = row.words[i];
    table.rows.push_back(std::move(parsed));
  }
  return table;
}

std::vector<DbatControlPoint> ReadDbatControl(const std::filesystem::path& path,
                                              const std::string& format) {
  std::vector<DbatControlPoint> points;
  std::map<std::string, int> lines;
  for (const DbatTable::Row& row : ReadDbatTable(path, format).rows) {
    const std::string& id = row.Text("id");
    const auto [first, is_new] = lines.emplace(id, row.place.line);
    if (!is_new) {
      throw ErrorAt(row.place,
                    Sentence("dbatPointTwice", "point \"{point}\" stands also in line {line}",
                             {{"point", id}, {"line", first->second}}));
    }
    points.push_back({id,
                      row.cells.contains("label") ? row.Text("label") : id,
                      {row.Number("x"), row.Number("y"), row.Number("z")},
                      Sigma(row),
                      row.place});
  }
  return points;
}

std::vector<DbatMark> ReadDbatMarks(const std::filesystem::path& path, const std::string& format) {
  std::vector<DbatMark> marks;
  for (const DbatTable::Row& row : ReadDbatTable(path, format).rows) {
    marks.push_back({row.Text("im"),
                     row.Text("id"),
                     {row.Number("x"), row.Number("y")},
                     row.Find("sxy"),
                     row.place});
    if (marks.back().sigma_px && !(*marks.back().sigma_px > 0)) {
      throw ErrorAt(row.place, Sentence("dbatSxy", "sxy must be positive"));
    }
  }
  return marks;
}

}  // namespace insitu
