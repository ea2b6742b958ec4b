// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/raw_photograph.h"

#include <libraw/libraw.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "calibration/files/error.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr int64_t kMostRawPixels = int64_t{1} << 29;  // as of other photographs
constexpr double kHighestCode = 65535;
constexpr char kDevelop[] =
    "convert it to DNG, or develop it to a 16-bit TIFF without lens correction in full size";

// One raw file, opened; LibRaw itself is a megabyte and belongs to one thread.
class RawFile {
 public:
  RawFile(const fs::path& path, bool is_half) : path_(path), raw_(std::make_unique<LibRaw>()) {
    if (!fs::is_regular_file(path)) throw InputError(path, "no such file, expected a photograph");
    raw_->set_dataerror_handler(
        [](void* is_damaged, const char*, const int) { *static_cast<bool*>(is_damaged) = true; },
        &is_damaged_);
    SetParameters(is_half);
    Require(raw_->open_file(path.c_str()));
    RequireKnownCamera();
    RequireSize();
  }

  const libraw_data_t& data() const { return raw_->imgdata; }

  // LibRaw develops no more after this.
  Eigen::Vector2i SizeAlone() {
    Require(raw_->adjust_sizes_info_only());
    return {data().sizes.iwidth, data().sizes.iheight};
  }

  // The sensor's samples.
  void Unpack() {
    Require(raw_->unpack());
    RequireWhole();
    if (WhiteLevel() < static_cast<int>(data().color.maximum)) {
      raw_->imgdata.params.user_sat = WhiteLevel() - BlackLevel();
    }
  }

  // Where the maker states that samples are proportional to light up to less, there.
  int WhiteLevel() const {
    long white = data().color.maximum;
    for (const long stated : data().color.linear_max) {
      if (stated > white / 2) white = std::min(white, stated);
    }
    return static_cast<int>(white);
  }

  int BlackLevel() const {
    const unsigned* of_colors = data().color.cblack;
    return static_cast<int>(data().color.black + *std::min_element(of_colors, of_colors + 4));
  }

  // All three colours at every pixel.
  void Develop() {
    Require(raw_->dcraw_process());
    RequireWhole();
  }

  // Of the sensor's sample (row, column) of what is seen; a second green is green.
  int ColorAt(int row, int column) const {
    const int color = raw_->COLOR(row, column);
    return color == 3 ? 1 : color;
  }

 private:
  void SetParameters(bool is_half) {
    libraw_output_params_t& how = raw_->imgdata.params;
    how.output_bps = 16;
    how.output_color = 0;  // the camera's own
    how.gamm[0] = how.gamm[1] = 1;
    how.no_auto_bright = 1;
    how.adjust_maximum_thr = 0;  // nor may the white level depend on what a photograph shows
    how.highlight = 1;           // nothing is cut by the white balance
    how.user_flip = 0;           // pixels as the sensor has them
    how.half_size = is_half ? 1 : 0;
  }

  void Require(int status) const {
    if (status == LIBRAW_SUCCESS) return;
    if (status == LIBRAW_FILE_UNSUPPORTED || status == LIBRAW_NOT_IMPLEMENTED) {
      throw InputError(path_, "is no raw photograph of a camera that LibRaw " +
                                  std::string(LibRaw::version()) + " knows; " + kDevelop);
    }
    throw InputError(path_, std::string("cut short or damaged: ") + LibRaw::strerror(status));
  }

  void RequireSize() const {
    const int width = data().sizes.width, height = data().sizes.height;
    if (int64_t{width} * height <= kMostRawPixels) return;
    throw InputError(path_, "is " + std::to_string(width) + "x" + std::to_string(height) +
                                " px, expected at most 536 megapixels");
  }

  void RequireWhole() const {
    if (is_damaged_) throw InputError(path_, "cut short or damaged, expected a whole raw file");
  }

  // Without a matrix LibRaw would take the camera's colours for sRGB.
  void RequireKnownCamera() const {
    const libraw_iparams_t& camera = data().idata;
    if (camera.colors == 1) return;
    const std::string name = std::string(camera.make) + " " + camera.model;
    if (camera.colors != 3) {
      throw InputError(path_, "is of a camera (" + name + ") of " + std::to_string(camera.colors) +
                                  " primary colours, expected red, green and blue; " + kDevelop);
    }
    const auto& matrix = data().color.rgb_cam;
    if (matrix[0][1] != 0 || matrix[1][0] != 0 || matrix[2][0] != 0) return;
    throw InputError(path_, "is of a camera (" + name + ") whose colours LibRaw " +
                                LibRaw::version() + " does not know; " + kDevelop);
  }

  fs::path path_;
  bool is_damaged_ = false;
  std::unique_ptr<LibRaw> raw_;
};

// Codes to linear Rec. 709. Where the channel that clips first has clipped, nothing is known of the
// colour: the others count as far as makes white, or bright skies would turn magenta.
class RawConversion : public ColorConversion {
 public:
  // `balance` is 1 where a channel clips first.
  RawConversion(Eigen::Matrix3d rec709, Eigen::Vector3d balance)
      : rec709_(std::move(rec709)), inverse_(rec709_.inverse()), balance_(std::move(balance)) {
    balance_.minCoeff(&first_);
  }

