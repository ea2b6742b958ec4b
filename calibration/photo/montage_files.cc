// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/montage_files.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/raw_ending.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/exif.h"
#include "calibration/photo/jpeg_blocks.h"
#include "calibration/photo/quick_codes.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

bool IsThePhotographs(const Raster& a, const Raster& b, int x, int y) {
  return std::equal(a.At(x, y), a.At(x, y) + 3, b.At(x, y));
}

// Of another depth.
template <typename To, typename From>
To Rescaled(From code) {
  if constexpr (std::is_same_v<To, From>) {
    return code;
  } else if constexpr (std::is_same_v<To, uint8_t> && std::is_same_v<From, uint16_t>) {
    return static_cast<uint8_t>((code + 128) / 257);
  } else {
    return static_cast<To>(257 * code);
  }
}

// The photograph's codes where the montage is the photograph.
template <typename Code, typename OriginalCode>
void Restore(const MontagePicture& montage, const std::vector<OriginalCode>& originals,
             std::vector<Code>* codes) {
  tbb::parallel_for(0, montage.linear.height, [&](int y) {
    for (int x = 0; x < montage.linear.width; ++x) {
      if (!IsThePhotographs(montage.linear, montage.photo.linear, x, y)) continue;
      const size_t at = (static_cast<size_t>(y) * montage.linear.width + x) * 3;
      for (size_t i = at; i < at + 3; ++i) (*codes)[i] = Rescaled<Code>(originals[i]);
    }
  });
}

template <typename Samples>
Samples Turned(const Samples& samples, int width, int height, int orientation) {
  const bool is_across = orientation >= 5;
  const int new_width = is_across ? height : width, new_height = is_across ? width : height;
  Samples turned(samples.size());
  for (int y = 0; y < new_height; ++y) {
    for (int x = 0; x < new_width; ++x) {
      int u = is_across ? y : x, v = is_across ? x : y;
      // Mirrored along the stored rows, along the stored columns.
      if (orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8) {
        u = width - 1 - u;
      }
      if (orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7) {
        v = height - 1 - v;
      }
      const size_t from = (static_cast<size_t>(v) * width + u) * 3;
      std::copy_n(samples.begin() + from, 3,
                  turned.begin() + (static_cast<size_t>(y) * new_width + x) * 3);
    }
  }
  return turned;
}

