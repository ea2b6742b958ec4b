// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/natural_environment.h"

#include <cmath>
#include <stdexcept>

#include "calibration/files/json_file.h"
#include "radiometry/image_quality_json.h"

namespace insitu {
namespace {

constexpr char kFormat[] = "insitu natural environment";
constexpr int kVersion = 3;               // 1: no input images, no covariances; 2: no primaries
constexpr double kReferenceDistance = 1;  // d_a [m]

Json::Value InteriorToJson(const Camera& camera) {
  const std::vector<double>& intrinsics = camera.intrinsics();
  Json::Value json;
  json["lens_model"] = camera.lens_model();
  json["intrinsics"] =
      ToJson(Eigen::VectorXd(Eigen::VectorXd::Map(intrinsics.data(), intrinsics.size())));
  json["width"] = camera.width();
  json["height"] = camera.height();
  return json;
}

Json::Value ExteriorToJson(const Rigid3& cam_from_world) {
  const Eigen::Quaterniond& rotation = cam_from_world.rotation;
  Json::Value json;
  json["rotation_wxyz"] = ToJson(
      Eigen::VectorXd(Eigen::Vector4d(rotation.w(), rotation.x(), rotation.y(), rotation.z())));
  json["translation"] = ToJson(cam_from_world.translation);
  return json;
}

Json::Value CameraToJson(const NaturalEnvironment& environment, size_t i,
                         const std::filesystem::path& folder) {
  const PosedCamera& posed = environment.scene.cameras[i];
  const InputImage& image = environment.input_images[i];
  Json::Value json = InteriorToJson(posed.camera);
  json["photo"] = posed.photo;
  json["cam_from_world"] = ExteriorToJson(posed.cam_from_world);
  if (!environment.scene.camera_covariances.empty()) {
    json["covariance"] = ToJson(environment.scene.camera_covariances[i]);
  }
  if (!environment.qualities.empty())
    json["image_quality"] = ImageQualityToJson(environment.qualities[i]);
  json["input_image"] = InteriorToJson(image.camera);
  json["input_image"]["file"] = image.file.lexically_relative(folder).generic_string();
  return json;
}

Json::Value PolygonToJson(const Polygon& polygon, const SceneGeometry& scene) {
  Json::Value json;
  json["name"] = polygon.name;
  for (const Eigen::Vector3d& vertex : polygon.vertices) json["vertices"].append(ToJson(vertex));
  if (!polygon.holes.empty()) json["holes"] = HolesToJson(polygon.holes);
  json["normal"] = ToJson(polygon.normal);
  json["photo"] = polygon.photo ? Json::Value(scene.cameras[*polygon.photo].photo) : Json::Value();
  json["material"] = polygon.material;
  if (polygon.covariance.size() > 0) json["covariance"] = ToJson(polygon.covariance);
  return json;
}

Json::Value DirectionToJson(const Direction& direction) {
  Json::Value json;
  json["unit"] = ToJson(direction.unit);
  json["covariance"] = ToJson(Eigen::MatrixXd(direction.covariance));
  return json;
}

Json::Value SceneToJson(const NaturalEnvironment& environment,
                        const std::filesystem::path& folder) {
  const SceneGeometry& scene = environment.scene;
  Json::Value json;
  json["origin"] = ToJson(scene.origin);
  json["cameras"] = Json::Value(Json::arrayValue);
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    json["cameras"].append(CameraToJson(environment, i, folder));
  }
  json["polygons"] = Json::Value(Json::arrayValue);
  for (const Polygon& p : scene.polygons) json["polygons"].append(PolygonToJson(p, scene));
  json["sun"] = scene.sun ? DirectionToJson(*scene.sun) : Json::Value();
  json["zenith"] = DirectionToJson(scene.zenith);
  json["vertex_sigma"] = scene.vertex_sigma;
  return json;
}

Json::Value MaterialToJson(const NaturalMaterial& material) {
  Json::Value json;
  json["diffuse_weight"] = material.diffuse_weight;
  if (material.transmission > 0) json["transmission"] = material.transmission;
  if (!material.specular) return json;
  json["specular"] = SpecularJson(*material.specular);
  if (material.bumps) json["bumps"] = BumpsJson(*material.bumps);
  return json;
}

Json::Value AirToJson(const Atmosphere& air, const SpectralBins& bins) {
  Json::Value json;
  json["horizon"] = BinsJson(air.horizon, bins);
  json["transmittance_per_m"] = BinsJson(air.transmittance, bins);
  json["reference_distance_m"] = kReferenceDistance;
  return json;
}

// Null: uniform.
Json::Value SkyShapeToJson(const Daylight& light, const SpectralBins& bins) {
  if (light.sky_shape.IsUniform()) return {};
  Json::Value json;
  json["gradation"] = BinsJson(light.sky_shape.gradation, bins);
  json["glow"] = BinsJson(light.sky_shape.glow, bins);
  if (light.photographed_sky) {
    json["photographed_radiance"] = BinsJson(*light.photographed_sky, bins);
  }
  return json;
}

Json::Value LightToJson(const Daylight& light, const SpectralBins& bins) {
  Json::Value json;
  json["sun_direction"] = ToJson(light.sun_direction);
  json["sun_solid_angle"] = light.sun_solid_angle;
  json["sun_is_one_direction"] = light.sun_is_one_direction;
  json["zenith_direction"] = ToJson(light.zenith_direction);
  json["polar_facets"] = light.polar_facets;
  json["sun_radiance"] = BinsJson(light.sun_radiance, bins);
  json["ambient_radiance"] = BinsJson(light.ambient_radiance, bins);
  json["sky_radiance"] = BinsJson(light.sky_radiance, bins);
  json["sky_shape"] = SkyShapeToJson(light, bins);
  return json;
}

// `unused` in the bins beyond.
Spectrum ReadBins(const JsonNode& node, const SpectralBins& bins, double unused = 0) {
  const std::vector<double> values = node.Numbers();
  if (static_cast<int>(values.size()) != bins.count) {
    throw node.Error("has " + std::to_string(values.size()) + " values, expected one for each of " +
                     std::to_string(bins.count) + " bins");
  }
  Spectrum spectrum = Spectrum::Constant(unused);
  std::copy(values.begin(), values.end(), spectrum.data());
  return spectrum;
}

Eigen::Vector3d ReadUnit(const JsonNode& node) {
  const Eigen::Vector3d unit = node.Vector3();
  if (std::abs(unit.norm() - 1) > 1e-9) throw node.Error("is not a unit vector, expected length 1");
  return unit;
}

Eigen::Quaterniond ReadRotation(const JsonNode& node) {
  const std::vector<double> q = node.Numbers();
  if (q.size() != 4) throw node.Error("is not a quaternion, expected w, x, y, z");
  const Eigen::Quaterniond rotation(q[0], q[1], q[2], q[3]);
  if (std::abs(rotation.norm() - 1) > 1e-9) {
    throw node.Error("is not a unit quaternion, expected length 1");
  }
  return rotation;
}

Camera ReadInterior(const JsonNode& node) {
  try {
    return {node.At("lens_model").Text(), node.At("intrinsics").Numbers(),
            node.At("width").Integer(), node.At("height").Integer()};
  } catch (const std::invalid_argument& error) {
    throw node.Error(std::string("is not a camera: ") + error.what());
  }
}

Rigid3 ReadExterior(const JsonNode& node) {
  return {ReadRotation(node.At("rotation_wxyz")), node.At("translation").Vector3()};
}

Eigen::MatrixXd ReadCovariance(const JsonNode& node, size_t size) {
  Eigen::MatrixXd covariance = node.Matrix();
  const auto rows = static_cast<Eigen::Index>(size);
  if (covariance.rows() == rows && covariance.cols() == rows) return covariance;
  throw node.Error("is not a covariance of " + std::to_string(size) + " unknowns");
}

// Of six elements of the exterior orientation and, where they are uncertain, all of the interior.
Eigen::MatrixXd ReadCameraCovariance(const JsonNode& node, const Camera& camera) {
  const size_t rows = node.Items().size();
  return ReadCovariance(node, rows == 6 ? rows : 6 + camera.intrinsics().size());
}

// Adds one camera with its input image.
void ReadCameraOf(const JsonNode& node, NaturalEnvironment* environment) {
  SceneGeometry& scene = environment->scene;
  scene.cameras.push_back(
      {node.At("photo").Text(), ReadInterior(node), ReadExterior(node.At("cam_from_world"))});
  if (const auto covariance = node.Find("covariance")) {
    scene.camera_covariances.push_back(
        ReadCameraCovariance(*covariance, scene.cameras.back().camera));
  }
  if (scene.camera_covariances.size() % scene.cameras.size() != 0) {
    throw node.Error("has a covariance or none, expected the same of all cameras");
  }
  const auto quality = node.Find("image_quality");
  environment->qualities.push_back(quality ? ImageQualityFromJson(*quality) : ImageQuality());
  const JsonNode image = node.At("input_image");
  environment->input_images.push_back(
      {node.path().parent_path() / image.At("file").Text(), ReadInterior(image)});
}

int PhotoIndex(const JsonNode& photo, const SceneGeometry& scene) {
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    if (scene.cameras[i].photo == photo.Text()) return static_cast<int>(i);
  }
  throw photo.Error("is the unknown photo \"" + photo.Text() + "\", expected one of the cameras'");
}

