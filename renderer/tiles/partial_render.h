// SPDX-License-Identifier: GPL-3.0-or-later
// work/render/<photo>.partial: the tiles of a render as they finish, so that it outlives Ctrl-C,
// kill -9, a full disk and power loss, and can be watched while it runs.
#pragma once

#include <atomic>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "renderer/tiles/tile_record.h"

namespace insitu {

// The file of a render that runs. While it is open nobody else renders the same picture.
class PartialRender {
 public:
  // Goes on with the file if it is of the same picture and inputs, else begins it anew. Throws
  // InputError: another program renders this picture; std::runtime_error: it cannot be written.
  PartialRender(std::filesystem::path path, const PartialHeader& header);
  ~PartialRender();
  PartialRender(const PartialRender&) = delete;
  PartialRender& operator=(const PartialRender&) = delete;

  // What an earlier run has left, each tile once; empty the second time.
  std::vector<FinishedTile> TakeEarlier();

  // From any thread. What cannot be written is told by failure() and leaves the file as it was.
  void Keep(const FinishedTile& tile);

  bool has_failed() const { return has_failed_; }
  std::string failure() const;  // "": none

  void Remove();  // when the result is written

 private:
  void Begin();
  void GoOn(const std::string& content, size_t header_bytes);
  void Write(const std::string& bytes);

  const std::filesystem::path path_;
  const PartialHeader header_;
  int file_ = -1;
  std::vector<FinishedTile> earlier_;
  mutable std::mutex mutex_;  // of what follows
  size_t bytes_ = 0;
  std::string failure_;
  std::atomic<bool> has_failed_ = false;
  std::jthread syncing_;
};

// The same file followed by others, whoever renders.
class PartialRenderReader {
 public:
  explicit PartialRenderReader(std::filesystem::path path) : path_(std::move(path)) {}
  ~PartialRenderReader();
  PartialRenderReader(const PartialRenderReader&) = delete;
  PartialRenderReader& operator=(const PartialRenderReader&) = delete;

  struct News {
    std::optional<PartialHeader> header;  // nullopt: there is no such render
    bool is_anew = false;                 // all that was told before does not hold any more
    bool is_running = false;              // else it was stopped, and waits
    std::vector<FinishedTile> tiles;      // since the last call, without their layers
  };
  News Read();  // at most about 64 MB at a time

 private:
  bool IsStill() const;
  void Close();

  const std::filesystem::path path_;
  int file_ = -1;
  size_t bytes_ = 0;  // that were read
  std::optional<PartialHeader> header_;
};

}  // namespace insitu
