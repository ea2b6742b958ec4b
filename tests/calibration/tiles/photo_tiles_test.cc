// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/tiles/photo_tiles.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "calibration/photo/photograph.h"
#include "calibration/tiles/photo_pyramid.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

cv::Mat Decoded(const std::string& bytes) {
  return cv::imdecode(std::vector<unsigned char>(bytes.begin(), bytes.end()), cv::IMREAD_UNCHANGED);
}

// Smooth and of about one colour, so that JPEG keeps it; nowhere the same.
cv::Mat Picture(int width, int height) {
  cv::Mat image(height, width, CV_8UC3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double grey = 128 + 50 * std::sin(0.011 * x + 0.02 * y) + 40 * std::cos(0.017 * x);
      image.at<cv::Vec3b>(y, x) = cv::Vec3b(cv::saturate_cast<unsigned char>(grey - 30),
                                            cv::saturate_cast<unsigned char>(grey),
                                            cv::saturate_cast<unsigned char>(grey + 30));
    }
  }
  return image;
}

double Difference(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF); }

class PhotoTilesTest : public testing::Test {
 protected:
  std::filesystem::path Write(const std::string& name, const cv::Mat& image) const {
    const auto path = folder_.path() / name;
    EXPECT_TRUE(cv::imwrite(path.string(), image, {cv::IMWRITE_JPEG_QUALITY, 95}));
    return path;
  }
  const ScratchFolder folder_;
};

TEST(PyramidSizeOf, CountsLevelsUntilOneTileHoldsIt) {
  EXPECT_EQ(PyramidSizeOf(1, 1).levels, 1);
  EXPECT_EQ(PyramidSizeOf(512, 512).levels, 1);
  EXPECT_EQ(PyramidSizeOf(513, 20).levels, 2);
  EXPECT_EQ(PyramidSizeOf(20, 1024).levels, 2);
  EXPECT_EQ(PyramidSizeOf(1025, 1025).levels, 3);
  EXPECT_EQ(PyramidSizeOf(6000, 4000).levels, 5);
  EXPECT_EQ(PyramidSizeOf(11600, 8700).levels, 6);
}

TEST_F(PhotoTilesTest, TilesShowThePixelsOfTheirLevel) {
  const cv::Mat image = Picture(1301, 777);
  PhotoTiles tiles({Write("a.jpg", image), Write("b.png", image)});
  for (const int photo : {0, 1}) {
    EXPECT_EQ(tiles.SizeOf(photo).levels, 3);
    cv::Mat expected = image;
    for (int level = 0; level < 3; ++level) {
      if (level > 0) expected = HalvedImage(expected);
      for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {2, 1}}) {
        const cv::Point corner(x * kTileSize, y * kTileSize);
        const cv::Rect inside =
            cv::Rect(corner, cv::Size(kTileSize, kTileSize)) & cv::Rect({0, 0}, expected.size());
        if (inside.empty()) continue;
        const cv::Mat tile = Decoded(tiles.Tile(photo, level, x, y));
        ASSERT_EQ(tile.size(), cv::Size(kTileSize, kTileSize));
        EXPECT_LE(Difference(tile(inside - corner), expected(inside)), 6)
            << photo << " " << level << " " << x << " " << y;
      }
    }
  }
}

TEST_F(PhotoTilesTest, OverviewsDoNotShift) {
  const cv::Mat image = Picture(4099, 2051);
  PhotoTiles tiles({Write("a.jpg", image), Write("b.png", image)});
  ASSERT_EQ(tiles.SizeOf(0).levels, 5);
  for (const int level : {3, 4}) {
    const cv::Mat jpeg = Decoded(tiles.Tile(0, level, 0, 0));
    const cv::Mat png = Decoded(tiles.Tile(1, level, 0, 0));
    for (int y = 0; y < 2051 >> level; y += 7) {
      for (int x = 0; x < std::min(4099 >> level, kTileSize); x += 7) {
        const int step = 1 << level;
        const cv::Scalar mean = cv::mean(image(cv::Rect(x * step, y * step, step, step)));
        for (int c = 0; c < 3; ++c) {
          ASSERT_NEAR(jpeg.at<cv::Vec3b>(y, x)[c], mean[c], 6);
          ASSERT_NEAR(png.at<cv::Vec3b>(y, x)[c], mean[c], 6);
        }
      }
    }
  }
}

