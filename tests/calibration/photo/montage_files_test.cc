// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/montage_files.h"

#include <cstdio>
// After what it needs.
#include <jpeglib.h>

#include <exiv2/exiv2.hpp>

#include "calibration/files/whole_file.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/calibration/photo/made_photographs.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

// The quantised coefficients of every block, component by component.
std::vector<std::vector<JCOEF>> BlocksOf(const fs::path& jpeg) {
  jpeg_decompress_struct codec = {};
  jpeg_error_mgr errors;
  codec.err = jpeg_std_error(&errors);
  jpeg_create_decompress(&codec);
  std::FILE* file = std::fopen(jpeg.c_str(), "rb");
  jpeg_stdio_src(&codec, file);
  jpeg_read_header(&codec, TRUE);
  jvirt_barray_ptr* arrays = jpeg_read_coefficients(&codec);
  std::vector<std::vector<JCOEF>> blocks;
  for (int c = 0; c < codec.num_components; ++c) {
    for (JDIMENSION row = 0; row < codec.comp_info[c].height_in_blocks; ++row) {
      JBLOCKARRAY line = codec.mem->access_virt_barray(reinterpret_cast<j_common_ptr>(&codec),
                                                       arrays[c], row, 1, FALSE);
      for (JDIMENSION column = 0; column < codec.comp_info[c].width_in_blocks; ++column) {
        blocks.emplace_back(line[0][column], line[0][column] + DCTSIZE2);
      }
    }
  }
  jpeg_destroy_decompress(&codec);
  std::fclose(file);
  return blocks;
}

class MontageFiles : public testing::Test {
 protected:
  fs::path At(const std::string& name) const { return folder_.path() / name; }

  // A smooth 64 x 48 picture.
  template <typename Code>
  static std::vector<Code> Smooth(int channels = 3) {
    std::vector<Code> codes;
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        for (int c = 0; c < channels; ++c) {
          const double share = (20 + x * (c + 1) + 2 * y) / 400.0;
          codes.push_back(static_cast<Code>(share * std::numeric_limits<Code>::max()));
        }
      }
    }
    return codes;
  }

  MontagePicture Unchanged(const std::string& name) const {
    Photograph photo = ReadPhotograph(At(name));
    Raster picture = photo.linear;
    return {std::move(picture), std::move(photo), At(name), true, {}};
  }

  static void SetStatement(MontagePicture* montage) {
    montage->statement = {"insitu 1", true, "4 pixels", "abc", "def", "123"};
  }

  template <typename Code>
  std::vector<Code> CodesIn(const std::string& name) const {
    return std::get<std::vector<Code>>(ReadCodedPhotograph(At(name)).samples);
  }

  static auto Metadata(const fs::path& path) {
    auto image = Exiv2::ImageFactory::open(path.string());
    image->readMetadata();
    return image;
  }

  ScratchFolder folder_;
};

TEST_F(MontageFiles, WithoutBuildingAreThePhotographInEverySpace) {
  const std::string p3 = MadeProfile(kDisplayP3, kSrgbTransfer), table = MadeTableProfile();
  WriteMade(At("srgb.jpg"), 64, 3, Smooth<uint8_t>());
  WriteMade(At("p3.jpg"), 64, 3, Smooth<uint8_t>(), p3);
  WriteMade(At("grey.jpg"), 64, 1, Smooth<uint8_t>(1), MadeGreyProfile(1.8));
  WriteMade(At("table.png"), 64, 3, Smooth<uint8_t>(), table);
  for (const char* name : {"srgb.jpg", "p3.jpg", "grey.jpg", "table.png"}) {
    EXPECT_TRUE(WriteMontageFiles(At("out"), Unchanged(name)).empty()) << name;
    EXPECT_EQ(CodesIn<uint8_t>("out.png"), CodesIn<uint8_t>(name)) << name;
    const Raster png = ReadPhotograph(At("out.png")).linear;
    const Raster photo = ReadPhotograph(At(name)).linear;
    for (size_t i = 0; i < photo.data.size(); ++i) {
      ASSERT_NEAR(png.data[i], photo.data[i], 1e-5) << name;  // a grey profile's becomes RGB's
    }
    if (fs::path(name).extension() == ".jpg") {
      EXPECT_EQ(CodesIn<uint8_t>("out.jpg"), CodesIn<uint8_t>(name)) << name;
    }
  }
}

