// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/cut_short.h"

#include <algorithm>
#include <fstream>

#include "calibration/files/error.h"

namespace insitu {

void RequireEnding(const std::filesystem::path& path, const std::string& ending) {
  constexpr int64_t kTail = 4096;
  std::ifstream file(path, std::ios::binary);
  const auto size = static_cast<int64_t>(std::filesystem::file_size(path));
  std::string tail(static_cast<size_t>(std::min(size, kTail)), '\0');
  file.seekg(size - std::ssize(tail));
  file.read(tail.data(), std::ssize(tail));
  if (tail.find(ending) != std::string::npos) return;
  int lines = 0;
  file.clear();
  file.seekg(0);
  for (std::string line; std::getline(file, line);) ++lines;
  throw InputError(path, lines, "the file ends here, expected " + ending + ": it is cut short");
}

void RequireLength(const std::filesystem::path& path, uint64_t stated) {
  const uint64_t size = std::filesystem::file_size(path);
  if (size >= stated) return;
  throw InputError(path, "is " + std::to_string(size) + " bytes long, expected " +
                             std::to_string(stated) + " as its head states: it is cut short");
}

}  // namespace insitu
