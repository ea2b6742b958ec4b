// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/editing/csv_survey_text.h"

#include <algorithm>
#include <iterator>

#include "calibration/files/delimited_rows.h"
#include "calibration/files/error_at.h"
#include "calibration/files/text_table.h"
#include "reconstruction/editing/csv_cells.h"

namespace insitu {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kOff = "#off";

// How long "#off" is with the blanks about it; 0: the line is none that is switched off.
size_t LengthOfOff(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string::npos || !std::string_view(text).substr(begin).starts_with(kOff)) {
    return 0;
  }
  const size_t end = begin + kOff.size();
  const size_t cells = text.find_first_not_of(" \t", end);
  return cells == end || cells == std::string::npos ? 0 : cells;
}

bool IsTrivial(const std::string& text) {
  const std::string_view trimmed = TrimmedView(text);
  return trimmed.empty() || trimmed[0] == '#';
}

template <typename Names>
bool Holds(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

const std::vector<std::string>& LaterColumns() {
  static const std::vector<std::string> columns = {"state", "method", "note"};
  return columns;
}

std::string StateOf(const Json::Value& row) { return RowText(row, "state"); }

}  // namespace

CsvSurveyText::CsvSurveyText(const EditedTable& table, std::filesystem::path path,
                             const std::string& text)
    : table_(table), path_(std::move(path)) {
  Load(text);
}

void CsvSurveyText::Load(const std::string& text) {
  lines_.clear();
  lines_of_key_.clear();
  header_ = lines_.end();
  columns_ = table_.columns;
  mark_ = text.starts_with(kByteOrderMark) ? kByteOrderMark : "";
  has_last_ending_ = text.empty() || text.back() == '\n';
  int number = 0;
  for (size_t begin = mark_.size(); begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const bool has_return = end > begin && text[end - 1] == '\r' && end < text.size();
    Line line{text.substr(begin, end - begin - has_return), has_return ? "\r\n" : "\n"};
    begin = end + 1;
    ++number;
    lines_.push_back(std::move(line));
    const auto last = std::prev(lines_.end());
    if (header_ == lines_.end() && !IsTrivial(last->text)) {
      ReadHeader(*last, number);
      header_ = last;
    } else if (!IsTrivial(last->text)) {
      SetText(last, last->text, ParseRow(last->text, number));
    } else if (const auto row = ParseOff(last->text)) {
      SetText(last, last->text, *row);
    }
  }
  if (!has_last_ending_ && lines_.size() > 1) {
    lines_.back().ending = std::prev(lines_.end(), 2)->ending;
  }
}

std::string CsvSurveyText::JoinedColumns() const {
  std::string joined;
  for (const std::string& column : table_.columns) joined += (joined.empty() ? "" : ",") + column;
  return joined;
}

void CsvSurveyText::ReadHeader(const Line& line, int number) {
  columns_.clear();
  for (const std::string_view cell : RawCells(line.text)) columns_.push_back(CellOf(cell));
  if (columns_.size() == 1 && SeparatorOfLine(line.text) != ' ') {
    throw InputError(path_, number,
                     "its cells stand between semicolons or tabulators: programs read them, but "
                     "only tables between "
                     "commas are edited here, save it as one: " +
                         JoinedColumns());
  }
  for (const std::string& column : table_.columns) {
    const auto count = std::count(columns_.begin(), columns_.end(), column);
    if (count == 1) continue;
    const Sentence::Values values = {{"column", column}, {"header", JoinedColumns()}};
    throw ErrorAt(
        {path_, number},
        count == 0
            ? Sentence("columnMissing",
                       "column \"{column}\" is missing, expected the header {header}", values)
            : Sentence("columnTwice",
                       "column \"{column}\" stands twice, expected the header {header}", values));
  }
}

Json::Value CsvSurveyText::RowOfCells(const std::vector<std::string_view>& cells,
                                      int number) const {
  if (cells.size() != columns_.size()) {
    throw ErrorAt({path_, number}, Sentence("cellCount", "{count} cells, expected {expected}",
                                            {{"count", static_cast<int>(cells.size())},
                                             {"expected", static_cast<int>(columns_.size())}}));
  }
  Json::Value row(Json::objectValue);
  for (size_t i = 0; i < cells.size(); ++i) {
    const std::string text = CellOf(cells[i]);
    const std::string& column = columns_[i];
    if (Holds(table_.numbers, column)) {
      const auto value = ParseNumber(text);
      if (!value) {
        throw ErrorAt(
            {path_, number},
            Sentence("cellNumber", "\"{text}\" in column \"{column}\", expected a finite number",
                     {{"text", text}, {"column", column}}));
      }
      row[column] = *value;
    } else if (!text.empty() && !column.empty() && !row.isMember(column)) {
      row[column] = text;
    }
  }
  return row;
}

