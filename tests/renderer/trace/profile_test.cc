// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <ctime>

namespace insitu {
namespace {

// Keeps the thread busy for that much CPU time.
void Work(double seconds) {
  const std::clock_t end = std::clock() + static_cast<std::clock_t>(seconds * CLOCKS_PER_SEC);
  volatile double sink = 0;
  while (std::clock() < end) sink = sink + std::sqrt(2.0);
}

TEST(Profile, CountsCpuTimeByPhase) {
  const Profile profile;
  Work(0.2);
  {
    const PhaseScope embree(Phase::kEmbree);
    Work(0.4);
    const PhaseScope files(Phase::kFiles);
    Work(0.2);
  }
  double shading = 0, embree = 0, files = 0;
  ASSERT_EQ(std::sscanf(profile.Report().c_str(), "shading %lf %% embree %lf %% files %lf",
                        &shading, &embree, &files),
            3);
  EXPECT_NEAR(shading, 25, 10);
  EXPECT_NEAR(embree, 50, 10);
  EXPECT_NEAR(files, 25, 10);
}

}  // namespace
}  // namespace insitu
