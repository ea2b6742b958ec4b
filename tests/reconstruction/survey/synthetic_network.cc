// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/reconstruction/survey/synthetic_network.h"

#include <Eigen/Geometry>
#include <array>
#include <iomanip>
#include <random>
#include <set>
#include <sstream>
#include <utility>

#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

const Eigen::Vector3d kSunInTown = Eigen::Vector3d(0.5, -0.4, 0.7).normalized();

Camera LensWithDistortion() {
  return Camera("LENSMODEL_OPENCV8",
                {1500, 1502, 899.5, 601.5, -0.12, 0.03, 5e-4, -3e-4, 0, 0, 0, 0}, 1800, 1200);
}

Rigid3 LookAt(const Eigen::Vector3d& center, const Eigen::Vector3d& target) {
  Eigen::Matrix3d cam_from_town;
  cam_from_town.row(2) = (target - center).normalized();
  cam_from_town.row(0) = (target - center).cross(Eigen::Vector3d::UnitZ()).normalized();
  cam_from_town.row(1) = cam_from_town.row(2).cross(cam_from_town.row(0));
  const Eigen::Quaterniond rotation(cam_from_town);
  return {rotation, -(rotation * center)};
}

std::string Numbered(std::string name, int number) { return name += std::to_string(number); }

class Town {
 public:
  explicit Town(const SyntheticNetworkOptions& options) : options_(options) {}

  SyntheticNetwork Build() {
    town_from_world_ =
        Inverse({Eigen::Quaterniond(Eigen::AngleAxisd(options_.tilt, Eigen::Vector3d(0.6, 0.8, 0))),
                 options_.origin});
    AddGround();
    AddBox("a", {-9, 2, 0}, {5, 4, 6});
    AddBox("b", {2, 5, 0}, {6, 5, 9});
    AddBox("c", {-3, 14, 0}, {7, 4, 12});
    AddPolygon("sail", {"b4", "b5", "c4"});
    AddPhotos();
    AddDirections();
    AddMarks();
    AddControl();
    if (options_.has_extras) {
      AddCameraPositions();
      AddEdges();
      AddConstraints();
    }
    return std::move(network_);
  }

 private:
  void AddPoint(const std::string& name, const Eigen::Vector3d& in_town) {
    network_.points[name] = Inverse(town_from_world_) * in_town;
  }

  void AddPolygon(const std::string& name, const std::vector<std::string>& vertices) {
    const int line = static_cast<int>(network_.survey.polygons.size()) + 2;
    network_.survey.polygons.push_back(
        {name, vertices, "P1", "stone", std::nullopt, {"polygons.json", line}});
  }

  void AddGround() {
    for (int i = 0; i < 9; ++i) {
      AddPoint(Numbered("g", i), {-8.0 + 8 * (i % 3), -6.0 + 3 * (i / 3), 0});
    }
    AddPoint("single", {13, -8, 0});
    AddPoint("buried", {-14, 22, 0});
    AddPoint("south", {-9, -8, 0});
    AddPoint("north", {12, 21, 0});
    AddPolygon("ground", {"south", "single", "north", "buried", "g3"});
  }

  void AddBox(const std::string& name, const Eigen::Vector3d& corner, const Eigen::Vector3d& size) {
    for (int k = 0; k < 8; ++k) {
      const Eigen::Vector3d step((k & 1) ^ ((k >> 1) & 1), (k >> 1) & 1, k >> 2);
      AddPoint(Numbered(name, k), corner + size.cwiseProduct(step));
    }
    for (int k = 0; k < 4; ++k) {
      const auto vertex = [&](int i) { return Numbered(name, i); };
      const int next = (k + 1) % 4;
      AddPolygon(Numbered(name + "_wall", k),
                 {vertex(k), vertex(next), vertex(next + 4), vertex(k + 4)});
    }
    AddPolygon(name + "_roof", {name + "4", name + "5", name + "6", name + "7"});
  }

  void AddPhotos() {
    const std::array<Eigen::Vector3d, 4> centers = {
        Eigen::Vector3d(-14, -24, 2), {-4, -27, 3}, {6, -26, 1.7}, {15, -22, 5}};
    for (size_t i = 0; i < centers.size(); ++i) {
      network_.photos.push_back(Numbered("P", static_cast<int>(i) + 1));
      network_.cameras.push_back(LensWithDistortion());
      network_.cam_from_world.push_back(LookAt(centers[i], {0, 4, 3}) * town_from_world_);
    }
  }

