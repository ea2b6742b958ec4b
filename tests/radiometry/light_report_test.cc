// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light_report.h"

#include <gtest/gtest.h>

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

TEST(BriefReport, SaysWhatWasFound) {
  const SyntheticSite truth = MakeSyntheticSite("report");
  const std::string report = BriefReport(MeasureDaylight(truth.site));
  EXPECT_NE(report.find("over 200 m, 6 samples"), std::string::npos) << report;
}

}  // namespace
}  // namespace insitu
