// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/gltf/gltf_material.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibration/files/error.h"
#include "renderer/gltf/gltf_json.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

Vector3d ColorIn(const Json::Value& value, const char* name, const Vector3d& other) {
  const auto color = NumbersOf(value, name, 3);
  return color ? Vector3d(color->cwiseMax(0).cwiseMin(1)) : other;
}

class GltfMaterialReader {
 public:
  GltfMaterialReader(GltfFile* file, const Json::Value& json, Model* model)
      : file_(*file), json_(json), model_(*model) {}

  GltfMaterial Read(const std::string& name) {
    material_.names.material = name;
    const Json::Value& gloss = ExtensionOf(json_, "KHR_materials_pbrSpecularGlossiness");
    const Json::Value& metal = MemberOf(json_, "pbrMetallicRoughness");
    if (gloss.isObject()) {
      ReadColor(gloss, "diffuseFactor", "diffuseTexture");
    } else {
      ReadColor(metal, "baseColorFactor", "baseColorTexture");
    }
    ReadGlass();
    ReadTranslucence();
    ReadMaps(metal);
    CountWhatIsNotShown(gloss, metal);
    return material_;
  }

 private:
  void ReadColor(const Json::Value& value, const char* factor, const char* texture) {
    material_.names.rgb = ColorIn(value, factor, Vector3d::Ones());
    const auto four = NumbersOf(value, factor, 4);
    const double alpha = four ? std::clamp((*four)[3], 0.0, 1.0) : 1;
    const std::string mode = TextOf(json_, "alphaMode");
    if (mode == "BLEND") material_.names.opacity = alpha;
    if (mode == "MASK") {
      material_.names.opacity = alpha >= NumberOf(json_, "alphaCutoff", 0.5) ? 1 : 0;
    }
    const Json::Value& place = MemberOf(value, texture);
    if (!IndexOf(place, "index")) return;
    ReadPlace(place);
    material_.names.texture = ImageOf(place, "its colour alone is shown");
  }

  // An image that says something else, at the colour's places.
  void ReadMap(const Json::Value& value, const char* name, std::vector<SurfaceMap> maps) {
    const Json::Value& place = MemberOf(value, name);
    if (!IndexOf(place, "index")) return;
    if (!has_place_) {
      ReadPlace(place);
    } else if (!IsAtPlace(place)) {
      return Skip(name, "lies otherwise than the colour: left out");
    }
    const std::string file = ImageOf(place, "left out");
    if (file.empty()) return;
    for (SurfaceMap& map : maps) {
      map.file = file;
      material_.names.maps.push_back(map);
    }
  }

  bool IsAtPlace(const Json::Value& place) {
    const GltfMaterial colored = material_;
    ReadPlace(place);
    const bool is_alike = material_.texture_set == colored.texture_set &&
                          material_.image_from_texture.isApprox(colored.image_from_texture);
    material_ = colored;
    return is_alike;
  }

  void ReadPlace(const Json::Value& place) {
    has_place_ = true;
    material_.image_from_texture = Eigen::Affine2d::Identity();
    const Json::Value& transform = ExtensionOf(place, "KHR_texture_transform");
    material_.texture_set =
        IndexOf(transform, "texCoord").value_or(IndexOf(place, "texCoord").value_or(0));
    const auto offset = NumbersOf(transform, "offset", 2), scale = NumbersOf(transform, "scale", 2);
    const double turn = NumberOf(transform, "rotation", 0);
    // T R S of the specification, v down: its rotation is clockwise for us.
    if (offset) material_.image_from_texture.translate(Eigen::Vector2d(*offset));
    material_.image_from_texture.rotate(Eigen::Rotation2Dd(-turn));
    if (scale) material_.image_from_texture.scale(Eigen::Vector2d(*scale));
  }

  // As SurfaceNames has it; empty, and counted as skipped: none that is read.
  std::string ImageOf(const Json::Value& place, const std::string& without) {
    const Json::Value& texture = file_.Find("textures", *IndexOf(place, "index"));
    const auto skipped = [&](const std::string& why) {
      ++model_.skipped[{"texture", why + ": " + without}];
      return std::string();
    };
    if (texture.isNull()) return skipped("is not there");
    auto source = IndexOf(texture, "source");
    if (const auto webp = IndexOf(ExtensionOf(texture, "EXT_texture_webp"), "source")) {
      if (!source) source = webp;
    }
    if (!source) return skipped("of a kind that is not read");
    const Json::Value& image = file_.Find("images", *source);
    if (image.isNull()) return skipped("its image is not there");
    material_.names.texture_place = file_.path().string();
    const std::string uri = TextOf(image, "uri"), name = "*" + std::to_string(*source);
    if (const auto view = IndexOf(image, "bufferView")) return ImageWithin(name, *view);
    if (!uri.starts_with("data:")) return uri;
    model_.images[name] = file_.BytesOfUri(uri);
    return name;
  }

  std::string ImageWithin(const std::string& name, int view) {
    try {
      model_.images[name] = std::string(file_.View(view));
      return name;
    } catch (const InputError& error) {
      model_.warnings.push_back(std::string(error.what()) + ": the texture of material \"" +
                                material_.names.material + "\" is left out");
      return "";
    }
  }

