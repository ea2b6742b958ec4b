// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/polygon_covariance.h"

#include <algorithm>
#include <map>
#include <optional>

#include "reconstruction/network/variance_factor.h"

namespace insitu {
namespace {

constexpr Eigen::Index kBatch = 96;  // columns of the inverse at a time, to bound the memory

// The columns of the survey's vertices that are not fixed, each with its place among them.
std::map<int, Eigen::Index> VertexColumns(const Survey& survey, const SurveyNetwork& survey_network,
                                          const NetworkSolution& solution) {
  std::map<int, Eigen::Index> places;
  for (const PolygonOutline& polygon : survey.polygons) {
    for (const std::string& vertex : AllVertices(polygon)) {
      const int point = survey_network.index_of_point.at(vertex);
      if (solution.columns.point[point]) places[*solution.columns.point[point]] = 0;
    }
  }
  Eigen::Index next = 0;
  for (auto& [column, place] : places) {
    place = next;
    next += 3;
  }
  return places;
}

// Rows of `all`, three for each place.
Eigen::MatrixXd VertexRows(const Eigen::MatrixXd& all, const std::map<int, Eigen::Index>& places) {
  Eigen::MatrixXd rows(3 * static_cast<Eigen::Index>(places.size()), all.cols());
  for (const auto& [column, place] : places) {
    rows.middleRows<3>(place) = all.middleRows<3>(column);
  }
  return rows;
}

// Of all vertices jointly.
Eigen::MatrixXd VertexCovariance(const Network& network, const NetworkSolution& solution,
                                 const std::map<int, Eigen::Index>& places) {
  const Eigen::Index count = 3 * static_cast<Eigen::Index>(places.size());
  std::vector<Eigen::Index> columns;
  for (const auto& [column, place] : places) {
    for (int axis = 0; axis < 3; ++axis) columns.push_back(column + axis);
  }
  Eigen::MatrixXd covariance(count, count);
  for (Eigen::Index first = 0; first < count; first += kBatch) {
    const Eigen::Index width = std::min(kBatch, count - first);
    Eigen::MatrixXd units = Eigen::MatrixXd::Zero(solution.columns.count, width);
    for (Eigen::Index i = 0; i < width; ++i) units(columns[first + i], i) = 1;
    covariance.middleCols(first, width) = VarianceFactor(solution.sigma0, solution.redundancy) *
                                          VertexRows(solution.cofactor.Times(units), places);
  }
  for (size_t i = 0; i < network.cameras.size(); ++i) {
    if (solution.lens_sensitivity[i].size() == 0) continue;
    const Eigen::MatrixXd by_lens = VertexRows(solution.lens_sensitivity[i], places);
    covariance += by_lens * network.cameras[i].calibration_covariance * by_lens.transpose();
  }
  return covariance;
}

}  // namespace

std::vector<Eigen::MatrixXd> PolygonCovariances(const Survey& survey,
                                                const SurveyNetwork& survey_network,
                                                const NetworkSolution& solution) {
  const std::map<int, Eigen::Index> places = VertexColumns(survey, survey_network, solution);
  const Eigen::MatrixXd joint = VertexCovariance(survey_network.network, solution, places);
  std::vector<Eigen::MatrixXd> covariances;
  for (const PolygonOutline& polygon : survey.polygons) {
    const auto count = static_cast<Eigen::Index>(AllVertices(polygon).size());
    std::vector<std::optional<Eigen::Index>> place;
    for (const std::string& vertex : AllVertices(polygon)) {
      const auto column = solution.columns.point[survey_network.index_of_point.at(vertex)];
      place.push_back(column ? std::optional(places.at(*column)) : std::nullopt);
    }
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(3 * count, 3 * count);
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index k = 0; k < count; ++k) {
        if (!place[i] || !place[k]) continue;
        own.block<3, 3>(3 * i, 3 * k) = joint.block<3, 3>(*place[i], *place[k]);
      }
    }
    covariances.push_back(std::move(own));
  }
  return covariances;
}

}  // namespace insitu