Polygon ReadPolygon(const JsonNode& node, const SceneGeometry& scene) {
  Polygon polygon;
  polygon.name = node.At("name").Text();
  for (const JsonNode& v : node.At("vertices").Items()) polygon.vertices.push_back(v.Vector3());
  polygon.normal = ReadUnit(node.At("normal"));
  if (polygon.vertices.size() < 3) {
    throw node.At("vertices").Error("has fewer than three vertices, expected a polygon");
  }
  if (const auto photo = node.Find("photo")) polygon.photo = PhotoIndex(*photo, scene);
  if (const auto holes = node.Find("holes")) polygon.holes = HolesFromJson(*holes);
  if (!polygon.holes.empty() && !HasInterior(polygon)) {
    throw node.Error(
        "polygon '" + polygon.name +
        "' has a hole that is not within it, expected those that insitu-reconstruct wrote");
  }
  polygon.material = node.At("material").Text();
  if (const auto covariance = node.Find("covariance")) {
    polygon.covariance = ReadCovariance(*covariance, 3 * AllVertices(polygon).size());
  }
  return polygon;
}

Direction ReadDirection(const JsonNode& node) {
  Direction direction{ReadUnit(node.At("unit")), Eigen::Matrix3d::Zero()};
  const std::vector<JsonNode> rows = node.At("covariance").Items();
  if (rows.size() != 3) throw node.At("covariance").Error("is not a matrix, expected three rows");
  for (int i = 0; i < 3; ++i) direction.covariance.row(i) = rows[i].Vector3();
  return direction;
}

