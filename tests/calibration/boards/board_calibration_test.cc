// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/boards/board_calibration.h"

#include <gtest/gtest.h>

#include <limits>

#include "calibration/files/error.h"

namespace insitu {
namespace {

std::string FaultOf(const BoardCalibrationOptions& options) {
  try {
    options.Check();
    return "none";
  } catch (const CheckError& error) {
    return error.what();
  }
}

TEST(BoardCalibrationOptions, NameTheFieldThatIsWrong) {
  EXPECT_EQ(FaultOf({}), "none");
  EXPECT_EQ(FaultOf({.focal_px = 1000}), "none");
  for (const double focal : {-1.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_NE(FaultOf({.focal_px = focal}).find("focal_px"), std::string::npos);
  }
  EXPECT_NE(FaultOf({.lens_model = "OPENCV8"}).find("lens_model"), std::string::npos);
  const BoardCalibrationOptions wrong{.focal_px = -1};
  EXPECT_THROW(CalibrateFromBoards({"board.jpg"}, {}, "camera.cameramodel", wrong), CheckError);
}

}  // namespace
}  // namespace insitu
