// SPDX-License-Identifier: GPL-3.0-or-later
// Mirroring surfaces, smooth and rough: how much they mirror, of what, and what of it is sun and
// lamps.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "renderer/trace/light_split.h"
#include "renderer/trace/montage_scene.h"

namespace insitu {

// Share of light that is mirrored at this cosine of incidence, 0..1; zero without a specular part.
Spectrum MirrorReflectance(const SpectralMaterial& material, double cosine);

// What a facet of the surface mirrors to the viewer. `weight` is its share of the surface's mirror
// image, 0 if it sends the viewer's ray into the surface.
struct MirroredRay {
  Ray ray;
  double weight = 1;
};
// `uniform` in [0, 1)^2 chooses the facet; a smooth surface has but one. The ray starts `clearance`
// [m] off the surface.
MirroredRay ChooseMirrored(const SurfacePoint& surface, const Roughness& roughness,
                           const Eigen::Vector3d& to_viewer, double clearance,
                           const Eigen::Vector2d& uniform);

// Columns: the axes of a frame whose z is the normal.
Eigen::Matrix3d FrameAbout(const Eigen::Vector3d& normal);

// The two numbers of a camera ray's mirror number `depth`.
Eigen::Vector2d FacetChoice(const LightDirections& light, int depth);
// A number in [0, 1) for a choice at that depth, independent of them.
double PathChoice(const LightDirections& light, int depth);

// Sun and lamps that reach `origin` [m], weighted by `lobe` of the unit direction towards each
// [1/sr]: where it is 0 nothing is asked. `with_building`: what it blocks, and its lamps.
Spectrum LightsByLobe(const MontageScene& scene, const Eigen::Vector3d& origin,
                      const LightDirections& light, bool with_building,
                      const std::function<double(const Eigen::Vector3d&)>& lobe);

// Sun and lamps in a rough mirror of facets that mirror all; zero for a smooth one, whose rays may
// meet them. `with_building`: what it blocks, and its lamps.
Spectrum LightsInRoughMirror(const MontageScene& scene, const SurfacePoint& surface,
                             const Roughness& roughness, const Eigen::Vector3d& to_viewer,
                             const LightDirections& light, bool with_building, double clearance);

// The sun's disc along a ray that meets nothing: its radiance within, zero beside.
Spectrum SunAlong(const MontageScene& scene, const Eigen::Vector3d& direction);

}  // namespace insitu
