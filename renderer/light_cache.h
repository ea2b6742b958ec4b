// SPDX-License-Identifier: GPL-3.0-or-later
// Light among surfaces, kept on disk for the next render of the same site and building: another
// photograph, frame or sharpness takes it up where it was, and comes to the same bytes as without.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "renderer/trace/interreflected_light.h"

namespace insitu {

// `inputs`: hash of all that this light depends on. nullopt: there is no such file, it is of other
// inputs, or not as it was written.
std::optional<KeptLight> ReadLightCache(const std::filesystem::path& path,
                                        const std::string& inputs);

// Light of more points than kMostKeptPoints, about a gigabyte, is not kept: what was there goes.
// Throws std::runtime_error: the disk is full.
inline constexpr size_t kMostKeptPoints = 3'000'000;
void WriteLightCache(const std::filesystem::path& path, const std::string& inputs,
                     const KeptLight& light);

}  // namespace insitu
