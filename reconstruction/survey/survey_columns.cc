// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/survey/survey_columns.h"

#include <algorithm>

#include "calibration/files/error_at.h"
#include "calibration/files/wording.h"

namespace insitu {
namespace {

using Titles = std::vector<ColumnTitle>;

bool IsHorizontal(Column column) { return column == Column::kX || column == Column::kY; }

std::string JoinedTitles(const std::vector<const ColumnTitle*>& titles) {
  std::string joined;
  for (const ColumnTitle* title : titles)
    joined += (joined.empty() ? "" : ", ") + Quoted(title->text);
  return joined;
}

Sentence SaidOf(Column column) {
  switch (column) {
    case Column::kName:
      return Sentence("columnOfName", "the point's name");
    case Column::kPhoto:
      return Sentence("columnOfPhoto", "the photo");
    case Column::kX:
      return Sentence("columnOfX", "east (x)");
    case Column::kY:
      return Sentence("columnOfY", "north (y)");
    case Column::kZ:
      return Sentence("columnOfHeight", "the height");
    default:
      return Sentence("columnOfAccuracy", "an accuracy");
  }
}

class Decision {
 public:
  Decision(Titles titles, const FilePlace& place, const SurveyReading& reading)
      : titles_(std::move(titles)), place_(place), reading_(reading) {}

  std::optional<SurveyColumns> Make() {
    TakeChosen();
    const bool has_grid = Has(Column::kX, false) && Has(Column::kY, false);
    const bool has_geographic = Has(Column::kX, true) && Has(Column::kY, true);
    if (has_grid && has_geographic) LeaveOutGeographic();
    SettleLetterH();
    for (const Column column : {Column::kName, Column::kPhoto, Column::kX, Column::kY, Column::kZ,
                                Column::kSigmaX, Column::kSigmaY, Column::kSigmaZ, Column::kSigmaXy,
                                Column::kSigmaXyz, Column::kEnabled, Column::kRole}) {
      Candidates(column);
    }
    if (!IsWhole()) return std::nullopt;
    for (auto& [column, candidates] : candidates_) Choose(column, candidates);
    columns_.has_marks = columns_.index.contains(Column::kPhoto);
    RequireOrder();
    RequireUnits();
    return std::move(columns_);
  }

 private:
  SaidError Error(const Sentence& message) const { return ErrorAt(place_, message); }

  SaidError Error(const ColumnTitle& title, const ColumnUnit& unit,
                  const Sentence& expected) const {
    return Error(Sentence(
        "columnUnit", "column {title} is in {unit}, expected {expected}",
        {{"title", Quoted(title.text)}, {"unit", unit.name}, {"expected", expected.ToJson()}}));
  }

  bool Has(Column column, bool is_geographic) const {
    return std::any_of(titles_.begin(), titles_.end(), [&](const ColumnTitle& title) {
      return title.column == column && title.is_geographic == is_geographic;
    });
  }

  // What the option --column says goes before everything.
  void TakeChosen() {
    for (const auto& [name, wanted] : reading_.columns) {
      const auto column = ColumnByName(name);
      if (!column) throw InputError("--column", "\"" + name + "\" is no quantity of a survey");
      const auto title =
          std::find_if(titles_.begin(), titles_.end(),
                       [&text = wanted](const auto& each) { return each.text == text; });
      if (title == titles_.end()) continue;  // of another file
      for (ColumnTitle& other : titles_) {
        if (other.column == *column && &other != &*title) other.column = Column::kOther;
      }
      title->column = *column;
      title->rank = 0;
      title->fault = {};
      is_chosen_ = true;
    }
  }

  // Longitude, latitude and the ellipsoidal height beside coordinates of the same places in a grid.
  void LeaveOutGeographic() {
    const bool has_other_height = std::any_of(
        titles_.begin(), titles_.end(),
        [](const auto& title) { return title.column == Column::kZ && !title.is_ellipsoidal; });
    for (ColumnTitle& title : titles_) {
      const bool is_left_out =
          (IsHorizontal(title.column) && title.is_geographic) ||
          (title.column == Column::kZ && title.is_ellipsoidal && has_other_height);
      if (!is_left_out) continue;
      columns_.left_out.push_back(title.text);
      title.column = Column::kOther;
    }
  }

  // "H RMS" beside "V RMS" is horizontal, "Std H" beside "Std E" of the height.
  void SettleLetterH() {
    const bool has_v = std::any_of(titles_.begin(), titles_.end(), [](const ColumnTitle& title) {
      return title.column == Column::kSigmaZ && !title.is_letter_h;
    });
    for (ColumnTitle& title : titles_) {
      if (title.is_letter_h && has_v) title.column = Column::kSigmaXy;
    }
  }

  void Candidates(Column column) {
    for (const ColumnTitle& title : titles_) {
      if (title.column == column) candidates_[column].push_back(&title);
    }
  }

  bool IsWhole() const {
    for (const Column needed : {Column::kName, Column::kX, Column::kY}) {
      if (!candidates_.contains(needed)) return false;
    }
    return candidates_.contains(Column::kPhoto) || candidates_.contains(Column::kZ);
  }

