// SPDX-License-Identifier: GPL-3.0-or-later
// The figures on the shared data, held to what the other programs print. Roma's time is no test.
#include "tests/benchmarks/reconstruction_figures.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/shared_data.h"

namespace insitu {
namespace {

// null: the data is not there, and the test is skipped with a word.
Json::Value Measure(const std::string& key) {
  const std::filesystem::path data = SharedData("");
  for (const ReconstructionFigure& figure : ReconstructionFigures()) {
    if (figure.key != key || !std::filesystem::exists(data / figure.folder)) continue;
    static std::map<std::string, Json::Value> measured;
    const auto [entry, is_new] = measured.try_emplace(key);
    if (is_new) entry->second = figure.measure(data);
    return entry->second;
  }
  return {};
}

TEST(ReconstructionFigures, AiconsReportIsReproduced) {
  const Json::Value figures = Measure("jaicov_aicon");
  if (figures.isNull()) GTEST_SKIP() << "SKIPPED: no shared data";
  EXPECT_NEAR(figures["s0_mm"].asDouble(), 0.000405, 0.0000005);
  EXPECT_EQ(figures["redundancy"].asInt(), 18804);
  EXPECT_EQ(figures["unknowns"].asInt(), 1147);
  EXPECT_EQ(figures["compared_observations"].asInt(), 19944);
  EXPECT_LE(figures["max_redundancy_number_difference"].asDouble(), 0.00501);
  EXPECT_LE(figures["max_w_test_difference"].asDouble(), 0.00501);
  EXPECT_LE(figures["max_point_difference_mm"].asDouble(), 0.0001);
  EXPECT_LE(figures["max_point_sigma_difference_mm"].asDouble(), 0.0000501);
  EXPECT_LE(figures["max_lens_difference_in_sigma"].asDouble(),
            0.02);  // half of the last digit of c
  EXPECT_LE(figures["max_relative_lens_sigma_difference"].asDouble(), 1e-6);
}

TEST(ReconstructionFigures, DbatsSelfCalibrationIsReproduced) {
  const Json::Value figures = Measure("dbat_camcal");
  if (figures.isNull()) GTEST_SKIP() << "SKIPPED: no shared data";
  EXPECT_NEAR(figures["sigma0"].asDouble(), 1.6148, 0.00005);
  EXPECT_EQ(figures["redundancy"].asInt(), 3725);
  EXPECT_LE(figures["max_parameter_difference_in_sigma"].asDouble(), 0.05);
  EXPECT_LE(figures["max_relative_sigma_difference"].asDouble(), 0.005);
}

TEST(ReconstructionFigures, DbatsControlVariantsAreReproduced) {
  const Json::Value figures = Measure("dbat_camcal");
  if (figures.isNull()) GTEST_SKIP() << "SKIPPED: no shared data";
  EXPECT_NEAR(figures["fixed_control"]["sigma0"].asDouble(), 1.78095, 0.000005);
  EXPECT_NEAR(figures["weighted_control"]["sigma0"].asDouble(), 1.60984, 0.000005);
  for (const char* variant : {"fixed_control", "weighted_control"}) {
    EXPECT_EQ(figures[variant]["redundancy"].asInt(), 3734);
    EXPECT_LE(figures[variant]["max_center_difference_mm"].asDouble(), 0.003);
    EXPECT_LE(figures[variant]["max_relative_center_sigma_difference"].asDouble(), 0.005);
  }
}

TEST(ReconstructionFigures, DbatsAerialBlockIsReproduced) {
  const Json::Value figures = Measure("sxb_aerial");
  if (figures.isNull()) GTEST_SKIP() << "SKIPPED: no shared data";
  EXPECT_NEAR(figures["sigma0"].asDouble(), 1.1786, 0.00005);
  EXPECT_NEAR(figures["sigma0_px"].asDouble(), 0.589299, 0.0000005);
  EXPECT_EQ(figures["redundancy"].asInt(), 1261);
  EXPECT_NEAR(figures["control_rms_m"].asDouble(), 0.035, 0.0005);
  EXPECT_NEAR(figures["check_rms_m"].asDouble(), 0.421, 0.0005);
}

TEST(ReconstructionFigures, DbatsArchIsReproduced) {
  if (!std::filesystem::exists(SharedData("adjustment/roma_arch"))) {
    GTEST_SKIP() << "SKIPPED: no shared data";
  }
  const Json::Value figures = RomaAccuracy(SharedData(""));
  EXPECT_NEAR(figures["sigma0_px_self_calibration"].asDouble(), 0.582769, 0.0000005);
  EXPECT_EQ(figures["redundancy"].asInt(), 101801);
  EXPECT_NEAR(figures["parameters"]["c"]["value"].asDouble(), 24.5425003, 0.0000005);
  EXPECT_NEAR(figures["parameters"]["xp"]["value"].asDouble(), 18.0816295, 0.0000005);
  EXPECT_NEAR(figures["parameters"]["yp"]["value"].asDouble(), -12.0164476, 0.0000005);
  EXPECT_NEAR(figures["sigma0_px_fixed"].asDouble(), 0.623075, 0.0000005);
  EXPECT_EQ(figures["redundancy_fixed"].asInt(), 101806);
}

TEST(ReconstructionFigures, MicmacsPairsAreReproduced) {
  const Json::Value figures = Measure("micmac_stonewall_gcp");
  if (figures.isNull()) GTEST_SKIP() << "SKIPPED: no shared data";
  ASSERT_EQ(figures["photos"].size(), 4u);
  for (const Json::Value& photo : figures["photos"]) {
    EXPECT_EQ(photo["pairs"].asInt(), 10);
    EXPECT_LE(photo["rms_px"].asDouble(), 0.001);  // the tolerance that MicMac states
    EXPECT_LE(photo["center_difference_m"].asDouble(), 1e-6);
    EXPECT_LE(photo["rotation_difference_rad"].asDouble(), 1e-6);
  }
}

TEST(ReconstructionFigures, BerlinIsPlacedFromPhotographsAlone) {
  const Json::Value figures = Measure("opensfm_berlin_cathedral");
  if (figures.isNull()) GTEST_SKIP() << "SKIPPED: no shared data";
  EXPECT_EQ(figures["placed"], figures["photos"]);
  EXPECT_EQ(figures["datum_defect"].asInt(), 0);  // their EXIF states where they were taken
  EXPECT_TRUE(figures["has_report"].asBool());
}

TEST(ReconstructionFigures, GalleryIsWithinItsSigmas) {
  const Json::Value figures = Measure("gallery");
  if (figures.isNull()) GTEST_SKIP() << "SKIPPED: no shared data";
  EXPECT_LE(figures["check_rms_over_sigma"].asDouble(), 1.2);
  EXPECT_LE(figures["sun_chi_square"].asDouble(), figures["chi_square_95"].asDouble());
  EXPECT_LE(figures["zenith_chi_square"].asDouble(), figures["chi_square_95"].asDouble());
}

}  // namespace
}  // namespace insitu
