// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/page_report.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace insitu {
namespace {

constexpr Json::ArrayIndex kPhotosInFull = 40, kPointsListed = 1000, kComparisonsListed = 300,
                           kMarksListed = 5;
constexpr Json::ArrayIndex kPolygonsListed = 1000;
constexpr Json::ArrayIndex kMarksInFull = 300;  // of a photo that is shown in full
constexpr double kDigits = 1e6;

double SizeOf(const Json::Value& vector) {
  double squares = 0;
  for (const Json::Value& part : vector)
    squares += part.isNumeric() ? part.asDouble() * part.asDouble() : 0;
  return std::sqrt(squares);
}

double NumberOrZero(const Json::Value& value) {
  return value.isNumeric() ? std::abs(value.asDouble()) : 0;
}

// The first `count` by `size`, largest first; returns how many there were more.
template <typename Size>
Json::ArrayIndex KeepWorst(Json::ArrayIndex count, const Size& size, Json::Value* rows) {
  if (!rows->isArray() || rows->size() <= count) return 0;
  std::vector<std::pair<double, Json::ArrayIndex>> order;
  for (Json::ArrayIndex i = 0; i < rows->size(); ++i) order.emplace_back(-size((*rows)[i]), i);
  std::sort(order.begin(), order.end());
  Json::Value kept(Json::arrayValue);
  for (Json::ArrayIndex i = 0; i < count; ++i) kept.append(std::move((*rows)[order[i].second]));
  const Json::ArrayIndex more = rows->size() - count;
  *rows = std::move(kept);
  return more;
}

void Round(Json::Value* value) {
  if (value->isDouble() && value->asDouble() != 0 && std::isfinite(value->asDouble())) {
    const double number = value->asDouble(), size = std::abs(number);
    const double unit = size >= 1 ? 1e-5 : std::pow(10, std::floor(std::log10(size))) / kDigits;
    *value = std::round(number / unit) * unit;
  } else if (value->isArray() || value->isObject()) {
    for (Json::Value& member : *value) Round(&member);
  }
}

double TestValue(const Json::Value& mark) { return NumberOrZero(mark["w"]); }

// Worst first; pictures, cells and all marks of the first ones only.
void CondensePhotos(Json::Value* photos) {
  std::vector<std::pair<double, Json::ArrayIndex>> order;
  for (Json::ArrayIndex i = 0; i < photos->size(); ++i)
    order.emplace_back(-NumberOrZero((*photos)[i]["rms_px"]), i);
  std::sort(order.begin(), order.end());
  Json::Value sorted(Json::arrayValue);
  for (const auto& [minus_rms, i] : order) {
    Json::Value& photo = (*photos)[i];
    const bool is_in_full = sorted.size() < kPhotosInFull;
    KeepWorst(is_in_full ? kMarksInFull : kMarksListed, TestValue, &photo["marks"]);
    if (!is_in_full) {
      photo.removeMember("thumbnail");
      photo["tie_point_grid"] = Json::Value(Json::arrayValue);
      photo["lens_correlation"] = Json::Value();
    }
    sorted.append(std::move(photo));
  }
  *photos = std::move(sorted);
}

std::string Note(Json::ArrayIndex photos, Json::ArrayIndex points, Json::ArrayIndex polygons) {
  std::string note = "This network is large: this page shows what fits worst";
  if (photos > kPhotosInFull) {
    note += ", pictures and marks of " + std::to_string(kPhotosInFull) + " of " +
            std::to_string(photos) + " photos";
  }
  if (points > 0) note += ", without " + std::to_string(points) + " points that fit better";
  if (polygons > 0) note += ", without " + std::to_string(polygons) + " polygons";
  return note + ". All is in report.json, observations.csv and points.csv beside it.";
}

bool IsLarge(const Json::Value& report) {
  Json::UInt64 marks = 0;
  for (const Json::Value& photo : report["photos"]) marks += photo["marks"].size();
  return report["photos"].size() > kPhotosInFull || report["points"].size() > 2 * kPointsListed ||
         marks > 20000 || report["polygons"].size() > 2 * kPolygonsListed;
}

}  // namespace

Json::Value ForPage(Json::Value report) {
  if (!IsLarge(report)) return report;
  Json::Value& photos = report["photos"];
  CondensePhotos(&photos);
  const auto sigma_of = [](const Json::Value& point) { return SizeOf(point["sigma_m"]); };
  const Json::ArrayIndex points = KeepWorst(kPointsListed, sigma_of, &report["points"]);
  for (const char* list : {"control", "check", "left_out"}) {
    const auto size = [](const Json::Value& point) { return NumberOrZero(point["over_sigma"]); };
    KeepWorst(kComparisonsListed, size, &report[list]["points"]);
  }
  const auto planarity = [](const Json::Value& polygon) {
    return NumberOrZero(polygon["planarity_rms_mm"]);
  };
  const Json::ArrayIndex polygons = KeepWorst(kPolygonsListed, planarity, &report["polygons"]);
  Round(&report);
  report["page_note"] = Note(photos.size(), points, polygons);
  return report;
}

}  // namespace insitu
