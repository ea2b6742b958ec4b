// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/raw_photograph.h"

#include <exiv2/exiv2.hpp>

#include "calibration/files/whole_file.h"
#include "calibration/photo/exif.h"
#include "calibration/photo/montage_files.h"
#include "calibration/photo/photo_thumbnail.h"
#include "calibration/photo/photograph.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/calibration/photo/made_raw.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

// Grey on the left, a strong green on the right.
Eigen::Vector3d TwoColors(int x, int) {
  return x < 32 ? Eigen::Vector3d(0.25, 0.25, 0.25) : Eigen::Vector3d(0.05, 0.3, 0.1);
}

class ReadRaw : public testing::Test {
 protected:
  fs::path Write(const std::string& name, const MadeRaw& raw) const {
    const fs::path path = folder_.path() / name;
    WriteMadeRaw(path, raw);
    return path;
  }

  ScratchFolder folder_;
};

void ExpectNear(const Eigen::Vector3d& value, const Eigen::Vector3d& expected, double bound) {
  EXPECT_LT((value - expected).cwiseAbs().maxCoeff(), bound) << value.transpose();
}

TEST_F(ReadRaw, IsLinearRec709OfTheScene) {
  const Photograph photo = ReadPhotograph(Write("a.DNG", {.scene = TwoColors}));
  EXPECT_EQ(photo.linear.width, 64);
  EXPECT_EQ(photo.linear.height, 48);
  ExpectNear(photo.linear.Rgb(10, 20), TwoColors(10, 20), 3e-4);
  ExpectNear(photo.linear.Rgb(50, 21), TwoColors(50, 21), 3e-4);
  EXPECT_EQ(photo.color.name, "raw, balanced for daylight (D65)");
  EXPECT_EQ(photo.encoding, Encoding::kSrgb16);
}

// No brightness of its own choosing, though nothing in it is bright.
TEST_F(ReadRaw, OfAQuarterOfTheLightHasAQuarter) {
  const Photograph dark = ReadPhotograph(Write(
      "a.dng", {.scene = [](int x, int y) -> Eigen::Vector3d { return TwoColors(x, y) / 4; }}));
  ExpectNear(dark.linear.Rgb(50, 20), TwoColors(50, 20) / 4, 3e-4);
}

TEST_F(ReadRaw, SaysWhereItsSensorClipped) {
  const Photograph photo =
      ReadPhotograph(Write("a.dng", {.scene = [](int x, int) -> Eigen::Vector3d {
                             return Eigen::Vector3d::Constant(x < 32 ? 0.9 : 3);
                           }}));
  EXPECT_FALSE(IsClipped(photo, 20, 20));
  EXPECT_TRUE(IsClipped(photo, 40, 20));
  EXPECT_TRUE(IsClipped(photo, 32, 21));  // although its own sample is not all of its channels
  ExpectNear(photo.linear.Rgb(40, 20), {1, 1, 1}, 3e-4);  // white, not magenta
}

// The channels that did not clip keep what they measured.
TEST_F(ReadRaw, ClipsChannelByChannel) {
  const auto scene = [](int, int) { return Eigen::Vector3d(0.1, 1.8, 0.1); };
  const CodedPhotograph photo = ReadCodedPhotograph(Write("a.dng", {.scene = scene}));
  const auto& codes = std::get<std::vector<uint16_t>>(photo.samples);
  const uint16_t* rgb = &codes[3 * (20 * 64 + 20)];
  EXPECT_EQ(rgb[1], 65535);
  EXPECT_LT(rgb[0], 60000);
  EXPECT_LT(rgb[2], 60000);
}

TEST_F(ReadRaw, StaysAsTheSensorHasIt) {
  const fs::path path = Write("a.dng", {.scene = TwoColors, .orientation = 6});
  EXPECT_EQ(ReadPhotographSize(path), Eigen::Vector2i(64, 48));
  EXPECT_EQ(ReadPhotograph(path).linear.width, 64);
  EXPECT_EQ(ReadOrientation(path), 6);
  EXPECT_EQ(ReadOrientation(Write("b.dng", {.scene = TwoColors, .orientation = 8})), 8);
  EXPECT_EQ(ReadOrientation(Write("c.dng", {.scene = TwoColors, .orientation = 3})), 3);
}

TEST_F(ReadRaw, HalfAsLargeIsTheSame) {
  const RawPhotograph half = ReadRawPhotograph(Write("a.dng", {.scene = TwoColors}), true);
  EXPECT_EQ(half.width, 32);
  const uint16_t* rgb = &half.codes[3 * (10 * 32 + 25)];
  ExpectNear(half.color.Linear(Eigen::Vector3d(rgb[0], rgb[1], rgb[2]) / 65535), TwoColors(50, 20),
             3e-4);
}

