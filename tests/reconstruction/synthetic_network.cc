// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/reconstruction/synthetic_network.h"

#include <Eigen/Geometry>
#include <array>
#include <iomanip>
#include <random>
#include <set>
#include <sstream>

#include "calibration/whole_file.h"

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

  SyntheticNetworkOptions options_;
  Rigid3 town_from_world_;
  SyntheticNetwork network_;
};

std::ostringstream Digits() {
  std::ostringstream text;
  text << std::setprecision(17);
  return text;
}

std::string ControlText(const Survey& survey) {
  std::ostringstream text = Digits();
  text << "name,x,y,z,sigma_x,sigma_y,sigma_z,role\n";
  for (const ControlPoint& point : survey.control_points) {
    text << point.name;
    for (const Eigen::Vector3d& vector : {point.position, point.sigma}) {
      text << "," << vector.x() << "," << vector.y() << "," << vector.z();
    }
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

std::string PolygonsText(const Survey& survey) {
  std::ostringstream text;
  text << "{\"polygons\": [\n";
  for (size_t i = 0; i < survey.polygons.size(); ++i) {
    const PolygonOutline& polygon = survey.polygons[i];
    text << "{\"name\": " << std::quoted(polygon.name) << ", \"vertices\": [";
    for (size_t k = 0; k < polygon.vertices.size(); ++k) {
      text << (k ? ", " : "") << std::quoted(polygon.vertices[k]);
    }
    text << "], \"photo\": " << std::quoted(polygon.photo.value())
         << ", \"material\": " << std::quoted(polygon.material) << ", \"mask\": null}"
         << (i + 1 < survey.polygons.size() ? ",\n" : "\n");
  }
  text << "]}\n";
  return text.str();
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
  return noisy;
}

void WriteSurvey(const SitePaths& site, const Survey& survey) {
  WriteWhole(site.survey() / "control_points.csv", ControlText(survey));
  WriteWhole(site.survey() / "observations.csv", MarksText(survey));
  WriteWhole(site.survey() / "polygons.json", PolygonsText(survey));
  WriteWhole(site.survey() / "directions.json",
             "{\"sun\": [\n" + PairLines(survey.sun_pairs, "shadow", "object") +
                 "], \"zenith\": [\n" + PairLines(survey.zenith_pairs, "bottom", "top") + "]}\n");
}

}  // namespace insitu