TEST_F(PhotoTilesTest, KeepsOverviewsUntilThePhotographIsAnotherOne) {
  const std::filesystem::path kept = folder_.path() / "overviews";
  const cv::Mat image = Picture(4100, 600);
  const auto path = Write("a.png", image);
  const std::string first = PhotoTiles({path}, kept).Tile(0, 3, 0, 0);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(kept), {}), 1);
  const auto size = std::filesystem::file_size(path);
  const auto time = std::filesystem::last_write_time(path);
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(100);
  file << "no pixels any more";
  file.close();
  ASSERT_EQ(std::filesystem::file_size(path), size);
  InputErrorOf([&] { PhotoTiles({path}, kept).Tile(0, 3, 0, 0); });  // its time is another one
  std::filesystem::last_write_time(path, time);
  EXPECT_EQ(PhotoTiles({path}, kept).Tile(0, 3, 0, 0), first);
  const cv::Mat other = 255 - image;
  Write("a.png", other);
  const cv::Mat tile = Decoded(PhotoTiles({path}, kept).Tile(0, 3, 0, 0));
  EXPECT_LE(Difference(tile(cv::Rect(0, 0, 512, 75)),
                       HalvedImage(HalvedImage(HalvedImage(other)))(cv::Rect(0, 0, 512, 75))),
            20);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(kept), {}), 1);
}

TEST_F(PhotoTilesTest, RepeatsTheEdge) {
  const cv::Mat image = Picture(600, 530);
  PhotoTiles tiles({Write("a.png", image)});
  const cv::Mat tile = Decoded(tiles.Tile(0, 0, 1, 1));
  cv::Mat expected;
  cv::copyMakeBorder(image(cv::Rect(512, 512, 88, 18)), expected, 0, 494, 0, 424,
                     cv::BORDER_REPLICATE);
  EXPECT_LE(Difference(tile, expected), 8);
  EXPECT_NE(InputErrorOf([&] { tiles.Tile(0, 0, 2, 0); }).find("no tile (2, 0) of level 0"),
            std::string::npos);
}

TEST_F(PhotoTilesTest, PatchesAreExact) {
  const cv::Mat image = Picture(101, 77);
  PhotoTiles tiles({Write("a.png", image), Write("b.jpg", image)});
  const cv::Mat patch = Decoded(tiles.Patch(0, 50, 40, 16));
  EXPECT_EQ(Difference(patch, image(cv::Rect(34, 24, 33, 33))), 0);
  EXPECT_EQ(Difference(Decoded(tiles.Patch(1, 50, 40, 16)),
                       cv::imread((folder_.path() / "b.jpg").string())(cv::Rect(34, 24, 33, 33))),
            0);
  const cv::Mat corner = Decoded(tiles.Patch(0, 100, 0, 3));
  ASSERT_EQ(corner.size(), cv::Size(7, 7));
  EXPECT_EQ(Difference(corner(cv::Rect(0, 3, 4, 4)), image(cv::Rect(97, 0, 4, 4))), 0);
  EXPECT_EQ(cv::norm(corner(cv::Rect(0, 0, 7, 3))), 0);
  EXPECT_EQ(cv::norm(corner(cv::Rect(4, 0, 3, 7))), 0);
  EXPECT_EQ(Difference(Decoded(tiles.Patch(0, 3, 4, 0)), image(cv::Rect(3, 4, 1, 1))), 0);
}

