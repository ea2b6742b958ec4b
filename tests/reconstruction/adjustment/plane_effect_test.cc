// SPDX-License-Identifier: GPL-3.0-or-later
// The solution with planes against that without, over networks whose planes hold and do not.
#include "reconstruction/adjustment/plane_effect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reconstruction/adjustment/adjust.h"
#include "reconstruction/verdict/verdict.h"
#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {
namespace {

// In the truth planes are exact: these sigmas say so.
AdjustmentOptions ExactGeometry() {
  AdjustmentOptions options;
  options.plane_sigma = options.zenith_sigma = options.sun_sigma = 1e-4;
  return options;
}

Adjustment AdjustNetwork(const SyntheticNetwork& network, const Survey& survey) {
  return Adjust(survey, network.photos, network.cameras, ExactGeometry());
}

const PlaneEffect::Shift* ShiftOf(const PlaneEffect& effect, const std::string& name) {
  const auto found = std::find_if(effect.shifts.begin(), effect.shifts.end(),
                                  [&](const auto& shift) { return shift.name == name; });
  return found == effect.shifts.end() ? nullptr : &*found;
}

// The survey with one point's marks where they were if it stood elsewhere.
Survey Moved(const SyntheticNetwork& network, Survey survey, const std::string& point,
             const Eigen::Vector3d& shift) {
  for (ImageObservation& mark : survey.observations) {
    if (mark.point != point) continue;
    const auto photo = std::find(network.photos.begin(), network.photos.end(), mark.photo) -
                       network.photos.begin();
    const Eigen::Vector3d moved = network.points.at(point) + shift;
    mark.pixel = *network.cameras[photo].Project(network.cam_from_world[photo] * moved);
  }
  return survey;
}

TEST(PlaneEffect, MovesNothingWhereAllIsExact) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const PlaneEffect effect = AdjustNetwork(network, network.survey).plane_effect;
  EXPECT_EQ(effect.unknown_because, "");
  EXPECT_EQ(effect.held_by_planes, std::vector<std::string>{"single"});
  EXPECT_EQ(effect.shifts.size(), network.photos.size() + network.points.size() - 1);
  for (const PlaneEffect::Shift& shift : effect.shifts) {
    EXPECT_LT(shift.difference.norm(), 1e-7) << shift.name;
  }
  // 65 vertices on 16 planes of three unknowns each; "single" takes its two marks and one vertex.
  EXPECT_EQ(effect.degrees, 65 - 3 * 16 - 1);
}

TEST(PlaneEffect, IsDistributedAsItsTestSays) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  // Plumb edges without error make their walls flat in the solution without planes too.
  network.survey.zenith_pairs.clear();
  constexpr int kNetworks = 40;
  int rejected = 0, shifts = 0;
  double statistic = 0, squares = 0;
  for (int seed = 1; seed <= kNetworks; ++seed) {
    const PlaneEffect effect = AdjustNetwork(network, WithNoise(network.survey, seed)).plane_effect;
    statistic += effect.statistic / effect.degrees;
    rejected += effect.statistic > effect.limit;
    for (const PlaneEffect::Shift& shift : effect.shifts) {
      if (!shift.w) continue;
      squares += *shift.w * *shift.w;
      ++shifts;
    }
  }
  EXPECT_NEAR(statistic / kNetworks, 1, 0.15);  // its own sigma is 0.056
  EXPECT_LE(rejected, 7);                       // 2 expected
  EXPECT_NEAR(std::sqrt(squares / shifts), 1, 0.15);
}

TEST(PlaneEffect, FindsAWallThatIsNotFlat) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const Survey survey =
      Moved(network, WithNoise(network.survey, 1), "b6", Eigen::Vector3d(0, 0.3, 0));
  const Adjustment adjustment = AdjustNetwork(network, survey);
  const PlaneEffect& effect = adjustment.plane_effect;
  EXPECT_GT(effect.statistic, 2 * effect.limit);
  const PlaneEffect::Shift* corner = ShiftOf(effect, "b6");
  ASSERT_TRUE(corner && corner->w);
  EXPECT_GT(std::abs(*corner->w), adjustment.critical_w);
  EXPECT_LT(corner->difference.y(), -0.04);  // the planes pull it back
  const auto findings = Judge(adjustment);
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const Finding& each) {
    return each.reason.find("the planes do not all hold") != std::string::npos;
  }));
}

TEST(PlaneEffect, IsNotComparedWithoutPlanes) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  Survey flat = network.survey;
  flat.polygons.clear();
  std::erase_if(flat.observations, [](const auto& mark) { return mark.point == "single"; });
  EXPECT_EQ(AdjustNetwork(network, flat).plane_effect.unknown_because, "there are no planes");
}

}  // namespace
}  // namespace insitu
