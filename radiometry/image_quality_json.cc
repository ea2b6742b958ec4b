// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/image_quality_json.h"

namespace insitu {
namespace {

constexpr double kMostSharpnessSigma = 5, kMostGrainLength = 5;  // [px], what rendering bears

double ReadNotNegative(const JsonNode& node) {
  const double value = node.Number();
  if (value >= 0) return value;
  throw node.Error("is negative, expected 0 or more");
}

double ReadSigma(const JsonNode& node) {
  const double sigma = node.Number();
  if (sigma > 0 && sigma <= kMostSharpnessSigma) return sigma;
  throw node.Error("is out of range, expected pixels above 0 and up to 5");
}

PointSpread ReadPointSpread(const JsonNode& node) {
  return {ReadSigma(node.At("center_sigma_px")), ReadSigma(node.At("corner_sigma_px")),
          ReadNotNegative(node.At("sigma_error_px")), node.At("edges").Integer()};
}

Grain ReadGrain(const JsonNode& node) {
  Grain grain;
  grain.floor = node.At("floor_rgb").Vector3();
  grain.slope = node.At("slope_rgb").Vector3();
  if (grain.floor.minCoeff() < 0 || grain.slope.minCoeff() < 0) {
    throw node.Error("has a negative variance, expected 0 or more");
  }
  grain.length = ReadNotNegative(node.At("length_px"));
  grain.shared = ReadNotNegative(node.At("shared"));
  if (grain.length > kMostGrainLength || grain.shared > 1) {
    throw node.Error("has a correlation out of range, expected up to 5 px and up to 1");
  }
  grain.patches = node.At("patches").Integer();
  return grain;
}

}  // namespace

Json::Value ImageQualityToJson(const ImageQuality& quality) {
  Json::Value json;
  json["point_spread"] = Json::Value();
  if (const auto& spread = quality.point_spread) {
    json["point_spread"]["center_sigma_px"] = spread->center_sigma;
    json["point_spread"]["corner_sigma_px"] = spread->corner_sigma;
    json["point_spread"]["sigma_error_px"] = spread->sigma_error;
    json["point_spread"]["edges"] = spread->edges;
  }
  json["grain"] = Json::Value();
  if (const auto& grain = quality.grain) {
    json["grain"]["floor_rgb"] = ToJson(grain->floor);
    json["grain"]["slope_rgb"] = ToJson(grain->slope);
    json["grain"]["length_px"] = grain->length;
    json["grain"]["shared"] = grain->shared;
    json["grain"]["patches"] = grain->patches;
  }
  return json;
}

ImageQuality ImageQualityFromJson(const JsonNode& node) {
  ImageQuality quality;
  if (const auto spread = node.Find("point_spread"))
    quality.point_spread = ReadPointSpread(*spread);
  if (const auto grain = node.Find("grain")) quality.grain = ReadGrain(*grain);
  return quality;
}

}  // namespace insitu