TEST_F(ReadRaw, HasAThumbnail) {
  const auto thumbnail = PhotoThumbnail(Write("a.dng", {.scene = TwoColors}), 16);
  ASSERT_TRUE(thumbnail);
  EXPECT_TRUE(thumbnail->starts_with("data:image/jpeg;base64,"));
}

TEST_F(ReadRaw, OfAnUnknownCameraIsRefused) {
  const fs::path path = Write("a.dng", {.scene = TwoColors, .has_colors = false});
  const std::string text = path.string() + ": is of a camera (Insitu Test) whose colours LibRaw " +
                           "0.20.2-Release does not know; convert it to DNG, or develop it to a "
                           "16-bit TIFF without lens correction in full size";
  EXPECT_EQ(InputErrorOf([&] { ReadPhotograph(path); }), text);
  EXPECT_EQ(InputErrorOf([&] { ReadPhotographSize(path); }), text);
  EXPECT_EQ(InputErrorOf([&] { ReadPhotographColor(path); }), text);
}

TEST_F(ReadRaw, ThatIsNoneIsRefused) {
  const fs::path text = folder_.Write("a.nef", std::string(20000, 'x'));
  EXPECT_TRUE(InputErrorOf([&] {
                ReadPhotograph(text);
              }).starts_with(text.string() + ": is no raw photograph of a camera that LibRaw "));
  const fs::path path = Write("b.dng", {.scene = TwoColors});
  fs::resize_file(path, fs::file_size(path) / 2);
  EXPECT_TRUE(InputErrorOf([&] {
                ReadPhotograph(path);
              }).starts_with(path.string() + ": cut short or damaged: "));
}

// OpenImageIO would show the small picture that a raw may begin with.
TEST_F(ReadRaw, UnderATiffsNameIsRefused) {
  const fs::path path = Write("a.tif", {.scene = TwoColors});
  EXPECT_TRUE(InputErrorOf([&] {
                ReadPhotograph(path);
              }).starts_with(path.string() + ": is a TIFF of photometric"));
}

class RawMontage : public ReadRaw {
 protected:
  void SetUp() override {
    const fs::path path = Write("a.dng", {.scene = TwoColors, .orientation = 6});
    const auto image = Exiv2::ImageFactory::open(path.string());
    image->readMetadata();
    image->exifData()["Exif.Photo.DateTimeOriginal"] = "2026:11:29 12:00:00";
    image->exifData()["Exif.Photo.ColorSpace"] = uint16_t{2};  // of the camera's own picture
    image->writeMetadata();
    Photograph photo = ReadPhotograph(path);
    Raster picture = photo.linear;
    linear_ = picture;
    remarks_ = WriteMontageFiles(At("out"), {std::move(picture), std::move(photo), path, true, {}});
  }

  fs::path At(const std::string& name) const { return folder_.path() / name; }

  Raster linear_;
  std::vector<std::string> remarks_;
};

TEST_F(RawMontage, WithoutBuildingIsTheRawInSrgb) {
  EXPECT_EQ(remarks_, std::vector<std::string>());
  const CodedPhotograph codes = CodesOf(linear_, Encoding::kSrgb16, {});
  EXPECT_EQ(ReadCodedPhotograph(At("out.tif")).samples, codes.samples);
  EXPECT_EQ(ReadCodedPhotograph(At("out.png")).samples, Upright(codes, 6).samples);
  const Raster exr = ReadPhotograph(At("out.exr")).linear;
  EXPECT_EQ(exr.width, 48);
  EXPECT_EQ(exr.Rgb(47 - 20, 10), linear_.Rgb(10, 20));
  ExpectNear(ReadPhotograph(At("out.jpg")).linear.Rgb(10, 20), TwoColors(10, 20), 0.01);
}

TEST_F(RawMontage, KeepsMetadataButNotThoseOfTheSensor) {
  for (const char* name : {"out.tif", "out.jpg"}) {
    const auto image = Exiv2::ImageFactory::open(At(name).string());
    image->readMetadata();
    Exiv2::ExifData& exif = image->exifData();
    EXPECT_EQ(exif["Exif.Image.Model"].toString(), "Test") << name;
    EXPECT_EQ(exif["Exif.Image.Orientation"].toString(), "6") << name;
    EXPECT_EQ(exif["Exif.Photo.DateTimeOriginal"].toString(), "2026:11:29 12:00:00") << name;
    EXPECT_EQ(exif["Exif.Photo.ColorSpace"].toString(), "1") << name;
    for (const char* key : {"Exif.Image.DNGVersion", "Exif.Image.ColorMatrix1",
                            "Exif.Image.CFAPattern", "Exif.Image.BlackLevel"}) {
      EXPECT_EQ(exif.findKey(Exiv2::ExifKey(key)), exif.end()) << name << " " << key;
    }
  }
}

}  // namespace
}  // namespace insitu
