// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/color/stated_color.h"

#include <cmath>
#include <exiv2/exiv2.hpp>

#include "calibration/color/icc_profile.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/calibration/photo/made_photographs.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

// The largest difference of two pictures in sRGB's 8-bit codes.
double LargestDifference(const Raster& a, const Raster& b) {
  EXPECT_EQ(a.data.size(), b.data.size());
  double largest = 0;
  for (size_t i = 0; i < a.data.size(); ++i) {
    const auto code = [](float linear) { return 255 * SrgbFromLinear(linear); };
    largest = std::max(largest, std::abs(code(a.data[i]) - code(b.data[i])));
  }
  return largest;
}

class StatedColor : public testing::Test {
 protected:
  fs::path At(const std::string& name) const { return folder_.path() / name; }
  std::string FaultOf(const std::string& name) const {
    return InputErrorOf([&] { ReadPhotograph(At(name)); });
  }
  ScratchFolder folder_;
};

TEST_F(StatedColor, AP3PictureAndItsSrgbTwinAreTheSameLight) {
  const auto srgb = ManyColors<uint16_t>(400);
  const auto p3 = P3FromSrgb(srgb);
  WriteMade(At("srgb.png"), 20, 3, srgb);
  WriteMade(At("matrix.tif"), 20, 3, p3, MadeProfile(kDisplayP3, kSrgbTransfer));
  WriteMade(At("matrix.png"), 20, 3, p3, MadeProfile(kDisplayP3, kSrgbTransfer));
  WriteMade(At("table.tif"), 20, 3, p3, MadeTableProfile());
  WriteMade(At("cicp.png"), 20, 3, p3);
  InsertChunk(At("cicp.png"), "cICP", std::string("\x0c\x0d\0\1", 4));
  const Raster twin = ReadPhotograph(At("srgb.png")).linear;
  for (const char* name : {"matrix.tif", "matrix.png", "cicp.png"}) {
    EXPECT_LT(LargestDifference(ReadPhotograph(At(name)).linear, twin), 0.1) << name;
  }
  EXPECT_LT(LargestDifference(ReadPhotograph(At("table.tif")).linear, twin), 3);  // of 17 nodes
}

TEST_F(StatedColor, ColorsBeyondRec709AreNotClipped) {
  WriteMade<uint8_t>(At("green.png"), 1, 3, {0, 255, 0}, MadeProfile(kDisplayP3, kSrgbTransfer));
  WriteMade<uint8_t>(At("green.tif"), 1, 3, {0, 255, 0}, MadeTableProfile());
  for (const char* name : {"green.png", "green.tif"}) {
    const Photograph photo = ReadPhotograph(At(name));
    EXPECT_NEAR(photo.linear.At(0, 0)[0], -0.2249, 2e-3) << name;  // Rec709From(kDisplayP3)
    EXPECT_NEAR(photo.linear.At(0, 0)[1], 1.0421, 2e-3) << name;
    EXPECT_TRUE(IsClipped(photo, 0, 0)) << name;
  }
}

TEST_F(StatedColor, EveryWayToSayAdobeRgbIsTheSame) {
  const Primaries adobe = {{0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}, {0.3127, 0.3290}};
  const auto codes = ManyColors<uint8_t>(256);
  WriteMade(At("icc2.png"), 16, 3, codes, MadeProfile(adobe, {563 / 256.0}, 2.1));
  WriteMade(At("chunks.png"), 16, 3, codes);
  InsertChunk(At("chunks.png"), "cHRM",
              ChunkInteger(31270) + ChunkInteger(32900) + ChunkInteger(64000) +
                  ChunkInteger(33000) + ChunkInteger(21000) + ChunkInteger(71000) +
                  ChunkInteger(15000) + ChunkInteger(6000));
  InsertChunk(At("chunks.png"), "gAMA", ChunkInteger(45471));
  WriteMade(At("exif.tif"), 16, 3, codes);
  {
    const auto image = Exiv2::ImageFactory::open(At("exif.tif").string());
    image->readMetadata();
    image->exifData()["Exif.Photo.ColorSpace"] = uint16_t{65535};
    image->exifData()["Exif.Iop.InteroperabilityIndex"] = "R03";
    image->writeMetadata();
  }
  const Raster icc = ReadPhotograph(At("icc2.png")).linear;
  EXPECT_LT(LargestDifference(ReadPhotograph(At("chunks.png")).linear, icc), 0.1);
  EXPECT_LT(LargestDifference(ReadPhotograph(At("exif.tif")).linear, icc), 0.1);
}

