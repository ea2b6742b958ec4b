// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/distinct_photographs.h"

#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

class DistinctPhotographs : public testing::Test {
 protected:
  DistinctPhotographs() { std::filesystem::remove_all(folder_); }

  std::filesystem::path Photograph(const std::string& name, const std::string& content) const {
    WriteWhole(folder_ / name, content);
    return folder_ / name;
  }

  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / "distinct_photographs";
};

TEST_F(DistinctPhotographs, MayBeOfOneSize) {
  EXPECT_NO_THROW(RequireDistinctPhotographs(
      {Photograph("a.jpg", "one"), Photograph("b.jpg", "two"), Photograph("c.jpg", "three")}));
}

TEST_F(DistinctPhotographs, AreNotOneFileTwice) {
  try {
    RequireDistinctPhotographs(
        {Photograph("a.jpg", "one"), Photograph("b.jpg", "two"), Photograph("c.jpg", "one")});
    FAIL();
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find((folder_ / "c.jpg").string() + ": is the same photograph as 'a.jpg'"),
              0u)
        << message;
  }
}

TEST_F(DistinctPhotographs, MustBeThere) {
  EXPECT_THROW(RequireDistinctPhotographs({folder_ / "missing.jpg"}), InputError);
}

}  // namespace
}  // namespace insitu
