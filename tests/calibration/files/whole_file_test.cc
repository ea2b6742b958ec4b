// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/whole_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>

#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

int FilesIn(const std::filesystem::path& folder) {
  return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(WholeFile, ReturnsWhatWasWritten) {
  const ScratchFolder folder;
  const std::string content("a\0b\r\n", 5);
  WriteWhole(folder.path() / "new/deep/a.bin", content);
  EXPECT_EQ(ReadWhole(folder.path() / "new/deep/a.bin"), content);
  EXPECT_EQ(FilesIn(folder.path() / "new/deep"), 1);
}

TEST(WholeFile, FailureLeavesTheOldFileAndNothingElse) {
  const ScratchFolder folder;
  const auto target = folder.Write("a.txt", "old");
  const auto fail = [](const std::filesystem::path& temporary) {
    std::ofstream(temporary) << "half";
    throw std::runtime_error("full");
  };
  EXPECT_THROW(WriteWhole(target, fail), std::runtime_error);
  EXPECT_EQ(ReadWhole(target), "old");
  EXPECT_EQ(FilesIn(folder.path()), 1);
}

TEST(WholeFile, TemporaryStandsBesideWithTheSameEnding) {
  const ScratchFolder folder;
  std::filesystem::path seen;
  WriteWhole(folder.path() / "a.cameramodel", [&](const std::filesystem::path& temporary) {
    seen = temporary;
    std::ofstream(temporary) << "x";
  });
  EXPECT_EQ(seen.parent_path(), folder.path());
  EXPECT_EQ(seen.extension(), ".cameramodel");
}

TEST(RemoveLeftovers, TakesOnlyWhatADeadProcessLeft) {
  const ScratchFolder folder;
  const pid_t dead = fork();
  if (dead == 0) _exit(0);
  waitpid(dead, nullptr, 0);
  const auto left = folder.Write("work/.a." + std::to_string(dead) + ".exr", "half");
  folder.Write("work/.a." + std::to_string(getpid()) + ".exr", "being written");
  folder.Write("work/a.1234.exr", "not hidden");
  folder.Write("work/.hidden.txt", "not numbered");
  EXPECT_THAT(RemoveLeftovers(folder.path()), testing::ElementsAre(left));
  EXPECT_EQ(FilesIn(folder.path() / "work"), 3);
}

TEST(WholeFile, UnreadableIsAnInputError) {
  const ScratchFolder folder;
  EXPECT_EQ(InputErrorOf([&] { ReadWhole(folder.path()); }),
            folder.path().string() + ": cannot be read");
}

}  // namespace
}  // namespace insitu
