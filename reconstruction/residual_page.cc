// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/report_page.h"
#include "reconstruction/residual_page_script.h"
#include "reconstruction/residual_report.h"

namespace insitu {

std::string ResidualPage(const Json::Value& report) {
  return ReportPage("Residual report", report, kResidualPageScript);
}

}  // namespace insitu