TEST_F(StatedColor, GammaAndChromaticitiesAreHeeded) {
  WriteMade<uint8_t>(At("linear.png"), 1, 3, {51, 102, 153});
  InsertChunk(At("linear.png"), "gAMA", ChunkInteger(100000));
  EXPECT_NEAR(ReadPhotograph(At("linear.png")).linear.At(0, 0)[1], 0.4, 1e-6);
  const std::vector<float> ap0 = {0.7347f, 0.2653f, 0, 1, 0.0001f, -0.077f, 0.32168f, 0.33767f};
  WriteMade<float>(At("ap0.exr"), 1, 3, {0.5f, 0.5f, 0.5f}, "", [&](OIIO::ImageSpec* spec) {
    spec->attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), ap0.data());
  });
  const Photograph photo = ReadPhotograph(At("ap0.exr"));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(photo.linear.At(0, 0)[c], 0.5, 1e-6);  // white is white
  EXPECT_EQ(photo.color.chromaticities, ap0);
}

TEST_F(StatedColor, AGreyProfileGivesTheCurve) {
  WriteMade<uint8_t>(At("grey.jpg"), 8, 1, std::vector<uint8_t>(64, 128), MadeGreyProfile(1.8));
  const Photograph photo = ReadPhotograph(At("grey.jpg"));
  EXPECT_NEAR(photo.linear.At(3, 3)[2], std::pow(128 / 255.0, 1.8), 1e-4);
  WriteCodes(At("back.png"), CodesOf(photo.linear, Encoding::kSrgb8, photo.color));
  EXPECT_LT(LargestDifference(ReadPhotograph(At("back.png")).linear, photo.linear), 0.01);
}

TEST_F(StatedColor, ASrgbProfileIsSrgb) {
  WriteMade<uint8_t>(At("a.png"), 1, 3, {10, 100, 200}, MadeProfile(kRec709, kSrgbTransfer));
  const Photograph photo = ReadPhotograph(At("a.png"));
  EXPECT_TRUE(photo.color.IsDefault());
  EXPECT_FALSE(photo.color.profile.empty());
}

TEST_F(StatedColor, AnUnnamedSpaceIsSaid) {
  WriteMade<uint8_t>(At("a.jpg"), 1, 3, {10, 100, 200});
  EXPECT_EQ(ReadPhotographColor(At("a.jpg")).assumption, "");
  const auto image = Exiv2::ImageFactory::open(At("a.jpg").string());
  image->readMetadata();
  image->exifData()["Exif.Photo.ColorSpace"] = uint16_t{65535};
  image->writeMetadata();
  EXPECT_NE(ReadPhotographColor(At("a.jpg")).assumption.find("65535"), std::string::npos);
}

TEST_F(StatedColor, EveryCodeOfEverySpaceReturns) {
  const auto p3 = ReadIccProfile(MadeProfile(kDisplayP3, kSrgbTransfer), 3, "p3");
  const auto adobe = ReadIccProfile(
      MadeProfile({{0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}, {0.3127, 0.3290}}, {2.2}, 2.1), 3,
      "a");
  const auto table = ReadIccProfile(MadeTableProfile(), 3, "table");
  for (const ColorSpace& space : {p3, adobe, table}) {
    for (int code = 0; code < 256; ++code) {
      const Eigen::Vector3d encoded = Eigen::Vector3d(code, (code * 7) % 256, 255 - code) / 255;
      const Eigen::Vector3d stored = space.Linear(encoded).cast<float>().cast<double>();
      EXPECT_LT((space.Encoded(stored) - encoded).cwiseAbs().maxCoeff(), 0.4 / 255)
          << space.name << " " << code;
    }
  }
}

TEST_F(StatedColor, WhatIsNoRgbIsRefused) {
  WriteMade<uint8_t>(At("cmyk.tif"), 2, 4, {0, 1, 2, 3, 4, 5, 6, 7}, "",
                     [](OIIO::ImageSpec* spec) { spec->attribute("tiff:ColorSpace", "CMYK"); });
  EXPECT_EQ(FaultOf("cmyk.tif"),
            At("cmyk.tif").string() + ": is CMYK, expected RGB or grey; convert it to sRGB");
  WriteCmykJpeg(At("cmyk.jpg"));
  EXPECT_EQ(FaultOf("cmyk.jpg"),
            At("cmyk.jpg").string() + ": is CMYK, expected RGB or grey; convert it to sRGB");
  WriteMade<float>(At("xyz.exr"), 1, 3, {1, 1, 1}, "", [](OIIO::ImageSpec* spec) {
    spec->channelnames = {"X", "Y", "Z"};
  });
  EXPECT_NE(FaultOf("xyz.exr").find("an EXR of channels X, Y, Z, expected RGB"), std::string::npos);
  WriteMade<uint8_t>(At("pq.png"), 1, 3, {1, 2, 3});
  InsertChunk(At("pq.png"), "cICP", std::string("\x09\x10\0\1", 4));
  EXPECT_NE(FaultOf("pq.png").find("HDR screens by PQ"), std::string::npos);
}

