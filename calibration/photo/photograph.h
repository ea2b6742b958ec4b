// SPDX-License-Identifier: GPL-3.0-or-later
// Photographs as files: decoding to linear light and the exact inverse, whole-or-nothing writing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "calibration/color/color_space.h"
#include "calibration/photo/raster.h"

namespace insitu {

// How a file holds its numbers: codes of 8 or 16 bits, which sRGB or the photograph's own colour
// space makes light of, or floating-point numbers. sRGB codes decode through one table and encode
// to the nearest code, so that Encode(Decode(code)) == code for every code.
enum class Encoding { kSrgb8, kSrgb16, kLinear };

struct Photograph {
  Raster linear;  // Rec. 709, three channels; colours beyond are negative or above 1
  Encoding encoding = Encoding::kSrgb8;
  ColorSpace color = {};  // of the file
};

// JPEG, PNG, TIFF, EXR or a camera's raw (raw_photograph.h), in the colour space that the file
// states and with the response that response.json beside it states (response.h); grey becomes three
// equal channels. Throws InputError: missing, not an image, cut short, over 536 megapixels, NaN or
// infinite values, CMYK, Lab or other colours than grey and RGB, a profile that is damaged or
// another one's.
Photograph ReadPhotograph(const std::filesystem::path& path);

// The same, as its file has it: codes of 8 or 16 bits, or numbers, in its colour space; three
// channels, rows of red, green and blue.
struct CodedPhotograph {
  int width = 0, height = 0;  // [px]
  std::variant<std::vector<uint8_t>, std::vector<uint16_t>, std::vector<float>> samples;
  ColorSpace color = {};
};
CodedPhotograph ReadCodedPhotograph(const std::filesystem::path& path);

// The colour space alone. Throws InputError as ReadPhotograph does of it.
ColorSpace ReadPhotographColor(const std::filesystem::path& path);

// The nearest codes of `encoding` in a colour space, or its numbers. Where `is_wanted`, if given,
// says no of a pixel (x, y), it stays 0.
CodedPhotograph CodesOf(const Raster& linear, Encoding encoding, const ColorSpace& color,
                        const std::function<bool(int x, int y)>& is_wanted = {});

// Writes them, with the colour space stated, into a file of the format of its name's ending.
// Throws std::runtime_error.
void WriteCodes(const std::filesystem::path& path, const CodedPhotograph& picture);

// (width, height) [px] from the file's header alone. Throws InputError: missing, not an image.
Eigen::Vector2i ReadPhotographSize(const std::filesystem::path& path);

// "640x480 px"
std::string SizeText(int width, int height);

// Throws InputError if a photograph is of another size than its camera's [px].
void RequirePhotographSize(const std::filesystem::path& path, int width, int height);

// Whether the sensor clipped here: a channel at its highest code (never for linear files).
bool IsClipped(const Photograph& photo, int x, int y);

// Each writes a temporary file and renames it, of three channels, a grey raster's alike. Values
// outside [0, 1] are clamped by PNG and JPEG.
void WriteExr(const std::filesystem::path& path, const Raster& linear);  // 32-bit float
void WritePng(const std::filesystem::path& path, const Raster& linear, Encoding encoding);
// sRGB, quality 95, no chroma subsampling; EXIF, XMP and ICC are copied from `metadata_source` if
// it has any (an EXR has none).
void WriteJpeg(const std::filesystem::path& path, const Raster& linear,
               const std::filesystem::path& metadata_source);

}  // namespace insitu