  bool IsMarked(const std::string& point, size_t photo) const {
    if (point == "buried") return false;
    if (point == "single") return photo + 1 == network_.photos.size();
    return true;
  }

  void AddMarks() {
    auto& marks = network_.survey.observations;
    for (size_t photo = 0; photo < network_.photos.size(); ++photo) {
      for (const auto& [name, point] : network_.points) {
        const auto pixel = network_.cameras[photo].Project(network_.cam_from_world[photo] * point);
        if (!IsMarked(name, photo) || !pixel || !network_.cameras[photo].Sees(*pixel)) continue;
        const int line = static_cast<int>(marks.size()) + 2;
        marks.push_back({network_.photos[photo],
                         name,
                         *pixel,
                         options_.mark_sigma_px,
                         {"observations.csv", line}});
      }
    }
  }

  void AddDirections() {
    const Eigen::Quaterniond world_from_town = town_from_world_.rotation.conjugate();
    network_.sun = world_from_town * kSunInTown;
    network_.zenith = world_from_town * Eigen::Vector3d::UnitZ();
    auto& survey = network_.survey;
    // Corners of the low box throw their shadows on points of the ground that bear these names.
    for (const std::string object : {"a4", "a5"}) {
      const Eigen::Vector3d top = town_from_world_ * network_.points.at(object);
      AddPoint("shadow_" + object, top - kSunInTown * (top.z() / kSunInTown.z()));
      survey.sun_pairs.push_back({"shadow_" + object, object, {"directions.json", 0}});
    }
    for (const std::string box : {"a", "b", "c"}) {
      survey.zenith_pairs.push_back({box + "0", box + "4", {"directions.json", 0}});
      survey.zenith_pairs.push_back({box + "1", box + "5", {"directions.json", 0}});
    }
    int line = 2;
    for (auto* pairs : {&survey.sun_pairs, &survey.zenith_pairs}) {
      for (DirectionPair& pair : *pairs) pair.place.line = line++;
      line += 1;
    }
  }

  void AddControl() {
    const std::set<std::string> check = {"b4", "b5"};
    for (const auto& [name, point] : network_.points) {
      const bool is_control = name[0] == 'g' || name[0] == 'a' || name == "buried";
      if (!is_control && !check.contains(name)) continue;
      const int line = static_cast<int>(network_.survey.control_points.size()) + 2;
      network_.survey.control_points.push_back(
          {name,
           point,
           Eigen::Vector3d::Constant(options_.control_sigma),
           is_control ? ControlRole::kControl : ControlRole::kCheck,
           {"control_points.csv", line}});
    }
  }

  // Fixed, weighted, free, weighted.
  void AddCameraPositions() {
    for (size_t i = 0; i < network_.photos.size(); ++i) {
      const PositionRole role = i == 0   ? PositionRole::kFixed
                                : i == 2 ? PositionRole::kFree
                                         : PositionRole::kWeighted;
      network_.survey.camera_positions.push_back(
          {network_.photos[i],
           Center(network_.cam_from_world[i]),
           Eigen::Vector3d::Constant(role == PositionRole::kFree ? 2 : 0.01),
           role,
           {"camera_positions.csv", static_cast<int>(i) + 2}});
    }
  }

  // Three places on each of two roof edges, on every photo that sees them.
  void AddEdges() {
    auto& edges = network_.survey.edges;
    const std::vector<std::pair<std::string, std::string>> ends = {{"b4", "b5"}, {"c4", "c5"}};
    for (size_t photo = 0; photo < network_.photos.size(); ++photo) {
      for (const auto& [from, to] : ends) {
        for (const double share : {0.2, 0.5, 0.9}) {
          const Eigen::Vector3d place =
              (1 - share) * network_.points.at(from) + share * network_.points.at(to);
          const auto pixel =
              network_.cameras[photo].Project(network_.cam_from_world[photo] * place);
          if (!pixel || !network_.cameras[photo].Sees(*pixel)) continue;
          edges.push_back({network_.photos[photo],
                           from,
                           to,
                           *pixel,
                           options_.mark_sigma_px,
                           {"edges.csv", static_cast<int>(edges.size()) + 2}});
        }
      }
    }
  }

