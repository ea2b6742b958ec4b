// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/site_lock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

TEST(SiteLock, ASecondRunIsToldWhoHoldsTheSite) {
  const ScratchFolder folder;
  const SitePaths site = {folder.path()};
  const SiteLock first(site, "insitu-montage SITE --frame photo");
  EXPECT_THAT(InputErrorOf([&] { const SiteLock second(site, "insitu-montage SITE"); }),
              testing::AllOf(
                  testing::StartsWith(folder.path().string() + ": is in use by insitu-montage SITE "
                                                               "--frame photo (process "),
                  testing::HasSubstr(std::to_string(getpid()) + " on ")));
}

TEST(SiteLock, OfAnotherFileGoesTogetherWithARun) {
  const ScratchFolder folder;
  const SitePaths site = {folder.path()};
  const SiteLock run(site, "insitu-montage SITE");
  const SiteLock editor(site, "insitu-prepare", folder.path() / "work/prepare/.lock");
  EXPECT_THAT(InputErrorOf([&] {
                const SiteLock second(site, "insitu-prepare", folder.path() / "work/prepare/.lock");
              }),
              testing::HasSubstr("in use by insitu-prepare (process "));
}

TEST(SiteLock, IsGoneWithItsProcess) {
  const ScratchFolder folder;
  const SitePaths site = {folder.path()};
  const pid_t child = fork();
  if (child == 0) {
    const SiteLock lock(site, "a run that is killed");
    _exit(0);  // no destructor
  }
  waitpid(child, nullptr, 0);
  EXPECT_NO_THROW(SiteLock(site, "the next run"));
}

TEST(SiteLock, SaysWhereNothingCanBeWritten) {
  const ScratchFolder folder;
  const SitePaths site = {folder.Write("site", "a file, no folder")};
  EXPECT_THAT(InputErrorOf([&] { const SiteLock lock(site, "insitu-montage"); }),
              testing::HasSubstr("work: cannot be written (Not a directory)"));
}

}  // namespace
}  // namespace insitu
