// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/survey_writer.h"

#include <json/value.h>

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <string>

#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "datasets_synthetic/random.h"

namespace insitu::demo {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

__attribute__((format(printf, 1, 2))) std::string Line(const char* format, ...) {
  char text[300];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

std::string ControlTable(const Site& site, const FieldSurvey& survey, double sigma) {
  std::string table = "name,x,y,z,sigma_x,sigma_y,sigma_z,role\n";
  Random random(11, 0, 0);
  for (const SurveyPoint& point : survey.points) {
    if (point.role == PointRole::kMarked) continue;
    Vector3d measured = site.origin + point.position;
    for (int axis = 0; axis < 3; ++axis) measured[axis] += sigma * random.Gaussian();
    table += Line("%s,%.4f,%.4f,%.4f,%.3f,%.3f,%.3f,%s\n", point.name.c_str(), measured.x(),
                  measured.y(), measured.z(), sigma, sigma, sigma,
                  point.role == PointRole::kCheck ? "check" : "control");
  }
  return table;
}

std::string MarkTable(const Site& site, const FieldSurvey& survey, double sigma) {
  std::string table = "photo,point,x,y,sigma\n";
  Random random(12, 0, 0);
  for (size_t view = 0; view < site.views.size(); ++view) {
    for (const SurveyPoint& point : survey.points) {
      for (const Mark& mark : point.marks) {
        if (mark.view != static_cast<int>(view)) continue;
        const double x = mark.pixel.x() + sigma * random.Gaussian();
        const double y = mark.pixel.y() + sigma * random.Gaussian();
        table += Line("%s,%s,%.3f,%.3f,%.1f\n", site.views[view].photo.c_str(), point.name.c_str(),
                      x, y, sigma);
      }
    }
  }
  return table;
}

Json::Value PixelsJson(const Site& site, const std::vector<ChosenPixel>& pixels) {
  Json::Value array(Json::arrayValue);
  for (const ChosenPixel& pixel : pixels) {
    Json::Value entry;
    entry["photo"] = site.views[pixel.view].photo;
    entry["x"] = pixel.x;
    entry["y"] = pixel.y;
    if (!pixel.polygon.empty()) entry["polygon"] = pixel.polygon;
    array.append(entry);
  }
  return array;
}

Json::Value BumpsJson(const Waves& waves) {
  Json::Value bumps;
  bumps["rms_slope"] = waves.rms_slope;
  bumps["scale_m"] = waves.longest;
  bumps["shortest_m"] = waves.shortest;
  bumps["spectrum"] = 0.0;
  return bumps;
}

Json::Value PairsJson(const std::vector<NamePair>& pairs, const char* first, const char* second) {
  Json::Value array(Json::arrayValue);
  for (const auto& [a, b] : pairs) {
    Json::Value entry;
    entry[first] = a;
    entry[second] = b;
    array.append(entry);
  }
  return array;
}

}  // namespace

void WriteMeasurements(const std::filesystem::path& folder, const Site& site,
                       const FieldSurvey& survey, const MeasuringNoise& noise) {
  WriteWhole(folder / "control_points.csv", ControlTable(site, survey, noise.control_m));
  WriteWhole(folder / "observations.csv", MarkTable(site, survey, noise.mark_px));
}

void WritePolygons(const std::filesystem::path& path, const Site& site,
                   const std::vector<int>& best_views) {
  Json::Value root;
  for (size_t i = 0; i < site.natural.faces.size(); ++i) {
    const Face& face = site.natural.faces[i];
    Json::Value polygon;
    polygon["name"] = face.name;
    for (const std::string& vertex : face.vertex_names) polygon["vertices"].append(vertex);
    polygon["photo"] =
        best_views[i] < 0 ? Json::Value() : Json::Value(site.views[best_views[i]].photo);
    polygon["material"] = MaterialName(face.material);
    polygon["mask"] = Json::Value();
    root["polygons"].append(polygon);
  }
  WriteJson(path, root);
}

void WriteDirections(const std::filesystem::path& path, const FieldSurvey& survey) {
  Json::Value root;
  root["sun"] = PairsJson(survey.sun_pairs, "object", "shadow");
  root["zenith"] = PairsJson(survey.zenith_pairs, "bottom", "top");
  WriteJson(path, root);
}

void WriteSamples(const std::filesystem::path& path, const Site& site, const ChosenSamples& samples,
                  const Daylight& daylight) {
  Json::Value root;
  root["horizon"] = PixelsJson(site, samples.horizon);
  if (!samples.haze.empty()) root["haze"] = PixelsJson(site, samples.haze);  // else clear air
  root["daylight"] = PixelsJson(site, samples.daylight);
  const Vector3d card = ReflectanceRgb(daylight, PlainReflectance(site.survey.daylight));
  for (const double value : card) {
    root["daylight_reflectance_rgb"].append(std::round(value * 1e4) / 1e4);
  }
  WriteJson(path, root);
}

void WriteNaturalMaterials(const std::filesystem::path& path, const Site& site) {
  Json::Value root;
  for (const Face& face : site.natural.faces) {
    Json::Value& material = root["materials"][MaterialName(face.material)];
    const double index = MirrorIndex(face.material);
    material["specular"] = index > 0 ? "fresnel" : "none";
    material["specular_weight"] = index > 0 ? 1.0 : 0.0;
    material["ior"] = index > 0 ? Json::Value(index) : Json::Value();
    material["roughness"] = index > 0 ? Json::Value(0.0) : Json::Value();
    material["diffuse"] = "from photo";
    if (face.material == Material::kWater && site.waves.rms_slope > 0) {
      material["bumps"] = BumpsJson(site.waves);
    }
  }
  WriteJson(path, root);
}

void WriteSiteDescription(const std::filesystem::path& path, const Site& site) {
  Json::Value root;
  root["name"] = site.record.name;
  root["latitude"] = site.record.latitude;
  root["longitude"] = site.record.longitude;
  root["altitude_m"] = site.origin.z();
  root["true_north"] = ToJson(Eigen::VectorXd(site.true_north));
  root["frame"] = "right-handed metres; z roughly up";
  root["local_time"] = site.record.local_time;
  root["sky"] = site.record.sky;
  root["film"] = "sRGB curve on linear Rec.709";
  WriteJson(path, root);
}

}  // namespace insitu::demo
