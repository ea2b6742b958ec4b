// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/unit_comment.h"

#include <algorithm>
#include <map>

#include "calibration/files/wording.h"
#include "renderer/mesh/model.h"

namespace insitu {
namespace {

std::string_view WithoutBlanks(std::string_view text) {
  constexpr char kAround[] = "# \t\r\"'";
  const size_t first = text.find_first_not_of(kAround);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kAround) - first + 1);
}

std::optional<double> MetresPerUnitNamed(const std::string& key) {
  static const std::map<std::string, double> kMetres = {
      {"MM", 1e-3},   {"MILLIMETER", 1e-3}, {"MILLIMETRE", 1e-3},
      {"CM", 1e-2},   {"CENTIMETER", 1e-2}, {"CENTIMETRE", 1e-2},
      {"M", 1},       {"METER", 1},         {"METRE", 1},
      {"KM", 1e3},    {"KILOMETER", 1e3},   {"KILOMETRE", 1e3},
      {"IN", 0.0254}, {"INCH", 0.0254},     {"INCHE", 0.0254},
      {"FT", 0.3048}, {"FEET", 0.3048},     {"FOOT", 0.3048},
      {"YD", 0.9144}, {"YARD", 0.9144}};
  std::string singular = key;
  if (singular.size() > 2 && singular.ends_with('S')) singular.pop_back();
  const auto found = kMetres.find(singular);
  return found == kMetres.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace

std::optional<UnitComment> ReadUnitComment(std::string_view line) {
  constexpr size_t kLongest = 100;
  const std::string_view text = WithoutBlanks(line);
  if (text.empty() || text.size() > kLongest) return std::nullopt;
  const size_t equals = text.find_first_of("=:");
  const size_t end = equals == text.npos ? text.find_last_of(" \t") : equals;
  if (end == text.npos) return std::nullopt;
  const std::string key = NameKey(std::string(WithoutBlanks(text.substr(0, end))));
  if (key != "FILE UNITS" && key != "FILE UNIT" && key != "UNITS" && key != "UNIT") {
    return std::nullopt;
  }
  const std::string unit = NameKey(std::string(WithoutBlanks(text.substr(end + 1))));
  const auto metres = MetresPerUnitNamed(unit);
  if (equals == text.npos && !metres) return std::nullopt;  // "unit cube"
  return UnitComment{std::string(text), metres};
}

std::string UnitNote(const UnitComment& comment) {
  return "its comment " + Quoted(comment.text) +
         (comment.metres ? " is taken as its unit" : " names no unit that is known");
}

}  // namespace insitu
