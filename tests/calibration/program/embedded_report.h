// SPDX-License-Identifier: GPL-3.0-or-later
// The report that a page holds, read back.
#pragma once

#include <gtest/gtest.h>
#include <json/reader.h>

#include <sstream>
#include <string>

namespace insitu {

inline Json::Value Embedded(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"report\">";
  const size_t begin = page.find(open) + open.size();
  std::istringstream text(page.substr(begin, page.find("</script>", begin) - begin));
  Json::Value json;
  std::string errors;
  EXPECT_TRUE(Json::parseFromStream(Json::CharReaderBuilder(), text, &json, &errors)) << errors;
  return json;
}

}  // namespace insitu
