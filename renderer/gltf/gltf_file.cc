// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/gltf/gltf_file.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"
#include "renderer/foreign/cut_short.h"
#include "renderer/foreign/file_reference.h"
#include "renderer/foreign/text_lines.h"
#include "renderer/gltf/gltf_json.h"

namespace insitu {
namespace {

constexpr size_t kGlbHead = 12, kChunkHead = 8;

uint32_t WordAt(const std::string& bytes, size_t place) {
  uint32_t word = 0;
  if (place + sizeof(word) <= bytes.size()) {
    std::memcpy(&word, bytes.data() + place, sizeof(word));
  }
  return word;
}

// What is no digit of base 64 is passed over.
std::string FromBase64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() * 3 / 4);
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    uint32_t digit = 0;
    if (c >= 'A' && c <= 'Z') {
      digit = c - 'A';
    } else if (c >= 'a' && c <= 'z') {
      digit = c - 'a' + 26;
    } else if (c >= '0' && c <= '9') {
      digit = c - '0' + 52;
    } else if (c == '+' || c == '-') {
      digit = 62;
    } else if (c == '/' || c == '_') {
      digit = 63;
    } else {
      continue;
    }
    bits = bits << 6 | digit;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<char>(bits >> count & 0xFF));
  }
  return bytes;
}

void Decode(const std::string& mode, std::string_view from, size_t count, size_t stride,
            std::string* to, int* status) {
  const auto* data = reinterpret_cast<const unsigned char*>(from.data());
  if (mode == "TRIANGLES") {
    *status = meshopt_decodeIndexBuffer(to->data(), count, stride, data, from.size());
  } else if (mode == "INDICES") {
    *status = meshopt_decodeIndexSequence(to->data(), count, stride, data, from.size());
  } else if (mode == "ATTRIBUTES") {
    *status = meshopt_decodeVertexBuffer(to->data(), count, stride, data, from.size());
  }
}

// False: unknown, or none for this stride.
bool Filter(const std::string& filter, size_t count, size_t stride, std::string* bytes) {
  if (filter.empty() || filter == "NONE") return true;
  if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) {
    meshopt_decodeFilterOct(bytes->data(), count, stride);
  } else if (filter == "QUATERNION" && stride == 8) {
    meshopt_decodeFilterQuat(bytes->data(), count, stride);
  } else if (filter == "EXPONENTIAL") {
    meshopt_decodeFilterExp(bytes->data(), count, stride);
  } else {
    return false;
  }
  return true;
}

bool IsStrideOf(const std::string& mode, size_t stride) {
  if (mode == "ATTRIBUTES") return stride > 0 && stride <= 256 && stride % 4 == 0;
  return stride == 2 || stride == 4;
}

}  // namespace

GltfFile::GltfFile(const std::filesystem::path& path) : path_(path) {
  std::string bytes = ReadWhole(path);
  if (bytes.starts_with("glTF")) {
    ReadBinary(bytes);
  } else {
    json_ = ParseJson(path, DecodedText(std::move(bytes)));
  }
  const std::string version = TextOf(MemberOf(json_, "asset"), "version");
  if (version.starts_with("2.") || version == "2") return;
  throw InputError(
      path, "is glTF of version " + Quoted(version) + ", expected 2.0: export it anew, or as OBJ");
}

void GltfFile::ReadBinary(const std::string& bytes) {
  const uint32_t version = WordAt(bytes, 4);
  if (version != 2) {
    throw InputError(path_,
                     "is binary glTF of version " + std::to_string(version) + ", expected 2");
  }
  RequireLength(path_, WordAt(bytes, 8));
  const size_t length = WordAt(bytes, kGlbHead), start = kGlbHead + kChunkHead;
  if (bytes.size() < start + length) {
    throw InputError(path_, "its JSON goes on beyond the file's end: it is cut short");
  }
  json_ = ParseJson(path_, bytes.substr(start, length));
  const size_t next = start + length;
  if (bytes.size() < next + kChunkHead) return;
  binary_ = bytes.substr(next + kChunkHead, WordAt(bytes, next));
}

