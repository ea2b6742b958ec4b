// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/reconstruction_figures.h"

#include "tests/reconstruction/network/network_statistics.h"

namespace insitu {

Json::Value CoverageFigures(const std::filesystem::path&) {
  const NetworkStatistics statistics = SampleNetworkStatistics(500);
  Json::Value json;
  json["pose"] = statistics.coverage_95.pose;
  json["vertex"] = statistics.coverage_95.vertex;
  json["plane"] = statistics.coverage_95.plane;
  json["sun"] = statistics.coverage_95.sun;
  json["zenith"] = statistics.coverage_95.zenith;
  json["mean_sigma0"] = statistics.mean_sigma0;
  json["w_false_alarms_at_5_percent"] = statistics.false_alarm_share;
  json["global_test_rejected_at_5_percent"] = statistics.global_test_share;
  json["blunders_of_twice_the_detectable_bias_found"] = statistics.found_blunder_share;
  return json;
}

const std::vector<ReconstructionFigure>& ReconstructionFigures() {
  static const std::vector<ReconstructionFigure> kFigures = {
      {"coverage_95", "", CoverageFigures},
      {"jaicov_aicon", "adjustment/jaicov_aicon", AiconFigures},
      {"dbat_camcal", "calibration/dbat_camcal_c4040z", DbatCamcalFigures},
      {"sxb_aerial", "adjustment/sxb_aerial", SxbFigures},
      {"roma_arch", "adjustment/roma_arch", RomaFigures},
      {"micmac_stonewall_gcp", "scenes/micmac_stonewall_gcp", StonewallFigures},
      {"opensfm_berlin_cathedral", "scenes/opensfm_berlin_cathedral", BerlinFigures},
      {"gallery", "gallery", GalleryFigures},
  };
  return kFigures;
}

}  // namespace insitu
