// SPDX-License-Identifier: GPL-3.0-or-later
// What a photograph's file states of its colours, wherever its format has a place for it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/color/color_space.h"

namespace insitu {

// What the decoder tells of a file.
struct DecodedHeader {
  int channels = 3;                   // of colour: 1 or 3
  bool is_float = false;              // numbers, no codes
  std::string profile;                // a TIFF's
  std::vector<float> chromaticities;  // an EXR's, 8 numbers; empty: none
};

// PNG: cICP before iCCP before sRGB before gAMA with cHRM [PNG 3rd edition, 4.3]; others: the ICC
// profile before EXIF's colour space with its interoperability index [DCF 2.0]; EXR:
// chromaticities. Throws InputError: a profile that is damaged or of other channels, a transfer
// function that is no photograph's.
ColorSpace ReadStatedColor(const std::filesystem::path& path, const DecodedHeader& header);

}  // namespace insitu
