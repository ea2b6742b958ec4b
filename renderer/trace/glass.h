// SPDX-License-Identifier: GPL-3.0-or-later
// The planned building's glass as a viewer sees it: mirror image, and what is behind.
#pragma once

#include <functional>

#include "renderer/trace/light_split.h"
#include "renderer/trace/montage_scene.h"
#include "renderer/trace/scene_hit.h"

namespace insitu {

// Radiance of a face of glass towards where the ray comes from, what meets its diffuse part left
// out. A pane shows its mirror image and, undeviated, what `straight_on` returns: the radiance
// that reaches it from behind along the ray. A body refracts and mirrors at each of its faces and
// absorbs between them. What leaves the glass is asked of `trace`: the apparent radiance along a
// ray. Up to the second pane or mirror (`depth`) both parts are followed, after that one by chance.
Spectrum GlassColor(const MontageScene& scene, const SceneHit& hit, const Ray& ray,
                    const LightDirections& light, int depth,
                    const std::function<Spectrum()>& straight_on,
                    const std::function<Spectrum(const Ray&)>& trace);

}  // namespace insitu
