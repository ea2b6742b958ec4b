// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/calibration/photo/made_raw.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "calibration/color/color_space.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

std::string LittleEndian(uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 255);
  return text;
}

enum Type { kByte = 1, kAscii = 2, kShort = 3, kLong = 4, kRational = 5, kSignedRational = 10 };

constexpr int kDenominator = 10000;

// One directory of a TIFF, then what does not fit into it, then the samples.
class Directory {
 public:
  void Add(int tag, Type type, const std::vector<double>& values) {
    std::string content;
    for (const double value : values) {
      if (type == kRational || type == kSignedRational) {
        content += LittleEndian(static_cast<uint32_t>(std::lround(value * kDenominator)), 4) +
                   LittleEndian(kDenominator, 4);
      } else {
        content += LittleEndian(static_cast<uint32_t>(std::lround(value)), type == kByte    ? 1
                                                                           : type == kShort ? 2
                                                                                            : 4);
      }
    }
    entries_[tag] = {type, static_cast<uint32_t>(values.size()), content};
  }

  void Add(int tag, const std::string& text) {
    entries_[tag] = {kAscii, static_cast<uint32_t>(text.size() + 1), text + '\0'};
  }

  std::string Bytes(const std::string& samples) {
    const size_t beyond = 8 + 2 + 12 * (entries_.size() + 1) + 4;
    size_t overflow = 0;
    for (const auto& [tag, entry] : entries_) overflow += Beyond(entry.content).size();
    constexpr int kStripOffsets = 273;
    Add(kStripOffsets, kLong, {static_cast<double>(beyond + overflow)});
    std::string head = std::string("II*\0", 4) + LittleEndian(8, 4);
    head += LittleEndian(static_cast<uint32_t>(entries_.size()), 2);
    std::string tail;
    for (const auto& [tag, entry] : entries_) {
      head += LittleEndian(tag, 2) + LittleEndian(entry.type, 2) + LittleEndian(entry.count, 4);
      const bool fits = entry.content.size() <= 4;
      std::string field =
          fits ? entry.content : LittleEndian(static_cast<uint32_t>(beyond + tail.size()), 4);
      field.resize(4, '\0');
      head += field;
      tail += Beyond(entry.content);
    }
    return head + LittleEndian(0, 4) + tail + samples;
  }

 private:
  struct Entry {
    Type type;
    uint32_t count;
    std::string content;
  };

  static std::string Beyond(std::string content) {
    if (content.size() <= 4) return "";
    content.resize((content.size() + 1) / 2 * 2, '\0');
    return content;
  }

  std::map<int, Entry> entries_;
};

std::string Samples(const MadeRaw& raw) {
  Eigen::Matrix3d camera = MadeRawColorMatrix() * XyzFromRgb(kRec709);
  camera /= (camera * Eigen::Vector3d::Ones()).maxCoeff();
  std::string samples;
  for (int y = 0; y < raw.height; ++y) {
    for (int x = 0; x < raw.width; ++x) {
      const double light = (camera * raw.scene(x, y))[x % 2 + y % 2];
      const double sample = raw.black + light * (raw.white - raw.black);
      samples += LittleEndian(
          static_cast<uint32_t>(std::lround(std::clamp(sample, 0.0, double(raw.white)))), 2);
    }
  }
  return samples;
}

}  // namespace

Eigen::Matrix3d MadeRawColorMatrix() {
  return (Eigen::Matrix3d() << 0.9, -0.3, -0.1, -0.4, 1.2, 0.2, -0.05, 0.2, 0.6).finished();
}

void WriteMadeRaw(const std::filesystem::path& path, const MadeRaw& raw) {
  const std::string samples = Samples(raw);
  Directory directory;
  directory.Add(254, kLong, {0});
  directory.Add(256, kLong, {static_cast<double>(raw.width)});
  directory.Add(257, kLong, {static_cast<double>(raw.height)});
  directory.Add(258, kShort, {16});
  directory.Add(259, kShort, {1});
  directory.Add(262, kShort, {32803});  // colour filters
  directory.Add(271, "Insitu");
  directory.Add(272, "Test");
  directory.Add(274, kShort, {static_cast<double>(raw.orientation)});
  directory.Add(277, kShort, {1});
  directory.Add(278, kLong, {static_cast<double>(raw.height)});
  directory.Add(279, kLong, {static_cast<double>(samples.size())});
  directory.Add(33421, kShort, {2, 2});
  directory.Add(33422, kByte, {0, 1, 1, 2});
  directory.Add(50706, kByte, {1, 4, 0, 0});
  directory.Add(50708, "Insitu Test");
  directory.Add(50714, kShort, {static_cast<double>(raw.black)});
  directory.Add(50717, kShort, {static_cast<double>(raw.white)});
  if (raw.has_colors) {
    std::vector<double> matrix;
    for (int i = 0; i < 9; ++i) matrix.push_back(MadeRawColorMatrix()(i / 3, i % 3));
    directory.Add(50721, kSignedRational, matrix);
    directory.Add(50728, kRational, {0.5, 1, 0.7});  // another white balance than daylight's
    directory.Add(50778, kShort, {21});              // D65
  }
  WriteWhole(path, directory.Bytes(samples));
}

}  // namespace insitu
