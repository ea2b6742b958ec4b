// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/distinct_photographs.h"

#include <cstdint>
#include <map>
#include <string>
#include <system_error>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"

namespace insitu {

void RequireDistinctPhotographs(const std::vector<std::filesystem::path>& photographs) {
  std::map<std::uintmax_t, std::vector<std::filesystem::path>> of_size;
  for (const std::filesystem::path& photograph : photographs) {
    std::error_code failure;
    const std::uintmax_t size = std::filesystem::file_size(photograph, failure);
    if (failure) throw InputError(photograph, "cannot be read: " + failure.message());
    of_size[size].push_back(photograph);
  }
  for (const auto& [size, alike] : of_size) {
    if (alike.size() < 2) continue;
    std::map<std::string, std::filesystem::path> of_content;
    for (const std::filesystem::path& photograph : alike) {
      const auto [first, is_new] = of_content.emplace(ReadWhole(photograph), photograph);
      if (is_new) continue;
      throw InputError(photograph,
                       "is the same photograph as '" + first->second.filename().string() +
                           "', byte for byte; expected each photograph once: remove one "
                           "of the files and its rows in the survey");
    }
  }
}

}  // namespace insitu
