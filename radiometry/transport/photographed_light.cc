// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/transport/photographed_light.h"

#include <tbb/parallel_for.h>

#include <utility>

namespace insitu {
namespace {

PatchGrid GridAbout(const LightFoci& foci) {
  PatchGrid grid{{}, foci.piece_m};
  for (const SurfacePoint& point : foci.points) {
    grid.foci.emplace_back(point.position, point.position);
  }
  return grid;
}

}  // namespace

PhotographedLight::PhotographedLight(const LitSite& site, std::vector<LocalImage> images,
                                     const LightFoci& foci, const InterreflectionOptions& options)
    : polygons_(MeshOfPolygons(site.scene)),
      rays_(polygons_.mesh),
      images_(std::move(images)),
      scene_{{site.scene, rays_, polygons_.polygon_of_triangle, images_, site.air, site.spectra},
             polygons_.mesh,
             nothing_.faces,
             {}},
      interreflection_(scene_, site.light, GridAbout(foci), options),
      meetings_(foci.points.size()) {
  tbb::parallel_for(size_t{0}, meetings_.size(),
                    [&](size_t i) { meetings_[i] = interreflection_.Meet(foci.points[i]); });
}

GatheredLight PhotographedLight::AtFocus(size_t point) const {
  return interreflection_.Gathered(meetings_[point]);
}

}  // namespace insitu
