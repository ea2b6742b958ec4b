// SPDX-License-Identifier: GPL-3.0-or-later
// An image beside that of a surface's colour, which says something else of it.
#pragma once

#include <string>

namespace insitu {

struct SurfaceMap {
  enum class Kind { kRoughness, kMetallic, kTransmission, kNormal, kHeight };

  Kind kind = Kind::kRoughness;
  std::string file;  // as named in its model, or a path
  int channel = 0;   // 0 red, 1 green, 2 blue; of normals all three count
  // Of what the codes, linear from 0 to 1, say; of normals their x and y; of heights how much
  // higher white is than black [m].
  double factor = 1;
  bool is_squared = false;  // roughness alone: the slope is the square, as glTF has it
  double mean = 0;          // of what it says, factor and all; of normals and heights 0

  bool operator==(const SurfaceMap&) const = default;
};

}  // namespace insitu
