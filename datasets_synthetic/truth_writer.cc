// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/truth_writer.h"

#include <json/value.h>
#include <tbb/parallel_invoke.h>

#include "calibration/files/json_file.h"
#include "calibration/photo/photograph.h"

namespace insitu::demo {
namespace {

using Eigen::Vector3d;

Json::Value VectorJson(const Eigen::VectorXd& vector) { return ToJson(vector); }

Json::Value LensJson(const Lens& lens) {
  Eigen::VectorXd intrinsics(12);
  intrinsics << lens.focal_x, lens.focal_y, lens.center_x, lens.center_y,
      Eigen::Map<const Eigen::VectorXd>(lens.distortion.data(), 8);
  Json::Value json;
  json["model"] = "LENSMODEL_OPENCV8";
  json["intrinsics"] = VectorJson(intrinsics);
  json["width"] = lens.width;
  json["height"] = lens.height;
  return json;
}

Json::Value AirJson(const Daylight& daylight) {
  constexpr double kDistance = 100;  // [m]
  Json::Value json;
  json["horizon_rgb"] = VectorJson(RgbFromSpectrum(daylight.sky_radiance));
  json["transmittance_per_metre_rgb"] = VectorJson(EffectiveTransmittance(daylight, kDistance));
  json["over_metres"] = kDistance;
  return json;
}

// A mask holds codes / 255; PNG's sRGB curve must give the codes back.
Raster EncodableMask(const Raster& mask) {
  Raster encodable = mask;
  for (float& value : encodable.data) value = static_cast<float>(LinearFromSrgb(value));
  return encodable;
}

}  // namespace

void WriteTruthImages(const std::filesystem::path& folder, const View& view,
                      const RenderedView& rendering) {
  tbb::parallel_invoke(
      [&] { WriteExr(folder / ("before_" + view.photo + ".exr"), rendering.before); },
      [&] { WriteExr(folder / ("after_" + view.photo + ".exr"), rendering.after); });
  WritePng(folder / ("mask_" + view.photo + ".png"), EncodableMask(rendering.mask),
           Encoding::kSrgb8);
}

void WriteTruth(const std::filesystem::path& path, const Site& site, const FieldSurvey& survey,
                const Daylight& daylight) {
  Json::Value root;
  root["sun"] = VectorJson(site.sun);
  root["zenith"] = VectorJson(site.zenith);
  root["lens"] = LensJson(site.views[0].lens);
  for (const View& view : site.views) {
    Json::Value& pose = root["photos"][view.photo];
    pose["center"] = VectorJson(site.origin + view.center);
    pose["cam_from_world_rotation"] = ToJson(Eigen::MatrixXd(view.cam_from_site));
  }
  root["air"] = AirJson(daylight);
  root["light"]["sun_irradiance_rgb"] = VectorJson(RgbFromSpectrum(daylight.sun_irradiance));
  root["light"]["sky_radiance_rgb"] = VectorJson(RgbFromSpectrum(daylight.sky_radiance));
  for (const SurveyPoint& point : survey.points) {
    root["points"][point.name] = VectorJson(site.origin + point.position);
  }
  WriteJson(path, root);
}

}  // namespace insitu::demo
