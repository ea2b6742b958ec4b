// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/photo_thumbnail.h"

#include "calibration/photo/photograph.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

TEST(PhotoThumbnail, IsASmallJpegAsADataUri) {
  ScratchFolder folder;
  Raster raster(64, 48);
  for (float& value : raster.data) value = 0.5f;
  WritePng(folder.path() / "a.png", raster, Encoding::kSrgb8);
  const auto thumbnail = PhotoThumbnail(folder.path() / "a.png", 16);
  ASSERT_TRUE(thumbnail);
  // In base64 the bytes ff d8 ff, with which every JPEG begins.
  EXPECT_EQ(thumbnail->substr(0, 27), "data:image/jpeg;base64,/9j/");
  EXPECT_EQ((thumbnail->size() - 23) % 4, 0u);
  EXPECT_EQ(*thumbnail, *PhotoThumbnail(folder.path() / "a.png", 16));
}

// OpenCV reads only some TIFF, and complains of the others on the terminal.
TEST(PhotoThumbnail, ATiffHasThatOfAPng) {
  ScratchFolder folder;
  Raster raster(64, 48);
  for (size_t i = 0; i < raster.data.size(); ++i) raster.data[i] = float(i % 7) / 7;
  WritePng(folder.path() / "a.png", raster, Encoding::kSrgb8);
  WriteCodes(folder.path() / "a.tif", CodesOf(raster, Encoding::kSrgb8, {}));
  EXPECT_EQ(PhotoThumbnail(folder.path() / "a.tif", 64),
            PhotoThumbnail(folder.path() / "a.png", 64));
  WriteCodes(folder.path() / "b.tif", CodesOf(raster, Encoding::kLinear, {}));
  EXPECT_TRUE(PhotoThumbnail(folder.path() / "b.tif", 16));
}

TEST(PhotoThumbnail, ExrHasNone) {
  ScratchFolder folder;
  WriteExr(folder.path() / "a.exr", Raster(64, 48));
  EXPECT_FALSE(PhotoThumbnail(folder.path() / "a.exr"));
}

TEST(PhotoThumbnail, RefusesWhatIsNoPhotograph) {
  ScratchFolder folder;
  const auto path = folder.Write("a.jpg", "no picture");
  EXPECT_EQ(InputErrorOf([&] { PhotoThumbnail(path); }).find(path.string()), 0u);
}

}  // namespace
}  // namespace insitu