TEST_F(MontageFiles, WithoutBuildingKeepEvery16BitCode) {
  for (const std::string& profile :
       {std::string(), MadeProfile(kDisplayP3, kSrgbTransfer), MadeTableProfile()}) {
    WriteMade(At("a.tif"), 64, 3, ManyColors<uint16_t>(64 * 48), profile);
    EXPECT_TRUE(WriteMontageFiles(At("out"), Unchanged("a.tif")).empty());
    EXPECT_EQ(CodesIn<uint16_t>("out.png"), CodesIn<uint16_t>("a.tif"));
    EXPECT_EQ(CodesIn<uint16_t>("out.tif"), CodesIn<uint16_t>("a.tif"));
    EXPECT_EQ(ReadPhotograph(At("out.tif")).linear.data, ReadPhotograph(At("a.tif")).linear.data);
  }
}

// Exiv2 reads no profile whose pieces are out of order, though that is allowed.
TEST_F(MontageFiles, AJpegKeepsAProfileInPieces) {
  WriteMade(At("a.jpg"), 64, 3, ManyColors<uint8_t>(64 * 48));
  const std::string profile = MadeProfile(kDisplayP3, kSrgbTransfer);
  const auto segment = [&](int number, const std::string& piece) {
    const std::string data = std::string("ICC_PROFILE\0", 12) + char(number) + '\2' + piece;
    const size_t length = data.size() + 2;
    return std::string("\xff\xe2") + char(length >> 8) + char(length & 255) + data;
  };
  std::string jpeg = ReadWhole(At("a.jpg"));
  jpeg.insert(2, segment(2, profile.substr(100)) + segment(1, profile.substr(0, 100)));
  folder_.Write("a.jpg", jpeg);
  WriteMontageFiles(At("out"), Unchanged("a.jpg"));
  EXPECT_EQ(ReadPhotographColor(At("out.jpg")).profile, ReadPhotographColor(At("a.jpg")).profile);
}

TEST_F(MontageFiles, AnExrKeepsItsChromaticitiesAndEveryNumber) {
  const std::vector<float> ap0 = {0.7347f, 0.2653f, 0, 1, 0.0001f, -0.077f, 0.32168f, 0.33767f};
  WriteMade<float>(
      At("a.exr"), 2, 3, {0.1f, 0.7f, 3, 1e-9f, 0.25f, -0.5f}, "", [&](OIIO::ImageSpec* spec) {
        spec->attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), ap0.data());
      });
  WriteMontageFiles(At("out"), Unchanged("a.exr"));
  EXPECT_EQ(CodesIn<float>("out.exr"), CodesIn<float>("a.exr"));
  EXPECT_EQ(ReadPhotographColor(At("out.exr")).chromaticities, ap0);
}

TEST_F(MontageFiles, AJpegsBlocksStayWhereNothingChanged) {
  WriteMade(At("a.jpg"), 64, 3, Smooth<uint8_t>(), MadeProfile(kDisplayP3, kSrgbTransfer),
            [](OIIO::ImageSpec* spec) {
              spec->attribute("jpeg:subsampling", "4:2:0");
              spec->attribute("CompressionQuality", 90);
            });
  MontagePicture montage = Unchanged("a.jpg");
  for (int y = 16; y < 32; ++y) {
    for (int x = 32; x < 48; ++x) montage.linear.SetRgb(x, y, {0.5, 0.1, 0.05});
  }
  const Raster wanted = montage.linear;
  EXPECT_TRUE(WriteMontageFiles(At("out"), montage).empty());
  const auto before = BlocksOf(At("a.jpg")), after = BlocksOf(At("out.jpg"));
  ASSERT_EQ(before.size(), after.size());
  int changed = 0;
  for (size_t i = 0; i < before.size(); ++i) changed += before[i] != after[i];
  EXPECT_GT(changed, 0);
  EXPECT_LE(changed, 4 + 2);  // the MCU of x 32 to 47, y 16 to 31: 4 of luma, one of each chroma
  const Raster read = ReadPhotograph(At("out.jpg")).linear;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(read.At(40, 24)[c], wanted.At(40, 24)[c], 0.03) << c;
  EXPECT_EQ(read.Rgb(5, 5), montage.photo.linear.Rgb(5, 5));
}

TEST_F(MontageFiles, AColouredMontageOfAGreyJpegIsEncodedAnewAndSaid) {
  WriteMade(At("a.jpg"), 64, 1, Smooth<uint8_t>(1), MadeGreyProfile(1.8));
  MontagePicture montage = Unchanged("a.jpg");
  montage.linear.SetRgb(3, 3, {0.5, 0.1, 0.05});
  const auto remarks = WriteMontageFiles(At("out"), montage);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_NE(remarks[0].find("encoded anew"), std::string::npos) << remarks[0];
  EXPECT_NEAR(ReadPhotograph(At("out.jpg")).linear.At(40, 24)[1], montage.linear.At(40, 24)[1],
              0.02);
}

