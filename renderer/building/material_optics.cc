// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/material_optics.h"

#include <string>

#include "radiometry/spectrum/spectrum.h"

namespace insitu {
namespace {

constexpr double kCoveredFrom = 420, kCoveredTo = 680;  // [nm], where the eye sees most
constexpr double kUsualIndex = 1.5;                     // of glass whose own is not given

double TransmissionOf(const JsonNode& node) {
  const double share = node.Number();
  if (share < 0 || share > 1) throw node.Error("is out of range, expected 0 to 1");
  return share;
}

bool IsTrue(const JsonNode& material, const std::string& key) {
  const auto node = material.Find(key);
  return node && node->Boolean();
}

Metal ReadMetal(const JsonNode& table) {
  Metal metal;
  for (const JsonNode& row : table.Items()) {
    const Eigen::Vector3d values = row.Vector3();
    if (!metal.index.empty() && values[0] <= metal.index.back()[0]) {
      throw row.Error("does not rise, expected wavelengths [nm] in order");
    }
    if (values[1] <= 0 || values[2] < 0)
      throw row.Error("is no complex index, expected n > 0, k >= 0");
    metal.index.emplace_back(values[0], values[1]);
    metal.extinction.emplace_back(values[0], values[2]);
  }
  if (metal.index.empty() || metal.index.front()[0] > kCoveredFrom ||
      metal.index.back()[0] < kCoveredTo) {
    throw table.Error(
        "does not cover the visible range, expected rows from 420 nm or less to 680 or more");
  }
  return metal;
}

// What stands in the place of Fresnel's index.
void ReadMirrorColor(const JsonNode& material, SurfaceMaterial* surface) {
  if (const auto rgb = material.Find("specular_rgb")) {
    surface->specular_rgb = rgb->Vector3();
    if (surface->specular_rgb.minCoeff() < 0 || surface->specular_rgb.maxCoeff() > 1) {
      throw rgb->Error("is no reflectance, expected three values from 0 to 1");
    }
  }
  const auto kind = material.Find("specular");
  if (kind && kind->Text() == "conductor") surface->metal = ReadMetal(material.At("complex_index"));
}

Eigen::Vector3d ReadAbsorption(const JsonNode& node) {
  const Eigen::Vector3d absorption = node.Vector3();
  if (absorption.minCoeff() < 0) throw node.Error("is negative, expected 0 or more per metre");
  return absorption;
}

std::optional<Glass> ReadGlass(const JsonNode& material, const SurfaceMaterial& surface) {
  const auto transmission = material.Find("transmission");
  if (!transmission || TransmissionOf(*transmission) == 0) return std::nullopt;
  Glass glass;
  glass.weight = transmission->Number();
  glass.is_solid = IsTrue(material, "solid");
  if (glass.is_solid && IsTrue(material, "thin")) {
    throw material.At("thin").Error("is true beside solid, expected one of them");
  }
  glass.index = kUsualIndex;
  if (surface.specular && surface.specular->index) glass.index = *surface.specular->index;
  if (const auto thickness = material.Find("thickness_m")) {
    glass.thickness = thickness->Number();
    if (glass.thickness < 0) throw thickness->Error("is negative, expected metres");
  }
  if (const auto absorption = material.Find("absorption_per_m")) {
    glass.absorption_rgb = ReadAbsorption(*absorption);
  }
  return glass;
}

}  // namespace

void ReadOptics(const JsonNode& material, SurfaceMaterial* surface) {
  ReadMirrorColor(material, surface);
  surface->specular = ReadSpecular(material, true);
  surface->glass = ReadGlass(material, *surface);
}

}  // namespace insitu