  void AddConstraint(GeometricConstraint::Kind kind, const std::vector<std::string>& polygons,
                     const std::vector<std::string>& points, double sigma, double value = 0) {
    const int line = static_cast<int>(network_.survey.constraints.size()) + 2;
    network_.survey.constraints.push_back(
        {kind, polygons, points, value, sigma, {"constraints.json", line}});
  }

  void AddConstraints() {
    using Kind = GeometricConstraint::Kind;
    const auto& points = network_.points;
    AddConstraint(Kind::kDistance, {}, {"b4", "b5"}, 0.003,
                  (points.at("b5") - points.at("b4")).norm());
    AddConstraint(Kind::kHeight, {}, {"b0", "c4"}, 0.004,
                  (points.at("c4") - points.at("b0")).dot(network_.zenith));
    AddConstraint(Kind::kHeight, {}, {"c4", "c6"}, 0.004);
    AddConstraint(Kind::kVertical, {"b_wall0"}, {}, 0.002);
    AddConstraint(Kind::kVertical, {}, {"c1", "c5"}, 0.002);
    AddConstraint(Kind::kHorizontal, {"b_roof"}, {}, 0.002);
    AddConstraint(Kind::kHorizontal, {}, {"c4", "c5"}, 0.002);
    AddConstraint(Kind::kParallel, {"b_wall0", "c_wall0"}, {}, 0.002);
    AddConstraint(Kind::kPerpendicular, {}, {"b4", "b5", "b5", "b6"}, 0.002);
  }

  SyntheticNetworkOptions options_;
  Rigid3 town_from_world_;
  SyntheticNetwork network_;
};

std::ostringstream Digits() {
  std::ostringstream text;
  text << std::setprecision(17);
  return text;
}

void WriteVector(const Eigen::VectorXd& vector, std::ostream* text) {
  for (const double value : vector) *text << "," << value;
}

std::string ControlText(const Survey& survey) {
  std::ostringstream text = Digits();
  text << "name,x,y,z,sigma_x,sigma_y,sigma_z,role\n";
  for (const ControlPoint& point : survey.control_points) {
    text << point.name;
    WriteVector(point.position, &text);
    WriteVector(point.sigma, &text);
    text << (point.role == ControlRole::kControl ? ",control\n" : ",check\n");
  }
  return text.str();
}

std::string MarksText(const Survey& survey) {
  std::ostringstream text = Digits();
  text << "photo,point,x,y,sigma\n";
  for (const ImageObservation& mark : survey.observations) {
    text << mark.photo << "," << mark.point << "," << mark.pixel.x() << "," << mark.pixel.y() << ","
         << mark.sigma_px << "\n";
  }
  return text.str();
}

std::string CameraPositionsText(const Survey& survey) {
  std::ostringstream text = Digits();
  text << "photo,x,y,z,sigma_x,sigma_y,sigma_z,role\n";
  for (const CameraPosition& camera : survey.camera_positions) {
    text << camera.photo;
    WriteVector(camera.position, &text);
    WriteVector(camera.sigma, &text);
    text << (camera.role == PositionRole::kFixed      ? ",fixed\n"
             : camera.role == PositionRole::kWeighted ? ",weighted\n"
                                                      : ",free\n");
  }
  return text.str();
}

std::string EdgesText(const Survey& survey) {
  std::ostringstream text = Digits();
  text << "photo,from,to,x,y,sigma\n";
  for (const EdgeMark& edge : survey.edges) {
    text << edge.photo << "," << edge.from << "," << edge.to;
    WriteVector(edge.pixel, &text);
    text << "," << edge.sigma_px << "\n";
  }
  return text.str();
}

std::string NameList(const std::vector<std::string>& names) {
  std::ostringstream text;
  text << "[";
  for (size_t i = 0; i < names.size(); ++i) text << (i ? ", " : "") << std::quoted(names[i]);
  text << "]";
  return text.str();
}

