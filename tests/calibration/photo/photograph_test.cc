// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/photograph.h"

#include <OpenImageIO/imageio.h>

#include <cmath>
#include <exiv2/exiv2.hpp>
#include <limits>

#include "calibration/files/whole_file.h"
#include "tests/calibration/files/scratch_folder.h"

// libpng leaves OpenImageIO's reader by longjmp when a file is cut: the message is lost, not ours.
extern "C" const char* __lsan_default_suppressions();   // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:OpenImageIO";
}

namespace insitu {
namespace {

namespace fs = std::filesystem;

// Pixels as another program would have written them.
template <typename Sample>
void WriteSamples(const fs::path& path, int width, int height, int channels,
                  const std::vector<Sample>& samples) {
  const auto output = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(output);
  OIIO::ImageSpec spec(width, height, channels, OIIO::BaseTypeFromC<Sample>::value);
  spec.attribute("oiio:UnassociatedAlpha", 1);  // the colours as given
  ASSERT_TRUE(output->open(path.string(), spec));
  ASSERT_TRUE(output->write_image(spec.format, samples.data()));
  ASSERT_TRUE(output->close());
}

template <typename Sample>
std::vector<Sample> ReadSamples(const fs::path& path) {
  const auto input = OIIO::ImageInput::open(path.string());
  EXPECT_TRUE(input);
  if (!input) return {};
  const OIIO::ImageSpec& spec = input->spec();
  std::vector<Sample> samples(static_cast<size_t>(spec.width) * spec.height * spec.nchannels);
  EXPECT_TRUE(input->read_image(0, 0, 0, spec.nchannels, OIIO::BaseTypeFromC<Sample>::value,
                                samples.data()));
  return samples;
}

// Every code of a type once, as the three channels of a square image.
template <typename Code>
std::vector<Code> EveryCode() {
  std::vector<Code> codes;
  for (int code = 0; code <= std::numeric_limits<Code>::max(); ++code) {
    codes.insert(codes.end(), 3, static_cast<Code>(code));
  }
  return codes;
}

Raster Gradient(int width, int height) {
  Raster image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.SetRgb(x, y, {(x + 0.5) / width, (y + 0.5) / height, 0.25});
    }
  }
  return image;
}

TEST(SrgbCurve, StandardValues) {
  EXPECT_EQ(LinearFromSrgb(0), 0);
  EXPECT_EQ(LinearFromSrgb(1), 1);
  EXPECT_NEAR(LinearFromSrgb(0.5), 0.21404114, 1e-8);
  EXPECT_NEAR(LinearFromSrgb(0.04), 0.04 / 12.92, 1e-15);
  for (double value = 0; value <= 1; value += 0.01) {
    EXPECT_NEAR(SrgbFromLinear(LinearFromSrgb(value)), value, 1e-7);
  }
}

TEST(Photograph, Every8BitCodeReturns) {
  const ScratchFolder folder;
  const auto codes = EveryCode<uint8_t>();
  WriteSamples(folder.path() / "in.png", 16, 16, 3, codes);
  const Photograph photo = ReadPhotograph(folder.path() / "in.png");
  EXPECT_EQ(photo.encoding, Encoding::kSrgb8);
  WritePng(folder.path() / "out.png", photo.linear, photo.encoding);
  EXPECT_EQ(ReadSamples<uint8_t>(folder.path() / "out.png"), codes);
}

TEST(Photograph, Every16BitCodeReturns) {
  const ScratchFolder folder;
  const auto codes = EveryCode<uint16_t>();
  for (const char* name : {"in.png", "in.tif"}) {
    WriteSamples(folder.path() / name, 256, 256, 3, codes);
    const Photograph photo = ReadPhotograph(folder.path() / name);
    EXPECT_EQ(photo.encoding, Encoding::kSrgb16);
    WritePng(folder.path() / "out.png", photo.linear, photo.encoding);
    EXPECT_EQ(ReadSamples<uint16_t>(folder.path() / "out.png"), codes) << name;
  }
}

TEST(Photograph, DecodesByTheCurve) {
  const ScratchFolder folder;
  WriteSamples<uint8_t>(folder.path() / "a.png", 1, 1, 3, {0, 128, 255});
  const Raster linear = ReadPhotograph(folder.path() / "a.png").linear;
  EXPECT_EQ(linear.At(0, 0)[0], 0.0f);
  EXPECT_FLOAT_EQ(linear.At(0, 0)[1], static_cast<float>(LinearFromSrgb(128 / 255.0)));
  EXPECT_EQ(linear.At(0, 0)[2], 1.0f);
}

