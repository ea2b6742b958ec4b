// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/gallery.h"

#include "datasets_synthetic/campus.h"

namespace insitu::demo {
namespace {

// The sun stands to the left behind the photographers: a support's shadow falls across the floor.
constexpr double kGalleryAzimuth = 107.7 * kDegree;

// On plan: a torus in the shadow of the middle support, a cone through the roof's edge, a sphere
// whose shadow crosses the path.
Building Solids() {
  Building solids;
  solids.layers = {Material::kBluePaint, Material::kRedPaint, Material::kSandstone};
  solids.meshes = {Torus({-0.5, 5.75, 0.51}, 0.86, 0.28, Material::kBluePaint),
                   Cone({-4.7, 3.75, -0.2}, 6.6, 1.35, 24, 64, Material::kRedPaint)};
  solids.bodies = {Ball({3.4, -2.6, 1.15}, 1.2, 4, Material::kSandstone)};
  return solids;
}

}  // namespace

SiteDescription DescribeGallery(int width, int height) {
  Site site = MakeCampus(width, height, kGalleryAzimuth);
  site.record.name = "gallery";
  return {site, Turned(Solids(), kGalleryAzimuth), ClearMorning()};
}

}  // namespace insitu::demo
