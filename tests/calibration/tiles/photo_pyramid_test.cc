// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/tiles/photo_pyramid.h"

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

cv::Mat Noise(int width, int height, int type = CV_8UC3) {
  cv::Mat image(height, width, type);
  cv::RNG random(7);
  random.fill(image, cv::RNG::UNIFORM, 0, type == CV_16UC3 ? 65536 : 256);
  return image;
}

double LargestDifference(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() ? cv::norm(a, b, cv::NORM_INF) : INFINITY;
}

// By definition: the mean of 2 x 2 pixels, the last column or row twice.
cv::Mat MeansOfFour(const cv::Mat& image) {
  cv::Mat half((image.rows + 1) / 2, (image.cols + 1) / 2, CV_8UC3);
  for (int y = 0; y < half.rows; ++y) {
    for (int x = 0; x < half.cols; ++x) {
      cv::Vec3i sum(2, 2, 2);
      for (const int dy : {0, 1}) {
        for (const int dx : {0, 1}) {
          sum += cv::Vec3i(image.at<cv::Vec3b>(std::min(2 * y + dy, image.rows - 1),
                                               std::min(2 * x + dx, image.cols - 1)));
        }
      }
      half.at<cv::Vec3b>(y, x) = cv::Vec3b(sum / 4);
    }
  }
  return half;
}

TEST(HalvedImage, IsTheMeanOfFourPixels) {
  for (const cv::Size size :
       {cv::Size(64, 48), cv::Size(65, 48), cv::Size(64, 47), cv::Size(33, 27), cv::Size(1, 1),
        cv::Size(1, 5), cv::Size(2, 1), cv::Size(3, 3)}) {
    const cv::Mat image = Noise(size.width, size.height);
    // cv::Vec3i / 4 rounds; so do both within one code.
    EXPECT_LE(LargestDifference(HalvedImage(image), MeansOfFour(image)), 1) << size;
  }
}

TEST(HalvedImage, DoesNotShift) {
  cv::Mat ramp(64, 64, CV_8UC3);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) ramp.at<cv::Vec3b>(y, x) = cv::Vec3b(4 * x, 4 * y, 0);
  }
  const cv::Mat half = HalvedImage(ramp);
  for (int i = 0; i < 32; ++i) EXPECT_EQ(half.at<cv::Vec3b>(i, i)[0], 4 * (2 * i) + 2);
}

TEST(EightBit, RoundsSixteenBitsAndEncodesLinearOnes) {
  cv::Mat codes(1, 3, CV_16UC3, cv::Scalar::all(0));
  codes.at<cv::Vec3w>(0, 1) = cv::Vec3w(257, 200 * 257, 65535);
  codes.at<cv::Vec3w>(0, 2) = cv::Vec3w(128, 129, 65400);
  const cv::Mat shown = EightBit(codes);
  EXPECT_EQ(shown.at<cv::Vec3b>(0, 1), cv::Vec3b(1, 200, 255));
  EXPECT_EQ(shown.at<cv::Vec3b>(0, 2), cv::Vec3b(0, 1, 254));
  const cv::Mat linear(1, 1, CV_32FC3, cv::Scalar(-1, 0.5, 7));
  EXPECT_EQ(EightBit(linear).at<cv::Vec3b>(0, 0), cv::Vec3b(0, 188, 255));
}

TEST(ReadShownPhotograph, HasTheCodesOfTheFile) {
  const ScratchFolder folder;
  for (const auto& [name, type] : {std::pair("a.png", CV_8UC3),
                                   {"b.png", CV_16UC3},
                                   {"c.tif", CV_8UC3},
                                   {"d.tif", CV_16UC3}}) {
    const cv::Mat image = Noise(301, 203, type);
    const auto path = folder.path() / name;
    ASSERT_TRUE(cv::imwrite(path.string(), image));
    EXPECT_EQ(LargestDifference(ReadShownPhotograph(path), image), 0) << name;
  }
  cv::Mat every(256, 256, CV_16UC3);
  for (int i = 0; i < 65536; ++i)
    every.at<cv::Vec3w>(i / 256, i % 256) = cv::Vec3w(i, 0, 65535 - i);
  const auto path = folder.path() / "every.png";
  ASSERT_TRUE(cv::imwrite(path.string(), every));
  EXPECT_EQ(LargestDifference(ReadShownPhotograph(path), every), 0);
}

