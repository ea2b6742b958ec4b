// SPDX-License-Identifier: GPL-3.0-or-later
// A photograph as another camera or program would have written it, for the end-to-end tests.
//   write_photograph SPACE SOURCE TARGET
// SPACE: srgb, p3, adobe, prophoto, linear; or raw, a DNG, and unknown_raw, one without the colours
// of its camera. Depth as TARGET's format has it: 8 bits of a JPEG, else 16.
#include <exception>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>

#include "calibration/color/icc_profile.h"
#include "calibration/photo/photograph.h"
#include "tests/calibration/photo/made_raw.h"

namespace insitu {
namespace {

const Primaries kDisplayP3 = {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.3127, 0.3290}};
const Primaries kAdobeRgb = {{0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}, {0.3127, 0.3290}};
const Primaries kProPhoto = {
    {0.7347, 0.2653}, {0.1596, 0.8404}, {0.0366, 0.0001}, {0.3457, 0.3585}};

ColorSpace SpaceOf(const std::string& name) {
  if (name == "srgb") return {};
  if (name == "p3") return MakeColorSpace("Display P3", kDisplayP3, kSrgbTransfer);
  if (name == "adobe") return MakeColorSpace("Adobe RGB (1998)", kAdobeRgb, {563 / 256.0});
  if (name == "prophoto") return MakeColorSpace("ProPhoto RGB", kProPhoto, {1.8});
  if (name == "linear") return MakeColorSpace("linear Rec. 709", kRec709, {1});
  throw std::runtime_error("no colour space " + name);
}

void WritePhotograph(const std::string& space, const std::string& source,
                     const std::string& target) {
  const Raster linear = ReadPhotograph(source).linear;
  if (space == "raw" || space == "unknown_raw") {
    MadeRaw raw{linear.width, linear.height,
                [&](int x, int y) -> Eigen::Vector3d { return linear.Rgb(x, y); }};
    raw.has_colors = space == "raw";
    WriteMadeRaw(target, raw);
    return;
  }
  const bool is_jpeg = target.ends_with(".jpg");
  WriteCodes(target,
             CodesOf(linear, is_jpeg ? Encoding::kSrgb8 : Encoding::kSrgb16, SpaceOf(space)));
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) {
  try {
    if (argc != 4) throw std::runtime_error("expected SPACE SOURCE TARGET");
    insitu::WritePhotograph(argv[1], argv[2], argv[3]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "write_photograph: " << error.what() << "\n";
    return 2;
  }
}