// With its input images.
void ReadScene(const JsonNode& node, NaturalEnvironment* environment) {
  SceneGeometry& scene = environment->scene;
  scene.origin = node.At("origin").Vector3();
  for (const JsonNode& camera : node.At("cameras").Items()) ReadCameraOf(camera, environment);
  for (const JsonNode& polygon : node.At("polygons").Items()) {
    scene.polygons.push_back(ReadPolygon(polygon, scene));
  }
  if (const auto sun = node.Find("sun")) scene.sun = ReadDirection(*sun);
  scene.zenith = ReadDirection(node.At("zenith"));
  scene.vertex_sigma = node.At("vertex_sigma").Number();
}

NaturalMaterial ReadMaterial(const JsonNode& node) {
  NaturalMaterial material;
  material.diffuse_weight = node.At("diffuse_weight").Number();
  if (const auto share = node.Find("transmission")) material.transmission = share->Number();
  if (const auto specular = node.Find("specular")) {
    material.specular = SpecularOf(*specular);
  }
  if (const auto bumps = node.Find("bumps")) material.bumps = BumpsOf(*bumps);
  return material;
}

std::map<std::string, NaturalMaterial> ReadMaterials(const JsonNode& root,
                                                     const SceneGeometry& scene) {
  std::map<std::string, NaturalMaterial> materials;
  const JsonNode node = root.At("materials");
  for (const auto& [name, material] : node.Members()) materials[name] = ReadMaterial(material);
  for (const Polygon& polygon : scene.polygons) {
    if (!materials.count(polygon.material)) {
      throw node.Error("lacks \"" + polygon.material + "\", expected every polygon's material");
    }
  }
  return materials;
}

Atmosphere ReadAir(const JsonNode& node, const SpectralBins& bins) {
  Atmosphere air;
  air.horizon = ReadBins(node.At("horizon"), bins);
  air.transmittance = ReadBins(node.At("transmittance_per_m"), bins, 1);
  constexpr double kMost = 1.01;  // least squares as printed may come out above 1
  if (!(air.transmittance > 0 && air.transmittance <= kMost).all()) {
    throw node.At("transmittance_per_m").Error("is out of range, expected above 0 and up to 1");
  }
  const JsonNode distance = node.At("reference_distance_m");
  if (distance.Number() != kReferenceDistance) throw distance.Error("is not 1, expected metres");
  return air;
}

void ReadSkyShape(const JsonNode& node, const SpectralBins& bins, Daylight* light) {
  constexpr double kMost = 4;  // far beyond what skies have
  light->sky_shape = {ReadBins(node.At("gradation"), bins), ReadBins(node.At("glow"), bins)};
  for (const Spectrum& power : {light->sky_shape.gradation, light->sky_shape.glow}) {
    if ((power.abs() > kMost).any()) throw node.Error("is no sky, expected powers of -4 to 4");
  }
  if (const auto seen = node.Find("photographed_radiance")) {
    light->photographed_sky = ReadBins(*seen, bins);
  }
}