std::string LowerEnding(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

// A picture's delivery: what is written is remembered, so that remarks are told once.
class Delivery {
 public:
  Delivery(fs::path stem, const MontagePicture& montage)
      : stem_(std::move(stem)), montage_(montage), orientation_(ReadOrientation(montage.source)) {
    if (montage.is_photo_frame) original_ = ReadCodedPhotograph(montage.source);
    const std::string& assumption = montage.photo.color.assumption;
    if (!assumption.empty()) remarks_.push_back(montage.source.string() + ": " + assumption);
  }

  std::vector<std::string> Write() {
    const std::string ending = LowerEnding(montage_.source);
    const bool is_raw = HasRawEnding(montage_.source);
    WriteLinear();
    WritePortableNetworkGraphics(ending == ".png");
    const bool is_tiff = ending == ".tif" || ending == ".tiff";
    if (is_tiff || is_raw || montage_.wants_tiff) {
      WriteTiff(is_raw || (montage_.wants_tiff && !(is_tiff && is_float())));
    } else {
      fs::remove(PathOf(".tif"));
    }
    WriteJpegFile(!is_tiff && !is_raw && ending != ".png" && ending != ".exr");
    return std::move(remarks_);
  }

 private:
  const ColorSpace& color() const { return montage_.photo.color; }
  bool is_float() const { return montage_.photo.encoding == Encoding::kLinear; }

  // An EXR of other primaries says so itself; curves and profiles have no place there, nor have
  // chromaticities in what holds codes.
  CodedPhotograph Codes(Encoding encoding) const {
    const bool is_exr = encoding == Encoding::kLinear;
    const bool has_place =
        is_exr ? !color().chromaticities.empty() : !color().profile.empty() || color().has_response;
    ColorSpace target = has_place ? color() : ColorSpace();
    const bool is_same = has_place || color().IsDefault();
    return MontageCodes(montage_, original_ && is_same ? &*original_ : nullptr, encoding, target);
  }

  void WriteSoon(const fs::path& file, const CodedPhotograph& picture) const {
    return montage_.is_quick ? WriteCodesQuickly(file, picture) : WriteCodes(file, picture);
  }

  fs::path PathOf(const char* ending) const { return stem_.string() + ending; }

  void Remark(const fs::path& path, const std::string& text) {
    remarks_.push_back(path.string() + ": " + text);
  }

  // Where the codes are written with the colour space, its profile is there already.
  void Describe(const fs::path& path, const fs::path& temporary, bool with_orientation,
                bool with_profile = false) {
    const CopiedMetadata copied = {with_profile, color().profile, with_orientation,
                                   &montage_.statement};
    for (const std::string& text : CopyMetadata(montage_.source, temporary, copied)) {
      Remark(path, text);
    }
  }

  void WriteLinear() {
    const CodedPhotograph picture = Upright(Codes(Encoding::kLinear), orientation_);
    WriteWhole(PathOf(".exr"), [&](const fs::path& temporary) { WriteSoon(temporary, picture); });
  }

  void WritePortableNetworkGraphics(bool is_like_source) {
    const int turn = is_like_source ? 1 : orientation_;
    const Encoding encoding = is_float() ? Encoding::kSrgb16 : montage_.photo.encoding;
    const CodedPhotograph picture = Upright(Codes(encoding), turn);
    const fs::path path = PathOf(".png");
    WriteWhole(path, [&](const fs::path& temporary) {
      WriteSoon(temporary, picture);
      Describe(path, temporary, is_like_source);
    });
  }

  // Else as the photograph, which is a TIFF, has its codes.
  void WriteTiff(bool has_16_bits) {
    const CodedPhotograph picture = has_16_bits
                                        ? Codes(Encoding::kSrgb16)
                                        : MontageCodes(montage_, original_ ? &*original_ : nullptr,
                                                       montage_.photo.encoding, color());
    const fs::path path = PathOf(".tif");
    WriteWhole(path, [&](const fs::path& temporary) {
      WriteCodes(temporary, picture);
      Describe(path, temporary, true);
    });
  }

  void WriteJpegFile(bool is_of_jpeg) {
    const CodedPhotograph picture = Codes(Encoding::kSrgb8);
    const fs::path path = PathOf(".jpg");
    WriteWhole(path, [&](const fs::path& temporary) {
      const bool has_blocks = is_of_jpeg && original_ && WroteBlocks(picture, path, temporary);
      if (!has_blocks) WriteCodes(temporary, picture);
      Describe(path, temporary, true, has_blocks);
    });
  }

  bool WroteBlocks(const CodedPhotograph& picture, const fs::path& path,
                   const fs::path& temporary) {
    const auto* before = std::get_if<std::vector<uint8_t>>(&original_->samples);
    const auto* after = std::get_if<std::vector<uint8_t>>(&picture.samples);
    INSITU_CHECK(before && after);
    const std::string why = WriteChangedBlocks(montage_.source, *before, *after, temporary);
    if (why.empty()) return true;
    Remark(path, "is encoded anew, at quality 95, not with the photograph's own blocks: " + why);
    return false;
  }

  const fs::path stem_;
  const MontagePicture& montage_;
  const int orientation_;
  std::optional<CodedPhotograph> original_;
  std::vector<std::string> remarks_;
};

}  // namespace

CodedPhotograph MontageCodes(const MontagePicture& montage, const CodedPhotograph* original,
                             Encoding encoding, const ColorSpace& color) {
  if (!original) return CodesOf(montage.linear, encoding, color);
  CodedPhotograph picture = CodesOf(montage.linear, encoding, color, [&](int x, int y) {
    return original->samples.index() == 2 || encoding == Encoding::kLinear ||
           !IsThePhotographs(montage.linear, montage.photo.linear, x, y);
  });
  std::visit(
      [&](auto& codes, const auto& originals) {
        using Code = typename std::decay_t<decltype(codes)>::value_type;
        using OriginalCode = typename std::decay_t<decltype(originals)>::value_type;
        if constexpr (std::is_floating_point_v<Code> == std::is_floating_point_v<OriginalCode>) {
          Restore<Code, OriginalCode>(montage, originals, &codes);
        }
      },
      picture.samples, original->samples);
  return picture;
}

CodedPhotograph Upright(CodedPhotograph picture, int orientation) {
  INSITU_CHECK(orientation >= 1 && orientation <= 8);
  if (orientation == 1) return picture;
  std::visit(
      [&](auto& samples) { samples = Turned(samples, picture.width, picture.height, orientation); },
      picture.samples);
  if (orientation >= 5) std::swap(picture.width, picture.height);
  return picture;
}

std::vector<std::string> WriteMontageFiles(const fs::path& stem, const MontagePicture& montage) {
  return Delivery(stem, montage).Write();
}

}  // namespace insitu
