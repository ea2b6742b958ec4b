// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/pavilion.h"

#include <numbers>

namespace insitu::demo {
namespace {

// Plan coordinates of the pavilion: behind the gallery's left half.
Building Drawn() {
  constexpr double kLeft = -13.2, kRight = -3.6, kFront = 11.2, kBack = 17.4, kEaves = 5.9;
  constexpr double kRightAngle = std::numbers::pi / 2;
  constexpr double kWidth = 1.7, kHeight = 2.1;
  Building pavilion;
  pavilion.layers = {Material::kPlaster, Material::kSlate,    Material::kTimber,
                     Material::kGlass,   Material::kRedPaint, Material::kSandstone};
  AddBox(pavilion.panels, {kLeft, kFront, -0.3}, {kRight, kBack, kEaves}, Material::kPlaster);
  AddBox(pavilion.panels, {kLeft - 0.7, kFront - 0.7, kEaves}, {kRight + 0.7, kBack + 0.7, 6.25},
         Material::kSlate);
  pavilion.window = WindowBlock(kWidth, kHeight);
  for (const double sill : {0.55, 3.3}) {
    for (int i = 0; i < 4; ++i) {  // the block's y axis points out of the wall: turned by 180
      pavilion.windows.push_back(
          {{kLeft + 0.6 + kWidth + 2.25 * i, kFront, sill}, 2 * kRightAngle});
    }
    for (int i = 0; i < 2; ++i) {
      pavilion.windows.push_back({{kLeft, kFront + 0.95 + 2.65 * i, sill}, kRightAngle});
      pavilion.windows.push_back({{kRight, kBack - 0.95 - 2.65 * i, sill}, -kRightAngle});
    }
  }
  pavilion.bodies = {Ball({2.4, -2.9, 0.95}, 1.05, 2, Material::kSandstone)};
  pavilion.meshes = {Cone({-4.4, 5.3, -0.2}, 8.2, 0.55, 6, 24, Material::kRedPaint)};
  return pavilion;
}

}  // namespace

Building MakePavilion(double azimuth) { return Turned(Drawn(), azimuth); }

}  // namespace insitu::demo
