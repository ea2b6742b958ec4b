// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/ies.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>

#include "calibration/files/error.h"

namespace insitu {
namespace {

// The numbers of a file, over its lines; blanks and commas between.
class Numbers {
 public:
  explicit Numbers(const std::filesystem::path& path) : path_(path), file_(path) {
    if (!file_) throw InputError(path, "cannot be read");
  }

  std::optional<std::string> NextLine() {
    std::string line;
    if (!std::getline(file_, line)) return std::nullopt;
    ++line_;
    if (line.ends_with('\r')) line.pop_back();
    return line;
  }
  double Next() {
    constexpr const char* kBlanks = " \t\r,";
    size_t first = 0;
    while ((first = rest_.find_first_not_of(kBlanks)) == std::string::npos) {
      auto line = NextLine();
      if (!line) throw Error("the file ends here, expected more numbers");
      rest_ = *std::move(line);
    }
    const size_t end = std::min(rest_.find_first_of(kBlanks, first), rest_.size());
    const std::string word = rest_.substr(first, end - first);
    rest_.erase(0, end);
    double value = 0;
    const auto [stop, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (status != std::errc() || stop != word.data() + word.size() || !std::isfinite(value)) {
      throw Error("\"" + word.substr(0, 40) + "\", expected a number");
    }
    return value;
  }
  int Count(int most, const char* what) {
    const double value = Next();
    if (value != std::floor(value) || value < 1 || value > most) {
      throw Error("expected a whole number of " + std::string(what) + ", 1 to " +
                  std::to_string(most));
    }
    return static_cast<int>(value);
  }
  std::vector<double> Rising(int count) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) {
      values.push_back(Next());
      if (i > 0 && values[i] <= values[i - 1]) throw Error("an angle does not rise");
    }
    return values;
  }
  InputError Error(const std::string& message) const { return {path_, line_, message}; }

 private:
  const std::filesystem::path& path_;
  std::ifstream file_;
  std::string rest_;
  int line_ = 0;
};

// How a lamp's tilt changes its output: of no use to a fixed luminaire.
void SkipTilt(const std::string& tilt, Numbers* numbers) {
  if (tilt.find("INCLUDE") == std::string::npos) return;
  constexpr int kMostAngles = 1000;
  numbers->Next();
  const int pairs = numbers->Count(kMostAngles, "tilt angles");
  for (int i = 0; i < 2 * pairs; ++i) numbers->Next();
}

void FindTilt(const std::filesystem::path& path, Numbers* numbers) {
  constexpr int kMostLines = 10000;
  for (int i = 0; i < kMostLines; ++i) {
    const auto line = numbers->NextLine();
    if (!line) break;
    if (line->starts_with("TILT=")) return SkipTilt(*line, numbers);
  }
  throw InputError(path, "has no line TILT=, expected an IES file (LM-63)");
}

}  // namespace

IesPhotometry ReadIes(const std::filesystem::path& path) {
  constexpr int kMostAngles = 100000, kTypeC = 1;
  Numbers numbers(path);
  FindTilt(path, &numbers);
  numbers.Next();  // lamps
  numbers.Next();  // lumens a lamp
  double factor = numbers.Next();
  const int gammas = numbers.Count(kMostAngles, "vertical angles");
  const int planes = numbers.Count(kMostAngles, "horizontal angles");
  if (static_cast<int64_t>(gammas) * planes > 10000000) throw numbers.Error("has too many angles");
  if (numbers.Next() != kTypeC) {
    throw numbers.Error("is photometry of type A or B, expected type C (1)");
  }
  for (int i = 0; i < 4; ++i) numbers.Next();  // units; width, length, height
  factor *= numbers.Next();                    // ballast
  numbers.Next();                              // for future use, or ballast-lamp factor
  numbers.Next();                              // watts
  IesPhotometry photometry;
  photometry.gamma_deg = numbers.Rising(gammas);
  photometry.c_deg = numbers.Rising(planes);
  for (int i = 0; i < gammas * planes; ++i) {
    photometry.candela.push_back(factor * numbers.Next());
    if (photometry.candela.back() < 0) throw numbers.Error("a negative candela value");
  }
  return photometry;
}

}  // namespace insitu
