// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/report_page.h"

#include "tests/calibration/program/embedded_report.h"

namespace insitu {
namespace {

size_t Count(const std::string& text, const std::string& what) {
  size_t count = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(ReportPage, HoldsItsReportAndItsScript) {
  Json::Value report;
  report["name"] = "Dachfirst <Süd> & \"Ost\" 例";
  report["value"] = 0.1;
  const std::string page = ReportPage("Report of <a> & b", report, "show(report);");
  EXPECT_EQ(Embedded(page), report);
  EXPECT_NE(page.find("<title>Report of &lt;a&gt; &amp; b</title>"), std::string::npos);
  EXPECT_NE(page.find("<script>show(report);</script>"), std::string::npos);
}

TEST(ReportPage, DoesNotLetANameEndItsScript) {
  Json::Value report;
  report["name"] = "</script><script>alert(1)</script><!--";
  const std::string page = ReportPage("", report, "");
  EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
  EXPECT_EQ(Count(page, "</script>"), 5u);  // data, d3, Plot, page.js, script
  EXPECT_EQ(Embedded(page), report);
}

TEST(ReportPage, RefersToNothingOutside) {
  const std::string page = ReportPage("title", Json::Value(), "");
  EXPECT_NE(page.find("content=\"default-src 'none'; "), std::string::npos);
  for (const std::string reference : {"<link", "<img", "<iframe", " src=", "@import", "url(http"}) {
    EXPECT_EQ(Count(page, reference), 0u) << reference;
  }
}

}  // namespace
}  // namespace insitu
