// SPDX-License-Identifier: GPL-3.0-or-later
// The head of a PLY file: what stands in it, in which order.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/foreign/unit_comment.h"

namespace insitu {

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;
  std::optional<PlyType> count_type;  // of a list
};

struct PlyElement {
  std::string name;
  int64_t count = 0;
  int line = 0;  // where the head states it
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { kText, kLittleEndian, kBigEndian };

struct PlyHead {
  PlyEncoding encoding = PlyEncoding::kText;
  std::vector<PlyElement> elements;
  std::string texture;              // of a comment "TextureFile NAME", as MeshLab writes it
  std::optional<UnitComment> unit;  // of the first comment that names one
  int lines = 0;
  size_t size = 0;  // [bytes], with the end of its last line
};

// Throws InputError at its line: no end_header, an unknown format, type or statement, a count that
// is none.
PlyHead ReadPlyHead(const std::filesystem::path& path, std::string_view bytes);

}  // namespace insitu