std::string PolygonsText(const Survey& survey) {
  std::ostringstream text;
  text << "{\"polygons\": [\n";
  for (size_t i = 0; i < survey.polygons.size(); ++i) {
    const PolygonOutline& polygon = survey.polygons[i];
    text << "{\"name\": " << std::quoted(polygon.name)
         << ", \"vertices\": " << NameList(polygon.vertices)
         << ", \"photo\": " << std::quoted(polygon.photo.value())
         << ", \"material\": " << std::quoted(polygon.material) << ", \"mask\": null}"
         << (i + 1 < survey.polygons.size() ? ",\n" : "\n");
  }
  text << "]}\n";
  return text.str();
}

std::string ConstraintText(const GeometricConstraint& constraint) {
  const std::array<std::string, 6> kinds = {"distance",   "height",   "vertical",
                                            "horizontal", "parallel", "perpendicular"};
  std::ostringstream text = Digits();
  text << "{\"kind\": " << std::quoted(kinds.at(static_cast<size_t>(constraint.kind)));
  if (constraint.points.empty()) {
    text << ", \"polygons\": " << NameList(constraint.polygons);
  } else {
    text << ", \"points\": " << NameList(constraint.points);
  }
  if (constraint.kind <= GeometricConstraint::Kind::kHeight) {
    text << ", \"value_m\": " << constraint.value << ", \"sigma_m\": " << constraint.sigma << "}";
  } else {
    text << ", \"sigma_mm_per_m\": " << 1000 * constraint.sigma << "}";
  }
  return text.str();
}

std::string ConstraintsText(const Survey& survey) {
  std::string text = "{\"constraints\": [\n";
  for (const GeometricConstraint& constraint : survey.constraints) {
    text += ConstraintText(constraint) + (&constraint == &survey.constraints.back() ? "\n" : ",\n");
  }
  return text + "]}\n";
}

std::string PairLines(const std::vector<DirectionPair>& pairs, const std::string& from,
                      const std::string& to) {
  std::ostringstream text;
  for (size_t i = 0; i < pairs.size(); ++i) {
    text << "{" << std::quoted(from) << ": " << std::quoted(pairs[i].from) << ", "
         << std::quoted(to) << ": " << std::quoted(pairs[i].to) << "}"
         << (i + 1 < pairs.size() ? ",\n" : "\n");
  }
  return text.str();
}

}  // namespace

SyntheticNetwork MakeSyntheticNetwork(const SyntheticNetworkOptions& options) {
  return Town(options).Build();
}

Survey WithNoise(const Survey& survey, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  Survey noisy = survey;
  for (ImageObservation& mark : noisy.observations) {
    for (int i = 0; i < 2; ++i) mark.pixel[i] += mark.sigma_px * normal(generator);
  }
  for (ControlPoint& point : noisy.control_points) {
    for (int i = 0; i < 3; ++i) point.position[i] += point.sigma[i] * normal(generator);
  }
  for (CameraPosition& camera : noisy.camera_positions) {
    if (camera.role == PositionRole::kFixed) continue;
    for (int i = 0; i < 3; ++i) camera.position[i] += camera.sigma[i] * normal(generator);
  }
  for (EdgeMark& edge : noisy.edges) {
    for (int i = 0; i < 2; ++i) edge.pixel[i] += edge.sigma_px * normal(generator);
  }
  for (GeometricConstraint& constraint : noisy.constraints) {
    if (constraint.kind > GeometricConstraint::Kind::kHeight) continue;  // angles are not measured
    constraint.value += constraint.sigma * normal(generator);
  }
  return noisy;
}

void WriteSurvey(const SitePaths& site, const Survey& survey) {
  WriteWhole(site.survey() / "control_points.csv", ControlText(survey));
  WriteWhole(site.survey() / "observations.csv", MarksText(survey));
  WriteWhole(site.survey() / "polygons.json", PolygonsText(survey));
  WriteWhole(site.survey() / "directions.json",
             "{\"sun\": [\n" + PairLines(survey.sun_pairs, "shadow", "object") +
                 "], \"zenith\": [\n" + PairLines(survey.zenith_pairs, "bottom", "top") + "]}\n");
  if (!survey.camera_positions.empty()) {
    WriteWhole(site.survey() / "camera_positions.csv", CameraPositionsText(survey));
  }
  if (!survey.edges.empty()) WriteWhole(site.survey() / "edges.csv", EdgesText(survey));
  if (!survey.constraints.empty()) {
    WriteWhole(site.survey() / "constraints.json", ConstraintsText(survey));
  }
}

}  // namespace insitu
