// SPDX-License-Identifier: GPL-3.0-or-later
// Small files that a test writes and reads back, in a folder of its own.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"

namespace insitu {

class TextFiles : public testing::Test {
 protected:
  TextFiles() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / ("insitu_" + std::to_string(getpid())) /
              test->test_suite_name() / test->name();
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~TextFiles() override { std::filesystem::remove_all(folder_.parent_path().parent_path()); }

  std::filesystem::path Write(const std::string& name, const std::string& content) const {
    WriteWhole(folder_ / name, content);
    return folder_ / name;
  }

  // Calling must throw InputError of that file and line (0: of the file), naming the subject.
  template <typename Call>
  void ExpectError(const Call& call, const std::string& file, int line,
                   const std::string& subject) const {
    try {
      call();
      ADD_FAILURE() << "expected an error about " << subject;
    } catch (const InputError& error) {
      const std::string message = error.what();
      const std::filesystem::path path = file.empty() ? folder_ : folder_ / file;
      const std::string place = path.string() + ":" + (line > 0 ? std::to_string(line) + ":" : " ");
      EXPECT_TRUE(message.starts_with(place)) << message << "\nexpected at " << place;
      EXPECT_NE(message.find(subject), std::string::npos) << message;
    }
  }

  // Every beginning of a file is read, or refused with an InputError; nothing else may happen.
  template <typename Read>
  void ExpectNoHarmWhenCut(const std::string& name, const std::string& content,
                           const Read& read) const {
    for (size_t length = 0; length < content.size(); ++length) {
      const std::filesystem::path path = Write(name, content.substr(0, length));
      try {
        read(path);
      } catch (const InputError&) {
      }
    }
    for (const std::string& garbage : {std::string("\x01\x02\xff\xfe garbage \x80"),
                                       std::string("\0\0\0\0", 4), std::string("p 1e999 2 3")}) {
      EXPECT_THROW(read(Write(name, garbage)), InputError);
    }
    Write(name, content);
  }

  std::filesystem::path folder_;
};

}  // namespace insitu
