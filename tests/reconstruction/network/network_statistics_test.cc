// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/reconstruction/network/network_statistics.h"

#include <gtest/gtest.h>

namespace insitu {
namespace {

TEST(NetworkStatistics, IntervalsOfRandomNetworksHoldTheTruth) {
  const NetworkStatistics statistics = SampleNetworkStatistics(500);
  const IntervalCoverage& coverage = statistics.coverage_95;
  for (const double share :
       {coverage.pose, coverage.vertex, coverage.plane, coverage.sun, coverage.zenith}) {
    EXPECT_NEAR(share, 0.95, 0.02);
  }
  EXPECT_NEAR(statistics.mean_sigma0, 1, 0.01);
  EXPECT_NEAR(statistics.false_alarm_share, 0.05, 0.002);
  EXPECT_GE(statistics.found_blunder_share, 0.95);
}

}  // namespace
}  // namespace insitu
