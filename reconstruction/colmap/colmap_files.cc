// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap/colmap_files.h"

namespace insitu {

InputError ColmapError(const std::filesystem::path& path, bool is_binary, size_t place,
                       const std::string& message) {
  if (!is_binary) return InputError(path, static_cast<int>(place), message);
  return InputError(path, "at byte " + std::to_string(place) + ": " + message);
}

}  // namespace insitu