Json::Value CsvSurveyText::ParseRow(const std::string& text, int number) const {
  Json::Value row = RowOfCells(RawCells(text), number);
  // A column "state" switches nothing off: programs read the row all the same.
  if (table_.has_state && StateOf(row) != "dubious") row.removeMember("state");
  return row;
}

std::optional<Json::Value> CsvSurveyText::ParseOff(const std::string& text) const {
  const size_t cells = table_.has_state && header_ != lines_.end() ? LengthOfOff(text) : 0;
  if (cells == 0) return std::nullopt;
  try {
    Json::Value row = RowOfCells(RawCells(std::string_view(text).substr(cells)), 0);
    row["state"] = "off";
    return row;
  } catch (const InputError&) {  // a comment that only begins like one
    return std::nullopt;
  }
}

std::optional<Json::Value> CsvSurveyText::ParseAny(const std::string& text) const {
  if (IsTrivial(text)) return ParseOff(text);
  try {
    return ParseRow(text, 0);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::string CsvSurveyText::text() const {
  std::string text = mark_;
  for (const Line& line : lines_) (text += line.text) += line.ending;
  if (!has_last_ending_ && !lines_.empty()) text.resize(text.size() - lines_.back().ending.size());
  return text;
}

std::vector<const Json::Value*> CsvSurveyText::Rows(const EditedTable&) const {
  std::vector<const Json::Value*> rows;
  for (const Line& line : lines_) {
    if (line.is_row) rows.push_back(&line.row);
  }
  return rows;
}

CsvSurveyText::Lines::iterator CsvSurveyText::FindLine(const Json::Value& row, bool exactly) {
  const auto [begin, end] = lines_of_key_.equal_range(KeyOfRow(table_, row));
  for (auto line = begin; line != end; ++line) {
    if (IsSameRow(table_, line->second->row, row)) return line->second;
  }
  return exactly || begin == end ? lines_.end() : begin->second;
}

const Json::Value* CsvSurveyText::Find(const EditedTable&, const Json::Value& row) const {
  auto* self = const_cast<CsvSurveyText*>(this);  // an iterator, of which only the row is shown
  const auto line = self->FindLine(row, false);
  return line == self->lines_.end() ? nullptr : &line->row;
}

bool CsvSurveyText::CanHold(const EditedTable&, const std::string& field) const {
  const bool may_follow = Holds(LaterColumns(), field) && (field != "state" || table_.has_state);
  return may_follow || (!field.empty() && Holds(columns_, field));
}

void CsvSurveyText::Index(Lines::iterator line) {
  lines_of_key_.emplace(KeyOfRow(table_, line->row), line);
}

void CsvSurveyText::Unindex(Lines::iterator line) {
  const auto [begin, end] = lines_of_key_.equal_range(KeyOfRow(table_, line->row));
  for (auto entry = begin; entry != end; ++entry) {
    if (entry->second != line) continue;
    lines_of_key_.erase(entry);
    return;
  }
}

void CsvSurveyText::SetText(Lines::iterator line, const std::string& text, const Json::Value& row) {
  if (line->is_row) Unindex(line);
  line->text = text;
  line->row = row;
  line->is_row = true;
  Index(line);
}

Json::Value CsvSurveyText::Edit(const EditedTable&, const Json::Value& before,
                                const Json::Value& after, const Json::Value& trace) {
  if (before.isNull()) return after.isNull() ? Json::Value() : Insert(after, trace);
  const auto line = FindLine(before, true);
  INSITU_CHECK(line != lines_.end());
  if (!after.isNull()) return Change(line, after, trace);
  Json::Value taken = Erase(line);
  DropColumns(trace["columns"]);
  const bool was_made = trace.isMember("text") && lines_of_key_.empty();
  if (was_made) Load(trace["text"].asString());
  return taken;
}

// Behind the last row, or behind the header.
CsvSurveyText::Lines::iterator CsvSurveyText::EndOfRows() {
  auto line = lines_.end();
  while (line != lines_.begin()) {
    const auto previous = std::prev(line);
    if (previous->is_row || previous == header_) return line;
    line = previous;
  }
  return line;
}

void CsvSurveyText::MakeHeader() {
  const std::string ending = lines_.empty() ? "\n" : lines_.back().ending;
  lines_.push_back({JoinedColumns(), ending});
  has_last_ending_ = true;
  header_ = std::prev(lines_.end());
  columns_ = table_.columns;
}

Json::Value CsvSurveyText::Insert(const Json::Value& after, const Json::Value& trace) {
  Json::Value taken(Json::objectValue);
  if (header_ == lines_.end()) {
    taken["text"] = text();
    MakeHeader();
  }
  const Json::Value columns = AddColumns(after);
  if (!columns.empty()) taken["columns"] = columns;
  std::string line = trace["line"].asString();
  const auto parsed = ParseAny(line);
  const bool is_as_it_was = parsed && IsSameRow(table_, *parsed, after);
  if (!is_as_it_was) line = Rewritten(std::string(columns_.size() - 1, ','), after);
  auto place = EndOfRows();
  if (trace["at"].isInt()) {
    const auto at = std::min(static_cast<size_t>(trace["at"].asUInt()), lines_.size());
    place = std::next(lines_.begin(), static_cast<std::ptrdiff_t>(at));
  }
  const std::string ending =
      trace.isMember("ending") ? trace["ending"].asString() : header_->ending;
  const auto inserted = lines_.insert(place, {line, ending});
  SetText(inserted, line, after);
  return taken;
}

Json::Value CsvSurveyText::Erase(Lines::iterator line) {
  Json::Value taken(Json::objectValue);
  taken["at"] = static_cast<Json::UInt>(std::distance(lines_.begin(), line));
  taken["line"] = line->text;
  if (line->ending != header_->ending) taken["ending"] = line->ending;
  Unindex(line);
  lines_.erase(line);
  return taken;
}

Json::Value CsvSurveyText::Change(Lines::iterator line, const Json::Value& after,
                                  const Json::Value& trace) {
  Json::Value taken(Json::objectValue);
  taken["line"] = line->text;
  const Json::Value columns = AddColumns(after);
  if (!columns.empty()) taken["columns"] = columns;
  SetText(line, Rewritten(line->text, after), after);
  DropColumns(trace["columns"]);
  const std::string was = trace["line"].asString();
  const auto parsed = ParseAny(was);
  if (parsed && IsSameRow(table_, *parsed, after)) SetText(line, was, after);
  return taken;
}

// Those that the row needs and the header lacks.
Json::Value CsvSurveyText::AddColumns(const Json::Value& row) {
  Json::Value added(Json::arrayValue);
  for (const std::string& column : LaterColumns()) {
    const std::string cell = RowText(row, column);
    const bool is_state = table_.has_state && column == "state";
    if (cell.empty() || (is_state && cell != "dubious") || Holds(columns_, column)) continue;
    AddColumn(column);
    added.append(column);
  }
  return added;
}

void CsvSurveyText::AddColumn(const std::string& column) {
  header_->text += "," + column;
  for (Line& line : lines_) {
    if (line.is_row) line.text += ',';
  }
  columns_.push_back(column);
}

bool CsvSurveyText::IsEmptyLastColumn(const std::string& column) const {
  if (columns_.back() != column || columns_.size() <= table_.columns.size()) return false;
  return std::all_of(lines_.begin(), lines_.end(), [](const Line& line) {
    return !line.is_row ||
           TrimmedView(std::string_view(line.text).substr(line.text.rfind(',') + 1)).empty();
  });
}

// Takes AddColumns back, of columns in which nothing stands any more.
void CsvSurveyText::DropColumns(const Json::Value& columns) {
  for (Json::ArrayIndex i = columns.size(); i > 0; --i) {
    if (!IsEmptyLastColumn(columns[i - 1].asString())) return;
    columns_.pop_back();
    header_->text.resize(header_->text.rfind(','));
    for (Line& line : lines_) {
      if (line.is_row) line.text.resize(line.text.rfind(','));
    }
  }
}

std::string CsvSurveyText::CellText(const std::string& column, std::string_view old,
                                    const Json::Value& row) const {
  const std::string was = CellOf(old);
  if (Holds(table_.numbers, column)) {
    const auto number = ParseNumber(was);
    const bool is_same = number && *number == row[column].asDouble();
    return is_same ? std::string(old) : InPlaceOf(old, NumberText(row[column]));
  }
  std::string text = RowText(row, column);
  if (table_.has_state && column == "state" && text != "dubious") {
    text = was == "dubious" ? "" : was;
  }
  return text == was ? std::string(old) : InPlaceOf(old, QuotedCell(text));
}

// The line `text` with the cells of `row`; a cell that means the same stays as it is.
std::string CsvSurveyText::Rewritten(const std::string& text, const Json::Value& row) const {
  const size_t off = table_.has_state ? LengthOfOff(text) : 0;
  const std::string prefix = off > 0 ? text.substr(0, off) : std::string(kOff) + " ";
  const std::vector<std::string_view> cells = RawCells(std::string_view(text).substr(off));
  std::string line;
  for (size_t i = 0; i < columns_.size(); ++i) {
    const bool is_first = std::find(columns_.begin(), columns_.end(), columns_[i]) ==
                          columns_.begin() + static_cast<std::ptrdiff_t>(i);
    const bool is_known = is_first && !columns_[i].empty();
    if (i > 0) line += ',';
    line += is_known ? CellText(columns_[i], cells[i], row) : std::string(cells[i]);
  }
  return table_.has_state && StateOf(row) == "off" ? prefix + line : line;
}

}  // namespace insitu
