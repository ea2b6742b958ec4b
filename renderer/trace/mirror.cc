// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/mirror.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiometry/light/fresnel.h"
#include "radiometry/light/split_mix.h"
#include "renderer/trace/through_glass.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

double Uniform(uint64_t seed) { return static_cast<double>(SplitMix64(seed) >> 11) * 0x1p-53; }

Spectrum SunReaching(const MontageScene& scene, const Ray& to_sun, bool with_building) {
  if (to_sun.direction.dot(scene.natural.light.zenith_direction) <= 0 ||
      scene.natural_rays.IsOccluded(to_sun)) {
    return Spectrum::Zero();
  }
  const Spectrum through =
      with_building ? TransmittanceAlong(scene, to_sun) : Spectrum::Ones().eval();
  return through * scene.natural.light.sun_radiance * scene.natural.light.sun_solid_angle;
}

// A highlight without masking, (n + 2) / (8 pi) cos^n of the angle between half vector and normal,
// n = 2 / m^2 - 2. [Hall & Greenberg 1983, after Blinn 1977; the factor keeps its energy]
double BlinnLobe(const Roughness& roughness, const Vector3d& to_viewer, const Vector3d& to_light) {
  if (to_viewer.z() <= 0 || to_light.z() <= 0) return 0;
  const double power = std::max(1.0, 2 / (roughness.slope * roughness.slope) - 2);
  const double cosine = (to_viewer + to_light).normalized().z();
  return (power + 2) / (8 * std::numbers::pi) * std::pow(cosine, power);
}

double LobeOf(const MontageScene& scene, const Roughness& roughness, const Vector3d& to_viewer,
              const Vector3d& to_light) {
  return scene.as_printed ? BlinnLobe(roughness, to_viewer, to_light)
                          : MirrorLobe(roughness, to_viewer, to_light);
}

}  // namespace

Eigen::Matrix3d FrameAbout(const Vector3d& normal) {
  Eigen::Matrix3d frame;
  frame.col(0) = normal.unitOrthogonal();
  frame.col(1) = normal.cross(frame.col(0));
  frame.col(2) = normal;
  return frame;
}

Spectrum MirrorReflectance(const SpectralMaterial& material, double cosine) {
  if (!material.specular) return Spectrum::Zero();
  const double c = std::clamp(cosine, 0.0, 1.0);
  const Specular& specular = *material.specular;
  if (specular.index) {
    return Spectrum::Constant(specular.weight * FresnelReflectance(c, *specular.index));
  }
  if (!material.metal) return specular.weight * material.mirror_color;
  return specular.weight *
         ConductorReflectance(c, material.metal->index, material.metal->extinction);
}

MirroredRay ChooseMirrored(const SurfacePoint& surface, const Roughness& roughness,
                           const Vector3d& to_viewer, double clearance,
                           const Eigen::Vector2d& uniform) {
  Vector3d facet = surface.normal;
  MirroredRay mirrored;
  if (roughness.slope > 0) {
    const Eigen::Matrix3d frame = FrameAbout(surface.normal);
    facet = frame * VisibleFacet(roughness, frame.transpose() * to_viewer, uniform);
  }
  const Vector3d direction = (2 * facet.dot(to_viewer) * facet - to_viewer).normalized();
  if (roughness.slope > 0) {
    mirrored.weight = SmithMasking(roughness, surface.normal.dot(direction));
  }
  mirrored.ray = {surface.position + clearance * surface.normal, direction};
  return mirrored;
}

Eigen::Vector2d FacetChoice(const LightDirections& light, int depth) {
  if (depth == 0) return light.facet;
  const uint64_t seed = light.seed + 4 * static_cast<uint64_t>(depth);
  return {Uniform(seed), Uniform(seed + 1)};
}

double PathChoice(const LightDirections& light, int depth) {
  return Uniform(light.seed + 4 * static_cast<uint64_t>(depth) + 2);
}

Spectrum LightsByLobe(const MontageScene& scene, const Vector3d& origin,
                      const LightDirections& light, bool with_building,
                      const std::function<double(const Vector3d&)>& lobe) {
  Spectrum radiance = Spectrum::Zero();
  if (const double share = lobe(light.sun); share > 0) {
    radiance += share * SunReaching(scene, {origin, light.sun}, with_building);
  }
  if (!with_building) return radiance;
  for (const LampSpectrum& lamp : scene.lamps) {
    const LampLight arriving = LampLightAt(scene, lamp, origin, light);
    const double share = lobe(arriving.direction);
    if (share > 0) radiance += share * arriving.normal_irradiance;
  }
  return radiance;
}

Spectrum LightsInRoughMirror(const MontageScene& scene, const SurfacePoint& surface,
                             const Roughness& roughness, const Vector3d& to_viewer,
                             const LightDirections& light, bool with_building, double clearance) {
  if (roughness.slope == 0) return Spectrum::Zero();
  const Eigen::Matrix3d to_frame = FrameAbout(surface.normal).transpose();
  const Vector3d view = to_frame * to_viewer;
  return LightsByLobe(scene, surface.position + clearance * surface.normal, light, with_building,
                      [&](const Vector3d& to_light) {
                        return LobeOf(scene, roughness, view, to_frame * to_light);
                      });
}

Spectrum SunAlong(const MontageScene& scene, const Vector3d& direction) {
  const Vector3d& sun = scene.natural.light.sun_direction;
  const double tangent = direction.cross(sun).norm();
  if (direction.dot(sun) <= 0 || tangent > scene.solar_disc_radius) return Spectrum::Zero();
  return scene.natural.light.sun_radiance;
}

}  // namespace insitu
