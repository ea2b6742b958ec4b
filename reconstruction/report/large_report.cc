// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/large_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace insitu {
namespace {

constexpr size_t kPhotosInFull = 40, kPointsListed = 1000, kMarksListed = 5, kManyMarks = 20000;
constexpr size_t kMarksInFull = 300;  // of a photo that is shown in full
constexpr size_t kUnlimited = std::numeric_limits<size_t>::max();
constexpr Json::ArrayIndex kComparisonsListed = 300, kPolygonsListed = 1000;
constexpr double kDigits = 1e6;

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

// Worst first; pictures, cells and correlations of the first ones only.
void CondensePhotos(const ReportExtent& extent, Json::Value* photos) {
  const auto misfit = [](const Json::Value& photo) { return NumberOrZero(photo["rms_px"]); };
  std::vector<std::pair<double, Json::ArrayIndex>> order;
  for (Json::ArrayIndex i = 0; i < photos->size(); ++i)
    order.emplace_back(-misfit((*photos)[i]), i);
  std::sort(order.begin(), order.end());
  Json::Value sorted(Json::arrayValue);
  for (const auto& [minus_rms, i] : order) {
    Json::Value& photo = (*photos)[i];
    if (!extent.photos_in_full.contains(photo["photo"].asString())) {
      photo.removeMember("thumbnail");
      photo["lens_correlation"] = Json::Value();
    }
    sorted.append(std::move(photo));
  }
  *photos = std::move(sorted);
}

std::string Note(size_t photos_in_full, size_t photos, size_t points, size_t polygons) {
  std::string note = "This network is large: this report tells what fits worst";
  if (photos_in_full < photos) {
    note += ", pictures and marks of " + std::to_string(photos_in_full) + " of " +
            std::to_string(photos) + " photos";
  }
  if (points > 0) note += ", without " + std::to_string(points) + " points that fit better";
  if (polygons > 0) note += ", without " + std::to_string(polygons) + " polygons";
  return note + ". All is in observations.csv and points.csv beside it.";
}

size_t SurveyedPoints(const Adjustment& adjustment) {
  return static_cast<size_t>(std::ranges::count_if(
      adjustment.points, [](const AdjustedPoint& point) { return !point.is_tie_point; }));
}

bool IsLarge(const Adjustment& adjustment) {
  const auto marks = static_cast<size_t>(
      std::ranges::count_if(adjustment.residuals, [](const ObservationResidual& row) {
        return row.kind == ObservationKind::kImage && row.axis == 0 && !row.is_tie_point;
      }));
  return adjustment.poses.size() > kPhotosInFull || marks > kManyMarks ||
         SurveyedPoints(adjustment) > 2 * kPointsListed ||
         adjustment.planes.size() > 2 * kPolygonsListed;
}

}  // namespace

size_t ReportExtent::MarksOf(const std::string& photo) const {
  if (!is_large) return kUnlimited;
  return photos_in_full.contains(photo) ? kMarksInFull : kMarksListed;
}

ReportExtent ExtentOf(const Adjustment& adjustment) {
  ReportExtent extent;
  extent.is_large = IsLarge(adjustment);
  extent.points = extent.is_large ? kPointsListed : kUnlimited;
  std::vector<std::pair<double, size_t>> order;
  for (size_t i = 0; i < adjustment.poses.size(); ++i) {
    order.emplace_back(-adjustment.poses[i].rms_px, i);
  }
  std::sort(order.begin(), order.end());
  if (extent.is_large) order.resize(std::min(order.size(), kPhotosInFull));
  for (const auto& [minus_rms, i] : order) {
    extent.photos_in_full.insert(adjustment.poses[i].photo);
  }
  return extent;
}

void CondenseReport(const Adjustment& adjustment, const ReportExtent& extent, Json::Value* report) {
  if (!extent.is_large) return;
  CondensePhotos(extent, &(*report)["photos"]);
  for (const char* list : {"control", "check", "left_out"}) {
    const auto size = [](const Json::Value& point) { return NumberOrZero(point["over_sigma"]); };
    KeepWorst(kComparisonsListed, size, &(*report)[list]["points"]);
  }
  const auto planarity = [](const Json::Value& polygon) {
    return NumberOrZero(polygon["planarity_rms_mm"]);
  };
  const Json::ArrayIndex polygons = KeepWorst(kPolygonsListed, planarity, &(*report)["polygons"]);
  const size_t surveyed = SurveyedPoints(adjustment);
  (*report)["page_note"] = Note(extent.photos_in_full.size(), adjustment.poses.size(),
                                surveyed - std::min(surveyed, extent.points), polygons);
}

Json::Value ForPage(Json::Value report) {
  if (report.isMember("page_note")) Round(&report);
  return report;
}

}  // namespace insitu
