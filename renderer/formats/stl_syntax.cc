// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/stl_syntax.h"

#include <fstream>
#include <string>
#include <string_view>

#include "calibration/files/error.h"
#include "renderer/formats/cut_short.h"

namespace insitu {

namespace fs = std::filesystem;

std::optional<uint64_t> BinaryStlSize(const fs::path& path) {
  constexpr size_t kHead = 80, kFacet = 50;
  uint32_t facets = 0;
  std::ifstream file(path, std::ios::binary);
  file.seekg(kHead);
  if (!file.read(reinterpret_cast<char*>(&facets), sizeof(facets))) return std::nullopt;
  return kHead + sizeof(facets) + kFacet * uint64_t{facets};
}

void CheckStl(const fs::path& path) {
  const std::optional<uint64_t> expected = BinaryStlSize(path);
  const uint64_t size = fs::file_size(path);
  if (size == expected) return;
  char head[5] = {};
  std::ifstream(path, std::ios::binary).read(head, sizeof(head));
  if (std::string_view(head, sizeof(head)) == "solid" || !expected) {
    return RequireEnding(path, "endsolid");
  }
  RequireLength(path, *expected);
  throw InputError(path, "is " + std::to_string(size) + " bytes long, expected " +
                             std::to_string(*expected) + " as its head states");
}

}  // namespace insitu
