// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/unit_comment.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <system_error>

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

// What may stand before a unit; of a sentence, its end. "File units" alone is sure of its meaning.
bool EndsInKey(std::string_view key) {
  static constexpr std::string_view kKeys[] = {
      "UNIT",          "UNITS",        "UNIT IS",       "UNITS ARE",
      "UNITS IN",      "UNITS ARE IN", "DIMENSIONS IN", "UNIT OF MEASUREMENT",
      "EINHEIT",       "EINHEITEN",    "MASSEINHEIT",   "UNITS OF MEASUREMENT",
      "COORDINATES IN"};
  return std::ranges::any_of(kKeys, [&](std::string_view known) {
    return key.ends_with(known) &&
           (key.size() == known.size() ||
            std::string_view(" \t,;.(").find(key[key.size() - known.size() - 1]) !=
                std::string_view::npos);
  });
}

bool IsKey(std::string_view key) {
  return key == "FILE UNITS" || key == "FILE UNIT" || key == "UNITS" || key == "UNIT" ||
         key == "EINHEIT" || key == "EINHEITEN";
}

// "1 unit = 0.01 meters" -> 0.01; nullopt: of another form.
std::optional<double> MetresOfOneUnit(std::string_view text) {
  const size_t equals = text.find('=');
  if (equals == text.npos) return std::nullopt;
  const std::string key = NameKey(std::string(WithoutBlanks(text.substr(0, equals))));
  if (!key.ends_with("1 UNIT") && !key.ends_with("ONE UNIT")) return std::nullopt;
  std::string_view rest = WithoutBlanks(text.substr(equals + 1));
  double number = 1;
  const auto [end, status] = std::from_chars(rest.begin(), rest.end(), number);
  if (status == std::errc()) rest.remove_prefix(static_cast<size_t>(end - rest.begin()));
  const auto metres = MetresOfUnitNamed(std::string(WithoutBlanks(rest)));
  if (!metres || !(number > 0) || number > 1e6) return std::nullopt;
  return number * *metres;
}

}  // namespace

std::optional<double> MetresOfUnitNamed(const std::string& name) {
  static const std::map<std::string, double> kMetres = {{"MM", 1e-3},
                                                        {"MILLIMETER", 1e-3},
                                                        {"MILLIMETRE", 1e-3},
                                                        {"MILLIMETRI", 1e-3},
                                                        {"MILIMETRO", 1e-3},
                                                        {"CM", 1e-2},
                                                        {"CENTIMETER", 1e-2},
                                                        {"CENTIMETRE", 1e-2},
                                                        {"ZENTIMETER", 1e-2},
                                                        {"CENTIMETRI", 1e-2},
                                                        {"CENTIMETRO", 1e-2},
                                                        {"DM", 0.1},
                                                        {"DECIMETER", 0.1},
                                                        {"DECIMETRE", 0.1},
                                                        {"DEZIMETER", 0.1},
                                                        {"M", 1},
                                                        {"METER", 1},
                                                        {"METRE", 1},
                                                        {"METRI", 1},
                                                        {"METRO", 1},
                                                        {"KM", 1e3},
                                                        {"KILOMETER", 1e3},
                                                        {"KILOMETRE", 1e3},
                                                        {"IN", 0.0254},
                                                        {"INCH", 0.0254},
                                                        {"INCHE", 0.0254},
                                                        {"ZOLL", 0.0254},
                                                        {"FT", 0.3048},
                                                        {"FEET", 0.3048},
                                                        {"FOOT", 0.3048},
                                                        {"FUSS", 0.3048},
                                                        {"YD", 0.9144},
                                                        {"YARD", 0.9144},
                                                        {"US SURVEY FEET", 1200.0 / 3937},
                                                        {"SURVEY FEET", 1200.0 / 3937},
                                                        {"US SURVEY FOOT", 1200.0 / 3937},
                                                        {"SURVEY FOOT", 1200.0 / 3937}};
  const std::string key = NameKey(name);
  const auto found = kMetres.find(key);
  if (found != kMetres.end()) return found->second;
  if (key.size() < 3 || !key.ends_with('S')) return std::nullopt;
  const auto singular = kMetres.find(key.substr(0, key.size() - 1));
  return singular == kMetres.end() ? std::nullopt : std::optional(singular->second);
}

std::optional<UnitComment> ReadUnitComment(std::string_view line) {
  constexpr size_t kLongest = 100;
  const std::string_view text = WithoutBlanks(line);
  if (text.empty() || text.size() > kLongest) return std::nullopt;
  if (const auto metres = MetresOfOneUnit(text)) return UnitComment{std::string(text), metres};
  const size_t equals = text.find_first_of("=:");
  const size_t end = equals == text.npos ? text.find_last_of(" \t") : equals;
  if (end == text.npos) return std::nullopt;
  const std::string key = NameKey(std::string(WithoutBlanks(text.substr(0, end))));
  const std::string unit(WithoutBlanks(text.substr(end + 1)));
  const auto metres = MetresOfUnitNamed(unit);
  if (IsKey(key) && (metres || equals != text.npos)) return UnitComment{std::string(text), metres};
  // "unit cube" names none, nor does "what is in the unit in".
  if (!EndsInKey(key) || !metres || NameKey(unit) == "IN") return std::nullopt;
  return UnitComment{std::string(text), metres};
}

std::string UnitNote(const UnitComment& comment) {
  return "its comment " + Quoted(comment.text) +
         (comment.metres ? " is taken as its unit" : " names no unit that is known");
}

}  // namespace insitu
