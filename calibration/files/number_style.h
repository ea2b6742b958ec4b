// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as spreadsheets of different countries write them: 1234.5, 1234,5, 1'234.5, 1.234,5, 1
// 234,5.
#pragma once

#include <optional>
#include <string_view>

namespace insitu {

// What the commas and points of a table's numbers are, learned from all of them: one number alone
// may leave it open, as 1,234 does.
class NumberStyle {
 public:
  // What `cell` tells of the style; nothing if it is no number in any.
  void Learn(std::string_view cell);

  // nullopt: no finite number in this style. A comma is decimal where nothing else in the table
  // speaks against it.
  std::optional<double> Parse(std::string_view cell) const;

  // The numbers of the table contradict each other: commas are decimal in some, points in others.
  bool is_mixed() const { return has_decimal_comma_ && has_decimal_point_; }

  // Whether a comma is decimal in all that was learned, or could be.
  bool has_decimal_commas() const { return !has_decimal_point_ && !has_grouping_comma_; }

 private:
  bool has_decimal_comma_ = false, has_decimal_point_ = false, has_grouping_comma_ = false,
       has_grouping_point_ = false;
};

}  // namespace insitu
