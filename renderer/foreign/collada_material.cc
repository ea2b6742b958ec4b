// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/collada_material.h"

#include <algorithm>

#include "calibration/color/color_space.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

class ColladaMaterialReader {
 public:
  ColladaMaterialReader(const ColladaLibrary& library, Model* model)
      : library_(library), model_(*model) {}

  SurfaceNames Read(const XmlNode& material) {
    names_.material = material.Attribute("name").value_or("");
    if (names_.material.empty()) names_.material = material.Attribute("id").value_or("");
    const auto instance = material.Find("instance_effect");
    const auto effect =
        instance ? library_.Find("effect", instance->Attribute("url").value_or("")) : std::nullopt;
    const auto profile = effect ? effect->Find("profile_COMMON") : std::nullopt;
    if (!profile) {
      Skip("material without profile_COMMON", "its colour is unknown");
      return names_;
    }
    for (const XmlNode& parameter : effect->Children("newparam")) AddParameter(parameter);
    for (const XmlNode& parameter : profile->Children("newparam")) AddParameter(parameter);
    const auto technique = profile->Find("technique");
    if (technique) {
      for (const char* shader : {"lambert", "phong", "blinn", "constant"}) {
        if (const auto found = technique->Find(shader)) ReadShader(*found);
      }
    }
    return names_;
  }

 private:
  void AddParameter(const XmlNode& parameter) {
    if (const auto id = parameter.Attribute("sid")) parameters_.try_emplace(*id, parameter);
  }

  void ReadShader(const XmlNode& shader) {
    const auto diffuse = shader.Find(shader.Name() == "constant" ? "emission" : "diffuse");
    if (diffuse) ReadDiffuse(*diffuse);
    ReadOpacity(shader);
    if (const auto index = NumberIn(shader, "index_of_refraction"); index && *index > 1) {
      names_.index = *index;
    }
    for (const char* gloss : {"specular", "reflective"}) {
      const auto node = shader.Find(gloss);
      const auto shine = node ? ColorIn(*node) : std::nullopt;
      if (shine && shine->head<3>().maxCoeff() > 0) {
        Skip(gloss, "shown as a diffuse surface: see specular of materials.json");
      }
    }
    const auto emission = shader.Find("emission");
    const auto color = emission ? ColorIn(*emission) : std::nullopt;
    if (shader.Name() != "constant" && color && color->head<3>().maxCoeff() > 0) {
      Skip("emission", "its faces do not shine: list lamps in lights.json");
    }
  }

  void ReadDiffuse(const XmlNode& diffuse) {
    if (const auto color = ColorIn(diffuse)) {
      Vector3d rgb = color->head<3>().cwiseMax(0).cwiseMin(1);
      for (double& channel : rgb) channel = LinearFromSrgb(channel);
      names_.rgb = rgb;
    }
    const auto texture = diffuse.Find("texture");
    if (!texture) return;
    const auto image = ImageOf(texture->Attribute("texture").value_or(""));
    const auto file = image ? image->Find("init_from") : std::nullopt;
    const auto reference = file ? file->Find("ref") : std::nullopt;
    if (file) names_.texture = reference ? reference->Text() : file->Text();
    if (names_.texture.find_first_not_of(" \t\r\n") == std::string::npos) {
      names_.texture.clear();
      return Skip("texture", "names no image: its colour alone is shown");
    }
    names_.texture_place = file->path().string() + ":" + std::to_string(file->line());
    if (!names_.rgb) names_.rgb = Vector3d::Ones();
  }

  // A sampler's, a surface's, or the image's own name, as careless programs write it.
  std::optional<XmlNode> ImageOf(std::string name) const {
    constexpr int kMostSteps = 4;
    for (int step = 0; step < kMostSteps; ++step) {
      if (const auto image = library_.Find("image", name)) return image;
      const auto parameter = parameters_.find(name);
      if (parameter == parameters_.end()) return std::nullopt;
      name = SourceOf(parameter->second);
    }
    return std::nullopt;
  }
  static std::string SourceOf(const XmlNode& parameter) {
    for (const char* kind : {"sampler2D", "surface"}) {
      const auto node = parameter.Find(kind);
      if (!node) continue;
      if (const auto image = node->Find("instance_image")) {
        return image->Attribute("url").value_or("");
      }
      const auto source = node->Find(node->Name() == "surface" ? "init_from" : "source");
      return source ? source->Text() : "";
    }
    return "";
  }

  void ReadOpacity(const XmlNode& shader) {
    const auto transparent = shader.Find("transparent");
    const auto transparency = NumberIn(shader, "transparency");
    if (!transparent && !transparency) return;
    if (transparent && transparent->Find("texture")) {
      return Skip("texture of transparency", "not shown");
    }
    const double share = std::clamp(transparency.value_or(1), 0.0, 1.0);
    const auto stated = transparent ? transparent->Attribute("opaque") : std::nullopt;
    const std::string mode = stated.value_or("A_ONE");
    const auto color = transparent ? ColorIn(*transparent) : std::nullopt;
    const Vector4d c = color.value_or(Vector4d::Ones());
    const double luminance = Vector3d(0.212671, 0.715160, 0.072169).dot(c.head<3>());
    double opacity = c[3] * share;
    if (mode == "RGB_ZERO") opacity = 1 - luminance * share;
    if (mode == "RGB_ONE") opacity = luminance * share;
    if (mode == "A_ZERO") opacity = 1 - c[3] * share;
    if (!stated && opacity <= 0) {
      return Skip("transparency 0 of no stated meaning", "taken as opaque");
    }
    names_.opacity = std::clamp(opacity, 0.0, 1.0);
  }

  std::optional<Vector4d> ColorIn(const XmlNode& node) {
    const auto color = node.Find("color");
    if (!color) return std::nullopt;
    int faulty = 0;
    std::vector<double> numbers = ColladaNumbers(*color, &faulty);
    if (faulty > 0 || numbers.size() < 3) {
      Skip("colour", "no three numbers");
      return std::nullopt;
    }
    numbers.resize(3 + std::min<size_t>(numbers.size() - 3, 1));
    return Vector4d(numbers[0], numbers[1], numbers[2], numbers.size() > 3 ? numbers[3] : 1);
  }
  static std::optional<double> NumberIn(const XmlNode& shader, const char* name) {
    const auto node = shader.Find(name);
    const auto number = node ? node->Find("float") : std::nullopt;
    if (!number) return std::nullopt;
    int faulty = 0;
    const std::vector<double> numbers = ColladaNumbers(*number, &faulty);
    if (faulty > 0 || numbers.empty()) return std::nullopt;
    return numbers.front();
  }
  void Skip(const char* kind, const char* reason) { ++model_.skipped[{kind, reason}]; }

  const ColladaLibrary& library_;
  Model& model_;
  SurfaceNames names_;
  std::map<std::string, XmlNode> parameters_;
};

}  // namespace

SurfaceNames ReadColladaMaterial(const ColladaLibrary& library, const XmlNode& material,
                                 Model* model) {
  return ColladaMaterialReader(library, model).Read(material);
}

}  // namespace insitu
