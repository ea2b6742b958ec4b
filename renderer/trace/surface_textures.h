// SPDX-License-Identifier: GPL-3.0-or-later
// Images on the building's faces, and solid textures, filtered to what a ray stands for.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/building/artificial_environment.h"
#include "renderer/trace/irradiance_map.h"
#include "renderer/trace/montage_scene.h"

namespace insitu {

// What the maps of a face say where a ray meets it; nullopt: it has none.
struct MapValues {
  std::optional<double> roughness, metallic, transmission;
  // Of the relief over the front of the face, along it; and the variance of slopes that are finer
  // than the ray.
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double variance = 0;
};

class SurfaceTextures {
 public:
  // Textures are named relative to `folder`. Their images in linear light, with their coarser
  // levels, are kept in `cache` under the hash of their files. `pixel_angle` [rad] is what a pixel
  // spans. Throws InputError: an image that is missing or unreadable.
  SurfaceTextures(const ArtificialEnvironment& environment, const std::filesystem::path& folder,
                  const std::filesystem::path& cache, double pixel_angle);
  ~SurfaceTextures();

  // Albedo, linear RGB, of what a ray of unit `direction` sees of a face `distance` [m] on: the
  // mean over the ray's share of the pixel. nullopt: the face has no texture, or no place on it.
  std::optional<Eigen::Vector3d> Albedo(const FacePlace& place, double distance,
                                        const Eigen::Vector3d& direction) const;
  // The other maps, filtered alike.
  MapValues Maps(const FacePlace& place, double distance, const Eigen::Vector3d& direction) const;

 private:
  struct Face;
  struct Images;
  struct Footprint;
  static void AddRelief(const SurfaceMap& says, const Face& face, const float* relief,
                        MapValues* values);
  const Face* FaceAt(const FacePlace& place) const;
  Footprint FootprintOf(const Face& face, const FacePlace& place, double distance,
                        const Eigen::Vector3d& direction) const;
  double ray_angle_;                   // [rad]
  std::vector<int> face_of_triangle_;  // -1: none
  std::vector<Face> faces_;
  std::unique_ptr<Images> images_;
};

// What of a surface's bumps is coarser than the ray's share of a pixel turns its normal, what is
// finer makes its mirror rough.
struct BumpedSurface {
  SurfacePoint surface;
  SpectralMaterial material;
};

// `surface` lies `distance` [m] along a ray to the viewer. Without bumps: as it is. The normal
// stays on the viewer's side.
BumpedSurface BumpedAt(const MontageScene& scene, const SurfacePoint& surface,
                       const SpectralMaterial& material, const Eigen::Vector3d& to_viewer,
                       double distance);

// A face of the building as a ray meets it, `distance` [m] on: its material there by textures and
// maps, its normal by relief and bumps. What is metal in part is metal where `choice`, in [0, 1),
// says so.
BumpedSurface BuildingSurfaceAt(const MontageScene& scene, const SurfacePoint& surface,
                                const FacePlace& place, double distance,
                                const Eigen::Vector3d& to_viewer, double choice);

// Share of what glass does not mirror that goes through where a ray of unit `direction` meets it.
double TransmissionAt(const MontageScene& scene, const FacePlace& place,
                      const Eigen::Vector3d& direction);

}  // namespace insitu
