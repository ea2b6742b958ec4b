// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/error.h"

namespace insitu {
namespace {

std::string Located(const std::filesystem::path& file, int line, const std::string& message) {
  std::string located = file.string();
  if (line > 0) located.append(":").append(std::to_string(line));
  return located.append(": ").append(message);
}

}  // namespace

InputError::InputError(const std::filesystem::path& file, int line, const std::string& message)
    : std::runtime_error(Located(file, line, message)) {}

CheckError::CheckError(const char* file, int line, const char* condition)
    : std::logic_error(Located(file, line, std::string("check failed: ") + condition)) {}

}  // namespace insitu
