// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/site.h"

#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

TEST(HasPhotographEnding, IsThatOfAFormatThatIsRead) {
  for (const char* name : {"a.jpg", "a.JPG", "a.jpeg", "a.png", "a.tif", "a.tiff", "a.exr"}) {
    EXPECT_TRUE(HasPhotographEnding(name)) << name;
  }
  for (const char* name : {"a.dng", "a.csv", "jpg", "a.jpg.txt", ""}) {
    EXPECT_FALSE(HasPhotographEnding(name)) << name;
  }
}

TEST(IsPhotograph, IsAFileThatIsThereAndNotHidden) {
  const ScratchFolder folder;
  EXPECT_TRUE(IsPhotograph(folder.Write("a.jpg", "")));
  EXPECT_FALSE(IsPhotograph(folder.Write(".a.jpg", "")));
  EXPECT_FALSE(IsPhotograph(folder.path() / "b.jpg"));
  std::filesystem::create_directory(folder.path() / "c.jpg");
  EXPECT_FALSE(IsPhotograph(folder.path() / "c.jpg"));
}

}  // namespace
}  // namespace insitu
