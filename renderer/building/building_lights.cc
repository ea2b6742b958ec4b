// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/building_lights.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "calibration/files/file_beside.h"
#include "calibration/files/json_file.h"
#include "radiometry/spectrum/spectral_table.h"
#include "renderer/building/ies.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

double Positive(const JsonNode& node) {
  if (!(node.Number() > 0)) throw node.Error("is not above 0");
  return node.Number();
}

double NotNegative(const JsonNode& node) {
  if (node.Number() < 0) throw node.Error("is negative, expected 0 or more");
  return node.Number();
}

SpectralTable SpectrumOf(const JsonNode& light, const MaterialLibrary& library) {
  if (const auto rows = light.Find("spectrum_table")) return ReadSpectralTable(*rows);
  if (const auto file = light.Find("spectrum_file")) return ReadSpectralTable(FileBeside(*file));
  const JsonNode name = light.At("spectrum");
  if (name.Text() != "blackbody") return SpectrumOfLamp(library, name);
  const JsonNode kelvin = light.At("temperature_K");
  if (kelvin.Number() < 500 || kelvin.Number() > 1e5) {
    throw kelvin.Error("is out of range, expected 500 to 100000 K");
  }
  return BlackbodyTable(kelvin.Number());
}

Vector3d Unit(const JsonNode& node) {
  const Vector3d direction = node.Vector3();
  if (direction.norm() == 0) throw node.Error("has no length, expected a direction");
  return direction.normalized();
}

// C = 0 lies over world x as far as the axis allows, turned about the axis.
Matrix3d LampAxes(const Vector3d& axis, double turn_deg) {
  const Vector3d near_x = std::abs(axis.x()) < 0.9 ? Vector3d::UnitX() : Vector3d::UnitY();
  const Vector3d c0 = (near_x - axis.dot(near_x) * axis).normalized();
  const Vector3d c90 = c0.cross(axis);
  const double c = std::cos(turn_deg * kDegree), s = std::sin(turn_deg * kDegree);
  Matrix3d axes;
  axes << c * c0 + s * c90, c * c90 - s * c0, axis;
  return axes;
}

LightDistribution SpotDistribution(const JsonNode& light) {
  const JsonNode half = light.At("half_angle_deg");
  const auto edge = light.Find("edge_deg");
  const double inner = half.Number(), outer = inner + (edge ? NotNegative(*edge) : 0) + 1e-6;
  if (inner <= 0 || outer > 180.001) throw half.Error("is out of range, expected above 0 to 180");
  return {LampAxes(Unit(light.At("direction")), 0), {0, inner, outer}, {0}, {1, 1, 0}};
}

LightDistribution IesDistribution(const JsonNode& light, const JsonNode& file) {
  const auto direction = light.Find("direction"), turn = light.Find("turn_deg");
  const Vector3d axis = direction ? Unit(*direction) : -Vector3d::UnitZ();
  IesPhotometry photometry = ReadIes(FileBeside(file));
  return {LampAxes(axis, turn ? turn->Number() : 0), std::move(photometry.gamma_deg),
          std::move(photometry.c_deg), std::move(photometry.candela)};
}

LightDistribution CosineDistribution(const Vector3d& axis) {
  LightDistribution distribution{LampAxes(axis, 0), {}, {0}, {}};
  for (int degrees = 0; degrees <= 90; degrees += 2) {
    distribution.gamma_deg.push_back(degrees);
    distribution.values.push_back(degrees == 90 ? 0 : std::cos(degrees * kDegree));
  }
  return distribution;
}

// Over all directions [sr]; 4 pi without a distribution.
double SolidAngleOf(const std::optional<LightDistribution>& distribution) {
  if (!distribution) return 4 * std::numbers::pi;
  constexpr int kSteps = 720;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double gamma = (i + 0.5) * std::numbers::pi / kSteps;
    const Vector3d inside(std::sin(gamma), 0, std::cos(gamma));
    sum += distribution->At(distribution->world_from_lamp * inside) * std::sin(gamma);
  }
  return sum * 2 * std::numbers::pi * std::numbers::pi / kSteps;
}

struct Area {
  Vector3d corner, u, v;
  double size() const { return u.cross(v).norm(); }
};

Area AreaOf(const JsonNode& light) {
  const Area area{light.At("position").Vector3(), light.At("edge_u").Vector3(),
                  light.At("edge_v").Vector3()};
  if (area.size() == 0) throw light.Error("is an area light whose edges span no area");
  return area;
}

// In candela at distribution 1, as a whole.
double CandelaOf(const JsonNode& light, const PointLight& lamp, const std::optional<Area>& area) {
  if (light.Find("ies")) {
    const auto dimming = light.Find("dimming");
    return dimming ? NotNegative(*dimming) : 1;
  }
  if (const auto candela = light.Find("luminous_intensity_cd")) return NotNegative(*candela);
  if (const auto lumen = light.Find("luminous_flux_lm")) {
    return NotNegative(*lumen) / SolidAngleOf(lamp.distribution);
  }
  const auto luminance = light.Find("luminance_cd_m2");
  if (luminance && area) return NotNegative(*luminance) * area->size();
  throw light.Error(
      "names no strength, expected intensity_rgb, luminous_intensity_cd, luminous_flux_lm, ies or, "
      "of an area, luminance_cd_m2");
}

