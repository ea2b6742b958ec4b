// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/linear_rows.h"

#include <OpenImageIO/imageio.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "calibration/color/srgb_table.h"
#include "calibration/files/error.h"

namespace insitu {
namespace {

// One row; `codes` and `linear` are three numbers a pixel.
template <typename Sample>
void DecodeRow(const ColorSpace& color, const Sample* codes, int width, float* linear) {
  if (!color.IsDefault()) {
    constexpr double kOne =
        std::is_floating_point_v<Sample> ? 1.0 : double(std::numeric_limits<Sample>::max());
    for (int x = 0; x < width; ++x, codes += 3, linear += 3) {
      const Eigen::Vector3d encoded(codes[0], codes[1], codes[2]);
      Eigen::Map<Eigen::Vector3f>{linear} = color.Linear(encoded / kOne).template cast<float>();
    }
  } else if constexpr (std::is_floating_point_v<Sample>) {
    std::copy_n(codes, 3 * width, linear);
  } else {
    const std::vector<float>& table = LinearTable<Sample>();
    for (int i = 0; i < 3 * width; ++i) linear[i] = table[codes[i]];
  }
}

}  // namespace

Raster LinearRows(const CodedPhotograph& photo, int first, int end) {
  INSITU_CHECK(0 <= first && first <= end && end <= photo.height);
  Raster rows(photo.width, end - first);
  std::visit(
      [&](const auto& samples) {
        tbb::parallel_for(0, rows.height, [&](int y) {
          DecodeRow(photo.color, &samples[static_cast<size_t>(first + y) * photo.width * 3],
                    photo.width, rows.At(0, y));
        });
      },
      photo.samples);
  return rows;
}

struct ExrRows::Output {
  std::string path;
  std::unique_ptr<OIIO::ImageOutput> file;
  int height = 0, next = 0;

  void Require(bool done) const {
    if (!done) throw std::runtime_error(path + ": " + file->geterror());
  }
};

// Its primaries are stated; the time of writing is not, or it would change the bytes.
ExrRows::ExrRows(const std::filesystem::path& path, int width, int height)
    : output_(std::make_unique<Output>()) {
  constexpr std::array<float, 8> kOfRec709 = {0.64f, 0.33f, 0.30f,   0.60f,
                                              0.15f, 0.06f, 0.3127f, 0.3290f};
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::FLOAT);
  spec.tile_width = spec.tile_height = kExrTile;
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "");
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), kOfRec709.data());
  output_->path = path.string();
  output_->height = height;
  output_->file = OIIO::ImageOutput::create(path.string());
  if (!output_->file) throw std::runtime_error(path.string() + ": " + OIIO::geterror());
  output_->Require(output_->file->open(path.string(), spec));
}

ExrRows::~ExrRows() = default;

void ExrRows::Append(const Raster& rows) {
  INSITU_CHECK(output_->next + rows.height <= output_->height);
  const int end = output_->next + rows.height;
  INSITU_CHECK(output_->next % kExrTile == 0 && (end % kExrTile == 0 || end == output_->height));
  output_->Require(output_->file->write_tiles(0, rows.width, output_->next, end, 0, 1,
                                              OIIO::TypeDesc::FLOAT, rows.data.data()));
  output_->next = end;
}

void ExrRows::Close() {
  INSITU_CHECK(output_->next == output_->height);
  output_->Require(output_->file->close());
}

}  // namespace insitu
