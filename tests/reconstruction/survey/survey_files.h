// SPDX-License-Identifier: GPL-3.0-or-later
// The synthetic town's survey in a folder of its own, for tests to spoil.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "reconstruction/survey/read_survey.h"
#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {

class SurveyFiles : public testing::Test {
 protected:
  SurveyFiles() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    site_.root = std::filesystem::path(testing::TempDir()) / "survey_files" / test->name();
    std::filesystem::remove_all(site_.root);
    WriteSurvey(site_, network_.survey);
  }

  // Puts `text` into a file in place of one of its lines, counted from 1.
  void ReplaceLine(const std::string& file, int line, const std::string& text) const {
    const std::string content = ReadWhole(site_.survey() / file);
    size_t begin = 0;
    for (int i = 1; i < line; ++i) begin = content.find('\n', begin) + 1;
    const size_t end = content.find('\n', begin);
    WriteWhole(site_.survey() / file, content.substr(0, begin) + text + content.substr(end));
  }

  // The message must begin with the file and line and name what is at fault.
  void ExpectError(const std::string& file, int line, const std::string& subject) const {
    try {
      ReadSurvey(site_, network_.photos);
      ADD_FAILURE() << "expected an error about " << subject;
    } catch (const InputError& error) {
      const std::string message = error.what();
      const std::string place = (site_.survey() / file).string() + ":" + std::to_string(line) + ":";
      EXPECT_EQ(message.substr(0, place.size()), place) << message;
      EXPECT_NE(message.find(subject), std::string::npos) << message;
    }
  }

  SitePaths site_;
  SyntheticNetwork network_ = MakeSyntheticNetwork();
};

}  // namespace insitu
