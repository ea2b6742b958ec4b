// SPDX-License-Identifier: GPL-3.0-or-later
// A table of the survey folder as a text. Lines "#off <cells>" are rows that are switched off; all
// other lines with # are comments.
#pragma once

#include <cstddef>
#include <filesystem>
#include <list>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "reconstruction/editing/survey_text.h"

namespace insitu {

class CsvSurveyText : public SurveyText {
 public:
  // Throws InputError at the line: a column that is missing or stands twice, a row with another
  // number of cells, a cell of a number column that is no finite number.
  CsvSurveyText(const EditedTable& table, std::filesystem::path path, const std::string& text);

  std::string text() const override;
  std::vector<const Json::Value*> Rows(const EditedTable& table) const override;
  const Json::Value* Find(const EditedTable& table, const Json::Value& row) const override;
  bool CanHold(const EditedTable& table, const std::string& field) const override;
  Json::Value Edit(const EditedTable& table, const Json::Value& before, const Json::Value& after,
                   const Json::Value& trace) override;

 private:
  struct Line {
    std::string text;
    std::string ending;  // LF or CRLF; the file's last line may lack it, see has_last_ending_
    bool is_row = false;
    Json::Value row = {};
  };
  using Lines = std::list<Line>;

  void Load(const std::string& text);
  void ReadHeader(const Line& line, int number);
  std::string JoinedColumns() const;
  std::optional<Json::Value> ParseOff(const std::string& text) const;
  Json::Value ParseRow(const std::string& text, int number) const;
  std::optional<Json::Value> ParseAny(const std::string& text) const;
  Json::Value RowOfCells(const std::vector<std::string_view>& cells, int number) const;

  Lines::iterator FindLine(const Json::Value& row, bool exactly);
  void Index(Lines::iterator line);
  void Unindex(Lines::iterator line);
  void SetText(Lines::iterator line, const std::string& text, const Json::Value& row);

  Json::Value Insert(const Json::Value& after, const Json::Value& trace);
  Json::Value Erase(Lines::iterator line);
  Json::Value Change(Lines::iterator line, const Json::Value& after, const Json::Value& trace);
  void MakeHeader();
  Json::Value AddColumns(const Json::Value& row);
  void AddColumn(const std::string& column);
  void DropColumns(const Json::Value& columns);
  bool IsEmptyLastColumn(const std::string& column) const;
  std::string Rewritten(const std::string& text, const Json::Value& row) const;
  std::string CellText(const std::string& column, std::string_view old,
                       const Json::Value& row) const;
  Lines::iterator EndOfRows();

  EditedTable table_;
  std::filesystem::path path_;
  std::string mark_;  // the byte order mark, if there is one
  Lines lines_;
  Lines::iterator header_ = lines_.end();
  bool has_last_ending_ = true;
  std::vector<std::string> columns_;
  std::unordered_multimap<std::string, Lines::iterator> lines_of_key_;
};

}  // namespace insitu