// The same pixels as the programs measure in.
TEST(ReadShownPhotograph, DecodesAJpegAsReadPhotographDoes) {
  const ScratchFolder folder;
  const auto path = folder.path() / "a.jpg";
  cv::Mat image = Noise(301, 203);
  cv::blur(image, image, cv::Size(9, 9));
  ASSERT_TRUE(cv::imwrite(path.string(), image));
  const cv::Mat shown = ReadShownPhotograph(path);
  const Photograph photo = ReadPhotograph(path);
  for (int y = 0; y < 203; ++y) {
    for (int x = 0; x < 301; ++x) {
      const auto& code = shown.at<cv::Vec3b>(y, x);
      ASSERT_EQ(static_cast<float>(LinearFromSrgb(code[2] / 255.)), photo.linear.At(x, y)[0]);
      ASSERT_EQ(static_cast<float>(LinearFromSrgb(code[0] / 255.)), photo.linear.At(x, y)[2]);
    }
  }
}

TEST(ReadShownPhotograph, KeepsAnExrLinear) {
  const ScratchFolder folder;
  Raster linear(5, 4);
  linear.SetRgb(3, 2, {0.25, 1.5, 3});
  WriteExr(folder.path() / "a.exr", linear);
  const cv::Mat image = ReadShownPhotograph(folder.path() / "a.exr");
  EXPECT_EQ(image.at<cv::Vec3f>(2, 3), cv::Vec3f(3, 1.5, 0.25));
}

// EXIF: orientation 6, turned by a quarter.
TEST(ReadShownPhotograph, DoesNotTurn) {
  const ScratchFolder folder;
  const auto path = folder.path() / "a.jpg";
  ASSERT_TRUE(cv::imwrite(path.string(), Noise(64, 32)));
  const std::string exif(
      "\xff\xe1\0\x22"
      "Exif\0\0"
      "II*\0\x08\0\0\0"
      "\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0",
      36);
  std::string jpeg = ReadWhole(path);
  jpeg.insert(2, exif);
  folder.Write("a.jpg", jpeg);
  ASSERT_EQ(cv::imread(path.string()).size(), cv::Size(32, 64));
  EXPECT_EQ(ReadShownPhotograph(path).size(), cv::Size(64, 32));
  EXPECT_EQ(ReadEighthOfPhotograph(path).size(), cv::Size(8, 4));
}

TEST(ReadEighthOfPhotograph, IsThePhotographHalvedThrice) {
  const ScratchFolder folder;
  const auto path = folder.path() / "a.jpg";
  for (const cv::Size size : {cv::Size(640, 480), cv::Size(641, 487), cv::Size(647, 481)}) {
    cv::Mat image = Noise(size.width, size.height);
    cv::blur(image, image, cv::Size(31, 31));
    image = (image - cv::Scalar::all(100)) * 4;
    ASSERT_TRUE(cv::imwrite(path.string(), image, {cv::IMWRITE_JPEG_QUALITY, 98}));
    const cv::Mat eighth = ReadEighthOfPhotograph(path);
    PhotoPyramid pyramid(ReadShownPhotograph(path), 0);
    ASSERT_EQ(eighth.size(), pyramid.Level(3).size());
    const cv::Rect whole_blocks(0, 0, size.width / 8, size.height / 8);
    EXPECT_LE(LargestDifference(eighth(whole_blocks), pyramid.Level(3)(whole_blocks)), 4);
  }
}

// A smooth picture, so that an encoder has use for each of PNG's filters, with some noise.
cv::Mat Graded(int width, int height, int type) {
  cv::Mat smooth, image = Noise(width, height, type);
  cv::blur(Noise(width, height, type), smooth, cv::Size(61, 61));
  return 0.02 * image + 0.98 * smooth;
}

// The mean of 8 x 8 pixels each.
cv::Mat MeansOfEights(const cv::Mat& image) {
  cv::Mat means((image.rows + 7) / 8, (image.cols + 7) / 8, image.type());
  for (int y = 0; y < means.rows; ++y) {
    for (int x = 0; x < means.cols; ++x) {
      const cv::Rect all(0, 0, image.cols, image.rows);
      const cv::Scalar mean = cv::mean(image(cv::Rect(8 * x, 8 * y, 8, 8) & all));
      cv::Mat(1, 1, image.type(), mean).copyTo(means(cv::Rect(x, y, 1, 1)));
    }
  }
  return means;
}

