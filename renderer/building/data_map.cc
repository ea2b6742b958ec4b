// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/data_map.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <variant>

#include "calibration/photo/photograph.h"

namespace insitu {
namespace {

constexpr double kFlattest = 0.05;  // z of a normal: what a code leaves of one seen from the side

// Codes as 0 to 1, in no colour space.
Raster CodesAsNumbers(const std::filesystem::path& path) {
  const CodedPhotograph coded = ReadCodedPhotograph(path);
  Raster numbers(coded.width, coded.height);
  std::visit(
      [&](const auto& samples) {
        using Code = typename std::decay_t<decltype(samples)>::value_type;
        const float highest = std::is_same_v<Code, float>     ? 1.0f
                              : std::is_same_v<Code, uint8_t> ? 255.0f
                                                              : 65535.0f;
        for (size_t i = 0; i < samples.size(); ++i) {
          numbers.data[i] = static_cast<float>(samples[i]) / highest;
        }
      },
      coded.samples);
  return numbers;
}

void SetRelief(float u, float v, float* to) {
  to[0] = u;
  to[1] = v;
  to[2] = u * u;
  to[3] = v * v;
  to[4] = u * v;
}

Raster SlopesOfNormals(const Raster& codes, double factor) {
  Raster slopes(codes.width, codes.height, kReliefChannels);
  for (int y = 0; y < codes.height; ++y) {
    for (int x = 0; x < codes.width; ++x) {
      const Eigen::Vector3d normal = 2 * codes.Rgb(x, y) - Eigen::Vector3d::Ones();
      const double scale = -factor / std::max(kFlattest, normal.z());
      SetRelief(static_cast<float>(scale * normal.x()), static_cast<float>(scale * normal.y()),
                slopes.At(x, y));
    }
  }
  return slopes;
}

// Rows go down, v goes up; the image repeats.
Raster SlopesOfHeights(const Raster& codes, int channel) {
  Raster slopes(codes.width, codes.height, kReliefChannels);
  const int w = codes.width, h = codes.height;
  const auto at = [&](int x, int y) { return codes.At((x + w) % w, (y + h) % h)[channel]; };
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const float u = (at(x + 1, y) - at(x - 1, y)) * static_cast<float>(w) / 2;
      const float v = (at(x, y - 1) - at(x, y + 1)) * static_cast<float>(h) / 2;
      SetRelief(u, v, slopes.At(x, y));
    }
  }
  return slopes;
}

}  // namespace

Raster ReadDataMap(const std::filesystem::path& path, const SurfaceMap& map) {
  const Raster codes = CodesAsNumbers(path);
  if (map.kind == SurfaceMap::Kind::kNormal) return SlopesOfNormals(codes, map.factor);
  if (map.kind == SurfaceMap::Kind::kHeight) return SlopesOfHeights(codes, map.channel);
  Raster values(codes.width, codes.height, 1);
  for (int y = 0; y < codes.height; ++y) {
    for (int x = 0; x < codes.width; ++x) {
      const float code = codes.At(x, y)[map.channel];
      *values.At(x, y) = map.is_squared ? code * code : code;
    }
  }
  return values;
}

double MeanOf(const Raster& data, const SurfaceMap& map) {
  double sum = 0;
  for (const float value : data.data) sum += value;
  return FactorOf(map) * sum / static_cast<double>(data.data.size());
}

Eigen::Vector3d MeanColor(const Raster& image) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) sum += image.Rgb(x, y);
  }
  return sum / (static_cast<double>(image.width) * image.height);
}

}  // namespace insitu
