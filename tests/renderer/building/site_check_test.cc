// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/site_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace insitu {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

AlignedBox3d Box(const Vector3d& low, const Vector3d& size) { return {low, low + size}; }

TEST(SiteCheck, NamesTheFactorThatIsOff) {
  const Vector3d origin(2600000, 1200000, 400), size(20, 12, 9);
  const AlignedBox3d site = Box(origin, {120, 90, 30});
  EXPECT_THAT(SuspicionsOf(Box(origin, size), site, 1), IsEmpty());
  EXPECT_THAT(SuspicionsOf(Box(1000 * origin, 1000 * size), site, 1),
              Contains(HasSubstr("of 1000:")));
  EXPECT_THAT(SuspicionsOf(Box(304.8 * origin, 304.8 * size), site, 0.3048),
              Contains(HasSubstr("of 304.8:")));
  EXPECT_THAT(SuspicionsOf(Box(25.4 * origin, 25.4 * size), site, 0.0254),
              Contains(HasSubstr("of 25.4:")));
  EXPECT_THAT(SuspicionsOf(Box(origin / 1000, size / 1000), site, 1e-3),
              Contains(HasSubstr("0.001:")));
  EXPECT_THAT(SuspicionsOf(Box(Vector3d::Zero(), size), site, 1),
              Contains(HasSubstr("from the site")));
  EXPECT_THAT(SuspicionsOf(Box(Vector3d::Zero(), 1000 * size), {}, 1),
              Contains(HasSubstr("1000:")));
  EXPECT_THAT(SuspicionsOf(Box(Vector3d::Zero(), size), {}, 1), IsEmpty());
  EXPECT_THAT(SuspicionsOf(Box(Vector3d::Zero(), 1000 * size), {}, {}),
              Contains(HasSubstr("millimetres taken as metres")));
  const AlignedBox3d house = Box(Vector3d::Zero(), size / 0.0254);  // an OBJ in inches
  const AlignedBox3d plot = Box(Vector3d::Zero(), {100, 100, 20});
  EXPECT_THAT(SuspicionsOf(house, plot, {}), Contains(HasSubstr("inches taken as metres")));
}

}  // namespace
}  // namespace insitu
