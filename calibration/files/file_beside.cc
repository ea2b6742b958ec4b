// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/file_beside.h"

#include <system_error>

namespace insitu {

std::filesystem::path FileBeside(const JsonNode& node) {
  const std::filesystem::path path = node.path().parent_path() / node.Text();
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) {
    throw node.Error("names " + node.Text() + ", which is not there, expected a file beside it");
  }
  return path;
}

}  // namespace insitu
