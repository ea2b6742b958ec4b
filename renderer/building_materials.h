// SPDX-License-Identifier: GPL-3.0-or-later
// What the architect's layers are made of, and the building's lamps: building/materials.json and
// building/lights.json.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "renderer/artificial_environment.h"

namespace insitu {

// By layer. Throws InputError: unreadable, weights or albedo outside 0..1, an unknown kind of
// specular, Fresnel without an index above 1, a mirroring material with roughness > 0.
std::map<std::string, SurfaceMaterial> ReadBuildingMaterials(const std::filesystem::path& path);

// Throws InputError: unreadable, a negative intensity.
std::vector<PointLight> ReadPointLights(const std::filesystem::path& path);

}  // namespace insitu
