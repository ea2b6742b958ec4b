// SPDX-License-Identifier: GPL-3.0-or-later
// photo_tiles_speed [PHOTO...]: how long the first tiles of photographs take; without any, of two
// that it makes, 24 and 100 megapixels.
#include <chrono>
#include <cstdio>
#include <ctime>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "calibration/tiles/photo_tiles.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

// As detailed as a photograph: its JPEG takes three to four bits a pixel.
fs::path MakePhotograph(int width, int height) {
  cv::Mat coarse(height / 8, width / 8, CV_8UC3), image(height, width, CV_8UC3), noise;
  cv::RNG random(1);
  random.fill(coarse, cv::RNG::UNIFORM, 0, 256);
  cv::resize(coarse, image, image.size(), 0, 0, cv::INTER_CUBIC);
  noise.create(image.size(), CV_8UC3);
  random.fill(noise, cv::RNG::UNIFORM, 0, 24);
  image += noise;
  const fs::path path =
      fs::temp_directory_path() / ("photo_tiles_speed_" + std::to_string(width) + ".jpg");
  cv::imwrite(path.string(), image, {cv::IMWRITE_JPEG_QUALITY, 92});
  return path;
}

void Time(const char* what, const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processor = std::clock();
  work();
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  std::printf("  %-38s %7.1f ms, of the processors %7.1f ms\n", what, time.count(),
              1000.0 * static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC);
}

void Measure(const fs::path& path) {
  PhotoTiles tiles({path});
  const PyramidSize size = tiles.SizeOf(0);
  std::printf("%s: %dx%d px, %.1f MB\n", path.filename().c_str(), size.width, size.height,
              static_cast<double>(fs::file_size(path)) / 1e6);
  Time("first tile, whole photograph", [&] { tiles.Tile(0, size.levels - 1, 0, 0); });
  Time("first tile, level 3", [&] { tiles.Tile(0, std::min(3, size.levels - 1), 0, 0); });
  Time("first tile, level 0 (decodes it all)", [&] { tiles.Tile(0, 0, 3, 3); });
  Time("first tile, level 1", [&] { tiles.Tile(0, 1, 1, 1); });
  Time("first tile, level 2", [&] { tiles.Tile(0, 2, 0, 0); });
  Time("another tile, level 0", [&] { tiles.Tile(0, 0, 1, 1); });
  Time("patch of radius 64", [&] { tiles.Patch(0, 1000, 1000, 64); });
  Time("patch of radius 256", [&] { tiles.Patch(0, 1000, 1000, 256); });
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) insitu::Measure(argv[i]);
  if (argc > 1) return 0;
  for (const auto& [width, height] : {std::pair(6000, 4000), {11600, 8700}}) {
    const auto path = insitu::MakePhotograph(width, height);
    insitu::Measure(path);
    std::filesystem::remove(path);
  }
}
