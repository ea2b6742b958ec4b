// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/jpeg_blocks.h"

#include <csetjmp>
#include <cstdio>
// After what it needs.
#include <jpeglib.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr int kBlock = DCTSIZE;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// libjpeg leaves by longjmp.
struct ErrorManager {
  jpeg_error_mgr base = {};
  std::jmp_buf leave = {};
  char message[JMSG_LENGTH_MAX] = {};
};

void LeaveByJump(j_common_ptr info) {
  auto* manager = reinterpret_cast<ErrorManager*>(info->err);
  info->err->format_message(info, manager->message);
  std::longjmp(manager->leave, 1);
}

void KeepQuiet(j_common_ptr /*info*/, int /*level*/) {}

using Block = Eigen::Matrix<float, kBlock, kBlock, Eigen::RowMajor>;

// The orthonormal DCT of T.81, A.3.3.
Block ForwardDct(const Block& samples) {
  static const Block basis = [] {
    Block rows;
    for (int u = 0; u < kBlock; ++u) {
      for (int x = 0; x < kBlock; ++x) {
        const double scale = u == 0 ? std::sqrt(1.0 / kBlock) : std::sqrt(2.0 / kBlock);
        rows(u, x) =
            static_cast<float>(scale * std::cos((2 * x + 1) * u * std::numbers::pi / (2 * kBlock)));
      }
    }
    return rows;
  }();
  return basis * samples * basis.transpose();
}

// Weights of red, green and blue in a component [JFIF 1.02].
Eigen::Vector3f WeightsOf(J_COLOR_SPACE space, int component) {
  if (space == JCS_RGB) return Eigen::Vector3f::Unit(component);
  if (component == 0 || space == JCS_GRAYSCALE) return {0.299f, 0.587f, 0.114f};
  if (component == 1) return {-0.168736f, -0.331264f, 0.5f};
  return {0.5f, -0.418688f, -0.081312f};
}

struct Difference {
  int width, height;
  const std::vector<uint8_t>&original, &changed;

  bool At(int x, int y, Eigen::Vector3f* rgb) const {
    const size_t i = (static_cast<size_t>(y) * width + x) * 3;
    for (int c = 0; c < 3; ++c) {
      (*rgb)[c] = static_cast<float>(changed[i + c]) - static_cast<float>(original[i + c]);
    }
    return !rgb->isZero(0);
  }
};

// A component's samples: `across` x `down` pixels each.
struct Sampling {
  int across = 1, down = 1;
  Eigen::Vector3f weights;
};

// The mean difference over a sample's pixels; whether there is any.
bool SampleAt(const Difference& difference, const Sampling& sampling, int sx, int sy, float* mean) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero(), rgb;
  int pixels = 0;
  bool differs = false;
  const int right = std::min((sx + 1) * sampling.across, difference.width);
  const int bottom = std::min((sy + 1) * sampling.down, difference.height);
  for (int y = sy * sampling.down; y < bottom; ++y) {
    for (int x = sx * sampling.across; x < right; ++x, ++pixels) {
      if (!difference.At(x, y, &rgb)) continue;
      sum += rgb;
      differs = true;
    }
  }
  *mean = pixels ? sampling.weights.dot(sum) / static_cast<float>(pixels) : 0;
  return differs;
}

bool BlockAt(const Difference& difference, const Sampling& sampling, int column, int row,
             Block* samples) {
  bool differs = false;
  for (int y = 0; y < kBlock; ++y) {
    for (int x = 0; x < kBlock; ++x) {
      differs |=
          SampleAt(difference, sampling, column * kBlock + x, row * kBlock + y, &(*samples)(y, x));
    }
  }
  return differs;
}

// What does not differ stays, even beyond what the code of 8-bit samples allows.
void AddTo(JCOEF* coefficients, const JQUANT_TBL& table, const Block& samples) {
  constexpr long kMost = 1023;
  const Block change = ForwardDct(samples);
  for (int i = 0; i < DCTSIZE2; ++i) {
    const float step = std::max<float>(1, table.quantval[i]);
    const long added = std::lround(change(i / kBlock, i % kBlock) / step);
    if (added == 0) continue;
    coefficients[i] = static_cast<JCOEF>(std::clamp(coefficients[i] + added, -kMost, kMost));
  }
}

void ChangeComponent(jpeg_decompress_struct* from, jvirt_barray_ptr array,
                     const jpeg_component_info& component, const Difference& difference,
                     const Sampling& sampling) {
  for (JDIMENSION row = 0; row < component.height_in_blocks; ++row) {
    JBLOCKARRAY blocks =
        from->mem->access_virt_barray(reinterpret_cast<j_common_ptr>(from), array, row, 1, TRUE);
    for (JDIMENSION column = 0; column < component.width_in_blocks; ++column) {
      Block samples;
      if (!BlockAt(difference, sampling, static_cast<int>(column), static_cast<int>(row),
                   &samples)) {
        continue;
      }
      AddTo(blocks[0][column], *component.quant_table, samples);
    }
  }
}