TEST(ReadEighthOfPhotograph, IsTheMeanOfEachEightPixelsSquared) {
  const ScratchFolder folder;
  const std::vector<int> filtered = {cv::IMWRITE_PNG_COMPRESSION, 6};
  const std::vector<int> sub_only;
  for (const int channels : {1, 3, 4}) {
    for (const int depth : {CV_8U, CV_16U}) {
      const cv::Mat image = Graded(333, 203, CV_MAKETYPE(depth, channels));
      cv::Mat expected;
      cv::cvtColor(MeansOfEights(image), expected,
                   channels == 1   ? cv::COLOR_GRAY2BGR
                   : channels == 3 ? cv::COLOR_BGR2RGB
                                   : cv::COLOR_BGRA2RGB);
      if (channels > 1) cv::cvtColor(expected, expected, cv::COLOR_RGB2BGR);
      std::vector<std::pair<const char*, std::vector<int>>> files = {{"a.png", filtered},
                                                                     {"b.png", sub_only}};
      for (const int compression : {1, 5, 8}) {  // none, LZW, deflate
        if (channels < 4) files.push_back({"c.tif", {cv::IMWRITE_TIFF_COMPRESSION, compression}});
      }
      for (const auto& [name, options] : files) {
        const auto path = folder.path() / name;
        ASSERT_TRUE(cv::imwrite(path.string(), image, options));
        EXPECT_LE(LargestDifference(ReadEighthOfPhotograph(path), expected), 1)
            << name << ' ' << channels << ' ' << depth;
      }
    }
  }
}

TEST(ReadEighthOfPhotograph, OfWhatIsCutOrDamagedThereIsNone) {
  const ScratchFolder folder;
  for (const char* name : {"a.png", "a.tif"}) {
    const auto path = folder.path() / name;
    ASSERT_TRUE(cv::imwrite(path.string(), Noise(640, 480)));
    const std::string whole = ReadWhole(path);
    std::string damaged = whole;
    for (size_t i = 0; i < 20; ++i) damaged[whole.size() / 2 + i] = '!';
    for (const std::string& content :
         {whole.substr(0, whole.size() / 2), whole.substr(0, 60), whole.substr(0, 5), damaged}) {
      const bool may_be_read = content == damaged && path.extension() == ".tif";  // no check sum
      const cv::Mat eighth = ReadEighthOfPhotograph(folder.Write("b", content));
      EXPECT_TRUE(eighth.empty() || may_be_read) << name << ' ' << content.size();
    }
  }
}

TEST(ReadShownPhotograph, NamesWhatCannotBeDecoded) {
  const ScratchFolder folder;
  const auto path = folder.path() / "a.jpg";
  ASSERT_TRUE(cv::imwrite(path.string(), Noise(640, 480)));
  const std::string whole = ReadWhole(path);
  for (const std::string& content :
       {whole.substr(0, whole.size() / 2), whole.substr(0, 300), whole.substr(0, 3),
        std::string("no picture"), std::string()}) {
    const auto damaged = folder.Write("b.jpg", content);
    EXPECT_EQ(InputErrorOf([&] { ReadShownPhotograph(damaged); }).find(damaged.string() + ": "),
              0u);
  }
  folder.Write("b.jpg", whole.substr(0, whole.size() / 2));
  InputErrorOf([&] { ReadEighthOfPhotograph(folder.path() / "b.jpg"); });
  const auto missing = folder.path() / "missing.jpg";
  EXPECT_NE(InputErrorOf([&] { ReadShownPhotograph(missing); }).find("missing.jpg"),
            std::string::npos);
}

TEST(PhotoPyramid, MakesLevelsOnceAndCountsThemAll) {
  PhotoPyramid pyramid(Noise(1001, 701), 2);
  EXPECT_EQ(pyramid.Level(2).size(), cv::Size(1001, 701));
  EXPECT_EQ(pyramid.Level(4).size(), cv::Size(251, 176));
  EXPECT_EQ(pyramid.Level(4).data, pyramid.Level(4).data);
  EXPECT_EQ(pyramid.bytes(), 1001u * 701 * 3 * 4 / 3);
  EXPECT_THROW(pyramid.Level(1), CheckError);
}

}  // namespace
}  // namespace insitu
