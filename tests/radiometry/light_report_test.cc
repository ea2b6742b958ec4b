// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light_report.h"

#include <gtest/gtest.h>

#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "tests/radiometry/measure/synthetic_site.h"

namespace insitu {
namespace {

TEST(WriteEnvironment, SameInputSameBytes) {
  const SyntheticSite truth = MakeSyntheticSite("bytes");
  WriteEnvironment(truth.site, MeasureDaylight(truth.site));
  const std::string first = ReadWhole(truth.site.environment());
  WriteEnvironment(truth.site, MeasureDaylight(truth.site));
  EXPECT_EQ(ReadWhole(truth.site.environment()), first);
}

// The paper's weights are of the whole spectrum, ours of each wavelength: as bright are both.
TEST(WriteEnvironment, TellsThePapersWeights) {
  const SyntheticSite truth = MakeSyntheticSite("weights");
  LightOptions options;
  options.average_over_wavelength = true;
  WriteEnvironment(truth.site, MeasureDaylight(truth.site, options));
  const JsonNode light = JsonNode::Load(truth.site.environment()).At("light");
  const std::vector<double> sky = light.At("sky_radiance").Numbers(),
                            spectrum = light.At("relative_spectrum").Numbers();
  ASSERT_EQ(sky.size(), spectrum.size());
  for (size_t i = 0; i < sky.size(); ++i) {
    EXPECT_NEAR(sky[i], light.At("k_h").Number() * spectrum[i], 1e-12) << i;
  }
}

TEST(BriefReport, SaysWhatWasFound) {
  const SyntheticSite truth = MakeSyntheticSite("report");
  const std::string report = BriefReport(MeasureDaylight(truth.site));
  EXPECT_NE(report.find("over 200 m, 6 samples"), std::string::npos) << report;
  EXPECT_NE(report.find("uniform, gradation 0 +- 0.0"), std::string::npos) << report;
  EXPECT_NE(report.find("in 2 photographs"), std::string::npos) << report;
  EXPECT_NE(report.find("A: too few sharp, straight edges"), std::string::npos) << report;
}

}  // namespace
}  // namespace insitu