Daylight ReadLight(const JsonNode& node, const SpectralBins& bins) {
  Daylight light;
  light.sun_direction = ReadUnit(node.At("sun_direction"));
  light.sun_solid_angle = node.At("sun_solid_angle").Number();
  light.sun_is_one_direction = node.At("sun_is_one_direction").Boolean();
  light.zenith_direction = ReadUnit(node.At("zenith_direction"));
  light.polar_facets = node.At("polar_facets").Integer();
  if (light.polar_facets < 1 || light.polar_facets > kMostPolarFacets) {
    throw node.At("polar_facets").Error("is not within 1 to 16");
  }
  light.sun_radiance = ReadBins(node.At("sun_radiance"), bins);
  light.ambient_radiance = ReadBins(node.At("ambient_radiance"), bins);
  light.sky_radiance = ReadBins(node.At("sky_radiance"), bins);
  if (const auto shape = node.Find("sky_shape")) ReadSkyShape(*shape, bins, &light);
  return light;
}

// Chromaticities x, y, those of the white last.
Json::Value PrimariesToJson(const RgbPrimaries& primaries) {
  Json::Value json(Json::arrayValue);
  for (const Eigen::Vector2d& xy :
       {primaries.red, primaries.green, primaries.blue, primaries.white}) {
    json.append(ToJson(Eigen::VectorXd(xy)));
  }
  return json;
}

Eigen::Vector2d ReadChromaticity(const JsonNode& node) {
  const std::vector<double> xy = node.Numbers();
  if (xy.size() != 2 || !(xy[0] >= 0 && xy[1] > 0 && xy[0] + xy[1] <= 1)) {
    throw node.Error("is no chromaticity, expected x and y");
  }
  return {xy[0], xy[1]};
}

RgbPrimaries ReadPrimaries(const JsonNode& node) {
  const std::vector<JsonNode> items = node.Items();
  if (items.size() != 4) throw node.Error("expected those of red, green, blue and white");
  const auto at = [&items](size_t i) { return ReadChromaticity(items[i]); };
  return {at(0), at(1), at(2), at(3)};
}

SpectralBins ReadSpectralBins(const JsonNode& node) {
  const int count = node.Integer();
  if (count < kFewestBins || count > kMaxBins) {
    throw node.Error("is out of range, expected " + std::to_string(kFewestBins) + " to " +
                     std::to_string(kMaxBins));
  }
  return {count};
}

}  // namespace

Json::Value BinsJson(const Spectrum& spectrum, const SpectralBins& bins) {
  return ToJson(Eigen::VectorXd(spectrum.head(bins.count).matrix()));
}

Json::Value DescriptionOf(const NaturalEnvironment& environment,
                          const std::filesystem::path& file) {
  const size_t cameras = environment.scene.cameras.size(),
               covariances = environment.scene.camera_covariances.size();
  INSITU_CHECK(environment.input_images.size() == cameras);
  INSITU_CHECK(environment.qualities.empty() || environment.qualities.size() == cameras);
  INSITU_CHECK(covariances == 0 || covariances == cameras);
  const SpectralBins& bins = environment.spectra.bins();
  Json::Value json;
  json["format"] = kFormat;
  json["version"] = kVersion;
  json["bins"] = bins.count;
  json["basis_primaries"] = PrimariesToJson(environment.spectra.basis_primaries());
  json["scene"] = SceneToJson(environment, file.parent_path());
  json["materials"] = Json::Value(Json::objectValue);
  for (const auto& [name, material] : environment.materials) {
    json["materials"][name] = MaterialToJson(material);
  }
  json["air"] = AirToJson(environment.air, bins);
  json["light"] = LightToJson(environment.light, bins);
  return json;
}

NaturalEnvironment ReadEnvironment(const SitePaths& site) {
  RequireResult(site.environment(), "insitu-light");
  const JsonNode root = JsonNode::Load(site.environment());
  const JsonNode format = root.At("format");
  if (format.Text() != kFormat) throw format.Error("expected \"" + std::string(kFormat) + "\"");
  const JsonNode version = root.At("version");
  if (version.Integer() != kVersion) {
    throw version.Error("is not this insitu's, expected " + std::to_string(kVersion) +
                        ": run insitu-light again");
  }
  NaturalEnvironment environment;
  environment.spectra = SpectralBasis(Rec709(), ReadSpectralBins(root.At("bins")),
                                      ReadPrimaries(root.At("basis_primaries")));
  const SpectralBins& bins = environment.spectra.bins();
  ReadScene(root.At("scene"), &environment);
  environment.materials = ReadMaterials(root, environment.scene);
  environment.air = ReadAir(root.At("air"), bins);
  environment.light = ReadLight(root.At("light"), bins);
  return environment;
}

}  // namespace insitu
