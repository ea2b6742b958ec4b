// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/gltf/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"
#include "renderer/gltf/gltf_json.h"

namespace insitu {
namespace {

constexpr int kFloat = 5126;

int SizeOfComponent(int type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case kFloat:
      return 4;
    default:
      return 0;
  }
}

int ComponentsOf(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  return type == "VEC4" ? 4 : 0;
}

// `components` numbers of a row at a place.
template <typename T>
void TakeRow(const char* at, int components, bool normalized, double* to) {
  for (int i = 0; i < components; ++i) {
    T value{};
    std::memcpy(&value, at + sizeof(T) * i, sizeof(T));
    to[i] = static_cast<double>(value);
    if constexpr (!std::is_floating_point_v<T>) {
      if (normalized) {
        to[i] = std::max(to[i] / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
      }
    }
  }
}

using RowTaker = void (*)(const char*, int, bool, double*);

RowTaker TakerOf(int type) {
  switch (type) {
    case 5120:
      return TakeRow<int8_t>;
    case 5121:
      return TakeRow<uint8_t>;
    case 5122:
      return TakeRow<int16_t>;
    case 5123:
      return TakeRow<uint16_t>;
    case 5125:
      return TakeRow<uint32_t>;
    default:
      return TakeRow<float>;
  }
}

// Rows of numbers in a buffer view.
struct Rows {
  int view = 0;
  size_t offset = 0, stride = 0, count = 0;
  int type = kFloat, components = 1;
  bool normalized = false;
  std::string what;  // for messages
};

void ReadRows(GltfFile* file, const Rows& rows, double* to) {
  const std::string_view bytes = file->View(rows.view);
  const size_t row = static_cast<size_t>(SizeOfComponent(rows.type)) * rows.components;
  const size_t stride = rows.stride > 0 ? rows.stride : row;
  const size_t end = rows.count == 0 ? 0 : rows.offset + stride * (rows.count - 1) + row;
  if (end > bytes.size()) {
    throw InputError(file->path(), rows.what + " ends at byte " + std::to_string(end) +
                                       " of buffer view " + std::to_string(rows.view) +
                                       ", which has " + std::to_string(bytes.size()));
  }
  const RowTaker take = TakerOf(rows.type);
  for (size_t i = 0; i < rows.count; ++i) {
    take(bytes.data() + rows.offset + stride * i, rows.components, rows.normalized,
         to + static_cast<size_t>(rows.components) * i);
  }
}

void PutSparse(GltfFile* file, const Json::Value& sparse, const Rows& rows, GltfValues* values) {
  const Json::Value& at = MemberOf(sparse, "indices");
  const Json::Value& what = MemberOf(sparse, "values");
  Rows places{.view = IndexOf(at, "bufferView").value_or(-1),
              .offset = static_cast<size_t>(IndexOf(at, "byteOffset").value_or(0)),
              .count = static_cast<size_t>(IndexOf(sparse, "count").value_or(0)),
              .type = IndexOf(at, "componentType").value_or(0),
              .what = rows.what};
  if (SizeOfComponent(places.type) == 0 || places.count > rows.count) {
    throw InputError(file->path(), rows.what + " has sparse values of an unknown kind");
  }
  Rows new_rows = rows;
  new_rows.view = IndexOf(what, "bufferView").value_or(-1);
  new_rows.offset = IndexOf(what, "byteOffset").value_or(0);
  new_rows.stride = 0;
  new_rows.count = places.count;
  std::vector<double> indices(places.count), numbers(places.count * rows.components);
  ReadRows(file, places, indices.data());
  ReadRows(file, new_rows, numbers.data());
  for (size_t i = 0; i < places.count; ++i) {
    if (!(indices[i] >= 0 && indices[i] < static_cast<double>(rows.count))) {
      throw InputError(file->path(), rows.what + " has a sparse value beyond its end");
    }
    std::copy_n(
        numbers.begin() + static_cast<std::ptrdiff_t>(i) * rows.components, rows.components,
        values->numbers.begin() + static_cast<std::ptrdiff_t>(indices[i]) * rows.components);
  }
}

Rows RowsOf(const GltfFile& file, int index) {
  const Json::Value& accessor = file.Item("accessors", index, "a mesh");
  Rows rows{.offset = static_cast<size_t>(IndexOf(accessor, "byteOffset").value_or(0)),
            .count = static_cast<size_t>(IndexOf(accessor, "count").value_or(0)),
            .type = IndexOf(accessor, "componentType").value_or(0),
            .components = ComponentsOf(TextOf(accessor, "type")),
            .normalized = MemberOf(accessor, "normalized") == Json::Value(true),
            .what = "accessor " + std::to_string(index)};
  if (SizeOfComponent(rows.type) == 0 || rows.components == 0) {
    throw InputError(file.path(), rows.what + " is of the unknown kind " +
                                      std::to_string(rows.type) + ", " +
                                      Quoted(TextOf(accessor, "type")));
  }
  return rows;
}

}  // namespace

GltfValues ReadGltfAccessor(GltfFile* file, int index) {
  Rows rows = RowsOf(*file, index);
  const Json::Value& accessor = file->Item("accessors", index, "a mesh");
  const std::optional<int> view = IndexOf(accessor, "bufferView");
  constexpr size_t kMostOfNothing = 10'000'000;
  GltfValues values{rows.components, {}};
  if (view) {
    rows.view = *view;
    rows.stride = IndexOf(file->Item("bufferViews", *view, rows.what), "byteStride").value_or(0);
    if (rows.count > file->View(*view).size()) {
      throw InputError(file->path(), rows.what + " states more than its buffer view holds");
    }
  } else if (rows.count > kMostOfNothing) {
    throw InputError(file->path(), rows.what + " has no buffer view");
  }
  values.numbers.resize(rows.count * rows.components);
  if (view) ReadRows(file, rows, values.numbers.data());
  const Json::Value& sparse = MemberOf(accessor, "sparse");
  if (sparse.isObject()) PutSparse(file, sparse, rows, &values);
  return values;
}

std::vector<uint32_t> ReadGltfIndices(GltfFile* file, int index) {
  if (RowsOf(*file, index).type == kFloat) {
    throw InputError(file->path(), "accessor " + std::to_string(index) + " holds no whole numbers");
  }
  const GltfValues values = ReadGltfAccessor(file, index);
  std::vector<uint32_t> indices(values.numbers.size());
  std::ranges::transform(values.numbers, indices.begin(), [](double number) {
    return static_cast<uint32_t>(std::max(number, 0.0));
  });
  return indices;
}

}  // namespace insitu