  // Normals; roughness in the green and metal in the blue channel; what goes through in the red.
  void ReadMaps(const Json::Value& metal) {
    using Kind = SurfaceMap::Kind;
    ReadMap(json_, "normalTexture",
            {{.kind = Kind::kNormal,
              .factor = NumberOf(MemberOf(json_, "normalTexture"), "scale", 1)}});
    ReadMap(
        metal, "metallicRoughnessTexture",
        {{.kind = Kind::kRoughness,
          .channel = 1,
          .factor = NumberOf(metal, "roughnessFactor", 1),
          .is_squared = true},
         {.kind = Kind::kMetallic, .channel = 2, .factor = NumberOf(metal, "metallicFactor", 1)}});
    const Json::Value& transmission = ExtensionOf(json_, "KHR_materials_transmission");
    if (material_.names.opacity < 1) {
      ReadMap(transmission, "transmissionTexture",
              {{.kind = Kind::kTransmission, .factor = 1 - material_.names.opacity}});
    }
  }

  void ReadGlass() {
    const Json::Value& transmission = ExtensionOf(json_, "KHR_materials_transmission");
    const double through = NumberOf(transmission, "transmissionFactor", 0);
    material_.names.opacity *= 1 - std::clamp(through, 0.0, 1.0);
    const double index = NumberOf(ExtensionOf(json_, "KHR_materials_ior"), "ior", 1.5);
    if (index > 1) material_.names.index = index;
    const Json::Value& volume = ExtensionOf(json_, "KHR_materials_volume");
    material_.names.is_solid = NumberOf(volume, "thicknessFactor", 0) > 0;
    const double distance = NumberOf(volume, "attenuationDistance", 0);
    if (distance <= 0) return;
    constexpr double kDarkest = 1e-6;
    material_.names.absorption_rgb =
        -ColorIn(volume, "attenuationColor", Vector3d::Ones()).cwiseMax(kDarkest).array().log() /
        distance;
    material_.names.absorption_rgb = material_.names.absorption_rgb.cwiseMax(0);
  }

  // A share of the diffuse part goes to the other side.
  void ReadTranslucence() {
    const Json::Value& diffuse = ExtensionOf(json_, "KHR_materials_diffuse_transmission");
    const double share = std::clamp(NumberOf(diffuse, "diffuseTransmissionFactor", 0), 0.0, 1.0);
    if (share == 0) return;
    for (const char* map : {"diffuseTransmissionTexture", "diffuseTransmissionColorTexture"}) {
      if (MemberOf(diffuse, map).isObject()) Skip(map, "not shown");
    }
    if (material_.names.opacity < 1) {
      return Skip("KHR_materials_diffuse_transmission", "of glass: not shown");
    }
    material_.names.diffuse_weight = 1 - share;
    material_.names.translucent_rgb =
        share * ColorIn(diffuse, "diffuseTransmissionColorFactor", Vector3d::Ones());
  }

  void CountWhatIsNotShown(const Json::Value& gloss, const Json::Value& metal) {
    for (const char* map : {"occlusionTexture", "emissiveTexture"}) {
      if (MemberOf(json_, map).isObject()) Skip(map, "not shown");
    }
    if (MemberOf(gloss, "specularGlossinessTexture").isObject()) {
      Skip("specularGlossinessTexture", "not shown");
    }
    if (gloss.isObject() && ColorIn(gloss, "specularFactor", Vector3d::Ones()).maxCoeff() > 0.1) {
      Skip("specularFactor", "shown as a diffuse surface: see specular of materials.json");
    }
    if (ExtensionOf(json_, "KHR_materials_unlit").isObject()) {
      Skip("KHR_materials_unlit", "lit as any surface is");
    }
    const double strength =
        NumberOf(ExtensionOf(json_, "KHR_materials_emissive_strength"), "emissiveStrength", 1);
    if (ColorIn(json_, "emissiveFactor", Vector3d::Zero()).maxCoeff() * strength > 0) {
      Skip("emissiveFactor", "its faces do not shine: list lamps in lights.json");
    }
    if (NumberOf(metal, "metallicFactor", 0) > 0 &&
        !MemberOf(metal, "metallicRoughnessTexture").isObject()) {
      Skip("metallicFactor", "shown as a diffuse surface: see specular of materials.json");
    }
  }
  void Skip(const char* kind, const char* reason) { ++model_.skipped[{kind, reason}]; }

  GltfFile& file_;
  const Json::Value& json_;
  Model& model_;
  GltfMaterial material_;
  bool has_place_ = false;  // of an image on the surface
};

}  // namespace

GltfMaterial ReadGltfMaterial(GltfFile* file, int index, Model* model) {
  const Json::Value& json = file->Item("materials", index, "a mesh");
  std::string name = TextOf(json, "name");
  if (name.empty()) name = "material " + std::to_string(index);
  return GltfMaterialReader(file, json, model).Read(name);
}

}  // namespace insitu
