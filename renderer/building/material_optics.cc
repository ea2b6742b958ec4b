// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/material_optics.h"

#include <cmath>
#include <string>

#include "radiometry/library/material_library.h"
#include "radiometry/spectrum/spectral_table.h"

namespace insitu {
namespace {

constexpr double kUsualIndex = 1.5;      // of glass whose own is not given
constexpr double kLookedThrough = 0.01;  // [m], of a glass whose thickness is not given

double TransmissionOf(const JsonNode& node) {
  const double share = node.Number();
  if (share < 0 || share > 1) throw node.Error("is out of range, expected 0 to 1");
  return share;
}

bool IsTrue(const MaterialKeys& material, const std::string& key) {
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
  RequireVisibleRange(metal.index, table);
  return metal;
}

// What stands in the place of Fresnel's index.
void ReadMirrorColor(const MaterialKeys& material, SurfaceMaterial* surface) {
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

// The three channels that dim white light as the table does, through as much as the pane is thick.
Eigen::Vector3d AbsorptionOf(const JsonNode& rows, double thickness) {
  SpectralTable table = ReadSpectralTable(rows);
  RequireVisibleRange(table, rows);
  const double layer = thickness > 0 ? thickness : kLookedThrough;
  for (Eigen::Vector2d& row : table) row.y() = std::exp(-layer * row.y());
  return -ColorOfReflectance(table).cwiseMax(1e-6).array().log() / layer;
}

std::optional<Glass> ReadGlass(const MaterialKeys& material, const SurfaceMaterial& surface) {
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
  const auto absorption = material.WithAnyOf({"absorption_per_m", "absorption_table"});
  if (!absorption) return glass;
  const auto rgb = absorption->Find("absorption_per_m");
  glass.absorption_rgb = rgb ? ReadAbsorption(*rgb)
                             : AbsorptionOf(absorption->At("absorption_table"), glass.thickness);
  return glass;
}

Eigen::Vector3d ReadShares(const JsonNode& node) {
  const Eigen::Vector3d shares = node.Vector3();
  if (shares.minCoeff() < 0 || shares.maxCoeff() > 1) {
    throw node.Error("is out of range, expected three values from 0 to 1");
  }
  return shares;
}

SpectralTable ReadShareTable(const JsonNode& rows) {
  SpectralTable table = ReadSpectralTable(rows);
  for (const Eigen::Vector2d& row : table) {
    if (row.y() > 1) throw rows.Error("has a value above 1, expected shares from 0 to 1");
  }
  RequireVisibleRange(table, rows);
  return table;
}

void ReadTranslucence(const MaterialKeys& material, SurfaceMaterial* surface) {
  constexpr double kRounding = 1e-6;
  const auto keys = material.WithAnyOf({"translucent_rgb", "translucent_table"});
  if (!keys) return;
  const auto rgb = keys->Find("translucent_rgb");
  const JsonNode node = rgb ? *rgb : keys->At("translucent_table");
  if (rgb) {
    surface->translucent_rgb = ReadShares(node);
  } else {
    surface->translucent = ReadShareTable(node);
    surface->translucent_rgb = ColorOfReflectance(surface->translucent);
  }
  if (surface->translucent_rgb.maxCoeff() <= 0) return;
  if (surface->glass) {
    throw node.Error(
        "stands beside transmission, expected one of them: light goes straight on or "
        "in all directions");
  }
  const Eigen::Vector3d all =
      surface->diffuse_weight * surface->diffuse_rgb + surface->translucent_rgb;
  if (all.maxCoeff() > 1 + kRounding) {
    throw node.Error(
        "and the diffuse colour times diffuse_weight are more than 1, expected no "
        "more light than falls on it");
  }
}

}  // namespace

void ReadOptics(const MaterialKeys& material, SurfaceMaterial* surface) {
  ReadMirrorColor(material, surface);
  surface->specular = ReadSpecular(material, true);
  surface->glass = ReadGlass(material, *surface);
  surface->bumps = ReadBumps(material);
  ReadTranslucence(material, surface);
}

}  // namespace insitu
