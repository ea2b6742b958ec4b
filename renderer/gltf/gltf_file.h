// SPDX-License-Identifier: GPL-3.0-or-later
// A glTF file of version 2, text or binary: its JSON and the bytes that it names.
#pragma once

#include <json/value.h>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace insitu {

class GltfFile {
 public:
  // Throws InputError: no JSON, a binary file that is cut short, another version.
  explicit GltfFile(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  const Json::Value& json() const { return json_; }

  // json()[list][index]; null: not there.
  const Json::Value& Find(const char* list, int index) const;

  // The same. Throws InputError: not there; `user` says what names it.
  const Json::Value& Item(const char* list, int index, const std::string& user) const;

  // The bytes of a buffer view, decompressed if it is compressed by meshopt; they live as long as
  // this. Throws InputError: beyond its buffer, a buffer that is not there, faulty compression.
  std::string_view View(int index);

  // Bytes that a URI holds ("data:...") or names. Throws InputError: neither.
  std::string BytesOfUri(const std::string& uri);

  const std::vector<std::filesystem::path>& files() const { return files_; }  // read for buffers

 private:
  void ReadBinary(const std::string& bytes);
  const std::string& Buffer(int index);
  std::string_view Part(int buffer, const Json::Value& place, const std::string& what);
  const std::string& Decompressed(int index, const Json::Value& compression);

  std::filesystem::path path_;
  Json::Value json_;
  std::string binary_;  // the chunk of a binary file
  std::vector<std::filesystem::path> files_;
  std::map<int, std::string> buffers_, decompressed_;
};

}  // namespace insitu
