// SPDX-License-Identifier: GPL-3.0-or-later
// The planned building's glass as a viewer sees it: mirror image, and what is behind.
#pragma once

#include <functional>

#include "renderer/trace/light_split.h"
#include "renderer/trace/montage_scene.h"
#include "renderer/trace/scene_hit.h"

namespace insitu {

// What a ray brings that goes on by a face of glass.
using TraceFurther = std::function<Spectrum(const Ray& ray, const LightDirections& light)>;

// Radiance of a face of glass towards where the ray comes from, what meets its diffuse part left
// out; `material` is it there. A pane shows its mirror image and, undeviated, what `straight_on`
// returns: the radiance that reaches it from behind along the ray. A body refracts and mirrors at
// each of its faces and absorbs between them. Rough ones do so facet by facet, and add sun and
// lamps by their lobes. Up to the second pane or mirror (`depth`) both parts are followed, after
// that one by chance.
Spectrum GlassColor(const MontageScene& scene, const SceneHit& hit,
                    const SpectralMaterial& material, const Ray& ray, const LightDirections& light,
                    int depth, const std::function<Spectrum()>& straight_on,
                    const TraceFurther& trace);

// The share that it mirrors at this cosine, 0..1.
Spectrum GlassReflectance(const SpectralMaterial& glass, double cosine);

// What goes on by a mirror or a pane that hands on so much.
LightDirections Part(LightDirections light, const MontageScene& scene, const Spectrum& share);

}  // namespace insitu