// What the lamps of a file share.
struct LampContext {
  std::optional<double> site_luminance;  // [cd/m^2]
  const MaterialLibrary& library;
};

void ReadStrength(const JsonNode& light, const LampContext& context,
                  const std::optional<Area>& area, PointLight* lamp) {
  if (const auto rgb = light.Find("intensity_rgb")) {
    lamp->intensity_rgb = rgb->Vector3();
    if (lamp->intensity_rgb.minCoeff() < 0) {
      throw rgb->Error("is negative, expected a radiant intensity of 0 or more");
    }
    return;
  }
  lamp->spectrum = SpectrumOf(light, context.library);
  lamp->candela = CandelaOf(light, *lamp, area);
  lamp->intensity_rgb = Vector3d::Zero();
  if (context.site_luminance) {
    lamp->intensity_rgb = ColorOfLight(lamp->spectrum) * (lamp->candela / *context.site_luminance);
  }
}

// An area light as lamps over it, just before its surface.
std::vector<PointLight> Spread(const JsonNode& light, const PointLight& whole, const Area& area) {
  constexpr double kClearance = 0.01;  // [m]
  const auto node = light.Find("samples");
  const int samples = node ? node->Integer() : 4;
  if (samples < 1 || samples > 32) throw node->Error("is out of range, expected 1 to 32");
  const Vector3d normal = area.u.cross(area.v).normalized();
  std::vector<PointLight> lamps;
  for (int i = 0; i < samples * samples; ++i) {
    PointLight lamp = whole;
    const int row = i / samples, column = i % samples;
    const double s = (column + 0.5) / samples, t = (row + 0.5) / samples;
    lamp.name.append(" ").append(std::to_string(i + 1));
    lamp.position = area.corner + s * area.u + t * area.v + kClearance * normal;
    lamp.intensity_rgb /= samples * samples;
    lamp.candela /= samples * samples;
    lamp.edge_u = area.u / samples;
    lamp.edge_v = area.v / samples;
    lamps.push_back(std::move(lamp));
  }
  return lamps;
}

void AddLight(const JsonNode& light, const LampContext& context, std::vector<PointLight>* lights) {
  const auto type_node = light.Find("type");
  const std::string type = type_node ? type_node->Text() : "point";
  const auto ies = light.Find("ies");
  if (type != "point" && type != "spot" && type != "area" && type != "ies") {
    throw type_node->Error("is \"" + type + "\", expected point, spot, area or ies");
  }
  if (type == "ies" && !ies) throw light.Error("is of type ies, expected \"ies\": its file");
  PointLight lamp{light.At("name").Text(), light.At("position").Vector3(), {}};
  std::optional<Area> area;
  if (type == "spot") lamp.distribution = SpotDistribution(light);
  if (type == "area") {
    area = AreaOf(light);
    lamp.distribution = CosineDistribution(area->u.cross(area->v).normalized());
  }
  if (ies) lamp.distribution = IesDistribution(light, *ies);
  ReadStrength(light, context, area, &lamp);
  if (const auto radius = light.Find("radius_m")) lamp.radius = NotNegative(*radius);
  const auto visible = light.Find("visible");
  lamp.is_visible = visible && visible->Boolean();
  if (lamp.is_visible && !area && lamp.radius == 0) {
    throw visible->Error("is true of a lamp without a size, expected radius_m above 0");
  }
  if (!area) {
    lights->push_back(std::move(lamp));
    return;
  }
  for (PointLight& part : Spread(light, lamp, *area)) lights->push_back(std::move(part));
}

std::optional<double> SiteLuminance(const JsonNode& root) {
  const auto node = root.Find("site_luminance_cd_m2");
  return node ? std::optional(Positive(*node)) : std::nullopt;
}

// glTF's cones: full strength within the inner, none beyond the outer one.
LightDistribution ConeDistribution(const ModelLamp& lamp) {
  const double inner = std::clamp(lamp.inner_deg.value_or(0), 1e-6, 179.0);
  const double outer = std::clamp(*lamp.outer_deg, inner + 1e-6, 180.0);
  return {LampAxes(lamp.direction, 0), {0, inner, outer}, {0}, {1, 1, 0}};
}

}  // namespace

std::vector<PointLight> LightsOfModel(const std::vector<ModelLamp>& lamps, const fs::path& path) {
  std::optional<double> luminance;
  if (fs::exists(path)) luminance = SiteLuminance(JsonNode::Load(path));
  std::vector<PointLight> lights;
  for (const ModelLamp& lamp : lamps) {
    PointLight light{lamp.name, lamp.position, Vector3d::Zero()};
    light.candela = lamp.candela;
    if (luminance) light.intensity_rgb = lamp.rgb * (lamp.candela / *luminance);
    if (lamp.outer_deg) light.distribution = ConeDistribution(lamp);
    lights.push_back(std::move(light));
  }
  return lights;
}

std::vector<PointLight> ReadLights(const fs::path& path, const MaterialLibrary& library) {
  const JsonNode root = JsonNode::Load(path);
  const LampContext context{SiteLuminance(root), library};
  std::vector<PointLight> lights;
  for (const JsonNode& light : root.At("lights").Items()) AddLight(light, context, &lights);
  return lights;
}

}  // namespace insitu
