// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/report_page.h"

#include <json/writer.h>

#include "calibration/program/html_text.h"
#include "calibration/program/report_page_parts.h"

namespace insitu {
namespace {

std::string Replaced(std::string_view text, char what, std::string_view by) {
  std::string result;
  for (const char c : text) {
    if (c == what) {
      result += by;
    } else {
      result += c;
    }
  }
  return result;
}

std::string Script(std::string_view content) {
  return "<script>" + std::string(content) + "</script>\n";
}

// In a JSON string \u003c is '<'; so no name ends the script element that holds the data.
std::string Data(const Json::Value& report) {
  Json::StreamWriterBuilder writer;
  writer["indentation"] = "";
  writer["emitUTF8"] = true;
  // A condensed report is rounded: digits behind that would only make the page large.
  if (report.isMember("page_note")) writer["precision"] = 12;
  return Replaced(Json::writeString(writer, report), '<', "\\u003c");
}

}  // namespace

std::string ReportPage(const std::string& title, const Json::Value& report,
                       std::string_view script) {
  const std::string escaped = HtmlText(title);
  return kPageHead + ("<title>" + escaped + "</title>\n<style>\n") + kPageStyle +
         "</style>\n</head>\n<body>\n<h1>" + escaped +
         "</h1>\n<noscript>This page builds its tables and plots with JavaScript from the JSON "
         "that "
         "it contains.</noscript>\n<script type=\"application/json\" id=\"report\">" +
         Data(report) + "</script>\n" + Script(kD3) + Script(kPlot) + Script(kPageScript) +
         Script(script) + "</body>\n</html>\n";
}

}  // namespace insitu
