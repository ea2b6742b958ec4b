// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/exchange/survey_file_formats.h"

#include <algorithm>
#include <cctype>

#include "calibration/program/site.h"

namespace insitu {

std::string PhotoName(const std::string& path) {
  const size_t folder = path.find_last_of("/\\");
  const std::string file = folder == std::string::npos ? path : path.substr(folder + 1);
  return IsPhotoFileName(file) ? std::filesystem::path(file).stem().string() : file;
}

bool IsPhotoFileName(const std::string& text) {
  if (HasPhotographEnding(text)) return true;
  std::string ending = std::filesystem::path(text).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending == ".dng";
}

}  // namespace insitu