TEST(Photograph, GreyBecomesThreeChannelsAndAlphaIsIgnored) {
  const ScratchFolder folder;
  WriteSamples<uint8_t>(folder.path() / "grey.png", 2, 1, 1, {10, 200});
  WriteSamples<uint8_t>(folder.path() / "rgba.png", 1, 1, 4, {10, 100, 200, 50});
  WriteSamples<uint8_t>(folder.path() / "rgb.png", 1, 1, 3, {10, 100, 200});
  const Raster grey = ReadPhotograph(folder.path() / "grey.png").linear;
  EXPECT_EQ(grey.At(1, 0)[0], grey.At(1, 0)[2]);
  EXPECT_GT(grey.At(1, 0)[0], grey.At(0, 0)[0]);
  EXPECT_EQ(ReadPhotograph(folder.path() / "rgba.png").linear.data,
            ReadPhotograph(folder.path() / "rgb.png").linear.data);
}

TEST(Photograph, ExrKeepsEveryFloat) {
  const ScratchFolder folder;
  Raster image = Gradient(7, 5);
  image.SetRgb(3, 2, {-0.5, 1e-12, 1e6});
  WriteExr(folder.path() / "deep/a.exr", image);
  const Photograph photo = ReadPhotograph(folder.path() / "deep/a.exr");
  EXPECT_EQ(photo.encoding, Encoding::kLinear);
  EXPECT_EQ(photo.linear.data, image.data);
  EXPECT_EQ(ReadPhotographSize(folder.path() / "deep/a.exr"), Eigen::Vector2i(7, 5));
}

TEST(Photograph, FilesDoNotDependOnTheTimeOfWriting) {
  const ScratchFolder folder;
  const auto source = folder.path() / "none.exr";
  WriteExr(source, Gradient(8, 8));
  const std::string exr = ReadWhole(source);
  EXPECT_EQ(exr.find("insitu_"), std::string::npos);
  const std::string cap_date("capDate\0string\0\0\0\0\0", 19);  // an empty text
  EXPECT_NE(exr.find(cap_date), std::string::npos);
}

TEST(Photograph, EncodingClampsAndRounds) {
  const ScratchFolder folder;
  Raster image(3, 1);
  image.SetRgb(0, 0, {-1, 0.5, 7});
  image.SetRgb(1, 0, {std::nan(""), 1, 0});
  WritePng(folder.path() / "a.png", image, Encoding::kSrgb8);
  const std::vector<uint8_t> expected = {0, 188, 255, 0, 255, 0, 0, 0, 0};
  EXPECT_EQ(ReadSamples<uint8_t>(folder.path() / "a.png"), expected);
  WritePng(folder.path() / "b.png", image, Encoding::kLinear);
  EXPECT_EQ(ReadSamples<uint16_t>(folder.path() / "b.png")[1], 48192);
  EXPECT_EQ(ReadPhotograph(folder.path() / "b.png").encoding, Encoding::kSrgb16);
}

TEST(Photograph, ClippedIsTheHighestCodeOfAnyChannel) {
  Photograph photo{Raster(2, 1), Encoding::kSrgb8};
  photo.linear.SetRgb(0, 0, {0.2, 1, 0.3});
  photo.linear.SetRgb(1, 0, {0.2, LinearFromSrgb(254 / 255.0), 0.3});
  EXPECT_TRUE(IsClipped(photo, 0, 0));
  EXPECT_FALSE(IsClipped(photo, 1, 0));
  photo.encoding = Encoding::kLinear;
  EXPECT_FALSE(IsClipped(photo, 0, 0));
}

TEST(Photograph, JpegKeepsMetadataButNotTheThumbnail) {
  const ScratchFolder folder;
  const auto exr = folder.path() / "a.exr", source = folder.path() / "source.jpg";
  WriteExr(exr, Gradient(32, 16));
  WriteJpeg(source, Gradient(32, 16), exr);
  const std::string profile(std::string("\0\0\0\x80", 4) +
                            std::string(124, 'p'));  // begins with its length
  {
    const auto image = Exiv2::ImageFactory::open(source.string());
    Exiv2::ExifData exif;
    exif["Exif.Image.Model"] = "Camera";
    exif["Exif.Photo.DateTimeOriginal"] = "2023:08:24 10:20:00";
    const std::string thumbnail = ReadWhole(source);
    Exiv2::ExifThumb(exif).setJpegThumbnail(reinterpret_cast<const Exiv2::byte*>(thumbnail.data()),
                                            static_cast<long>(thumbnail.size()));
    Exiv2::XmpData xmp;
    xmp["Xmp.dc.source"] = "survey";
    Exiv2::DataBuf icc(reinterpret_cast<const Exiv2::byte*>(profile.data()),
                       static_cast<long>(profile.size()));
    image->setExifData(exif);
    image->setXmpData(xmp);
    image->setIccProfile(icc, false);
    image->writeMetadata();
  }
  WriteJpeg(folder.path() / "out.jpg", Gradient(32, 16), source);
  const auto image = Exiv2::ImageFactory::open((folder.path() / "out.jpg").string());
  image->readMetadata();
  EXPECT_EQ(image->exifData()["Exif.Image.Model"].toString(), "Camera");
  EXPECT_EQ(image->exifData()["Exif.Photo.DateTimeOriginal"].toString(), "2023:08:24 10:20:00");
  EXPECT_EQ(image->xmpData()["Xmp.dc.source"].toString(), "survey");
  ASSERT_TRUE(image->iccProfileDefined());
  EXPECT_EQ(static_cast<size_t>(image->iccProfile()->size_), profile.size());
  EXPECT_TRUE(Exiv2::ExifThumb(image->exifData()).copy().size_ == 0);
}

