// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/render_quality.h"

#include <algorithm>

namespace insitu {
namespace {

void AtMost(int rays, int outline_rays, int bounces, int coarseness, RenderSiteOptions* options) {
  RenderOptions& render = options->render;
  options->light_coarseness = coarseness;
  render.most_rays = std::min(render.most_rays, rays);
  render.outline_rays = std::min(render.outline_rays, outline_rays);
  if (!options->uniform_ambient)
    options->bounces = std::min(options->bounces.value_or(bounces), bounces);
}

}  // namespace

void Lessen(Quality quality, RenderSiteOptions* options) {
  if (quality == Quality::kFinal) return;
  options->quality = quality == Quality::kFast ? "fast" : "draft";
  if (quality == Quality::kDraft) return AtMost(4, 8, 1, 2, options);
  AtMost(4, 4, 1, 4, options);
  options->render.block = 4;
  options->find_shadows = false;
  options->occlusion_pixels = 4;
  options->is_quick = true;
}

}  // namespace insitu
