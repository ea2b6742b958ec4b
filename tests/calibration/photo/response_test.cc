// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/color/response.h"

#include "calibration/photo/montage_files.h"
#include "calibration/photo/photograph.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/calibration/photo/made_photographs.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

TEST(ResponseCurve, GoesThroughItsPointsAndRises) {
  const ToneCurve curve = ResponseCurve({{0, 0}, {0.2, 0.01}, {0.5, 0.6}, {0.8, 0.7}, {1, 2}});
  EXPECT_NEAR(curve.Linear(0.2), 0.005, 1e-6);  // light is 1 at the code 1
  EXPECT_NEAR(curve.Linear(0.5), 0.3, 1e-6);
  EXPECT_DOUBLE_EQ(curve.Linear(1), 1);
  double before = -1;
  for (int i = 0; i <= 1000; ++i) {
    const double code = i / 1000.0, light = curve.Linear(code);
    EXPECT_GT(light, before);
    EXPECT_NEAR(curve.Encoded(light), code, 1e-6);
    before = light;
  }
}

TEST(ResponseCurve, OfTwoPointsIsStraight) {
  EXPECT_NEAR(ResponseCurve({{0, 0}, {1, 5}}).Linear(0.3), 0.3, 1e-9);
}

class Response : public testing::Test {
 protected:
  fs::path At(const std::string& name) const { return folder_.path() / name; }
  void State(const std::string& curves) const {
    folder_.Write("response.json", "{\"curves\": [\n" + curves + "\n]}");
  }
  std::string Fault(const std::string& curves) const {
    State(curves);
    return InputErrorOf([&] { ReadPhotograph(At("a.png")); });
  }
  ScratchFolder folder_;
};

TEST_F(Response, IsThatOfItsChannelAndPhotograph) {
  WriteMade<uint16_t>(At("a.png"), 1, 3, {32768, 32768, 32768});
  WriteMade<uint16_t>(At("b.png"), 1, 3, {32768, 32768, 32768});
  State(R"({"photos": ["b"], "red": [[0, 0], [1, 1]], "green": [[0, 0], [0.5, 0.1], [1, 1]],
            "blue": [[0, 0], [0.5, 0.9], [1, 1]]}, {"all": [[0, 0], [0.5, 0.25], [1, 1]]})");
  const double at = 32768 / 65535.0;
  const Eigen::Vector3d of_others = ReadPhotograph(At("a.png")).linear.Rgb(0, 0);
  EXPECT_NEAR(of_others[0], 0.25, 1e-4);
  const Eigen::Vector3d rgb = ReadPhotograph(At("b.png")).linear.Rgb(0, 0);
  EXPECT_NEAR(rgb[0], at, 1e-6);
  EXPECT_NEAR(rgb[1], 0.1, 1e-4);
  EXPECT_NEAR(rgb[2], 0.9, 1e-4);
}

// The curve counts from what the picture shows, whatever its space.
TEST_F(Response, FollowsAProfile) {
  WriteMade<uint16_t>(At("a.tif"), 1, 3, {32768, 32768, 32768}, MadeProfile(kRec709, {1}));
  State(R"({"all": [[0, 0], [1, 1]]})");
  EXPECT_NEAR(ReadPhotograph(At("a.tif")).linear.Rgb(0, 0)[1], SrgbFromLinear(0.5), 1e-3);
}

TEST_F(Response, LeavesNumbersAlone) {
  WriteMade<float>(At("a.exr"), 1, 3, {0.5f, 0.5f, 0.5f});
  State(R"({"all": [[0, 0], [0.5, 0.1], [1, 1]]})");
  EXPECT_EQ(ReadPhotograph(At("a.exr")).linear.Rgb(0, 0)[0], 0.5);
}

// What it does to light is undone in what is delivered.
TEST_F(Response, IsInvertedInTheMontage) {
  const std::vector<uint8_t> codes = ManyColors<uint8_t>(64 * 48);
  for (const bool has_profile : {false, true}) {
    WriteMade(At("a.png"), 64, 3, codes, has_profile ? MadeProfile(kDisplayP3, {2.2}) : "");
    State(R"({"red": [[0, 0], [0.3, 0.02], [0.7, 0.6], [1, 1]], "green": [[0, 0], [0.5, 0.1],
              [1, 1]], "blue": [[0, 0], [0.4, 0.2], [1, 1]]})");
    Photograph photo = ReadPhotograph(At("a.png"));
    Raster picture = photo.linear;
    // All is computed anew, but comes out as it was.
    for (float& value : picture.data) value = std::nextafter(value, 2.0f);
    WriteMontageFiles(At("out"), {std::move(picture), std::move(photo), At("a.png"), true, {}});
    const auto written = std::get<std::vector<uint8_t>>(ReadCodedPhotograph(At("out.png")).samples);
    EXPECT_EQ(written, codes) << has_profile;
  }
}

TEST_F(Response, AtFaultIsNamedByItsLine) {
  WriteMade<uint8_t>(At("a.png"), 1, 3, {1, 2, 3});
  const std::string file = At("response.json").string();
  EXPECT_TRUE(
      Fault(R"({"all": [[0, 0], [0.6, 0.5], [0.5, 0.6], [1, 1]]})").starts_with(file + ":2: "));
  EXPECT_TRUE(Fault(R"({"all": [[0, 0], [0.5, 0.6], [1, 0.6]]})").starts_with(file + ":2: "));
  EXPECT_TRUE(Fault(R"({"all": [[0, 0.1], [1, 1]]})").starts_with(file + ":2: "));
  EXPECT_TRUE(Fault(R"({"all": [[0, 0], [0.9, 1]]})").starts_with(file + ":2: "));
  EXPECT_TRUE(Fault(R"({"red": [[0, 0], [1, 1]]})").starts_with(file + ":2: "));
}

}  // namespace
}  // namespace insitu
