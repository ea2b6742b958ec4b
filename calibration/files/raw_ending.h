// SPDX-License-Identifier: GPL-3.0-or-later
// Which files are a camera's raw data.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string>

namespace insitu {

// Whether a name ends as a camera's raw data do (.dng, .nef, .cr3 ...), in any case.
inline bool HasRawEnding(const std::filesystem::path& name) {
  static constexpr std::array kEndings = {".3fr", ".ari", ".arw", ".cr2", ".cr3", ".crw", ".dcr",
                                          ".dng", ".erf", ".fff", ".iiq", ".k25", ".kdc", ".mef",
                                          ".mos", ".mrw", ".nef", ".nrw", ".orf", ".pef", ".raf",
                                          ".raw", ".rw2", ".rwl", ".sr2", ".srf", ".srw", ".x3f"};
  std::string ending = name.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

}  // namespace insitu