void ChangeBlocks(jpeg_decompress_struct* from, jvirt_barray_ptr* arrays,
                  const Difference& difference) {
  for (int c = 0; c < from->num_components; ++c) {
    const jpeg_component_info& component = from->comp_info[c];
    const Sampling sampling = {from->max_h_samp_factor / component.h_samp_factor,
                               from->max_v_samp_factor / component.v_samp_factor,
                               WeightsOf(from->jpeg_color_space, c)};
    ChangeComponent(from, arrays[c], component, difference, sampling);
  }
}

bool IsColored(const Difference& difference) {
  Eigen::Vector3f rgb;
  for (int y = 0; y < difference.height; ++y) {
    for (int x = 0; x < difference.width; ++x) {
      if (difference.At(x, y, &rgb) && (rgb[0] != rgb[1] || rgb[1] != rgb[2])) return true;
    }
  }
  return false;
}

// Why the blocks cannot be kept; "": they can.
std::string Obstacle(const jpeg_decompress_struct& from, const Difference& difference) {
  const J_COLOR_SPACE space = from.jpeg_color_space;
  if (space != JCS_GRAYSCALE && space != JCS_RGB && space != JCS_YCbCr) {
    return "its components are neither grey, RGB nor YCbCr";
  }
  if (space == JCS_GRAYSCALE && IsColored(difference)) return "it is grey and the montage is not";
  for (int c = 0; c < from.num_components; ++c) {
    const jpeg_component_info& component = from.comp_info[c];
    if (from.max_h_samp_factor % component.h_samp_factor != 0 ||
        from.max_v_samp_factor % component.v_samp_factor != 0 || !component.quant_table) {
      return "its subsampling is unusual";
    }
  }
  return "";
}

// What libjpeg holds. Nothing between a setjmp and what may jump has a destructor.
struct Codecs {
  jpeg_decompress_struct from = {};
  jpeg_compress_struct to = {};
  ErrorManager errors;

  Codecs() {
    from.err = to.err = jpeg_std_error(&errors.base);
    errors.base.error_exit = &LeaveByJump;
    errors.base.emit_message = &KeepQuiet;
  }
  ~Codecs() {
    jpeg_destroy_compress(&to);
    jpeg_destroy_decompress(&from);
  }
  Codecs(const Codecs&) = delete;
  Codecs& operator=(const Codecs&) = delete;
};

jvirt_barray_ptr* ReadCoefficients(Codecs* codecs, std::FILE* source) {
  if (setjmp(codecs->errors.leave)) return nullptr;  // NOLINT(cert-err52-cpp): libjpeg's way
  jpeg_create_decompress(&codecs->from);
  jpeg_stdio_src(&codecs->from, source);
  jpeg_read_header(&codecs->from, TRUE);
  return jpeg_read_coefficients(&codecs->from);
}

// Tables of the shortest code, a progressive one progressive again.
bool WriteCoefficients(Codecs* codecs, jvirt_barray_ptr* arrays, std::FILE* target) {
  if (setjmp(codecs->errors.leave)) return false;  // NOLINT(cert-err52-cpp): libjpeg's way
  jpeg_create_compress(&codecs->to);
  jpeg_stdio_dest(&codecs->to, target);
  jpeg_copy_critical_parameters(&codecs->from, &codecs->to);
  codecs->to.optimize_coding = TRUE;
  codecs->to.restart_interval = codecs->from.restart_interval;
  if (codecs->from.progressive_mode) jpeg_simple_progression(&codecs->to);
  jpeg_write_coefficients(&codecs->to, arrays);
  jpeg_finish_compress(&codecs->to);
  return true;
}

}  // namespace

std::string WriteChangedBlocks(const fs::path& source, const std::vector<uint8_t>& original,
                               const std::vector<uint8_t>& changed, const fs::path& target) {
  const File in(std::fopen(source.c_str(), "rb"));
  if (!in) return "it cannot be read again";
  Codecs codecs;
  jvirt_barray_ptr* arrays = ReadCoefficients(&codecs, in.get());
  if (!arrays) return std::string("its blocks cannot be read: ") + codecs.errors.message;
  const Difference difference = {static_cast<int>(codecs.from.image_width),
                                 static_cast<int>(codecs.from.image_height), original, changed};
  const size_t samples = size_t{3} * difference.width * difference.height;
  if (original.size() != samples || changed.size() != samples) return "its frame is another";
  if (const std::string why = Obstacle(codecs.from, difference); !why.empty()) return why;
  ChangeBlocks(&codecs.from, arrays, difference);
  const File out(std::fopen(target.c_str(), "wb"));
  if (!out || !WriteCoefficients(&codecs, arrays, out.get()) || std::fflush(out.get()) != 0) {
    return std::string("its blocks cannot be written: ") + codecs.errors.message;
  }
  return "";
}

}  // namespace insitu
