// SPDX-License-Identifier: GPL-3.0-or-later
// Appendix A of the paper in a page: which spectra stand behind colours.
#pragma once

#include <json/value.h>

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "radiometry/spectrum/color.h"

namespace insitu {

struct RgbSpace {
  std::string key, name;  // "ntsc", "NTSC 1953"
  RgbPrimaries primaries;
};
const std::vector<RgbSpace>& RgbSpaces();  // NTSC, Rec. 709, Display P3, Rec. 2020

struct SpectraRequest {
  Eigen::Vector3d rgb = {0.8, 0.5, 0.2};  // linear, 0..1
  std::string space = "rec709";           // of rgb, a key of RgbSpaces()
  int bins = kMaxBins;                    // 9, or 16

  // Throws InputError that names the option: rgb beyond 0..1 or black, a space that is none.
  void Check() const;
};

// Its JSON: the spectrum locus and the spaces' triangles [Durisch92, Fig. 8]; of each space the
// basis functions that both branches of the search find; metamers of the colour, one a space
// [Durisch92, Fig. 9]; and the round trip RGB -> spectrum -> RGB.
Json::Value SpectraReport(const SpectraRequest& request);

// The same in lines for the terminal.
std::string BriefSpectra(const Json::Value& report);

void WriteSpectraPage(const std::filesystem::path& html, const Json::Value& report);

}  // namespace insitu
