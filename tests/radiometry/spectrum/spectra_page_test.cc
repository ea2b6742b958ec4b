// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/spectrum/spectra_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/files/error.h"

namespace insitu {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> Numbers(const Json::Value& list) {
  std::vector<double> numbers;
  for (const Json::Value& value : list) numbers.push_back(value.asDouble());
  return numbers;
}

// The sum of a spectrum's bins times the observer, written out here.
Eigen::Vector3d TristimulusOf(const Json::Value& spectrum, const SpectralBins& bins) {
  const auto matching = ColorMatching(bins);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < bins.count; ++i) sum += spectrum[i].asDouble() * matching.col(i);
  return sum / matching.row(1).sum();
}

TEST(SpectraReport, MetamersDifferAndLookAlike) {
  for (const int count : {9, 16}) {
    SpectraRequest request;
    request.bins = count;
    const Json::Value report = SpectraReport(request);
    const std::vector<double> xyz = Numbers(report["color"]["xyz"]);
    ASSERT_EQ(report["metamers"].size(), 4U);
    for (const Json::Value& metamer : report["metamers"]) {
      const Eigen::Vector3d seen = TristimulusOf(metamer["spectrum"], {count});
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(seen[i], xyz[i], 1e-12) << metamer["space"].asString();
    }
    EXPECT_NE(report["metamers"][0]["spectrum"], report["metamers"][1]["spectrum"]);
    EXPECT_THAT(Numbers(report["metamers"][1]["rgb"]),
                ElementsAre(testing::DoubleNear(0.8, 1e-12), testing::DoubleNear(0.5, 1e-12),
                            testing::DoubleNear(0.2, 1e-12)));
  }
}

// What rgb_to_spectrum.h says of the spaces: Rec. 709's three are solutions, of NTSC's red there is
// none; a solution has the primary's colour, a box need not.
TEST(SpectraReport, BothBranchesOfTheSearch) {
  const Json::Value report = SpectraReport({});
  const auto is_exact = [&](int space, int primary) {
    return !report["spaces"][space]["bases"][primary]["exact"].isNull();
  };
  EXPECT_FALSE(is_exact(0, 0));
  for (int primary = 0; primary < 3; ++primary) EXPECT_TRUE(is_exact(1, primary));
  for (const Json::Value& space : report["spaces"]) {
    for (const Json::Value& basis : space["bases"]) {
      if (!basis["exact"].isNull()) {
        EXPECT_LT(basis["exact"]["off"].asDouble(), 1e-12);
      }
      EXPECT_GT(basis["box"]["off"].asDouble(), 1e-4);
    }
  }
  EXPECT_GE(report["spaces"][1]["round_trip"]["lowest"].asDouble(), -1e-12);
  EXPECT_LT(report["spaces"][0]["round_trip"]["lowest"].asDouble(), 0);
  EXPECT_LT(report["spaces"][0]["round_trip"]["worst"].asDouble(), 1e-14);
}

TEST(SpectraReport, BriefNamesEveryPrimary) {
  const std::string brief = BriefSpectra(SpectraReport({}));
  EXPECT_THAT(brief, HasSubstr("NTSC 1953\n  red    nearest box 605 nm, 630 nm"));
  EXPECT_THAT(brief, HasSubstr("Rec. 709 (sRGB)\n  red    exact"));
}

TEST(SpectraRequest, RefusesWhatIsNoColour) {
  SpectraRequest request;
  request.rgb = {0.5, 1.1, 0};
  EXPECT_THROW(request.Check(), InputError);
  request.rgb = {0, 0, 0};
  EXPECT_THROW(request.Check(), InputError);
  request.rgb = {0, 0, 1};
  EXPECT_NO_THROW(request.Check());
  request.space = "cmyk";
  EXPECT_THROW(request.Check(), InputError);
}

}  // namespace
}  // namespace insitu
