// SPDX-License-Identifier: GPL-3.0-or-later
// Photographs as files: decoding to linear light and the exact inverse, whole-or-nothing writing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "calibration/photo/raster.h"

namespace insitu {

// How a file's numbers relate to linear light. sRGB codes decode through one table and encode to
// the nearest code, so that Encode(Decode(code)) == code for every code.
enum class Encoding { kSrgb8, kSrgb16, kLinear };

struct Photograph {
  Raster linear;  // Rec. 709, three channels
  Encoding encoding = Encoding::kSrgb8;
};

// [0, 1] -> [0, 1], IEC 61966-2-1.
double LinearFromSrgb(double encoded);
double SrgbFromLinear(double linear);

// JPEG, PNG, TIFF (sRGB) or EXR (linear); grey becomes three equal channels.
// Throws InputError: missing, not an image, cut short, NaN or infinite values.
Photograph ReadPhotograph(const std::filesystem::path& path);

// The same, as its file has it: sRGB codes of 8 or 16 bits, or linear values; three channels, rows
// of red, green and blue.
struct CodedPhotograph {
  int width = 0, height = 0;  // [px]
  std::variant<std::vector<uint8_t>, std::vector<uint16_t>, std::vector<float>> samples;
};
CodedPhotograph ReadCodedPhotograph(const std::filesystem::path& path);

// (width, height) [px] from the file's header alone. Throws InputError: missing, not an image.
Eigen::Vector2i ReadPhotographSize(const std::filesystem::path& path);

// "640x480 px"
std::string SizeText(int width, int height);

// Throws InputError if a photograph is of another size than its camera's [px].
void RequirePhotographSize(const std::filesystem::path& path, int width, int height);

// Whether the sensor clipped here: a channel at its highest code (never for linear files).
bool IsClipped(const Photograph& photo, int x, int y);

// Each writes a temporary file and renames it. Values outside [0, 1] are clamped by PNG and JPEG.
void WriteExr(const std::filesystem::path& path, const Raster& linear);  // 32-bit float
void WritePng(const std::filesystem::path& path, const Raster& linear, Encoding encoding);
// Quality 95, no chroma subsampling; EXIF, XMP and ICC are copied from `metadata_source` if it has
// any (an EXR has none).
void WriteJpeg(const std::filesystem::path& path, const Raster& linear,
               const std::filesystem::path& metadata_source);

}  // namespace insitu
