// SPDX-License-Identifier: GPL-3.0-or-later
// A file of a site as a text that can be edited row by row: what no edit touches stays as it is,
// byte for byte.
#pragma once

#include <json/value.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reconstruction/editing/edited_tables.h"

namespace insitu {

class SurveyText {
 public:
  virtual ~SurveyText() = default;

  // The file's whole content; "" where there is no file.
  virtual std::string text() const = 0;

  // In the file's order. Valid until the next edit.
  virtual std::vector<const Json::Value*> Rows(const EditedTable& table) const = 0;

  // The row that means the same as `row`, else one of the same key, else nullptr.
  virtual const Json::Value* Find(const EditedTable& table, const Json::Value& row) const = 0;

  // Whether a row of the file can have such a field.
  virtual bool CanHold(const EditedTable& table, const std::string& field) const = 0;

  // Puts `after` in the place of `before`, which is there (see Find); null: nothing there, nothing
  // wanted. Returns what is needed to take that back: given as `trace` with the inverse edit it
  // brings back every byte, if nothing else was changed meanwhile; else only what is meant.
  virtual Json::Value Edit(const EditedTable& table, const Json::Value& before,
                           const Json::Value& after, const Json::Value& trace) = 0;
};

// Where a text stops being UTF-8 (a zero byte is none either); nullopt: it is UTF-8.
std::optional<size_t> FirstNotUtf8(const std::string& text);

}  // namespace insitu
