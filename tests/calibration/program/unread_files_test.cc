// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/unread_files.h"

#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

TEST(UnreadFiles, AreToldByNameWithRemedy) {
  const ScratchFolder folder;
  const SitePaths site{folder.path()};
  for (const char* name :
       {"photos/a.jpg", "photos/b.JPE", "photos/c.HEIC", "photos/a.cr2", "photos/b.CR2",
        "photos/d.nef", "photos/.f.heic", "photos/notes.txt", "calibration/board_1.jpg",
        "calibration/board.txt", "calibration/wide/IMG_1.jpg", "calibration/wide/IMG_2.jpg",
        "calibration/wide/IMG_3.jpg"}) {
    folder.Write(name, "");
  }
  const std::string photos = site.photos().string(), wide = (site.boards() / "wide").string();
  EXPECT_EQ(
      UnreadFiles(site),
      (std::vector<std::string>{
          photos + "/a.cr2 and 1 other .cr2 file are not read beside the picture of the same "
                   "name; to measure light in the raw, move the picture away and mark its points "
                   "on the raw",
          photos + "/c.HEIC is not read, expected JPEG, PNG, TIFF, EXR or raw; export it as JPEG "
                   "or TIFF in full size",
          wide + "/IMG_1.jpg and 2 other picture files are not named board_*, so not read; "
                 "name photographs of the board board_1.jpg, board_2.jpg and so on"}));
}

TEST(UnreadFiles, OfAnEmptySiteAreNone) {
  const ScratchFolder folder;
  EXPECT_TRUE(UnreadFiles({folder.path()}).empty());
}

TEST(HasPhotographEnding, RawIsAPhotograph) {
  EXPECT_TRUE(HasPhotographEnding("IMG_1.DNG"));
  EXPECT_FALSE(HasPhotographEnding("IMG_1.xmp"));
}

TEST(HasPhotographEnding, JpeIsAJpeg) { EXPECT_TRUE(HasPhotographEnding("IMG_1.JPE")); }

}  // namespace
}  // namespace insitu
