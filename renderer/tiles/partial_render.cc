// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/tiles/partial_render.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <map>
#include <stdexcept>
#include <utility>

#include "calibration/files/error.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr auto kSyncInterval = std::chrono::seconds(5);  // which power loss may cost, about
constexpr size_t kMostReadBytes = size_t{64} << 20;

[[noreturn]] void ThrowCannot(const fs::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + ": cannot be " + what + ": " + std::strerror(errno));
}

struct flock WholeFile(int16_t type) {
  struct flock lock = {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  return lock;
}

// Locks belong to the opened file, so that they end with the program, however that ends.
bool Lock(int file) {
  struct flock lock = WholeFile(F_WRLCK);
  return fcntl(file, F_OFD_SETLK, &lock) == 0;
}

bool IsLocked(int file) {
  struct flock lock = WholeFile(F_WRLCK);
  return fcntl(file, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

// Whether the opened file is still the one of that name.
bool IsAt(int file, const fs::path& path) {
  struct stat opened = {}, named = {};
  return fstat(file, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

// Opened and locked; made if it is not there.
int OpenLocked(const fs::path& path) {
  if (path.has_parent_path()) fs::create_directories(path.parent_path());
  while (true) {
    const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file < 0) ThrowCannot(path, "opened");
    if (!Lock(file)) {
      close(file);
      throw InputError(path, "another program is rendering this picture: wait for it or stop it");
    }
    if (IsAt(file, path)) return file;
    close(file);  // removed meanwhile by the one that has finished it
  }
}

std::string ReadFrom(int file, size_t offset, size_t most) {
  std::string content(most, '\0');
  size_t size = 0;
  while (size < most) {
    const ssize_t count =
        pread(file, content.data() + size, most - size, static_cast<off_t>(offset + size));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    size += static_cast<size_t>(count);
  }
  content.resize(size);
  return content;
}

size_t SizeOf(int file) {
  struct stat about = {};
  return fstat(file, &about) == 0 ? static_cast<size_t>(about.st_size) : 0;
}

}  // namespace

PartialRender::PartialRender(std::filesystem::path path, const PartialHeader& header)
    : path_(std::move(path)), header_(header), file_(OpenLocked(path_)) {
  try {
    const std::string content = ReadFrom(file_, 0, SizeOf(file_));
    size_t header_bytes = 0;
    const auto there = ReadHeader(content, &header_bytes);
    if (there == header_) {
      GoOn(content, header_bytes);
    } else {
      Begin();
    }
  } catch (...) {
    close(file_);
    throw;
  }
  syncing_ = std::jthread([this](const std::stop_token& stop) {
    std::mutex waiting;
    std::unique_lock lock(waiting);
    std::condition_variable_any ended;
    while (!ended.wait_for(lock, stop, kSyncInterval, [&] { return stop.stop_requested(); })) {
      fdatasync(file_);
    }
  });
}

PartialRender::~PartialRender() {
  syncing_.request_stop();
  syncing_.join();
  fdatasync(file_);
  close(file_);
}

void PartialRender::Begin() {
  if (ftruncate(file_, 0) != 0) ThrowCannot(path_, "written");
  bytes_ = 0;
  Write(HeaderText(header_));
  if (!failure_.empty()) throw std::runtime_error(failure_);
}

// What follows the last whole record is of a write that was cut short.
void PartialRender::GoOn(const std::string& content, size_t header_bytes) {
  std::map<int, size_t> places;  // in earlier_
  bytes_ = header_bytes;
  size_t length = 0;
  while (auto tile = ReadTileRecord(std::string_view(content).substr(bytes_), header_, &length)) {
    bytes_ += length;
    const auto [place, is_new] = places.try_emplace(tile->index, earlier_.size());
    if (is_new) earlier_.emplace_back();
    earlier_[place->second] = std::move(*tile);  // the last: it was wanted with other layers
  }
  if (ftruncate(file_, static_cast<off_t>(bytes_)) != 0) ThrowCannot(path_, "written");
}

void PartialRender::Write(const std::string& bytes) {
  size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count = pwrite(file_, bytes.data() + written, bytes.size() - written,
                                 static_cast<off_t>(bytes_ + written));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      failure_ = path_.string() + ": cannot be written: " + std::strerror(errno);
      has_failed_ = true;
      if (ftruncate(file_, static_cast<off_t>(bytes_)) != 0) return;  // the check sum tells it too
      return;
    }
    written += static_cast<size_t>(count);
  }
  bytes_ += bytes.size();
}

std::vector<FinishedTile> PartialRender::TakeEarlier() { return std::exchange(earlier_, {}); }

void PartialRender::Keep(const FinishedTile& tile) {
  const std::string record = TileRecord(tile);
  const std::lock_guard lock(mutex_);
  if (failure_.empty()) Write(record);
}

std::string PartialRender::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

void PartialRender::Remove() {
  std::error_code ignored;  // what is left is read by the next run, which comes to the same bytes
  fs::remove(path_, ignored);
}

PartialRenderReader::~PartialRenderReader() { Close(); }

void PartialRenderReader::Close() {
  if (file_ >= 0) close(file_);
  file_ = -1;
  bytes_ = 0;
  header_.reset();
}

// Whether what was read stands in the file as it was.
bool PartialRenderReader::IsStill() const {
  if (!IsAt(file_, path_) || SizeOf(file_) < bytes_) return false;
  size_t length = 0;
  return ReadHeader(ReadFrom(file_, 0, kMostHeaderBytes), &length) == header_;
}

PartialRenderReader::News PartialRenderReader::Read() {
  News news;
  if (file_ >= 0 && !IsStill()) {
    Close();
    news.is_anew = true;
  }
  if (file_ < 0) file_ = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0) return news;
  const size_t there = SizeOf(file_) - bytes_;
  const std::string content = ReadFrom(file_, bytes_, std::min(there, kMostReadBytes));
  std::string_view rest = content;
  size_t length = 0;
  if (!header_) {
    header_ = ReadHeader(rest, &length);
    if (!header_) return news;
    news.is_anew = true;
    rest.remove_prefix(length);
  }
  while (auto tile = ReadTileRecord(rest, *header_, &length)) {
    rest.remove_prefix(length);
    tile->layers = {};
    news.tiles.push_back(std::move(*tile));
  }
  bytes_ += content.size() - rest.size();
  news.header = header_;
  news.is_running = IsLocked(file_);
  return news;
}

}  // namespace insitu
