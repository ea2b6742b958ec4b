// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/gltf/gltf_draco.h"

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <array>

namespace insitu {
namespace {

GltfValues ValuesOf(const draco::PointAttribute& attribute, uint32_t points) {
  constexpr int kMostComponents = 4;
  GltfValues values;
  values.components = std::min<int>(attribute.num_components(), kMostComponents);
  values.numbers.reserve(size_t{points} * values.components);
  for (draco::PointIndex i(0); i < points; ++i) {
    std::array<float, kMostComponents> row{};
    attribute.ConvertValue<float>(attribute.mapped_index(i), static_cast<int8_t>(values.components),
                                  row.data());
    for (int c = 0; c < values.components; ++c) values.numbers.push_back(row[c]);
  }
  return values;
}

}  // namespace

std::optional<DracoMesh> DecodeDraco(std::string_view bytes,
                                     const std::map<std::string, int>& ids) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return std::nullopt;
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  DracoMesh result;
  for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f) {
    for (const draco::PointIndex& point : mesh->face(f)) result.indices.push_back(point.value());
  }
  for (const auto& [name, id] : ids) {
    const draco::PointAttribute* attribute =
        mesh->GetAttributeByUniqueId(static_cast<uint32_t>(id));
    if (attribute) result.attributes[name] = ValuesOf(*attribute, mesh->num_points());
  }
  return result;
}

}  // namespace insitu