TEST_F(StatedColor, ProfilesThatSayNothingAreRefused) {
  const std::string good = MadeProfile(kDisplayP3, kSrgbTransfer);
  const std::vector<std::pair<std::string, std::string>> faults = {
      {MadeLinkProfile(), "is of class 'link'"},
      {MadeCmykProfile(), "is for CMYK but the file holds red, green and blue"},
      {MadeGreyProfile(2.2), "is for GRAY but the file holds red, green and blue"},
      {good.substr(0, 200), "is damaged"},
      {"\x7f" + good.substr(1), "is damaged"},  // says that it is longer than it is
      {std::string(300, 'x'), "is damaged"}};
  for (const auto& [profile, fault] : faults) {
    WriteMade<uint8_t>(At("a.jpg"), 1, 3, {1, 2, 3}, profile);
    const std::string message = FaultOf("a.jpg");
    EXPECT_EQ(message.find(At("a.jpg").string() + ": its ICC profile "), 0u) << message;
    EXPECT_NE(message.find(fault), std::string::npos) << message;
    EXPECT_NE(message.find("convert the photograph to sRGB"), std::string::npos) << message;
  }
}

// As some programs pad it; PNG's library would not write it.
TEST_F(StatedColor, AProfileWithSomethingBehindIsDelivered) {
  const std::string good = MadeProfile(kDisplayP3, kSrgbTransfer);
  WriteMade<uint8_t>(At("a.jpg"), 1, 3, {1, 2, 3}, good + "abc");
  const ColorSpace color = ReadPhotographColor(At("a.jpg"));
  EXPECT_EQ(color.profile.size() % 4, 0u);
  WriteCodes(At("b.png"), CodesOf(Raster(2, 2), Encoding::kSrgb8, color));
  EXPECT_EQ(ReadPhotographColor(At("b.png")).profile, color.profile);
}

TEST_F(StatedColor, APngWithoutEndIsRefusedByOneLine) {
  WriteMade(At("a.png"), 64, 3, ManyColors<uint8_t>(64 * 48));
  fs::resize_file(At("a.png"), fs::file_size(At("a.png")) / 2);
  testing::internal::CaptureStderr();
  EXPECT_EQ(FaultOf("a.png"),
            At("a.png").string() + ": cut short or damaged: its last chunk, IEND, is missing");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(StatedColor, APictureOfBitsIsRefused) {
  WriteMade<uint8_t>(At("a.tif"), 8, 1, std::vector<uint8_t>(64, 255), "",
                     [](OIIO::ImageSpec* spec) { spec->attribute("oiio:BitsPerSample", 1); });
  EXPECT_EQ(FaultOf("a.tif"),
            At("a.tif").string() + ": has 1 bit a pixel, expected 8 or 16 bits a channel");
}

TEST_F(StatedColor, AProfileThatUnpacksWithoutEndIsRefused) {
  WriteMade<uint8_t>(At("bomb.png"), 1, 3, {1, 2, 3});
  const std::string bomb(size_t{80} << 20, '\0');
  InsertChunk(At("bomb.png"), "iCCP", std::string("bomb\0\0", 6) + Deflated(bomb));
  EXPECT_NE(FaultOf("bomb.png").find("unpacks to over 64 MB"), std::string::npos);
  WriteMade<uint8_t>(At("torn.png"), 1, 3, {1, 2, 3});
  InsertChunk(At("torn.png"), "iCCP", std::string("torn\0\0", 6) + "no zlib");
  EXPECT_NE(FaultOf("torn.png").find("its ICC profile is damaged"), std::string::npos);
}

TEST_F(StatedColor, APictureOf60000SquaredIsRefused) {
  WriteMade<uint8_t>(At("a.png"), 1, 3, {1, 2, 3});
  std::string content = ReadWhole(At("a.png"));
  content.replace(8, 25, "");
  folder_.Write("large.png", content);
  InsertChunk(At("large.png"), "IHDR",
              ChunkInteger(60000) + ChunkInteger(60000) + std::string("\x08\2\0\0\0", 5), 8);
  EXPECT_NE(FaultOf("large.png").find("is 60000x60000 px, expected at most 536 megapixels"),
            std::string::npos);
}

}  // namespace
}  // namespace insitu
