// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/shadows/existing_shadows.h"

#include <gtest/gtest.h>

#include "renderer/trace/interreflected_light.h"
#include "tests/renderer/trace/small_site.h"

namespace insitu {
namespace {

// The lawn of the small site, in the lower part of its photograph, with a shadow painted on it that
// nothing casts.
class ExistingShadows : public testing::Test {
 protected:
  ExistingShadows() {
    const Daylight& light = small_.natural.light;
    const SpectralBasis& spectra = small_.natural.spectra;
    const Spectrum sky = std::numbers::pi * (light.sky_radiance + light.ambient_radiance);
    const Spectrum sun = light.sun_radiance * light.sun_solid_angle * std::sqrt(0.5);
    const Eigen::Vector3d left =
        spectra.RgbFromSpectrum(sky).cwiseQuotient(spectra.RgbFromSpectrum(sky + sun));
    for (int y = 34; y < 44; ++y) {
      for (int x = 20; x < 40; ++x) {
        small_.photo.SetRgb(x, y, small_.photo.Rgb(x, y).cwiseProduct(left));
      }
    }
  }
  SunShares Find(const Foreground* foreground = nullptr) {
    MontageScene scene = small_.With({});
    AddInterreflection(&scene, 0);
    return FindExistingShadows(scene, small_.camera(), small_.photo, foreground);
  }
  SmallSite small_ = MakeSmallSite();
};

TEST_F(ExistingShadows, AreFoundAndNothingElse) {
  const SunShares shares = Find();
  EXPECT_LT(*shares.share.At(30, 39), 0.05);
  EXPECT_GT(*shares.share.At(10, 39), 0.95);
  EXPECT_GT(*shares.share.At(50, 45), 0.95);
  EXPECT_EQ(*shares.share.At(30, 2), 1);  // the sky
}

TEST_F(ExistingShadows, NotBehindWhatStandsInFront) {
  Foreground tree{Raster(64, 48, 1), small_.photo};
  for (int y = 34; y < 44; ++y) {
    for (int x = 20; x < 40; ++x) *tree.share.At(x, y) = 1;
  }
  EXPECT_EQ(*Find(&tree).share.At(30, 39), 1);
}

}  // namespace
}  // namespace insitu
