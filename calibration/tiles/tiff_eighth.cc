// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/tiles/tiff_eighth.h"

#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "calibration/tiles/eighth_sums.h"

namespace insitu {
namespace {

constexpr tmsize_t kMostStrip = tmsize_t{1} << 30;  // bytes that are believed

struct ClosesTiff {
  void operator()(TIFF* file) const { TIFFClose(file); }
};
using TiffFile = std::unique_ptr<TIFF, ClosesTiff>;

// What is wrong, the decoding of the whole tells.
int SayNothing(TIFF* /*file*/, void* /*data*/, const char* /*module*/, const char* /*format*/,
               va_list /*values*/) {
  return 1;
}

TiffFile OpenTiff(const std::filesystem::path& path) {
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  TIFFOpenOptionsSetErrorHandlerExtR(options, SayNothing, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options, SayNothing, nullptr);
  TiffFile file(TIFFOpenExt(path.c_str(), "r", options));
  TIFFOpenOptionsFree(options);
  return file;
}

template <typename Value>
Value Field(TIFF* file, uint32_t tag) {
  Value value = 0;
  TIFFGetFieldDefaulted(file, tag, &value);
  return value;
}

bool IsLossless(int compression) {
  return compression == COMPRESSION_NONE || compression == COMPRESSION_LZW ||
         compression == COMPRESSION_ADOBE_DEFLATE || compression == COMPRESSION_DEFLATE ||
         compression == COMPRESSION_PACKBITS;
}

struct TiffLayout {
  int width = 0, height = 0, channels = 0, depth = 0;
  int strip_rows = 0, strips = 0;
};

// nullopt: not one that is read here.
std::optional<TiffLayout> LayoutOf(TIFF* file) {
  TiffLayout layout;
  layout.width = Field<int32_t>(file, TIFFTAG_IMAGEWIDTH);
  layout.height = Field<int32_t>(file, TIFFTAG_IMAGELENGTH);
  layout.channels = Field<uint16_t>(file, TIFFTAG_SAMPLESPERPIXEL);
  layout.depth = Field<uint16_t>(file, TIFFTAG_BITSPERSAMPLE);
  const int photometric = Field<uint16_t>(file, TIFFTAG_PHOTOMETRIC);
  const bool is_color = photometric == PHOTOMETRIC_RGB && layout.channels == 3;
  const bool is_grey = photometric == PHOTOMETRIC_MINISBLACK && layout.channels == 1;
  if (TIFFIsTiled(file) || layout.width <= 0 || layout.height <= 0 || (!is_color && !is_grey) ||
      (layout.depth != 8 && layout.depth != 16) ||
      Field<uint16_t>(file, TIFFTAG_SAMPLEFORMAT) != SAMPLEFORMAT_UINT ||
      Field<uint16_t>(file, TIFFTAG_PLANARCONFIG) != PLANARCONFIG_CONTIG ||
      !IsLossless(Field<uint16_t>(file, TIFFTAG_COMPRESSION)) || TIFFStripSize(file) > kMostStrip) {
    return std::nullopt;
  }
  const auto rows = Field<uint32_t>(file, TIFFTAG_ROWSPERSTRIP);
  layout.strip_rows = static_cast<int>(std::min<uint32_t>(rows, layout.height));
  layout.strips = static_cast<int>(TIFFNumberOfStrips(file));
  if (layout.strip_rows == 0) return std::nullopt;
  return layout;
}

// False: some strip cannot be read.
bool SumStrips(const std::filesystem::path& path, const TiffLayout& layout, int first, int end,
               EighthSums* sums) {
  const TiffFile file = OpenTiff(path);
  if (!file) return false;
  std::vector<uint16_t> samples((TIFFStripSize(file.get()) + 1) / 2);
  const auto row_samples = static_cast<size_t>(layout.width) * layout.channels;
  for (int strip = first; strip < end; ++strip) {
    const int top = strip * layout.strip_rows;
    const int rows = std::min(layout.strip_rows, layout.height - top);
    const auto expected = static_cast<tmsize_t>(rows * row_samples * (layout.depth / 8));
    if (TIFFReadEncodedStrip(file.get(), strip, samples.data(), expected) != expected) return false;
    for (int i = 0; i < rows; ++i) {
      if (layout.depth == 16) {
        sums->Add(top + i, samples.data() + i * row_samples, layout.channels);
      } else {
        const auto* bytes = reinterpret_cast<const uint8_t*>(samples.data());
        sums->Add(top + i, bytes + i * row_samples, layout.channels);
      }
    }
  }
  return true;
}

}  // namespace

cv::Mat ReadEighthOfTiff(const std::filesystem::path& path) {
  const TiffFile file = OpenTiff(path);
  if (!file) return {};
  const auto layout = LayoutOf(file.get());
  if (!layout) return {};
  const int parts = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1,
                               std::min(16, layout->strips));
  std::vector<EighthSums> sums;
  for (int part = 0; part < parts; ++part) sums.emplace_back(layout->width, layout->height);
  std::vector<std::future<bool>> read;
  for (int part = 0; part < parts; ++part) {
    const auto begin = [&](int i) { return static_cast<int>(int64_t{layout->strips} * i / parts); };
    read.push_back(std::async(std::launch::async, SumStrips, path, *layout, begin(part),
                              begin(part + 1), &sums[part]));
  }
  bool is_whole = true;
  for (std::future<bool>& part : read) is_whole = part.get() && is_whole;
  if (!is_whole) return {};
  for (int part = 1; part < parts; ++part) sums[0].Add(sums[part]);
  return sums[0].Means(layout->depth == 16 ? CV_16U : CV_8U);
}

}  // namespace insitu
