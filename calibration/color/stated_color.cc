// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/color/stated_color.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <exiv2/exiv2.hpp>
#include <map>
#include <optional>
#include <string_view>

#include "calibration/color/icc_profile.h"
#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

// Profiles of cameras and printers have up to some megabytes.
constexpr size_t kMostProfileBytes = size_t{64} << 20;

const Primaries kAdobeRgb = {{0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}, {0.3127, 0.3290}};

uint32_t BigEndian(std::string_view bytes, size_t at, int count) {
  uint32_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

struct JpegSegment {
  uint32_t marker;  // its second byte
  std::string_view content;
};

// Those before the scan [ITU-T T.81, B.1.1].
std::vector<JpegSegment> SegmentsOf(std::string_view jpeg) {
  std::vector<JpegSegment> segments;
  for (size_t at = 2; at + 4 <= jpeg.size() && jpeg[at] == '\xff';) {
    const uint32_t marker = BigEndian(jpeg, at + 1, 1);
    if (marker == 0xff) {  // fill
      ++at;
      continue;
    }
    const uint32_t length = BigEndian(jpeg, at + 2, 2);
    if (marker == 0xda || length < 2 || at + 2 + length > jpeg.size()) break;
    segments.push_back({marker, jpeg.substr(at + 4, length - 2)});
    at += 2 + length;
  }
  return segments;
}

// OpenImageIO makes RGB of CMYK without a profile. Throws InputError.
void RequireNoCmyk(const std::vector<JpegSegment>& segments, const fs::path& path) {
  for (const JpegSegment& segment : segments) {
    const bool is_frame = segment.marker >= 0xc0 && segment.marker <= 0xcf &&
                          segment.marker != 0xc4 && segment.marker != 0xc8 &&
                          segment.marker != 0xcc;
    if (is_frame && segment.content.size() > 5 && segment.content[5] == 4) {
      throw InputError(path, "is CMYK, expected RGB or grey; convert it to sRGB");
    }
  }
}

// The pieces of an ICC profile in APP2 [ICC.1:2010, B.4], in their order. Throws InputError: one is
// missing.
std::string ProfileOfJpeg(const std::vector<JpegSegment>& segments, const fs::path& path) {
  constexpr std::string_view kName("ICC_PROFILE\0", 12);
  std::map<uint32_t, std::string_view> pieces;
  uint32_t expected = 0;
  for (const auto& [marker, content] : segments) {
    if (marker != 0xe2 || content.size() <= 14 || !content.starts_with(kName)) continue;
    pieces[BigEndian(content, 12, 1)] = content.substr(14);
    expected = BigEndian(content, 13, 1);
  }
  std::string profile;
  for (const auto& [number, piece] : pieces) profile += piece;
  if (pieces.size() == expected) return profile;
  throw InputError(path, "its ICC profile is damaged: " + std::to_string(pieces.size()) + " of " +
                             std::to_string(expected) + " pieces are there; convert the " +
                             "photograph to sRGB");
}

// PNG's library would say so on the terminal, beside us. Throws InputError: the file ends before
// its last chunk.
void RequireWholePng(std::string_view png, const fs::path& path) {
  for (size_t at = 8; at + 12 <= png.size();) {
    const size_t length = BigEndian(png, at, 4);
    if (at + 12 + length > png.size()) break;
    if (png.substr(at + 4, 4) == "IEND") return;
    at += 12 + length;
  }
  throw InputError(path, "cut short or damaged: its last chunk, IEND, is missing");
}

// The chunks before the picture, by their names; of one name the first.
std::map<std::string, std::string_view> ChunksOf(std::string_view png) {
  std::map<std::string, std::string_view> chunks;
  for (size_t at = 8; at + 12 <= png.size();) {
    const size_t length = BigEndian(png, at, 4);
    const std::string name(png.substr(at + 4, 4));
    if (name == "IDAT" || at + 12 + length > png.size()) break;
    chunks.emplace(name, png.substr(at + 8, length));
    at += 12 + length;
  }
  return chunks;
}

// Throws InputError: damaged, or more than a profile has.
std::string Inflated(std::string_view compressed, const fs::path& path) {
  z_stream stream = {};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(compressed.data()));
  stream.avail_in = static_cast<uInt>(compressed.size());
  if (inflateInit(&stream) != Z_OK) throw std::runtime_error("zlib cannot start");
  std::string result, piece(1 << 16, '\0');
  int status = Z_OK;
  while (status == Z_OK && result.size() <= kMostProfileBytes) {
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    status = inflate(&stream, Z_NO_FLUSH);
    result.append(piece, 0, piece.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (status == Z_STREAM_END) return result;
  throw InputError(path, result.size() > kMostProfileBytes
                             ? "its ICC profile unpacks to over 64 MB, which no profile has; "
                               "convert the photograph to sRGB"
                             : "its ICC profile is damaged; convert the photograph to sRGB");
}

std::string ProfileOfChunk(std::string_view chunk, const fs::path& path) {
  const size_t name_end = std::min(chunk.find('\0'), chunk.size());
  if (name_end + 2 >= chunk.size()) return Inflated({}, path);
  return Inflated(chunk.substr(name_end + 2), path);
}

// Coding-independent code points [ITU-T H.273, tables 2 and 3].
const std::map<uint32_t, Primaries>& PrimariesOfCodePoints() {
  static const Eigen::Vector2d d65 = kRec709.white;
  static const std::map<uint32_t, Primaries> all = {
      {1, kRec709},
      {5, {{0.64, 0.33}, {0.29, 0.60}, {0.15, 0.06}, d65}},
      {6, {{0.630, 0.340}, {0.310, 0.595}, {0.155, 0.070}, d65}},
      {9, {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, d65}},
      {11, {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.314, 0.351}}},
      {12, {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, d65}},
  };
  return all;
}

std::optional<TransferFunction> TransferOfCodePoint(uint32_t code) {
  switch (code) {
    case 1:
    case 6:
    case 14:
    case 15:  // the camera's curve of BT.709 and BT.2020
      return TransferFunction{1 / 0.45, 1 / 1.099, 0.099 / 1.099, 1 / 4.5, 0.081};
    case 4:
      return TransferFunction{2.2};
    case 5:
      return TransferFunction{2.8};
    case 8:
      return TransferFunction{1};
    case 13:
      return kSrgbTransfer;
    default:
      return std::nullopt;
  }
}

ColorSpace ColorOfCodePoints(std::string_view chunk, const fs::path& path) {
  if (chunk.size() != 4) throw InputError(path, "its chunk cICP is damaged, expected 4 bytes");
  const uint32_t transfer_code = BigEndian(chunk, 1, 1);
  if (transfer_code == 16 || transfer_code == 18) {
    throw InputError(path, std::string("is coded for HDR screens by ") +
                               (transfer_code == 16 ? "PQ" : "HLG") +
                               ", which is no photographed light; convert it to sRGB or EXR");
  }
  const auto primaries = PrimariesOfCodePoints().find(BigEndian(chunk, 0, 1));
  const auto transfer = TransferOfCodePoint(transfer_code);
  if (primaries == PrimariesOfCodePoints().end() || !transfer || chunk[2] != 0 || chunk[3] != 1) {
    throw InputError(path,
                     "its chunk cICP names colours that are not known here; convert it to sRGB");
  }
  if (chunk[0] == 1 && transfer_code == 13) return {};
  return MakeColorSpace("cICP", primaries->second, *transfer);
}

// gAMA is the exponent of writing times 100 000, cHRM white, red, green and blue times 100 000.
ColorSpace ColorOfGamma(const std::map<std::string, std::string_view>& chunks,
                        const fs::path& path) {
  const auto gamma = chunks.find("gAMA"), corners = chunks.find("cHRM");
  if (gamma == chunks.end() && corners == chunks.end()) return {};
  TransferFunction transfer = kSrgbTransfer;
  if (gamma != chunks.end()) {
    const uint32_t exponent = gamma->second.size() == 4 ? BigEndian(gamma->second, 0, 4) : 0;
    if (exponent < 10000 || exponent > 1000000) {
      throw InputError(path, "its chunk gAMA is damaged, expected about 45455");
    }
    transfer = {100000.0 / exponent};
  }
  Primaries primaries = kRec709;
  if (corners != chunks.end()) {
    if (corners->second.size() != 32) throw InputError(path, "its chunk cHRM is damaged");
    const auto xy = [&](size_t at) {
      return Eigen::Vector2d(BigEndian(corners->second, at, 4) / 1e5,
                             BigEndian(corners->second, at + 4, 4) / 1e5);
    };
    primaries = {xy(8), xy(16), xy(24), xy(0)};
    const Eigen::Matrix3d rec709 = Rec709From(primaries);
    if (!rec709.allFinite() || std::abs(rec709.determinant()) < 1e-6) {
      throw InputError(path, "its chunk cHRM names no triangle of colours");
    }
  }
  return MakeColorSpace("gAMA and cHRM", primaries, transfer);
}

ColorSpace ColorOfPng(std::string_view png, const DecodedHeader& header, const fs::path& path) {
  RequireWholePng(png, path);
  const auto chunks = ChunksOf(png);
  if (const auto points = chunks.find("cICP"); points != chunks.end()) {
    return ColorOfCodePoints(points->second, path);
  }
  if (const auto profile = chunks.find("iCCP"); profile != chunks.end()) {
    return ReadIccProfile(ProfileOfChunk(profile->second, path), header.channels, path);
  }
  if (chunks.contains("sRGB")) return {};
  return ColorOfGamma(chunks, path);
}

// Of a file without profile. Of a TIFF of fewer than 8 bits the decoder gives the bare numbers.
ColorSpace ColorOfExif(const fs::path& path) {
  Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);  // cameras' own oddities are not the user's
  Exiv2::ExifData exif;
  try {
    const auto image = Exiv2::ImageFactory::open(path.string());
    image->readMetadata();
    exif = image->exifData();
  } catch (const Exiv2::Error&) {  // a format without metadata
    return {};
  }
  const auto text = [&](const char* key) {
    const auto entry = exif.findKey(Exiv2::ExifKey(key));
    return entry == exif.end() ? std::string() : entry->toString();
  };
  const std::string photometric = text("Exif.Image.PhotometricInterpretation"),
                    bits = text("Exif.Image.BitsPerSample");
  if ((photometric == "0" || photometric == "1") && (bits == "1" || bits == "2" || bits == "4")) {
    throw InputError(path, "has " + bits + (bits == "1" ? " bit" : " bits") +
                               " a pixel, expected 8 or 16 bits a channel");
  }
  const std::string space = text("Exif.Photo.ColorSpace"),
                    index = text("Exif.Iop.InteroperabilityIndex");
  if (space == "2" || (space != "1" && index.starts_with("R03"))) {
    return MakeColorSpace("Adobe RGB (1998)", kAdobeRgb, {563 / 256.0});
  }
  ColorSpace srgb;
  if (space == "65535" && !index.starts_with("R98")) {
    srgb.assumption =
        "states that its colours are not sRGB (EXIF ColorSpace 65535) but not which they are; they "
        "were taken for sRGB, which can be wrong by 5 in colour difference; put its ICC profile "
        "into the file";
  }
  return srgb;
}

