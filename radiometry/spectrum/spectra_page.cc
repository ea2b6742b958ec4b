// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/spectrum/spectra_page.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"
#include "calibration/program/report_page.h"
#include "radiometry/spectrum/rgb_to_spectrum.h"
#include "radiometry/spectrum/spectra_page_script.h"

namespace insitu {
namespace {

Json::Value ListOf(const Eigen::Ref<const Eigen::VectorXd>& values) {
  Json::Value list(Json::arrayValue);
  for (const double value : values) list.append(value);
  return list;
}

// The value of each bin that is used.
Json::Value BinsOf(const Spectrum& spectrum, const SpectralBins& bins) {
  return ListOf(spectrum.head(bins.count).matrix());
}

Json::Value LocusJson() {
  Json::Value locus(Json::arrayValue);
  for (const SpectralColor& color : SpectrumLocus()) {
    Json::Value json;
    json["nm"] = color.wavelength;
    json["xy"] = ListOf(color.chromaticity);
    locus.append(json);
  }
  return locus;
}

Json::Value CandidateJson(const PiecewiseBasis& basis, const Eigen::Vector3d& target,
                          const SpectralBins& bins) {
  Json::Value json;
  json["spectrum"] = BinsOf(Evaluate(basis, bins), bins);
  json["transitions_nm"] = ListOf(Eigen::Vector2d(bins.Edge(basis.second), bins.Edge(basis.third)));
  json["weights"] = ListOf(basis.weights);
  json["off"] = (Tristimulus(Evaluate(basis, bins), bins) - target).norm();
  return json;
}

// Both branches of the search, whichever counts.
Json::Value BasesJson(const RgbPrimaries& primaries, const SpectralBins& bins) {
  const Eigen::Matrix3d primary_xyz = RgbFromXyz(primaries).inverse();
  Json::Value list(Json::arrayValue);
  for (int channel = 0; channel < 3; ++channel) {
    const Eigen::Vector3d target = primary_xyz.col(channel);
    const auto exact = FindExactBasis(target, bins);
    Json::Value json;
    json["primary"] = std::vector<const char*>{"red", "green", "blue"}[channel];
    json["exact"] = exact ? CandidateJson(*exact, target, bins) : Json::Value();
    json["box"] = CandidateJson(FindNearestBox(target, bins), target, bins);
    list.append(json);
  }
  return list;
}

// Over all colours of a cube of steps: the worst error of a channel, and the lowest radiance there
// is relative to the spectrum's peak, 0 where none is negative.
Json::Value RoundTripJson(const SpectralBasis& basis) {
  constexpr int kCubeSteps = 16, kSide = kCubeSteps + 1;
  double worst = 0, lowest = 0;
  for (int index = 1; index < kSide * kSide * kSide; ++index) {
    const Eigen::Vector3i steps(index % kSide, index / kSide % kSide, index / kSide / kSide);
    const Eigen::Vector3d rgb = steps.cast<double>() / kCubeSteps;
    const Spectrum spectrum = basis.SpectrumFromRgb(rgb);
    worst = std::max(worst, (basis.RgbFromSpectrum(spectrum) - rgb).cwiseAbs().maxCoeff());
    lowest = std::min(lowest, spectrum.minCoeff() / spectrum.maxCoeff());
  }
  Json::Value json;
  json["worst"] = worst;
  json["lowest"] = lowest;
  return json;
}

Json::Value MetamerJson(const RgbSpace& space, const Eigen::Vector3d& tristimulus,
                        const SpectralBins& bins) {
  const Eigen::Vector3d rgb = RgbFromXyz(space.primaries) * tristimulus;
  const Spectrum spectrum = SpectralBasis(space.primaries, bins).SpectrumFromRgb(rgb);
  Json::Value json;
  json["space"] = space.name;
  json["rgb"] = ListOf(rgb);
  json["is_inside"] = rgb.minCoeff() >= -1e-9;
  json["spectrum"] = BinsOf(spectrum, bins);
  json["off"] = (Tristimulus(spectrum, bins) - tristimulus).norm();
  return json;
}

Json::Value SpaceJson(const RgbSpace& space, const SpectralBins& bins) {
  Json::Value json;
  json["key"] = space.key;
  json["name"] = space.name;
  json["red"] = ListOf(space.primaries.red);
  json["green"] = ListOf(space.primaries.green);
  json["blue"] = ListOf(space.primaries.blue);
  json["white"] = ListOf(space.primaries.white);
  json["bases"] = BasesJson(space.primaries, bins);
  json["round_trip"] = RoundTripJson(SpectralBasis(space.primaries, bins));
  return json;
}

const RgbSpace& SpaceOf(const std::string& key) {
  const auto& spaces = RgbSpaces();
  const auto found = std::ranges::find(spaces, key, &RgbSpace::key);
  INSITU_CHECK(found != spaces.end());
  return *found;
}

}  // namespace

const std::vector<RgbSpace>& RgbSpaces() {
  static const std::vector<RgbSpace> spaces = {{"ntsc", "NTSC 1953", Ntsc1953()},
                                               {"rec709", "Rec. 709 (sRGB)", Rec709()},
                                               {"p3", "Display P3", DisplayP3()},
                                               {"rec2020", "Rec. 2020", Rec2020()}};
  return spaces;
}

void SpectraRequest::Check() const {
  if (!rgb.allFinite() || rgb.minCoeff() < 0 || rgb.maxCoeff() > 1) {
    throw InputError("--rgb", "has a value outside 0 to 1: it is linear red, green and blue");
  }
  if (rgb.maxCoeff() == 0) throw InputError("--rgb", "is black, which has no spectrum to show");
  if (std::ranges::find(RgbSpaces(), space, &RgbSpace::key) == RgbSpaces().end()) {
    throw InputError("--space", "'" + space + "', expected ntsc, rec709, p3 or rec2020");
  }
  if (bins != 9 && bins != kMaxBins) throw InputError("--bins", "is not 9 or 16");
}

Json::Value SpectraReport(const SpectraRequest& request) {
  request.Check();
  const SpectralBins bins{request.bins};
  const RgbSpace& own = SpaceOf(request.space);
  const Eigen::Vector3d tristimulus = RgbFromXyz(own.primaries).inverse() * request.rgb;
  Json::Value report;
  report["edges_nm"] =
      ListOf(Eigen::VectorXd::LinSpaced(bins.count + 1, bins.Edge(0), bins.Edge(bins.count)));
  report["locus"] = LocusJson();
  for (const RgbSpace& space : RgbSpaces()) {
    report["spaces"].append(SpaceJson(space, bins));
    report["metamers"].append(MetamerJson(space, tristimulus, bins));
  }
  report["color"]["rgb"] = ListOf(request.rgb);
  report["color"]["space"] = own.name;
  report["color"]["xyz"] = ListOf(tristimulus);
  report["color"]["xy"] = ListOf(Chromaticity(tristimulus).head<2>());
  return report;
}

std::string BriefSpectra(const Json::Value& report) {
  std::ostringstream out;
  for (const Json::Value& space : report["spaces"]) {
    out << space["name"].asString() << "\n";
    for (const Json::Value& basis : space["bases"]) {
      const bool is_exact = !basis["exact"].isNull();
      const Json::Value& used = is_exact ? basis["exact"] : basis["box"];
      out << Formatted("  %-6s %-11s %.0f nm, %.0f nm  weights %.4f %.4f %.4f",
                       basis["primary"].asCString(), is_exact ? "exact" : "nearest box",
                       used["transitions_nm"][0].asDouble(), used["transitions_nm"][1].asDouble(),
                       used["weights"][0].asDouble(), used["weights"][1].asDouble(),
                       used["weights"][2].asDouble());
      out << (is_exact ? "\n" : Formatted("  off by %.4f\n", used["off"].asDouble()));
    }
    out << Formatted("  round trip: %.1e at worst; lowest radiance %.2f %% of the peak\n",
                     space["round_trip"]["worst"].asDouble(),
                     100 * space["round_trip"]["lowest"].asDouble());
  }
  return out.str();
}

void WriteSpectraPage(const std::filesystem::path& html, const Json::Value& report) {
  WriteWhole(html, ReportPage("Spectra behind colours", report, kSpectraPageScript));
}

}  // namespace insitu
