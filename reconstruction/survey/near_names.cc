// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/survey/near_names.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

#include "calibration/files/plain_text.h"

namespace insitu {
namespace {

constexpr size_t kMostNames = 3;  // more than these help nobody
constexpr size_t kLongName = 6;   // [letters], two slips are likely in one

// Lower-case letters and digits, numbers without leading zeros.
std::string Essence(const std::string& text) {
  const std::string name = Composed(text);
  std::string essence;
  bool is_in_number = false;
  for (size_t i = 0; i < name.size(); ++i) {
    const auto letter = static_cast<unsigned char>(name[i]);
    const bool leads_digit =
        i + 1 < name.size() && std::isdigit(static_cast<unsigned char>(name[i + 1]));
    if (letter == '0' && !is_in_number && leads_digit) continue;
    is_in_number = std::isdigit(letter);
    if (std::isalnum(letter) || letter >= 0x80) essence += static_cast<char>(std::tolower(letter));
  }
  return essence;
}

// Damerau's distance, of neighbours exchanged once.
size_t Slips(const std::string& a, const std::string& b) {
  std::vector<std::vector<size_t>> slips(a.size() + 1, std::vector<size_t>(b.size() + 1));
  for (size_t i = 0; i <= a.size(); ++i) {
    for (size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        slips[i][j] = i + j;
        continue;
      }
      slips[i][j] = std::min(
          {slips[i - 1][j] + 1, slips[i][j - 1] + 1, slips[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) slips[i][j] = std::min(slips[i][j], slips[i - 2][j - 2] + 1);
    }
  }
  return slips[a.size()][b.size()];
}

}  // namespace

std::vector<std::string> NearNames(const std::string& name, const std::set<std::string>& known) {
  std::vector<std::string> alike, near;
  const size_t most_slips = name.size() < kLongName ? 1 : 2;
  size_t fewest = most_slips;
  for (const std::string& candidate : known) {
    if (candidate == name) continue;
    if (Essence(candidate) == Essence(name)) alike.push_back(candidate);
    if (name.size() < 2 || candidate.size() + most_slips < name.size()) continue;
    const size_t slips = Slips(name, candidate);
    if (slips > fewest) continue;
    if (slips < fewest) near.clear();
    fewest = slips;
    near.push_back(candidate);
  }
  std::vector<std::string>& names = alike.empty() ? near : alike;
  if (names.size() > kMostNames) names.clear();
  return names;
}

std::string EssenceOf(const std::string& name) { return Essence(name); }

std::string DigitsWithin(const std::string& name) {
  std::string digits;
  for (const char letter : Essence(name)) {
    if (letter >= '0' && letter <= '9') digits += letter;
  }
  const auto is_sign = [&](size_t i) {
    const auto letter = static_cast<unsigned char>(name[i]);
    return !std::isalnum(letter) && letter < 0x80;
  };
  for (size_t i = 1; i < name.size(); ++i) {
    const auto letter = static_cast<unsigned char>(name[i]);
    const bool is_alone = is_sign(i - 1) && (i + 1 == name.size() || is_sign(i + 1));
    if (is_alone && std::isalpha(letter)) digits += static_cast<char>(std::tolower(letter));
  }
  return digits;
}

std::set<std::string> WithDigitsOf(const std::string& name, const std::set<std::string>& known) {
  const std::string digits = DigitsWithin(name);
  std::set<std::string> alike = known;
  std::erase_if(alike, [&](const auto& each) { return DigitsWithin(each) != digits; });
  return alike;
}

Sentence SaidMeant(const std::string& name, const std::set<std::string>& known) {
  const std::vector<std::string> names = NearNames(name, known);
  switch (names.size()) {
    case 0:
      return Sentence::Verbatim("");
    case 1:
      return Sentence("meantOne", "; did you mean '{a}'?", {{"a", names[0]}});
    case 2:
      return Sentence("meantTwo", "; did you mean '{a}' or '{b}'?",
                      {{"a", names[0]}, {"b", names[1]}});
    default:
      return Sentence("meantThree", "; did you mean '{a}', '{b}' or '{c}'?",
                      {{"a", names[0]}, {"b", names[1]}, {"c", names[2]}});
  }
}

std::string DidYouMean(const std::string& name, const std::set<std::string>& known) {
  return SaidMeant(name, known).text();
}

}  // namespace insitu
