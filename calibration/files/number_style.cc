// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/number_style.h"

#include <algorithm>
#include <string>

#include "calibration/files/words.h"

namespace insitu {
namespace {

// Marks between thousands that are never decimal: apostrophes, and blanks of any width.
constexpr std::string_view kGroupMarks[] = {
    "'", " ", "\xC2\xA0", "\xE2\x80\x99", "\xE2\x80\xAF", "\xE2\x80\x89"};

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// Without the marks between groups of three digits; nullopt: such a mark stands elsewhere.
std::optional<std::string> Ungrouped(std::string_view cell) {
  std::string number;
  size_t since_mark = 0;
  bool has_mark = false, is_whole = true;
  while (!cell.empty()) {
    const auto mark = std::find_if(std::begin(kGroupMarks), std::end(kGroupMarks),
                                   [&](std::string_view each) { return cell.starts_with(each); });
    if (mark == std::end(kGroupMarks)) {
      const bool is_digit = IsDigit(cell[0]);
      if (!is_digit && is_whole && has_mark && since_mark != 3) return std::nullopt;
      if (!is_digit && cell[0] != '-' && cell[0] != '+') is_whole = false;
      since_mark += is_digit;
      number += cell[0];
      cell.remove_prefix(1);
      continue;
    }
    const bool may_group =
        is_whole && (has_mark ? since_mark == 3 : since_mark >= 1 && since_mark <= 3);
    if (!may_group) return std::nullopt;
    has_mark = true;
    since_mark = 0;
    cell.remove_prefix(mark->size());
  }
  if (is_whole && has_mark && since_mark != 3) return std::nullopt;
  return number;
}

struct Shape {
  size_t commas = 0, points = 0;
  size_t before = 0;  // digits before the first mark
  size_t after = 0;   // digits behind the last mark
  bool begins_with_zero = false, comma_is_last = false;
};

// nullopt: no number in any style.
std::optional<Shape> ShapeOf(std::string_view cell) {
  Shape shape;
  if (!cell.empty() && (cell[0] == '-' || cell[0] == '+')) cell.remove_prefix(1);
  const size_t exponent = cell.find_first_of("eE");
  if (exponent != std::string_view::npos) {
    if (!ParseNumber("1" + std::string(cell.substr(exponent)))) return std::nullopt;
    cell = cell.substr(0, exponent);
  }
  shape.begins_with_zero = !cell.empty() && cell[0] == '0';
  size_t digits = 0;
  for (const char c : cell) {
    if (IsDigit(c)) {
      ++digits;
      ++(shape.commas + shape.points == 0 ? shape.before : shape.after);
      continue;
    }
    if (c != ',' && c != '.') return std::nullopt;
    ++(c == ',' ? shape.commas : shape.points);
    shape.comma_is_last = c == ',';
    shape.after = 0;
  }
  return digits > 0 ? std::optional(shape) : std::nullopt;
}

// 1,234 may be a thousand and more; 12345,678 and 0,123 may not.
bool MayGroup(const Shape& shape) {
  return shape.after == 3 && shape.before >= 1 && shape.before <= 3 && !shape.begins_with_zero;
}

std::string Without(std::string text, char mark) {
  std::erase(text, mark);
  return text;
}

}  // namespace

void NumberStyle::Learn(std::string_view cell) {
  const auto number = Ungrouped(TrimmedView(cell));
  const auto shape = number ? ShapeOf(*number) : std::nullopt;
  if (!shape || shape->commas + shape->points == 0) return;
  if (shape->commas > 0 && shape->points > 0) {
    (shape->comma_is_last ? has_decimal_comma_ : has_decimal_point_) = true;
    (shape->comma_is_last ? has_grouping_point_ : has_grouping_comma_) = true;
  } else if (shape->commas > 1) {
    has_grouping_comma_ = true;
  } else if (shape->points > 1) {
    has_grouping_point_ = true;
  } else if (!MayGroup(*shape)) {
    (shape->commas == 1 ? has_decimal_comma_ : has_decimal_point_) = true;
  }
}

std::optional<double> NumberStyle::Parse(std::string_view cell) const {
  const auto number = Ungrouped(TrimmedView(cell));
  if (!number) return std::nullopt;
  const auto shape = ShapeOf(*number);
  if (!shape) return ParseNumber(*number);
  if (shape->commas + shape->points == 0) return ParseNumber(*number);
  if (is_mixed()) return std::nullopt;
  const bool has_comma_numbers = has_grouping_point_ || has_decimal_comma_;
  if (shape->commas == 0 && shape->points == 1 && !has_comma_numbers) return ParseNumber(*number);
  const bool is_comma_decimal =
      has_decimal_comma_ || has_grouping_point_ || (!has_decimal_point_ && !has_grouping_comma_);
  const char decimal = is_comma_decimal ? ',' : '.', group = is_comma_decimal ? '.' : ',';
  const size_t decimals = is_comma_decimal ? shape->commas : shape->points;
  const size_t groups = is_comma_decimal ? shape->points : shape->commas;
  if (decimals > 1 || (decimals == 1 && groups > 0 && shape->comma_is_last != is_comma_decimal)) {
    return std::nullopt;
  }
  if (groups == 1 && decimals == 0 && !MayGroup(*shape)) return std::nullopt;
  std::string plain = Without(*number, group);
  std::replace(plain.begin(), plain.end(), decimal, '.');
  return ParseNumber(plain);
}

}  // namespace insitu
