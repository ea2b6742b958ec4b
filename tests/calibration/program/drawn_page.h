// SPDX-License-Identifier: GPL-3.0-or-later
// What a browser makes of a report's page: its elements after the script has run.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "calibration/files/whole_file.h"

namespace insitu {

// In Debian's Chromium; a failure of the test where it is missing.
inline std::string Drawn(const std::string& page) {
  EXPECT_EQ(std::system("command -v chromium >/dev/null"), 0) << "Debian package chromium";
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const auto path =
      std::filesystem::path(testing::TempDir()) / (std::string(test->name()) + ".html");
  WriteWhole(path, page);
  const std::string command =
      "timeout 60 chromium --headless --no-sandbox --disable-gpu --dump-dom 'file://" +
      path.string() + "' 2>/dev/null";
  FILE* pipe = popen(command.c_str(), "r");
  std::string dom;
  char buffer[4096];
  while (const size_t count = fread(buffer, 1, sizeof buffer, pipe)) dom.append(buffer, count);
  pclose(pipe);
  return dom;
}

}  // namespace insitu
