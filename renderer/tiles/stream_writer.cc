// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/tiles/stream_writer.h"

#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <utility>

namespace insitu {
namespace {

constexpr int kMostPhoto = 256;  // [px] of the reduced photograph
constexpr auto kHeartbeat = std::chrono::seconds(1);
constexpr int kPatienceMs = 3000;                 // at the end, with a reader that does not read
constexpr size_t kMostAtOnce = size_t{64} << 10;  // [bytes]

}  // namespace

StreamFormat TextFormat(StreamCoding coding) {
  return {
      .begin = StreamBegin,
      .image =
          [](const std::string& name, const Raster& photo) {
            return ImageStatement(name, photo.width, photo.height) +
                   PhotoStatement(Reduced(photo, kMostPhoto));
          },
      .tile =
          [coding](const std::string&, const Raster& photo, const FinishedTile& tile) {
            return TileStatement(photo.width, photo.height, tile.index, TileCodes(tile, photo),
                                 coding);
          },
      .progress = ProgressStatement,
      .end = EndStatement,
  };
}

RenderStream::RenderStream(int file, StreamFormat format)
    : file_(file), format_(std::move(format)) {
  signal(SIGPIPE, SIG_IGN);
  head_ = format_.begin();
  thread_ = std::thread([this] { Run(); });
}

RenderStream::~RenderStream() {
  {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
  }
  news_.notify_all();
  thread_.join();
}

void RenderStream::Begin(const std::string& name, const Raster& photo) {
  if (is_closed_) return;
  const std::string image = format_.image(name, photo);
  const std::lock_guard lock(mutex_);
  // Of the picture before, what was not sent is sent before this one.
  head_ += std::exchange(tail_, {}) + image;
  name_ = name;
  photo_ = &photo;
  done_ = 0;
  news_.notify_all();
}

void RenderStream::Take(const FinishedTile& tile) {
  if (is_closed_) return;
  const std::lock_guard lock(mutex_);
  tiles_[tile.index] = tile;
  ++done_;
  news_.notify_all();
}

void RenderStream::End(bool is_whole) {
  const std::lock_guard lock(mutex_);
  if (!photo_) return;
  for (const auto& [index, tile] : std::exchange(tiles_, {})) {
    tail_ += format_.tile(name_, *photo_, tile);
  }
  tail_ +=
      format_.progress(done_, TileCount(photo_->width, photo_->height)) + format_.end(is_whole);
  photo_ = nullptr;
  news_.notify_all();
}

// Of what there is to be sent, as much as is written at once; a sign of life if there is nothing.
std::string RenderStream::NextText(std::unique_lock<std::mutex>* lock) {
  const auto is_news = [this] {
    return !head_.empty() || !tiles_.empty() || !tail_.empty() || is_ended_;
  };
  news_.wait_for(*lock, kHeartbeat, is_news);
  std::string text = std::exchange(head_, {});
  while (!tiles_.empty() && text.size() < kMostAtOnce) {
    const auto first = tiles_.begin();
    text += format_.tile(name_, *photo_, first->second);
    tiles_.erase(first);
  }
  if (!tiles_.empty()) return text;
  text += std::exchange(tail_, {});
  if (photo_) text += format_.progress(done_, TileCount(photo_->width, photo_->height));
  return text;
}

void RenderStream::Run() {
  std::unique_lock lock(mutex_);
  while (true) {
    const std::string text = NextText(&lock);
    if (text.empty() && is_ended_) return;
    lock.unlock();
    const bool is_written = Write(text);
    lock.lock();
    if (!is_written) {
      is_closed_ = true;
      return;
    }
  }
}

// False: nobody reads any more. A pipe that is ready takes PIPE_BUF bytes without waiting; to make
// it non-blocking would make it so for everybody who has it open.
bool RenderStream::Write(const std::string& text) {
  size_t written = 0;
  while (written < text.size()) {
    pollfd ready = {file_, POLLOUT, 0};
    const int found = poll(&ready, 1, kPatienceMs);
    if (found < 0 && errno == EINTR) continue;
    if (found > 0 && (ready.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0) return false;
    if (found == 0 && IsEnded()) return false;
    if (found <= 0) continue;
    const size_t most = std::min<size_t>(text.size() - written, PIPE_BUF);
    const ssize_t count = write(file_, text.data() + written, most);
    if (count < 0 && errno != EAGAIN && errno != EINTR) return false;
    if (count <= 0) continue;
    written += static_cast<size_t>(count);
    bytes_ += count;
  }
  return true;
}

bool RenderStream::IsEnded() {
  const std::lock_guard lock(mutex_);
  return is_ended_;
}

}  // namespace insitu
