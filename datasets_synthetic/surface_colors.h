// SPDX-License-Identifier: GPL-3.0-or-later
// What the surfaces of the demo site reflect: smooth spectral curves with a little texture.
#pragma once

#include <Eigen/Core>
#include <string>

#include "datasets_synthetic/spectral_light.h"

namespace insitu::demo {

enum class Material {
  kGrass,
  kForest,
  kGravel,
  kConcrete,
  kBrick,
  kRoofTile,
  kMetal,
  // Of new buildings; these carry no texture.
  kPlaster,
  kSlate,
  kTimber,
  kGlass,
  kRedPaint,
  kSandstone,
  // Of the paper's examples.
  kBluePaint,
  kBridgeTimber,
  kBridgeRoof,
  kWhitePlaster,
  kPalePlaster,
  kStucco,
  kPaving,
  kBoards,
  kPane,
  kWater,
};
inline constexpr int kMaterials = 23;

// "lawn", "concrete", ... as in survey/materials.json, "PAV_WALL", ... as in the DXF's layers.
const std::string& MaterialName(Material material);

// Reflectance (albedo, 0..1) without texture.
const Spectrum& PlainReflectance(Material material);

// Index of refraction of a mirroring material, 0 for the others.
double MirrorIndex(Material material);

// Reflectance at a position in the surface's own coordinates [m]. Detail finer than `footprint`
// [m], the size of a pixel on the surface, is averaged out.
Spectrum TexturedReflectance(Material material, const Eigen::Vector2d& position, double footprint);

// Existing windows are dark panes painted on their wall, targets black and white squares.
const Spectrum& WindowReflectance();
const Spectrum& TargetReflectance(bool white);

}  // namespace insitu::demo