ColorSpace ColorOfChromaticities(const std::vector<float>& xy, const fs::path& path) {
  if (xy.empty()) return {};
  INSITU_CHECK(xy.size() == 8);
  const auto at = [&](int i) { return Eigen::Vector2d(xy[i], xy[i + 1]); };
  const Primaries primaries = {at(0), at(2), at(4), at(6)};
  const Eigen::Matrix3d rec709 = Rec709From(primaries);
  if (!rec709.allFinite() || std::abs(rec709.determinant()) < 1e-6) {
    throw InputError(path, "its chromaticities name no triangle of colours");
  }
  if ((rec709 - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-5) return {};
  const ToneCurve straight(TransferFunction{1});
  ColorSpace space;
  space.name = "chromaticities of its own";
  space.conversion = MatrixConversion({straight, straight, straight}, rec709);
  space.chromaticities = xy;
  return space;
}

}  // namespace

ColorSpace ReadStatedColor(const fs::path& path, const DecodedHeader& header) {
  if (header.profile.size() > kMostProfileBytes) {
    throw InputError(path, "its ICC profile has over 64 MB, which no profile has");
  }
  if (!header.profile.empty()) return ReadIccProfile(header.profile, header.channels, path);
  if (!header.chromaticities.empty()) return ColorOfChromaticities(header.chromaticities, path);
  if (header.is_float) return {};
  const std::string content = ReadWhole(path);
  if (content.starts_with("\x89PNG\r\n\x1a\n")) return ColorOfPng(content, header, path);
  if (content.starts_with("\xff\xd8")) {
    const std::vector<JpegSegment> segments = SegmentsOf(content);
    RequireNoCmyk(segments, path);
    const std::string profile = ProfileOfJpeg(segments, path);
    if (!profile.empty()) return ReadIccProfile(profile, header.channels, path);
  }
  return ColorOfExif(path);
}

}  // namespace insitu
