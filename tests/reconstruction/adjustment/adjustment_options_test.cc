// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/adjustment_options.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>

#include "calibration/files/error.h"
#include "reconstruction/adjustment/adjust.h"

namespace insitu {
namespace {

// What Check says of options with one field changed; empty: nothing.
template <typename Field>
std::string FaultWith(Field AdjustmentOptions::*field, Field value) {
  AdjustmentOptions options;
  options.*field = value;
  try {
    options.Check();
  } catch (const CheckError& error) {
    return error.what();
  }
  return "";
}

TEST(AdjustmentOptions, AreSoundAsTheyStand) { EXPECT_NO_THROW(AdjustmentOptions().Check()); }

TEST(AdjustmentOptions, NameTheFieldThatIsWrong) {
  const std::pair<double AdjustmentOptions::*, const char*> sigmas[] = {
      {&AdjustmentOptions::plane_sigma, "plane_sigma"},
      {&AdjustmentOptions::zenith_sigma, "zenith_sigma"},
      {&AdjustmentOptions::sun_sigma, "sun_sigma"}};
  for (const auto& [field, name] : sigmas) {
    EXPECT_EQ(FaultWith(field, 1e-9), "");
    for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()}) {
      EXPECT_NE(FaultWith(field, wrong).find(name), std::string::npos) << name << " " << wrong;
    }
  }
  for (const double wrong : {0.0, 1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_NE(FaultWith(&AdjustmentOptions::significance, wrong).find("significance"),
              std::string::npos);
  }
}

TEST(AdjustmentOptions, AreCheckedBeforeAnythingElse) {
  AdjustmentOptions options;
  options.sun_sigma = 0;
  try {
    Adjust({}, {}, {}, options);
    FAIL() << "expected the field's name";
  } catch (const CheckError& error) {
    EXPECT_NE(std::string(error.what()).find("sun_sigma"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace insitu