const Json::Value& GltfFile::Find(const char* list, int index) const {
  const Json::Value& items = MemberOf(json_, list);
  const bool is_there = items.isArray() && index >= 0 && index < static_cast<int>(items.size()) &&
                        items[index].isObject();
  return is_there ? items[index] : Json::Value::nullSingleton();
}

const Json::Value& GltfFile::Item(const char* list, int index, const std::string& user) const {
  const Json::Value& item = Find(list, index);
  if (!item.isNull()) return item;
  throw InputError(path_,
                   user + " names " + list + "[" + std::to_string(index) + "], which is not there");
}

std::string GltfFile::BytesOfUri(const std::string& uri) {
  if (uri.starts_with("data:")) {
    const size_t comma = std::min(uri.find(','), uri.size());
    return FromBase64(std::string_view(uri).substr(std::min(comma + 1, uri.size())));
  }
  const auto file = FindReference(path_, uri);
  if (!file) {
    throw InputError(path_, "names the file " + Quoted(uri) +
                                ", which is not there: put it beside the model, or export .glb, "
                                "which holds all in one file");
  }
  files_.push_back(*file);
  return ReadWhole(*file);
}

const std::string& GltfFile::Buffer(int index) {
  const Json::Value& buffer = Item("buffers", index, "a buffer view");
  const std::string uri = TextOf(buffer, "uri");
  if (uri.empty() && index == 0) return binary_;
  const auto [found, is_new] = buffers_.try_emplace(index);
  if (is_new && !uri.empty()) found->second = BytesOfUri(uri);
  return found->second;
}

std::string_view GltfFile::Part(int buffer, const Json::Value& place, const std::string& what) {
  const std::string& bytes = Buffer(buffer);
  const size_t first = IndexOf(place, "byteOffset").value_or(0);
  const size_t length = IndexOf(place, "byteLength").value_or(0);
  if (first > bytes.size() || length > bytes.size() - first) {
    throw InputError(path_, what + " ends at byte " + std::to_string(first + length) +
                                " of buffer " + std::to_string(buffer) + ", which has " +
                                std::to_string(bytes.size()) + ": the file is cut short");
  }
  return std::string_view(bytes).substr(first, length);
}

std::string_view GltfFile::View(int index) {
  const Json::Value& view = Item("bufferViews", index, "an accessor or image");
  const Json::Value& compression = ExtensionOf(view, "EXT_meshopt_compression");
  if (compression.isObject()) return Decompressed(index, compression);
  return Part(IndexOf(view, "buffer").value_or(0), view, "buffer view " + std::to_string(index));
}

const std::string& GltfFile::Decompressed(int index, const Json::Value& compression) {
  const auto [found, is_new] = decompressed_.try_emplace(index);
  if (!is_new) return found->second;
  const std::string what = "buffer view " + std::to_string(index);
  const std::string_view from = Part(IndexOf(compression, "buffer").value_or(0), compression, what);
  const std::string mode = TextOf(compression, "mode");
  const size_t count = IndexOf(compression, "count").value_or(0);
  const size_t stride = IndexOf(compression, "byteStride").value_or(0);
  constexpr size_t kMostPerByte = 1000;  // what compresses better was made up
  int status = -1;
  if (IsStrideOf(mode, stride) && count <= from.size() * kMostPerByte) {
    found->second.resize(count * stride);
    Decode(mode, from, count, stride, &found->second, &status);
  }
  if (status != 0 || !Filter(TextOf(compression, "filter"), count, stride, &found->second)) {
    throw InputError(path_, what +
                                " cannot be decompressed (EXT_meshopt_compression): it is "
                                "damaged; export it without compression");
  }
  return found->second;
}

}  // namespace insitu
