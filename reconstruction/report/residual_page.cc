// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/residual_page.h"

#include "calibration/program/report_page.h"
#include "reconstruction/report/large_report.h"
#include "reconstruction/report/residual_page_script.h"

namespace insitu {

std::string ResidualPage(const Json::Value& report) {
  return ReportPage("Residual report", ForPage(report), kResidualPageScript);
}

}  // namespace insitu
