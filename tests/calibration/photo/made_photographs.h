// SPDX-License-Identifier: GPL-3.0-or-later
// Small photographs and profiles as other programs write them.
#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "calibration/color/color_space.h"

namespace insitu {

inline const Primaries kDisplayP3 = {
    {0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.3127, 0.3290}};

// An RGB display profile of matrix and curves, of version 2 or 4.
std::string MadeProfile(const Primaries& primaries, const TransferFunction& transfer,
                        double version = 4);
// A camera's profile that has nothing but a table of 17 x 17 x 17 Lab colours: those of P3.
std::string MadeTableProfile();
std::string MadeGreyProfile(double gamma);
std::string MadeLinkProfile();  // of a class that no picture may hold
std::string MadeCmykProfile();

// Pixels of a file by OpenImageIO, with what `describe` states in it.
template <typename Sample>
void WriteMade(const std::filesystem::path& path, int width, int channels,
               const std::vector<Sample>& samples, const std::string& profile = "",
               const std::function<void(OIIO::ImageSpec*)>& describe = {}) {
  const int height = static_cast<int>(samples.size()) / channels / width;
  OIIO::ImageSpec spec(width, height, channels, OIIO::BaseTypeFromC<Sample>::value);
  if (!profile.empty()) {
    spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, profile.size()),
                   profile.data());
  }
  if (describe) describe(&spec);
  const auto output = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(output);
  ASSERT_TRUE(output->open(path.string(), spec)) << output->geterror();
  ASSERT_TRUE(output->write_image(spec.format, samples.data()));
  ASSERT_TRUE(output->close());
}

// Of one colour, without a profile.
void WriteCmykJpeg(const std::filesystem::path& path);

// Puts a chunk into a PNG, after its header.
void InsertChunk(const std::filesystem::path& png, const std::string& name,
                 const std::string& content, size_t at = 33);
std::string ChunkInteger(uint32_t value);  // its four bytes
std::string Deflated(const std::string& text);

// Codes of P3 from codes of sRGB, both of 16 bits, as LittleCMS counts them.
std::vector<uint16_t> P3FromSrgb(const std::vector<uint16_t>& srgb);

// Different colours, of `pixels` pixels.
template <typename Code>
std::vector<Code> ManyColors(int pixels) {
  std::vector<Code> codes;
  uint32_t state = 1;
  for (int i = 0; i < 3 * pixels; ++i) {
    state = state * 1664525 + 1013904223;
    codes.push_back(static_cast<Code>(state >> 16));
  }
  return codes;
}

}  // namespace insitu