TEST_F(PhotoTilesTest, TellsValues) {
  cv::Mat deep(3, 4, CV_16UC3, cv::Scalar(0, 0, 0));
  deep.at<cv::Vec3w>(1, 2) = cv::Vec3w(65535, 1000, 32768);
  cv::Mat plain(3, 4, CV_8UC3, cv::Scalar(0, 0, 0));
  plain.at<cv::Vec3b>(1, 2) = cv::Vec3b(255, 10, 188);
  Raster linear(4, 3);
  linear.SetRgb(2, 1, {0.5, 0, 4});
  WriteExr(folder_.path() / "c.exr", linear);
  PhotoTiles tiles({Write("a.png", deep), Write("b.png", plain), folder_.path() / "c.exr"});
  EXPECT_EQ(tiles.Value(0, 2, 1).encoded, Eigen::Vector3d(32768 / 65535., 1000 / 65535., 1));
  EXPECT_DOUBLE_EQ(tiles.Value(0, 2, 1).linear.x(), LinearFromSrgb(32768 / 65535.));
  EXPECT_EQ(tiles.Value(1, 2, 1).encoded, Eigen::Vector3d(188 / 255., 10 / 255., 1));
  EXPECT_DOUBLE_EQ(tiles.Value(1, 2, 1).linear.y(), LinearFromSrgb(10 / 255.));
  EXPECT_EQ(tiles.Value(2, 2, 1).linear, Eigen::Vector3d(0.5, 0, 4));
  EXPECT_DOUBLE_EQ(tiles.Value(2, 2, 1).encoded.x(), SrgbFromLinear(0.5));
  EXPECT_EQ(tiles.Value(1, 0, 0).linear, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(Decoded(tiles.Patch(2, 2, 1, 0)).at<cv::Vec3b>(0, 0), cv::Vec3b(255, 0, 188));
}

TEST_F(PhotoTilesTest, RefusesWhatIsNotThere) {
  PhotoTiles tiles({Write("a.png", Picture(600, 300))});
  EXPECT_EQ(tiles.count(), 1);
  for (const int photo : {-1, 1}) InputErrorOf([&] { tiles.SizeOf(photo); });
  for (const int level : {-1, 2, 31, 1000}) InputErrorOf([&] { tiles.Tile(0, level, 0, 0); });
  for (const int x : {-1, 2, 1 << 30}) {
    InputErrorOf([&] { tiles.Tile(0, 0, x, 0); });
    InputErrorOf([&] { tiles.Tile(0, 0, 0, x); });
  }
  for (const int x : {-1, 600}) {
    InputErrorOf([&] { tiles.Patch(0, x, 0, 1); });
    InputErrorOf([&] { tiles.Value(0, x, 0); });
  }
  for (const int radius : {-1, 513}) InputErrorOf([&] { tiles.Patch(0, 0, 0, radius); });
}

TEST_F(PhotoTilesTest, NamesAPhotographThatCannotBeDecoded) {
  const auto whole = Write("a.jpg", Picture(4200, 600));
  std::string bytes;
  {
    std::ifstream file(whole, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(file), {});
  }
  PhotoTiles tiles({folder_.Write("cut.jpg", bytes.substr(0, bytes.size() / 2)), whole,
                    folder_.Write("none.jpg", "no picture"), folder_.path() / "missing.jpg"});
  EXPECT_EQ(tiles.SizeOf(0).width, 4200);
  for (const int level : {0, 3}) {
    EXPECT_NE(InputErrorOf([&] { tiles.Tile(0, level, 0, 0); }).find("cut.jpg: "),
              std::string::npos);
  }
  EXPECT_NE(InputErrorOf([&] { tiles.SizeOf(2); }).find("none.jpg: "), std::string::npos);
  EXPECT_NE(InputErrorOf([&] { tiles.Patch(3, 0, 0, 1); }).find("missing.jpg: "),
            std::string::npos);
  EXPECT_FALSE(tiles.Tile(1, 0, 0, 0).empty());
  folder_.Write("cut.jpg", bytes);  // repaired
  EXPECT_FALSE(tiles.Tile(0, 0, 0, 0).empty());
}

TEST_F(PhotoTilesTest, NoticesAPhotographOfAnotherSizeThanBefore) {
  PhotoTiles tiles({Write("a.png", Picture(600, 300))});
  EXPECT_EQ(tiles.SizeOf(0).width, 600);
  Write("a.png", Picture(300, 600));
  EXPECT_NE(InputErrorOf([&] { tiles.Tile(0, 0, 0, 0); }).find("expected 600x300 px"),
            std::string::npos);
}

TEST_F(PhotoTilesTest, AnswersSeveralThreadsWithLittleMemory) {
  std::vector<std::filesystem::path> photos;
  for (int i = 0; i < 4; ++i) {
    photos.push_back(Write("p" + std::to_string(i) + ".jpg", Picture(1100 + i, 1030)));
  }
  PhotoTiles tiles(photos, {}, 10'000'000), alone(photos);
  std::vector<std::string> expected;
  for (int i = 0; i < 36; ++i) expected.push_back(alone.Tile(i % 4, 0, i / 4 % 3, i / 12));
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&, thread] {
      for (int k = 0; k < 36; ++k) {
        const int i = (k * 7 + 9 * thread) % 36;
        EXPECT_TRUE(tiles.Tile(i % 4, 0, i / 4 % 3, i / 12) == expected[i]);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace insitu
