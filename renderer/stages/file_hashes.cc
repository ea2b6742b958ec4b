// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/stages/file_hashes.h"

#include <json/value.h>
#include <sys/stat.h>

#include <ctime>
#include <optional>
#include <utility>

#include "calibration/files/json_file.h"
#include "calibration/files/sha256.h"

namespace insitu {
namespace {

constexpr int kStoreVersion = 1;
constexpr int64_t kClockGrain_ns = 2'000'000'000;

int64_t Nanoseconds(const timespec& time) { return time.tv_sec * 1'000'000'000LL + time.tv_nsec; }

int64_t Now() {
  timespec now = {};
  clock_gettime(CLOCK_REALTIME, &now);
  return Nanoseconds(now);
}

std::optional<Json::Value> ReadStore(const std::filesystem::path& store) {
  if (!std::filesystem::exists(store)) return std::nullopt;
  try {
    Json::Value json = ReadJson(store);
    if (json.isObject() && json["version"] == kStoreVersion && json["files"].isObject())
      return json;
  } catch (const std::exception&) {  // it is only there to save time
  }
  return std::nullopt;
}

// Size, inode, three times, hash.
bool IsRow(const Json::Value& row) {
  if (!row.isArray() || row.size() != 6 || !row[5].isString()) return false;
  for (Json::ArrayIndex i = 0; i < 5; ++i) {
    if (!row[i].isInt64()) return false;
  }
  return true;
}

}  // namespace

FileHashes::FileHashes(std::filesystem::path store) : store_(std::move(store)) {
  const std::optional<Json::Value> json = ReadStore(store_);
  if (!json) return;
  const Json::Value& files = (*json)["files"];
  for (const std::string& path : files.getMemberNames()) {
    const Json::Value& row = files[path];
    if (!IsRow(row)) continue;
    Entry& entry = entries_[path];
    entry = {row[0].asInt64(), row[1].asInt64(), row[2].asInt64(),
             row[3].asInt64(), row[4].asInt64(), row[5].asString()};
  }
}

bool FileHashes::IsSame(const Entry& kept, const Entry& now) {
  const bool was_at_rest = kept.read_ns - kept.changed_ns > kClockGrain_ns;
  return was_at_rest && kept.size == now.size && kept.inode == now.inode &&
         kept.modified_ns == now.modified_ns && kept.changed_ns == now.changed_ns;
}

std::string FileHashes::Hash(const std::filesystem::path& path) {
  struct stat status = {};
  if (stat(path.c_str(), &status) != 0 || S_ISDIR(status.st_mode)) return "";
  Entry now = {status.st_size,
               static_cast<int64_t>(status.st_ino),
               Nanoseconds(status.st_mtim),
               Nanoseconds(status.st_ctim),
               Now(),
               ""};
  const std::string key = std::filesystem::absolute(path).lexically_normal().string();
  {
    const std::lock_guard lock(mutex_);
    const auto kept = entries_.find(key);
    if (kept != entries_.end() && IsSame(kept->second, now)) return kept->second.hash;
  }
  now.hash = Sha256(path);
  const std::lock_guard lock(mutex_);
  return (entries_[key] = now).hash;
}

void FileHashes::Save() const {
  const std::lock_guard lock(mutex_);
  Json::Value json;
  json["version"] = kStoreVersion;
  json["files"] = Json::Value(Json::objectValue);
  for (const auto& [path, entry] : entries_) {
    Json::Value& row = json["files"][path];
    for (const int64_t number :
         {entry.size, entry.inode, entry.modified_ns, entry.changed_ns, entry.read_ns}) {
      row.append(Json::Value::Int64(number));
    }
    row.append(entry.hash);
  }
  WriteJson(store_, json);
}

}  // namespace insitu
