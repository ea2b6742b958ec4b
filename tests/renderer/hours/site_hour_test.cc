// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/hours/site_hour.h"

#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "reconstruction/geometry/omega_phi_kappa.h"

namespace insitu {
namespace {

constexpr char kDay[] = "2024-05-15";

TEST(HourName, IsTheClockOnThePhotographsDayAndTheDateOnOthers) {
  EXPECT_EQ(HourName({.time = "16:30"}, kDay), "1630");
  EXPECT_EQ(HourName({.time = "2024-05-15T16:30"}, kDay), "1630");
  EXPECT_EQ(HourName({.time = "2024-05-15T16:30:00+02:00"}, kDay), "1630");
  EXPECT_EQ(HourName({.time = "2024-12-21T12:00"}, kDay), "2024-12-21T1200");
  EXPECT_EQ(HourName({.time = "2024-12-21T12:00"}, ""), "2024-12-21T1200");
}

TEST(HourName, OfASunIsItsPosition) {
  EXPECT_EQ(HourName({.time = "", .sun = SunPosition{180 * kDegree, 35.54 * kDegree}}, kDay),
            "az180_0el35_5");
}

TEST(HourName, RefusesWhatIsNoTime) {
  for (const char* time : {"", "noon", "25:00", "16:60", "4:30", "2024-02-30T12:00", "16:30x",
                           "2024-05-15", "../16:30"}) {
    EXPECT_THROW(HourName({.time = time}, kDay), InputError) << time;
  }
}

}  // namespace
}  // namespace insitu
