// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of a glTF accessor, whatever they are stored as.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/gltf/gltf_file.h"

namespace insitu {

// `count` rows of `components` numbers.
struct GltfValues {
  int components = 0;
  std::vector<double> numbers;

  int count() const { return components == 0 ? 0 : static_cast<int>(numbers.size()) / components; }
};

// Quantised values as their numbers, normalised ones as -1..1 or 0..1, sparse ones put in. Throws
// InputError: not there, beyond its buffer view, of an unknown type.
GltfValues ReadGltfAccessor(GltfFile* file, int index);

// The same as whole numbers. Throws InputError: floating-point numbers too.
std::vector<uint32_t> ReadGltfIndices(GltfFile* file, int index);

}  // namespace insitu
