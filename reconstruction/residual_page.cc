// SPDX-License-Identifier: GPL-3.0-or-later
#include <json/writer.h>

#include "calibration/error.h"
#include "reconstruction/report_page_template.h"
#include "reconstruction/residual_report.h"

namespace insitu {

std::string ResidualPage(const Json::Value& report) {
  Json::StreamWriterBuilder writer;
  writer["indentation"] = "";
  std::string data;
  // A name must not end the script element that holds the data.
  for (const char c : Json::writeString(writer, report)) {
    if (c == '<') {
      data += "\\u003c";
    } else {
      data += c;
    }
  }
  const std::string mark = "REPORT_JSON";
  std::string page = kReportPage;
  const size_t position = page.find(mark);
  INSITU_CHECK(position != std::string::npos);
  return page.replace(position, mark.size(), data);
}

}  // namespace insitu