  Eigen::Vector3d Linear(const Eigen::Vector3d& encoded) const override {
    const Eigen::Vector3d balanced = balance_.cwiseProduct(encoded);
    return rec709_ * (encoded[first_] < 1 ? balanced : balanced.cwiseMin(1).eval());
  }

  Eigen::Vector3d Encoded(const Eigen::Vector3d& linear) const override {
    return (inverse_ * linear).cwiseQuotient(balance_);
  }

 private:
  const Eigen::Matrix3d rec709_, inverse_;
  Eigen::Vector3d balance_;
  int first_ = 0;
};

// A camera's primaries and its balance for daylight are LibRaw's.
ColorSpace ColorOfRaw(const libraw_data_t& data) {
  ColorSpace color;
  color.name = "raw, balanced for daylight (D65)";
  Eigen::Matrix3d rec709 = Eigen::Matrix3d::Identity();
  Eigen::Vector3d balance = Eigen::Vector3d::Ones();
  for (int c = 0; c < 3 && data.idata.colors == 3; ++c) {
    balance[c] = data.color.pre_mul[c];
    for (int k = 0; k < 3; ++k) rec709(c, k) = data.color.rgb_cam[c][k];
  }
  color.conversion = std::make_shared<RawConversion>(rec709, balance / balance.minCoeff());
  return color;
}

// Whether each sample of the sensor that is seen clipped; empty: it has no such samples.
std::vector<uint8_t> ClippedSamples(const RawFile& file) {
  const libraw_data_t& data = file.data();
  const int white = file.WhiteLevel();
  const libraw_image_sizes_t& sizes = data.sizes;
  const uint16_t* samples = data.rawdata.raw_image;
  if (!samples || data.idata.filters == 0) return {};
  std::vector<uint8_t> clipped(static_cast<size_t>(sizes.width) * sizes.height);
  for (int y = 0; y < sizes.height; ++y) {
    const uint16_t* row =
        samples + static_cast<size_t>(y + sizes.top_margin) * (sizes.raw_pitch / sizeof(uint16_t)) +
        sizes.left_margin;
    for (int x = 0; x < sizes.width; ++x) {
      clipped[static_cast<size_t>(y) * sizes.width + x] = row[x] >= white;
    }
  }
  return clipped;
}

// The colours of the clipped samples at a pixel and around it.
void MarkClipped(const RawFile& file, const std::vector<uint8_t>& clipped, int width, int height,
                 std::vector<uint16_t>* codes) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!clipped[static_cast<size_t>(y) * width + x]) continue;
      const int color = file.ColorAt(y, x);
      for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u) {
          (*codes)[(static_cast<size_t>(v) * width + u) * 3 + color] = 65535;
        }
      }
    }
  }
}

// LibRaw balanced the colours to tell edges by; what clips is each channel's own highest code.
std::vector<uint16_t> RawCodes(const libraw_data_t& data) {
  const bool is_grey = data.idata.colors == 1;
  std::array<double, 3> factors = {1, 1, 1};
  for (int c = 0; c < 3 && !is_grey; ++c) factors[c] = 1 / data.color.pre_mul[c];
  const int width = data.sizes.iwidth;
  std::vector<uint16_t> codes(static_cast<size_t>(width) * data.sizes.iheight * 3);
  tbb::parallel_for(0, int{data.sizes.iheight}, [&](int y) {
    for (size_t i = static_cast<size_t>(y) * width; i < static_cast<size_t>(y + 1) * width; ++i) {
      for (int c = 0; c < 3; ++c) {
        const double code = factors[c] * data.image[i][is_grey ? 0 : c];
        codes[3 * i + c] = static_cast<uint16_t>(std::lround(std::min(code, kHighestCode)));
      }
    }
  });
  return codes;
}

}  // namespace

RawPhotograph ReadRawPhotograph(const fs::path& path, bool is_half) {
  RawFile file(path, is_half);
  const ColorSpace color = ColorOfRaw(file.data());
  file.Unpack();
  const std::vector<uint8_t> clipped = ClippedSamples(file);
  file.Develop();
  const int width = file.data().sizes.iwidth, height = file.data().sizes.iheight;
  std::vector<uint16_t> codes = RawCodes(file.data());
  // Of sensors that LibRaw turns or halves, pixels are no samples.
  if (clipped.size() * 3 == codes.size()) {
    MarkClipped(file, clipped, width, height, &codes);
  }
  return {width, height, std::move(codes), color};
}

ColorSpace ReadRawColor(const fs::path& path) { return ColorOfRaw(RawFile(path, false).data()); }

Eigen::Vector2i ReadRawSize(const fs::path& path) { return RawFile(path, false).SizeAlone(); }

int ReadRawOrientation(const fs::path& path) {
  const int flip = RawFile(path, false).data().sizes.flip;
  return flip == 3 ? 3 : flip == 5 ? 8 : flip == 6 ? 6 : 1;
}

}  // namespace insitu
