// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/editing/merge_rows.h"

#include <cmath>
#include <map>
#include <unordered_map>

#include "calibration/files/error.h"
#include "reconstruction/editing/make_survey_text.h"

namespace insitu {
namespace {

constexpr double kFarApart = 3;  // [sigma of the difference]

// Rows by their key; equal rows one after the other.
struct KeyedRows {
  std::vector<std::string> order;
  std::unordered_map<std::string, const Json::Value*> rows;

  const Json::Value& At(const std::string& key) const {
    const auto row = rows.find(key);
    return row == rows.end() ? Json::Value::nullSingleton() : *row->second;
  }
};

KeyedRows ByKey(const EditedTable& table, const SurveyText& text) {
  KeyedRows keyed;
  const std::vector<const Json::Value*> rows = text.Rows(table);
  keyed.rows.reserve(rows.size());
  keyed.order.reserve(rows.size());
  for (const Json::Value* row : rows) {
    const std::string once = KeyOfRow(table, *row);
    std::string key = once;
    for (int again = 1; keyed.rows.contains(key); ++again) key = once + std::to_string(again);
    keyed.rows.emplace(key, row);
    keyed.order.push_back(std::move(key));
  }
  return keyed;
}

// In our order; then what only they or the base have.
std::vector<std::string> AllKeys(const KeyedRows& ours, const KeyedRows& theirs,
                                 const KeyedRows& base) {
  std::vector<std::string> keys = ours.order;
  for (const std::string& key : theirs.order) {
    if (!ours.rows.contains(key)) keys.push_back(key);
  }
  for (const std::string& key : base.order) {
    if (!ours.rows.contains(key) && !theirs.rows.contains(key)) keys.push_back(key);
  }
  return keys;
}

void MergeTable(const EditedTable& table, const SurveyText& base_text, const SurveyText& our_text,
                MergedText& merged) {
  const KeyedRows base = ByKey(table, base_text), ours = ByKey(table, our_text),
                  theirs = ByKey(table, *merged.text);
  for (const std::string& key : AllKeys(ours, theirs, base)) {
    const Json::Value &was = base.At(key), &our = ours.At(key), &their = theirs.At(key);
    if (IsSameRow(table, our, their)) continue;
    if (IsSameRow(table, was, their)) {
      merged.ours.push_back({table.name, their, our});
      merged.text->Edit(table, merged.ours.back().before, our, Json::Value());
      continue;
    }
    merged.outside.push_back({table.name, our, their});
    if (!IsSameRow(table, was, our)) merged.conflicts.push_back({table.name, was, their, our});
  }
}

bool AreFarApart(const EditedTable& table, const Json::Value& ours, const Json::Value& theirs) {
  if (IsSameRow(table, ours, theirs)) return false;
  if (table.name != "observations") return true;
  const double sigma = std::hypot(ours["sigma"].asDouble(), theirs["sigma"].asDouble());
  for (const char* axis : {"x", "y"}) {
    if (!(std::abs(ours[axis].asDouble() - theirs[axis].asDouble()) <= kFarApart * sigma)) {
      return true;
    }
  }
  return false;
}

}  // namespace

MergedText MergeText(const std::vector<EditedTable>& tables, const std::filesystem::path& path,
                     const std::string& base, const SurveyText& ours, const std::string& theirs) {
  MergedText merged{MakeSurveyText(tables, path, theirs)};
  const bool has_changes = ours.text() != base;
  const auto base_text = has_changes ? MakeSurveyText(tables, path, base) : nullptr;
  const SurveyText& was = has_changes ? *base_text : ours;
  for (const EditedTable& table : tables) MergeTable(table, was, ours, merged);
  return merged;
}

MergedRows MergeSurvey(const std::vector<EditedTable>& tables, const SurveyText& ours,
                       const SurveyText& theirs) {
  MergedRows merged;
  for (const EditedTable& table : tables) {
    for (const Json::Value* row : theirs.Rows(table)) {
      const Json::Value* our = ours.Find(table, *row);
      if (!our) {
        merged.edits.push_back({table.name, Json::Value(), *row});
      } else if (AreFarApart(table, *our, *row)) {
        merged.conflicts.push_back({table.name, Json::Value(), *our, *row});
      }
    }
  }
  return merged;
}

}  // namespace insitu