TEST_F(MontageFiles, StandUprightInEveryFormat) {
  WriteMade(At("a.jpg"), 64, 3, Smooth<uint8_t>());
  {
    const auto image = Metadata(At("a.jpg"));
    image->exifData()["Exif.Image.Orientation"] = uint16_t{6};
    image->writeMetadata();
  }
  WriteMontageFiles(At("out"), Unchanged("a.jpg"));
  EXPECT_EQ(Metadata(At("out.jpg"))->exifData()["Exif.Image.Orientation"].toLong(), 6);
  EXPECT_EQ(ReadPhotographSize(At("out.jpg")), Eigen::Vector2i(64, 48));
  EXPECT_EQ(ReadPhotographSize(At("out.exr")), Eigen::Vector2i(48, 64));
  EXPECT_EQ(ReadPhotographSize(At("out.png")), Eigen::Vector2i(48, 64));
  const Raster photo = ReadPhotograph(At("a.jpg")).linear,
               png = ReadPhotograph(At("out.png")).linear;
  EXPECT_EQ(png.Rgb(0, 0), photo.Rgb(0, 47));  // turned clockwise: the left lower corner comes up
  EXPECT_EQ(png.Rgb(47, 63), photo.Rgb(63, 0));
}

TEST_F(MontageFiles, TurningTwiceByTheInverseIsNothing) {
  const int inverses[] = {0, 1, 2, 3, 4, 5, 8, 7, 6};
  const CodedPhotograph picture = {3, 2, ManyColors<uint8_t>(6), {}};
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const CodedPhotograph back = Upright(Upright(picture, orientation), inverses[orientation]);
    EXPECT_EQ(back.samples, picture.samples) << orientation;
  }
}

TEST_F(MontageFiles, TooMuchMetadataIsLeftOutAndSaid) {
  WriteMade(At("a.tif"), 64, 3, Smooth<uint8_t>());
  {
    const auto image = Metadata(At("a.tif"));
    image->xmpData()["Xmp.photoshop.DocumentAncestors"] = std::string(90000, 'a');
    image->xmpData()["Xmp.dc.source"] = "survey";
    image->writeMetadata();
  }
  MontagePicture montage = Unchanged("a.tif");
  SetStatement(&montage);
  const auto remarks = WriteMontageFiles(At("out"), montage);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_NE(remarks[0].find("out.jpg: its XMP does not fit into a JPEG (64 kB): "
                            "Xmp.photoshop.DocumentAncestors is left out"),
            std::string::npos)
      << remarks[0];
  EXPECT_EQ(Metadata(At("out.jpg"))->xmpData()["Xmp.dc.source"].toString(), "survey");
  EXPECT_EQ(Metadata(At("out.png"))->xmpData().count(), Metadata(At("out.tif"))->xmpData().count());
}

TEST_F(MontageFiles, SayThatTheyAreAMontage) {
  WriteMade(At("a.tif"), 64, 3, Smooth<uint8_t>());
  {
    const auto image = Metadata(At("a.tif"));
    image->xmpData()["Xmp.iptcExt.DigitalSourceType"] = "digitalCapture";
    image->xmpData()["Xmp.xmp.CreatorTool"] = "Camera";
    image->exifData()["Exif.Image.Model"] = "Model";
    image->iptcData()["Iptc.Application2.Caption"] = "caption";
    image->writeMetadata();
  }
  MontagePicture montage = Unchanged("a.tif");
  SetStatement(&montage);
  EXPECT_TRUE(WriteMontageFiles(At("out"), montage).empty());
  for (const char* name : {"out.jpg", "out.png", "out.tif"}) {
    const auto image = Metadata(At(name));
    Exiv2::XmpData& xmp = image->xmpData();
    EXPECT_EQ(xmp["Xmp.iptcExt.DigitalSourceType"].toString(),
              "http://cv.iptc.org/newscodes/digitalsourcetype/compositeSynthetic")
        << name;
    EXPECT_EQ(xmp["Xmp.insitu.PhotographDigitalSourceType"].toString(), "digitalCapture");
    EXPECT_EQ(xmp["Xmp.xmp.CreatorTool"].toString(), "Camera") << name;
    EXPECT_EQ(xmp["Xmp.insitu.Program"].toString(), "insitu 1") << name;
    EXPECT_EQ(xmp["Xmp.insitu.PhotographSha256"].toString(), "abc") << name;
    EXPECT_EQ(image->exifData()["Exif.Image.Model"].toString(), "Model") << name;
    EXPECT_EQ(image->iptcData()["Iptc.Application2.Caption"].toString(), "caption") << name;
  }
}

}  // namespace
}  // namespace insitu