TEST(Photograph, JpegIsCloseAndWithoutSubsampling) {
  const ScratchFolder folder;
  const auto exr = folder.path() / "a.exr", jpeg = folder.path() / "a.jpg";
  // Two saturated colours side by side: subsampled chroma would smear them.
  Raster image(16, 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) image.SetRgb(x, y, {x % 2 ? 0.8 : 0.1, 0.2, x % 2 ? 0.1 : 0.8});
  }
  WriteExr(exr, image);
  WriteJpeg(jpeg, image, exr);
  const Raster read = ReadPhotograph(jpeg).linear;
  for (size_t i = 0; i < read.data.size(); ++i) ASSERT_NEAR(read.data[i], image.data[i], 0.06);
}

TEST(Photograph, MissingMetadataSourceWritesNothing) {
  const ScratchFolder folder;
  EXPECT_THROW(WriteJpeg(folder.path() / "a.jpg", Gradient(4, 4), folder.path() / "no.jpg"),
               InputError);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

class CutPhotograph : public testing::TestWithParam<const char*> {};

TEST_P(CutPhotograph, IsAnInputErrorWhereverItIsCut) {
  const ScratchFolder folder;
  const auto exr = folder.path() / "whole.exr", whole = folder.path() / GetParam();
  const Raster image = Gradient(97, 61);
  WriteExr(exr, image);
  if (whole.extension() == ".jpg") WriteJpeg(whole, image, exr);
  if (whole.extension() == ".png") WritePng(whole, image, Encoding::kSrgb8);
  ASSERT_NO_THROW(ReadPhotograph(whole));
  const std::string content = ReadWhole(whole);
  for (const double share : {0.0, 0.01, 0.3, 0.6, 0.9}) {
    const size_t length = static_cast<size_t>(share * static_cast<double>(content.size()));
    const auto cut = folder.Write("cut" + whole.extension().string(), content.substr(0, length));
    const std::string message = InputErrorOf([&] { ReadPhotograph(cut); });
    EXPECT_EQ(message.find(cut.string() + ": "), 0u) << share << " " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, CutPhotograph,
                         testing::Values("whole.jpg", "whole.png", "whole.exr"));

TEST(Photograph, JpegWithoutItsLastTwoBytesIsCutShort) {
  const ScratchFolder folder;
  const auto exr = folder.path() / "a.exr", jpeg = folder.path() / "a.jpg";
  WriteExr(exr, Gradient(64, 48));
  WriteJpeg(jpeg, Gradient(64, 48), exr);
  const std::string content = ReadWhole(jpeg);
  const auto cut = folder.Write("cut.jpg", content.substr(0, content.size() - 2));
  EXPECT_EQ(InputErrorOf([&] { ReadPhotograph(cut); }).find(cut.string() + ": cut short"), 0u);
}

TEST(Photograph, NanNamesThePixel) {
  const ScratchFolder folder;
  const auto path = folder.path() / "a.exr";
  Raster image = Gradient(9, 7);
  image.At(5, 3)[1] = std::numeric_limits<float>::quiet_NaN();
  WriteExr(path, image);
  EXPECT_EQ(InputErrorOf([&] { ReadPhotograph(path); }),
            path.string() + ": pixel (5, 3) is NaN or infinite, expected finite values");
}

TEST(Photograph, NotAnImage) {
  const ScratchFolder folder;
  const auto text = folder.Write("a.jpg", "hello, this is no photograph");
  EXPECT_EQ(InputErrorOf([&] { ReadPhotograph(text); }).find(text.string() + ": not a readable"),
            0u);
  EXPECT_EQ(InputErrorOf([&] { ReadPhotographSize(folder.path() / "no.jpg"); }),
            (folder.path() / "no.jpg").string() + ": no such file, expected a photograph");
}

}  // namespace
}  // namespace insitu
