// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/through_glass.h"

#include <algorithm>
#include <cmath>

#include "radiometry/light/fresnel.h"
#include "renderer/trace/profile.h"
#include "renderer/trace/surface_textures.h"

namespace insitu {
namespace {

constexpr int kMostInterfaces = 32;   // on one ray; light that has more is taken as lost
constexpr double kBeyondFace = 1e-4;  // [m], beyond a face that was met

// A body that the ray is inside of: where it came in, and how much longer its bent way is.
struct Inside {
  double entry = 0;
  double longer = 1;
};

double WayFactor(double cosine, double index) { return cosine / RefractedCosine(cosine, index); }

}  // namespace

SheetOptics PaneOptics(const SpectralGlass& glass, double cosine) {
  if (glass.rough) return glass.rough->Optics(cosine);
  return ThinSheet(cosine, glass.index, glass.absorption, glass.thickness);
}

double FaceTransmittance(const SpectralGlass& glass, double cosine) {
  if (glass.rough) return glass.rough->from_outside().Transmittance(cosine);
  return 1 - FresnelReflectance(cosine, glass.index);
}

Spectrum TransmittanceAlong(const MontageScene& scene, const Ray& ray) {
  const PhaseScope phase(Phase::kEmbree);
  if (scene.OpaqueRays().IsOccluded(ray)) return Spectrum::Zero();
  Spectrum share = Spectrum::Ones();
  if (!scene.split_faces) return share;
  const FaceSubset& clear = scene.split_faces->clear;
  Ray rest = ray;
  Inside inside{ray.near, 1};
  for (int i = 0; i < kMostInterfaces; ++i) {
    const auto hit = clear.rays.Nearest(rest);
    if (!hit) return share;
    const int triangle = clear.triangles[hit->triangle];
    const SpectralGlass& glass = *scene.MaterialOfTriangle(triangle).glass;
    const double along = ray.direction.dot(hit->sphere_normal ? *hit->sphere_normal
                                                              : scene.artificial_normals[triangle]);
    const double cosine = std::min(1.0, std::abs(along));
    const double weight = TransmissionAt(scene, {triangle, hit->uv, along > 0}, ray.direction);
    if (!glass.is_solid) {
      share *= weight * PaneOptics(glass, cosine).transmittance;
    } else {
      share *= weight * FaceTransmittance(glass, cosine);
      const double longer = WayFactor(cosine, glass.index);
      if (along > 0) {
        const double way = (hit->distance - inside.entry) * std::min(inside.longer, longer);
        share *= (-glass.absorption * way).exp();
      }
      inside = {hit->distance, longer};
    }
    rest.near = hit->distance + kBeyondFace;
  }
  return Spectrum::Zero();
}

}  // namespace insitu
