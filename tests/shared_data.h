// SPDX-License-Identifier: GPL-3.0-or-later
// The data sets that are no part of this repository: INSITU_SHARED names their folder, else
// ../shared beside it is tried, as in tests/end_to_end.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace insitu {

inline std::filesystem::path SharedData(const std::string& name) {
  const char* shared = std::getenv("INSITU_SHARED");
  const std::filesystem::path beside = std::filesystem::path(INSITU_SOURCE_FOLDER) / "../shared";
  return (shared ? std::filesystem::path(shared) : beside) / "data" / name;
}

}  // namespace insitu

// In a test's body: `folder` becomes the data set's, or the test is skipped with a word.
#define INSITU_SHARED_DATA_OR_SKIP(folder, name)                                      \
  const ::std::filesystem::path folder = ::insitu::SharedData(name);                  \
  if (!std::filesystem::exists(folder)) {                                             \
    GTEST_SKIP() << "SKIPPED: no shared data " << folder.lexically_normal().string(); \
  }
