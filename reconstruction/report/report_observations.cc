// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/report_observations.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "reconstruction/verdict/advice.h"
#include "reconstruction/verdict/verdict.h"

namespace insitu {
namespace {

constexpr size_t kShown = 50;
constexpr double kHistogramLimit = 5, kHistogramStep = 0.25;

Json::Value OrNull(const std::optional<double>& value) {
  return value ? Json::Value(*value) : Json::Value();
}

Json::Value RowReport(const ObservationResidual& row, double critical_w) {
  Json::Value json;
  json["observation"] = Describe(row);
  json["group"] = Group(row);
  if (!row.photo.empty()) json["photo"] = row.photo;
  json["subject"] = Subject(row);
  json["observed"] = row.observed;
  json["residual"] = row.residual;
  json["sigma"] = row.sigma;
  json["redundancy"] = row.redundancy;
  json["w"] = OrNull(row.w);
  json["detectable"] = OrNull(row.detectable);
  json["external"] = OrNull(row.external);
  json["point_shift_m"] = OrNull(row.point_shift_m);
  if (std::abs(row.w.value_or(0)) > critical_w) json["advice"] = Advice(row);
  return json;
}

// The first rows of `residuals` by `key`, smallest first; those without a key do not count.
template <typename Key>
Json::Value Foremost(const Adjustment& adjustment, const Key& key) {
  std::vector<std::pair<double, size_t>> order;
  for (size_t i = 0; i < adjustment.residuals.size(); ++i) {
    if (const std::optional<double> value = key(adjustment.residuals[i])) {
      order.emplace_back(*value, i);
    }
  }
  const size_t shown = std::min(kShown, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(shown), order.end());
  Json::Value json(Json::arrayValue);
  for (size_t i = 0; i < shown; ++i) {
    json.append(RowReport(adjustment.residuals[order[i].second], adjustment.critical_w));
  }
  return json;
}

}  // namespace

Json::Value ObservationsSection(const Adjustment& adjustment) {
  int controlled = 0, flagged = 0, weak = 0;
  for (const ObservationResidual& row : adjustment.residuals) {
    controlled += row.w.has_value();
    flagged += std::abs(row.w.value_or(0)) > adjustment.critical_w;
    weak += row.redundancy < kWeaklyControlled;
  }
  Json::Value json;
  json["count"] = static_cast<Json::UInt64>(adjustment.residuals.size());
  json["controlled"] = controlled;
  json["critical_w"] = adjustment.critical_w;
  json["flagged"] = flagged;
  json["flagged_by_chance"] = controlled * std::erfc(adjustment.critical_w / std::sqrt(2));
  const std::optional<ObservationResidual> suspect = Suspect(adjustment);
  json["suspect"] = suspect ? RowReport(*suspect, adjustment.critical_w) : Json::Value();
  json["largest_w"] = Foremost(adjustment, [](const ObservationResidual& row) {
    return row.w ? std::optional(-std::abs(*row.w)) : std::nullopt;
  });
  json["weakly_controlled"] = weak;
  json["weak_limit"] = kWeaklyControlled;
  json["least_controlled"] = Foremost(adjustment, [](const ObservationResidual& row) {
    return row.redundancy < kWeaklyControlled ? std::optional(row.redundancy) : std::nullopt;
  });
  return json;
}

Json::Value HistogramSection(const Adjustment& adjustment) {
  const int bins = std::lround(2 * kHistogramLimit / kHistogramStep);
  std::vector<int> counts(bins, 0);
  int below = 0, above = 0;
  for (const ObservationResidual& row : adjustment.residuals) {
    if (!row.w) continue;
    const double bin = std::floor((*row.w + kHistogramLimit) / kHistogramStep);
    if (bin < 0) {
      ++below;
    } else if (bin >= bins) {
      ++above;
    } else {
      ++counts[static_cast<size_t>(bin)];
    }
  }
  Json::Value json;
  json["low"] = -kHistogramLimit;
  json["step"] = kHistogramStep;
  json["counts"] = Json::Value(Json::arrayValue);
  for (const int count : counts) json["counts"].append(count);
  json["below"] = below;
  json["above"] = above;
  json["total"] = std::accumulate(counts.begin(), counts.end(), below + above);
  return json;
}

}  // namespace insitu