  // The plainest title; of a height alone the ellipsoidal one counts as any other, since nothing
  // tells which is meant.
  void Choose(Column column, std::vector<const ColumnTitle*> candidates) {
    const bool is_height = column == Column::kZ;
    const auto best =
        std::min_element(candidates.begin(), candidates.end(),
                         [](const auto* a, const auto* b) { return a->rank < b->rank; });
    std::vector<const ColumnTitle*> equal, rest;
    for (const ColumnTitle* title : candidates) {
      (is_height || title->rank == (*best)->rank ? equal : rest).push_back(title);
    }
    if (equal.size() > 1) {
      throw Error(Sentence("columnsEqual",
                           "columns {titles} are all {quantity}; which is meant? say it with "
                           "--column {name}=TITLE",
                           {{"titles", JoinedTitles(equal)},
                            {"quantity", SaidOf(column).ToJson()},
                            {"name", NameOf(column)}}));
    }
    const ColumnTitle& title = *equal[0];
    for (const ColumnTitle* other : rest) columns_.left_out.push_back(other->text);
    if (!title.fault.empty()) {
      throw Error(Sentence("columnFault", "column {title} {fault}",
                           {{"title", Quoted(title.text)}, {"fault", title.fault.ToJson()}}));
    }
    columns_.index[column] = static_cast<size_t>(&title - titles_.data());
    if (title.unit) columns_.unit[column] = *title.unit;
    if (IsHorizontal(column) && title.is_geographic) columns_.has_degrees = true;
  }

  // Geodesists count x northwards: the order tells.
  void RequireOrder() const {
    const ColumnTitle& x = titles_[columns_.index.at(Column::kX)];
    const ColumnTitle& y = titles_[columns_.index.at(Column::kY)];
    const bool is_open = x.is_map_axis && y.is_map_axis && &y < &x && !columns_.has_marks;
    if (!is_open || is_chosen_) return;
    throw Error(
        Sentence("columnsOrder",
                 "column {y} stands before {x}, as where x counts northwards; which is east? say "
                 "it with --column east=TITLE --column north=TITLE",
                 {{"y", Quoted(y.text)}, {"x", Quoted(x.text)}}));
  }

  void RequireUnits() {
    using Kind = ColumnUnit::Kind;
    for (const auto& [column, index] : columns_.index) {
      const bool is_named = column == Column::kName || column == Column::kPhoto ||
                            column == Column::kRole || column == Column::kEnabled;
      if (is_named) continue;
      const auto stated = columns_.unit.find(column);
      if (columns_.has_marks) {
        if (stated != columns_.unit.end()) RequirePixels(titles_[index], stated->second);
        continue;
      }
      const bool is_angle = IsHorizontal(column) && columns_.has_degrees;
      if (stated == columns_.unit.end()) {
        if (reading_.unit && !is_angle) columns_.unit[column] = OptionalUnit();
        continue;
      }
      const ColumnUnit& unit = stated->second;
      if (unit.kind != (is_angle ? Kind::kAngle : Kind::kLength)) {
        const Sentence expected = is_angle ? Sentence("unitAngle", "degrees, or gon")
                                           : Sentence("unitLength", "a length");
        throw Error(titles_[index], unit, expected);
      }
      if (IsPlainFoot(unit)) columns_.unit[column] = FootOf(titles_[index]);
    }
  }

  void RequirePixels(const ColumnTitle& title, const ColumnUnit& unit) const {
    if (unit.kind == ColumnUnit::Kind::kPixel) return;
    throw Error(title, unit, Sentence("unitPixels", "pixels of the original photograph"));
  }

  ColumnUnit OptionalUnit() const {
    const auto unit = UnitByName(*reading_.unit);
    if (unit && unit->kind == ColumnUnit::Kind::kLength && !IsPlainFoot(*unit)) return *unit;
    throw InputError(
        "--unit",
        "\"" + *reading_.unit +
            "\" is none of m, mm, cm, km, \"US survey feet\", \"international feet\", inches");
  }

  ColumnUnit FootOf(const ColumnTitle& title) const {
    if (reading_.unit) {
      const ColumnUnit unit = OptionalUnit();
      if (unit.name.find("feet") != std::string::npos) return unit;
    }
    throw Error(
        Sentence("columnFeet",
                 "column {title} is in feet, of which there are two (2 ppm apart: a metre in 500 "
                 "km); say which with --unit \"US survey feet\" or --unit \"international feet\"",
                 {{"title", Quoted(title.text)}}));
  }

  Titles titles_;
  const FilePlace& place_;
  const SurveyReading& reading_;
  std::map<Column, std::vector<const ColumnTitle*>> candidates_;
  SurveyColumns columns_;
  bool is_chosen_ = false;
};

Titles ReadTitles(const std::vector<std::string>& texts) {
  Titles titles;
  for (const std::string& text : texts) titles.push_back(ReadColumnTitle(text));
  return titles;
}

}  // namespace

std::optional<SurveyColumns> DecideColumns(const std::vector<std::string>& titles,
                                           const FilePlace& place, const SurveyReading& reading) {
  return Decision(ReadTitles(titles), place, reading).Make();
}

std::optional<Sentence> MissingColumn(const std::vector<std::string>& texts) {
  const Titles titles = ReadTitles(texts);
  const auto has = [&](Column column) {
    return std::any_of(titles.begin(), titles.end(),
                       [&](const auto& title) { return title.column == column; });
  };
  const std::vector<Column> needed = {Column::kName, Column::kX, Column::kY, Column::kZ};
  std::vector<Column> missing;
  std::copy_if(needed.begin(), needed.end(), std::back_inserter(missing),
               [&](Column column) { return !has(column); });
  if (missing.empty() || missing.size() > 2 || titles.size() < 3) return std::nullopt;
  std::string columns;
  for (const ColumnTitle& title : titles)
    columns += (columns.empty() ? "" : ", ") + Quoted(title.text);
  return Sentence("columnMissingOf",
                  "no column is {quantity} (there are {columns}); say which with --column "
                  "{name}=TITLE",
                  {{"quantity", SaidOf(missing[0]).ToJson()},
                   {"columns", columns},
                   {"name", NameOf(missing[0])}});
}

}  // namespace insitu
